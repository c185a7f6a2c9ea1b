// SPDX-License-Identifier: Apache-2.0
//
// What a program of the project ends with, and the errors of the command line.
#pragma once

#include <stdexcept>

namespace halfspace {

/// What a program ends with.
enum ExitCode : int {
  kOk = 0,
  kDiffers = 1,     ///< compare: by more than is tolerated
  kUsage = 2,       ///< the command line cannot be understood
  kBadInput = 3,    ///< an unknown scene, a wrong key or value, a file that cannot be read
  kCannotWrite = 4  ///< the result cannot be written
};

/// A command line that cannot be understood. what() is one line.
class UsageError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Two pictures that differ by more than is tolerated. what() is one line.
class DifferenceError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace halfspace
