// SPDX-License-Identifier: Apache-2.0
//
// Exit codes of the programs, and command-line errors.
#pragma once

#include <stdexcept>

namespace halfspace {

/// The exit codes of the programs.
enum ExitCode : int {
  kOk = 0,
  kDiffers = 1,     ///< compare, check-lesson: the images differ by more than is accepted
  kUsage = 2,       ///< invalid command line
  kBadInput = 3,    ///< unknown scene, invalid key or value, unreadable file, or out of memory
  kCannotWrite = 4  ///< the result cannot be written
};

/// The command line is invalid. what() is one line.
class UsageError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Images differ by more than is accepted. what() is one line.
class DifferenceError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace halfspace
