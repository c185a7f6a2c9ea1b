// SPDX-License-Identifier: Apache-2.0
#include "command_line/command_line.h"

#include <CLI/CLI.hpp>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <iostream>
#include <memory>
#include <string_view>
#include <vector>

#include "command_line/errors.h"
#include "command_line/progress.h"
#include "halfspace/core/check.h"
#include "halfspace/core/text.h"
#include "halfspace/image/atomic_output.h"

namespace halfspace {

namespace {

std::atomic<bool> is_quiet = false;

// Removes partial output files and then lets the signal terminate the program, as the parent process expects. The handler is installed with
// SA_RESETHAND, so the default handler receives the raised signal when this one returns.
extern "C" void on_signal(int signal) {
  remove_unfinished_output();
  clear_progress();
  std::raise(signal);
}

void handle_signals() {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGPIPE}) {
    struct sigaction old = {};
    if (::sigaction(signal, nullptr, &old) != 0) continue;
    // Signals that nohup or the shell ignore stay ignored, except that a program whose reader has enough always ends without a message.
    if (old.sa_handler == SIG_IGN && signal != SIGPIPE) continue;
    struct sigaction action = {};
    action.sa_handler = on_signal;
    action.sa_flags = static_cast<int>(SA_RESETHAND);
    ::sigaction(signal, &action, nullptr);
  }
}

// Returns the long option names of a parser, or the names of its subcommands.
std::vector<std::string> names_of(const CLI::App& app, bool options) {
  std::vector<std::string> names;
  if (options) {
    for (const CLI::Option* option : app.get_options()) {
      for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
    }
  } else {
    for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; })) names.push_back(command->get_name());
  }
  return names;
}

std::string suggested_word(std::string_view wrong, const std::vector<std::string>& names) {
  const std::vector<std::string_view> views(names.begin(), names.end());
  return suggestion(wrong, views);
}

std::string see_help(const CLI::App& program) {
  const std::vector<CLI::App*> chosen = program.get_subcommands();
  return "; see '" + program.get_name() + " " + (chosen.empty() ? "" : chosen.front()->get_name() + " ") + "--help'";
}

// Returns an error about the first argument that was not parsed, with a suggestion if there is a similar valid name.
UsageError unknown_argument(const CLI::App& program) {
  const std::vector<CLI::App*> chosen = program.get_subcommands();
  const CLI::App& app = chosen.empty() ? program : *chosen.front();
  std::vector<std::string> rest = app.remaining();
  if (rest.empty()) rest = program.remaining();
  const bool only_positional = std::erase(rest, "--") > 0;  // arguments after "--" are not options
  const std::string word = rest.empty() ? "" : rest.front();
  if (word.starts_with("-") && !only_positional)
    return UsageError("unknown option '" + word + "'" + suggested_word(word.substr(0, word.find('=')), names_of(app, true)));
  if (chosen.empty() && !names_of(program, false).empty())
    return UsageError("unknown command '" + word + "'" + suggested_command(word, program));
  return UsageError((chosen.empty() ? "" : app.get_name() + ": ") + "unexpected argument '" + word + "'" + see_help(program));
}

// Joins the lines of a CLI11 message, which may have several.
std::string one_line(std::string text) {
  for (char& c : text) {
    if (c == '\n') c = ' ';
  }
  while (text.ends_with(' ') || text.ends_with('.')) text.pop_back();
  return text;
}

// Describes an option with too few or too many values.
std::string mismatch(const CLI::ArgumentMismatch& e) {
  const std::string text = one_line(e.what());
  const std::string::size_type end = text.find(": At Most 1 required");
  return end == std::string::npos ? text : text.substr(0, end) + " is given more than once; expected it once";
}

// Prints an error as a single line. Control characters and invalid UTF-8, which can come from files or arguments, are escaped.
int report(const CLI::App& program, ExitCode code, std::string_view what) {
  std::fputs((program.get_name() + ": " + printable(what) + "\n").c_str(), stderr);
  return code;
}

// Omits the value that CLI11 prints in braces after a flag: it is not a default, but the value of the flag if it is given without one.
class HelpFormatter : public CLI::Formatter {
  std::string make_help(const CLI::App* app, std::string name, CLI::AppFormatMode mode) const override {
    std::string text = CLI::Formatter::make_help(app, std::move(name), mode);
    // Omitted groups leave gaps.
    for (std::size_t gap = text.find("\n\n\n"); gap != std::string::npos; gap = text.find("\n\n\n")) text.erase(gap, 1);
    return text;
  }
  std::string make_group(std::string group, bool is_positional, std::vector<const CLI::Option*> options) const override {
    return group == kUnlistedGroup || group == kOutputGroup ? "" : CLI::Formatter::make_group(group, is_positional, options);
  }
  // Omits the headline: positional arguments are listed directly below the usage line.
  std::string make_positionals(const CLI::App* app) const override {
    const std::string text = CLI::Formatter::make_positionals(app);
    return text.empty() ? text : text.substr(text.find(":\n") + 2);
  }
  std::string make_option_name(const CLI::Option* option, bool positional) const override {
    const std::string name = CLI::Formatter::make_option_name(option, positional);
    return name.substr(0, name.find('{'));
  }
};

}  // namespace

std::string suggested_command(std::string_view wrong, const CLI::App& program) { return suggested_word(wrong, names_of(program, false)); }

std::vector<std::string> words_after(const CLI::App& program, const std::string& command) {
  if (command.empty()) return names_of(program, false);
  for (const CLI::App* c : program.get_subcommands([](const CLI::App*) { return true; })) {
    if (c->get_name() == command) return names_of(*c, true);
  }
  return {};
}

void set_common_options(CLI::App& program) {
  program.set_help_flag("-h,--help", "Print this help and exit");
  program.set_version_flag("--version", program.get_name() + " " HALFSPACE_VERSION, "Print the version and exit");
  program.formatter(std::make_shared<HelpFormatter>());
  program.get_formatter()->column_width(28);
}

void print_warning(const std::string& problem) {
  if (!is_quiet) print_problem("warning: " + problem);
}

void print_note(const std::string& result) {
  if (!is_quiet) print_problem(result);
}

void print_problem(const std::string& problem) {
  clear_progress();
  std::fputs(("halfspace: " + printable(problem) + "\n").c_str(), stderr);
}

void set_quiet(bool quiet) { is_quiet = quiet; }

ExitCode exit_code_of(const std::exception& e) {
  if (dynamic_cast<const UsageError*>(&e) != nullptr) return kUsage;
  if (dynamic_cast<const DifferenceError*>(&e) != nullptr) return kDiffers;
  return dynamic_cast<const OutputError*>(&e) != nullptr ? kCannotWrite : kBadInput;
}

std::string message_of(const std::exception& e) {
  if (dynamic_cast<const std::bad_alloc*>(&e) != nullptr) return "not enough memory; expected a smaller --size or smaller maps";
  const bool is_own = exit_code_of(e) != kBadInput || dynamic_cast<const InputError*>(&e) != nullptr;
  return is_own ? e.what() : std::string("system error: ") + e.what();
}

int run_program(CLI::App& program, const std::function<void()>& parse_and_run) {
  handle_signals();
  try {
    parse_and_run();
  } catch (const CLI::ExtrasError&) {
    return report(program, kUsage, unknown_argument(program).what());
  } catch (const CLI::ArgumentMismatch& e) {
    return report(program, kUsage, mismatch(e) + see_help(program));
  } catch (const CLI::ParseError& e) {
    if (e.get_exit_code() != 0) return report(program, kUsage, one_line(e.what()) + see_help(program));
    program.exit(e, std::cout, std::cerr);  // --help
  } catch (const std::exception& e) {
    return report(program, exit_code_of(e), message_of(e));
  }
  errno = 0;  // 0 afterwards if the stream had failed before
  std::cout.flush();
  if (!std::cout)
    return report(program, kCannotWrite, "standard output: cannot write" + (errno == 0 ? "" : std::string(": ") + std::strerror(errno)));
  return kOk;
}

}  // namespace halfspace
