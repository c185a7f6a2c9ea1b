// SPDX-License-Identifier: Apache-2.0
//
// The subcommands of `halfspace`. Each adds itself to the parser, with its options and help, and runs when chosen.
#pragma once

#include <CLI/CLI.hpp>
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

/// They throw UsageError, InputError or OutputError from the parser's callback.
void add_render_command(CLI::App& program);
void add_convert_normal_command(CLI::App& program);
void add_validate_command(CLI::App& program);  // where the program has rays
void add_compare_command(CLI::App& program);
void add_chart_command(CLI::App& program);  // where the program has rays
void add_list_command(CLI::App& program);
void add_info_command(CLI::App& program);
void add_completion_command(CLI::App& program);

}  // namespace halfspace
