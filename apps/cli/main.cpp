// SPDX-License-Identifier: Apache-2.0
//
// The command line program: its subcommands and their options.
#include <CLI/CLI.hpp>
#include <memory>
#include <string>
#include <vector>

#include "cli/command_line.h"
#include "cli/commands.h"
#include "cli/errors.h"

namespace halfspace {

namespace {

// --set KEY=VALUE, which may be given several times.
void add_set_option(CLI::App* command, std::vector<std::string>& settings) {
  command->add_option("--set", settings, "Set a key ('halfspace list SCENE' tells all)")
      ->type_name("KEY=VALUE")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
}

void add_render_command(CLI::App& program) {
  CLI::App* command = program.add_subcommand("render", "Render a scene to a picture, or to numbered frames");
  const auto args = std::make_shared<RenderArguments>();
  command->add_option("SCENE", args->scene, "A scene's name, or a scene file")->required()->type_name("");
  command->add_option("-o,--output", args->out, ".png .jpg .tif, or linear .exr .hdr")->type_name("OUT");
  command->add_option("--size", args->size, "Pixels (default 1920x1080)")->type_name("WxH");
  add_set_option(command, args->set);
  command->add_option("--camera", args->camera, "One of the scene's cameras")->type_name("NAME");
  command->add_option("--shading", args->shading, "Light all by: none flat provoking gouraud phong")->type_name("RATE");
  command->add_option("--time", args->time, "Seconds into the animation (default 0)")->type_name("S");
  command->add_option("--frames", args->frames, "Frames A to B into OUT_0000.png, ...")->type_name("A..B");
  command->add_option("--fps", args->fps, "Frames per second (default 30)")->type_name("N");
  command->add_option("--max-error", args->max_error, "Cheapest model with edges this right")->type_name("PX");
  command->add_option("--max-error-color", args->max_error_color, "... with colours this right, in codes")->type_name("E");
  command->add_flag("--resume", args->resume, "Leave out frames that are there, whole");
  command->add_option("--threads", args->threads, "Threads (default: one a core)")->type_name("N");
  command->add_flag("--stats{text}", args->statistics, "Print times and counts, as text or JSON")->option_text("[=json]");
  command->add_flag("--print", args->print, "Print the scene with all settings instead");
  command->footer(
      "Examples:\n"
      "  halfspace render earth -o earth.png --size 1280x720\n"
      "  halfspace render moon --set moon.color=lroc.png --frames 0..47 -o out/moon.png");
  command->callback([args] { render_command(*args); });
}

void add_convert_normal_command(CLI::App& program) {
  CLI::App* command = program.add_subcommand("convert-normal", "Make a normal map of a map of heights");
  const auto args = std::make_shared<ConvertNormalArguments>();
  command->add_option("HEIGHT", args->height, "Image of heights, 8 or 16 bits or floats")->required()->type_name("");
  command->add_option("-o,--output", args->out, "PNG in tangent space, green up")->required()->type_name("NORMAL");
  command->add_option("--strength", args->strength, "Texels from black up to white (default 8)")->type_name("S");
  command->add_option("--edges", args->edges, "repeat (default), clamp, or sphere")->type_name("E");
  command->footer(
      "Examples:\n"
      "  halfspace convert-normal bricks_height.png -o bricks_normal.png\n"
      "  halfspace convert-normal earthbump.tif -o out.png --strength 30 --edges sphere");
  command->callback([args] { convert_normal_command(*args); });
}

#if HALFSPACE_HAS_RAYS
void add_validate_command(CLI::App& program) {
  CLI::App* command = program.add_subcommand("validate", "Hold a scene's shadows against rays");
  const auto args = std::make_shared<ValidateArguments>();
  command->add_option("SCENE", args->scene, "A scene's name, or a scene file")->type_name("");
  command->add_flag("--json", args->json, "Report as JSON: one object per light");
  command->add_option("-o,--output", args->out, "Write pictures: map, truth, difference; or a chart")->type_name("DIR");
  command->add_flag("--table", args->table, "Every bias and filter on four scenes, as CSV");
  command->add_flag("--full", args->full, "With --table: every combination (hours)");
  add_set_option(command, args->set);
  command->add_option("--size", args->size, "Pixels (default 960x540)")->type_name("WxH");
  command->add_option("--camera", args->camera, "One of the scene's cameras")->type_name("NAME");
  command->add_option("--time", args->time, "Seconds into the animation (default 0)")->type_name("S");
  command->add_option("--rays", args->rays, "Per pixel, for lights with a size (default 1024)")->type_name("N");
  command->add_option("--threads", args->threads, "Threads (default: one a core)")->type_name("N");
  command->footer(
      "Examples:\n"
      "  halfspace validate moon --json\n"
      "  halfspace validate shadow-plane --set shadow.bias=constant -o out");
  command->callback([args] { validate_command(*args); });
}

void add_chart_command(CLI::App& program) {
  CLI::App* command = program.add_subcommand("chart", "Measure error against time, as charts");
  const auto args = std::make_shared<ChartArguments>();
  command->add_option("STUDY", args->study, "all, or one of those below")->required()->type_name("");
  command->add_option("-o,--output", args->out, "Folder (default charts)")->type_name("DIR");
  command->add_flag("--quick", args->quick, "Small pictures: to see that it works");
  command->add_option("--threads", args->threads, "Default: one per core")->type_name("N");
  command->footer("Studies:" + study_lines() +
                  "\nExamples:\n"
                  "  halfspace chart all -o charts\n"
                  "  halfspace chart shading_rate --quick");
  command->callback([args] { chart_command(*args); });
}
#else
void add_validate_command(CLI::App&) {}
void add_chart_command(CLI::App&) {}
#endif

void add_compare_command(CLI::App& program) {
  CLI::App* command = program.add_subcommand("compare", "Tell how far two pictures are from each other");
  const auto args = std::make_shared<CompareArguments>();
  command->add_option("A", args->a, "A picture")->required()->type_name("");
  command->add_option("B", args->b, "Another one of the same size")->required()->type_name("");
  command->add_flag("--json", args->json, "Report as JSON");
  command->add_option("-o,--output", args->out, "Write the differences as colours (PNG)")->type_name("DIFF");
  command->add_option("--tolerance", args->tolerance, "Exit 1 where a channel differs by more")->type_name("T");
  command->footer(
      "Examples:\n"
      "  halfspace compare before.png after.png -o difference.png\n"
      "  halfspace compare golden.exr moon.exr --tolerance 0.004 --json");
  command->callback([args] { compare_command(*args); });
}

void add_list_command(CLI::App& program) {
  CLI::App* command = program.add_subcommand("list", "List the scenes, or the keys of a scene");
  const auto args = std::make_shared<ListArguments>();
  command->add_option("SCENE", args->scene, "A scene's name or file: list its keys")->type_name("");
  command->add_flag("--names", args->names, "Names alone, one a line");
  command->add_flag("--schema", args->schema, "The JSON Schema of scene files instead");
  command->footer("Examples:\n  halfspace list\n  halfspace list moon");
  command->callback([args] { list_command(*args); });
}

void add_info_command(CLI::App& program) {
  CLI::App* command = program.add_subcommand("info", "Tell version, instruction set, compiler, cores and modules");
  const auto args = std::make_shared<InfoArguments>();
  command->add_flag("--json", args->json, "As JSON");
  command->footer("Examples:\n  halfspace info\n  halfspace info --json");
  command->callback([args] { info_command(*args); });
}

void add_completion_command(CLI::App& program) {
  CLI::App* command = program.add_subcommand("completion", "Print a script that completes words in a shell");
  const auto args = std::make_shared<CompletionArguments>();
  command->add_option("SHELL", args->shell, "bash, zsh or fish; words or studies for a list")->required()->type_name("");
  command->add_option("COMMAND", args->command, "With words: the command whose options to print")->type_name("");
  command->footer(
      "Examples:\n  halfspace completion bash >> ~/.bashrc\n  halfspace completion fish | "
      "source");
  command->callback(
      [args, &program] { completion_command(*args, [&program](const std::string& name) { return words_after(program, name); }); });
}

void parse_and_run(CLI::App& program, int argc, char** argv) {
  program.name("halfspace");
  program.require_subcommand(0, 1);
  set_common_options(program);
  add_render_command(program);
  add_convert_normal_command(program);
  add_validate_command(program);
  add_compare_command(program);
  add_chart_command(program);
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
