// SPDX-License-Identifier: Apache-2.0
//
// What every program of the project does alike: help, signals, and one line on standard error with an exit code for what went
// wrong.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace CLI {
class App;
}

namespace halfspace {

/// --help and --version, and how help is laid out. The program has its name.
void set_common_options(CLI::App& program);

/// "; did you mean 'COMMAND'?" or the list of the program's subcommands: the tail of an error line.
std::string suggested_command(std::string_view wrong, const CLI::App& program);

/// The options of the subcommand of that name ("--NAME"), or the names of all subcommands for "".
std::vector<std::string> words_after(const CLI::App& program, const std::string& command);

/// Runs parse_and_run, which names the program, parses and may throw what parsers and commands do. Returns the exit code.
int run_program(CLI::App& program, const std::function<void()>& parse_and_run);

}  // namespace halfspace
