// SPDX-License-Identifier: Apache-2.0
//
// Behavior shared by all programs of the project: help, signal handling, and errors, which are reported by one line on standard error and
// an exit code.
#pragma once

#include <exception>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "command_line/errors.h"

namespace CLI {
class App;
}

namespace halfspace {

/// The name of the group of options that the help of a command omits.
inline constexpr const char* kUnlistedGroup = "unlisted";
inline constexpr const char* kOutputGroup = "unlisted output";

/// Adds --help and --version and sets the layout of the help text. The name of the program must already be set.
void set_common_options(CLI::App& program);

/// Returns the end of an error message: "; did you mean 'COMMAND'?" if a subcommand is similar, else a list of the subcommands.
std::string suggested_command(std::string_view wrong, const CLI::App& program);

/// Returns the options of a subcommand as "--NAME", or the names of all subcommands if `command` is empty.
std::vector<std::string> words_after(const CLI::App& program, const std::string& command);

/// Print a warning, the result of a run, or a problem that does not end the run, as a single line on standard error. Control characters and
/// invalid UTF-8 are escaped. Warnings and results are not printed if the program is quiet.
void print_warning(const std::string& problem);
void print_note(const std::string& result);
void print_problem(const std::string& problem);

/// Sets whether the program is quiet.
void set_quiet(bool quiet);

/// Returns the exit code for an exception, and its line for standard error.
ExitCode exit_code_of(const std::exception& e);
std::string message_of(const std::exception& e);

/// Calls parse_and_run, reports any exception that it throws, and returns the exit code. parse_and_run must set the program's name.
int run_program(CLI::App& program, const std::function<void()>& parse_and_run);

}  // namespace halfspace
