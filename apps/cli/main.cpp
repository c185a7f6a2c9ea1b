// SPDX-License-Identifier: Apache-2.0
//
// The command line program: its subcommands.
#include <string>

#include "cli/command_line.h"

namespace halfspace {

namespace {

void parse_and_run(CLI::App& program, int argc, char** argv) {
  program.name("halfspace");
  program.require_subcommand(0, 1);
  set_common_options(program);
  add_render_command(program);
  add_convert_normal_command(program);
  if constexpr (HALFSPACE_HAS_RAYS) add_validate_command(program);
  add_compare_command(program);
  if constexpr (HALFSPACE_HAS_RAYS) add_chart_command(program);
  add_list_command(program);
  add_info_command(program);
  add_completion_command(program);
  program.footer("halfspace COMMAND --help tells more of a command.");
  if (argc < 2) throw UsageError("no command" + suggested_command("", program) + " (see 'halfspace --help')");
  program.parse(argc, argv);
}

}  // namespace

}  // namespace halfspace

int main(int argc, char** argv) {
  CLI::App program("Halfspace: a renderer that runs on the CPU alone");
  return halfspace::run_program(program, [&] { halfspace::parse_and_run(program, argc, argv); });
}
