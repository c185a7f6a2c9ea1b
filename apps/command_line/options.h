// SPDX-License-Identifier: Apache-2.0
//
// Declares options that several commands and programs share.
#pragma once

#include <string>
#include <vector>

#include "command_line/limit_arguments.h"
#include "command_line/model_arguments.h"

namespace CLI {
class App;
class Validator;
}  // namespace CLI

namespace halfspace {

/// Rejects an empty name, for example from an unset variable of a shell script.
CLI::Validator not_empty();

/// Adds --set KEY=VALUE, which can be given several times.
void add_set_option(CLI::App* command, std::vector<std::string>& settings);

/// Adds the view options that apply to scenes and models: --camera, --shading and --time.
void add_view_options(CLI::App* command, std::string& camera, std::string& shading, std::string& time);

/// Adds the options for model files. They are listed by --help-model, so that the help of the command fits on a screen.
/// with_turntable: whether the command accepts --turntable.
void add_model_options(CLI::App* command, ModelArguments& args, bool with_turntable = true);

/// Adds --max-memory and --max-pixels. If they are unlisted, --help-model lists them.
void add_limit_options(CLI::App* command, LimitArguments& args, bool is_listed = true);

/// Adds --max-primitives, for commands that draw or export models.
void add_primitive_limit_option(CLI::App* command, LimitArguments& args, bool is_listed = true);

/// Prints a group of options that the help of the command omits, and ends the program successfully.
void print_group(const CLI::App* command, const char* group, const std::string& title);

}  // namespace halfspace
