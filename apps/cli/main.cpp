// SPDX-License-Identifier: Apache-2.0
//
// The command-line program: declares the subcommands and their options.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <iostream>
#include <memory>
#include <string>
#include <vector>

#include "cli/commands.h"
#include "command_line/command_line.h"
#include "command_line/errors.h"
#include "command_line/options.h"

namespace halfspace {

namespace {

// Adds the options for the output. They are listed by --help-output, so that the help of the command fits on a screen.
void add_output_options(CLI::App* command, RenderArguments& args) {
  const auto add = [&](const char* name, std::string& value, const char* help, const char* type) {
    command->add_option(name, value, help)->type_name(type)->group(kOutputGroup);
  };
  const auto add_flag = [&](const char* name, bool& value, const char* help) { command->add_flag(name, value, help)->group(kOutputGroup); };
  add("--aov", args.output.aov, "Also write depth, distance, normal, ...", "LIST");
  add_flag("--aov-separate", args.output.separate, "Write each to its own file, OUT-depth.exr, ...");
  add("--bits", args.output.bits, "Bits per channel of a .png: 8 (default) or 16", "N");
  add("--crop", args.output.crop, "Render only this rectangle, from the top left", "X,Y,W,H");
  add("--format", args.format, "With -o -: png (default), y4m, rgb24, rgba, rgbaf32", "F");
  add("--loop", args.loop, "Play a .webp or .gif N times (default 0: forever)", "N");
  add("--list", args.list, "Also render the scenes in FILE, one per line; - is stdin", "FILE");
  add("--shard", args.shard, "Render only share I of N of the scenes or frames", "I/N");
  add_flag("--mpi", args.mpi, "Share the scenes or frames with the other processes of mpirun");
  add("--report", args.report, "With several scenes: write which failed, as JSON", "FILE");
  add("--progress", args.progress, "json: print a line of JSON per picture", "STYLE");
  add_flag("--verbose", args.verbose, "Print a line per picture");
  add_flag("--quiet", args.quiet, "Print only errors");
  command
      ->add_flag_callback(
          "--help-output",
          [command] {
            print_group(command, kOutputGroup,
                        "Output options of 'halfspace render'. OUT ends in .png, .jpg, .tif, .exr or .hdr, or is - for\n"
                        "standard output. With --frames or --turntable, one .webp or .gif can contain all frames. By default,\n"
                        "OUT is NAME.png for a scene or the scene file NAME.json, and NAME-render.png for a model file.\n"
                        "{name} in OUT stands for NAME; with several scenes, each needs its own file.\n"
                        "--aov accepts a comma-separated list of depth, distance, normal, camera_normal, albedo, position,\n"
                        "uv, object, instance, triangle and barycentrics.\n"
                        "They are written to OUT if that is an .exr file, and to OUT-aov.exr otherwise.\n"
                        "--frames accepts a frame (7), a range (0..47) or every tenth frame of a range (0..100:10). The number\n"
                        "follows NAME, as in NAME_0007.png. OUT can have a place for it instead: %03d for three digits, or\n"
                        "{frame} for those of NAME_0007. With --frames, %% in OUT is a percent sign.\n"
                        "--shard shares the scenes of a list, or the frames of a scene, among N processes, from 0 to N-1.");
          },
          "Print these options and exit")
      ->group(kOutputGroup);
}

void add_render_command(CLI::App& program) {
  CLI::App* command = program.add_subcommand("render", "Render a scene to an image or to numbered frames");
  const auto args = std::make_shared<RenderArguments>();
  command->add_option("SCENE", args->scenes, "Scenes, scene files or models (see --help-model)")->type_name("")->check(not_empty());
  command->add_option("-o,--output", args->out, "Picture (default NAME.png; see --help-output)")->type_name("OUT")->check(not_empty());
  command->add_option("--size", args->size, "Size in pixels (default 1920x1080)")->type_name("WxH");
  add_set_option(command, args->set);
  add_view_options(command, args->camera, args->shading, args->time);
  command->add_option("--frames", args->frames, "Render frames A to B (see --help-output)")->type_name("A..B");
  command->add_option("--fps", args->fps, "Frames per second (default 30)")->type_name("N");
  command->add_option("--max-error", args->max_error, "Use the cheapest model with edges within PX px")->type_name("PX");
  command->add_option("--max-error-color", args->max_error_color, "... and with colors within E 8-bit steps")->type_name("E");
  command->add_flag("--no-cache", args->no_cache, "Keep no simplified meshes in the cache folder")->group(kUnlistedGroup);
  command->add_flag("--resume", args->resume, "Keep pictures that would not change");
  command->add_option("--threads", args->threads, "Threads (default: one per core)")->type_name("N");
  command->add_flag("--stats{text}", args->statistics, "Print times and counts as text or JSON")->option_text("[=json]");
  command->add_flag("--print", args->print, "Print the scene with all settings and exit");
  command->add_flag("--wireframe{lines}", args->wireframe, "Draw only edges; =hidden omits hidden edges")->group(kUnlistedGroup);
  command->add_flag("--naive", args->naive, "Draw with the naive pipeline; report differences")->group(kUnlistedGroup);
  add_output_options(command, *args);
  add_model_options(command, args->model);
  add_limit_options(command, args->limits, false);
  add_primitive_limit_option(command, args->limits, false);
  command->footer(
      "Examples:\n"
      "  halfspace render earth -o earth.png --size 1280x720\n"
      "  halfspace render moon --set moon.color=lroc.png --frames 0..47 -o out/moon.png");
  command->callback([args] { render_command(*args); });
}

void add_explain_command(CLI::App& program) {
  CLI::App* command = program.add_subcommand("explain", "Write a web page that explains a frame");
  const auto args = std::make_shared<ExplainArguments>();
  command->add_option("SCENE", args->scene, "Scene, scene file or model file (see --help-model)")
      ->required()
      ->type_name("")
      ->check(not_empty());
  command->add_option("-o,--output", args->out, "Output file (default SCENE.html)")->type_name("PAGE")->check(not_empty());
  command->add_option("--pixel", args->pixel, "Pixel, from the upper left (default: an example; --text, --json: most fragments)")
      ->type_name("X,Y");
  command->add_option("--lessons", args->lessons, "Address of the folder docs/tutorial/lessons, for links to lessons")
      ->type_name("ADDRESS")
      ->check(not_empty());
  command->add_flag("--text", args->text, "Print the history of the pixel as text instead");
  command->add_flag("--json", args->json, "Print the history of the pixel as JSON instead");
  command->add_option("--size", args->size, "Size in pixels (default 640x360)")->type_name("WxH");
  add_set_option(command, args->set);
  add_view_options(command, args->camera, args->shading, args->time);
  command->add_option("--threads", args->threads, "Threads (default: one per core)")->type_name("N");
  add_model_options(command, args->model, false);
  add_limit_options(command, args->limits, false);
  add_primitive_limit_option(command, args->limits, false);
  command->footer(
      "Examples:\n"
      "  halfspace explain pipeline -o pipeline.html\n"
      "  halfspace explain day-night --pixel 320,180 --json");
  command->callback([args] { explain_command(*args); });
}

void add_export_command(CLI::App& program) {
  CLI::App* command = program.add_subcommand("export", "Write a scene or a model as glTF, OBJ, PLY or STL");
  const auto args = std::make_shared<ExportArguments>();
  command->add_option("SCENE", args->scene, "Scene, scene file or model file")->required()->type_name("")->check(not_empty());
  command->add_option("-o,--output", args->out, "Output file: .glb, .gltf, .obj, .ply or .stl")
      ->required()
      ->type_name("FILE")
      ->check(not_empty());
  add_set_option(command, args->set);
  command->add_flag("--allow-outside", args->allow_outside, "Read files outside the folder of the model");
  command->add_option("--threads", args->threads, "Threads (default: one per core)")->type_name("N");
  add_limit_options(command, args->limits);
  add_primitive_limit_option(command, args->limits);
  command->footer(
      "Examples:\n"
      "  halfspace export shapes -o shapes.glb\n"
      "  halfspace export chair.obj -o chair.gltf");
  command->callback([args] { export_command(*args); });
}

void add_convert_normal_command(CLI::App& program) {
  CLI::App* command = program.add_subcommand("convert-normal", "Convert a height map to a normal map");
  const auto args = std::make_shared<ConvertNormalArguments>();
  command->add_option("HEIGHT", args->height, "Height map with 8-bit, 16-bit or float texels")->required()->type_name("");
  command->add_option("-o,--output", args->out, "Normal map as PNG, in tangent space, green up")
      ->required()
      ->type_name("NORMAL")
      ->check(not_empty());
  command->add_option("--strength", args->strength, "Height of white, in texels (default 8)")->type_name("S");
  command->add_option("--edges", args->edges, "Edges of the map: repeat (default), clamp, sphere")->type_name("E");
  command->footer(
      "Examples:\n"
      "  halfspace convert-normal bricks_height.png -o bricks_normal.png\n"
      "  halfspace convert-normal earthbump.tif -o out.png --strength 30 --edges sphere");
  command->callback([args] { convert_normal_command(*args); });
}

#if HALFSPACE_HAS_RAYS
void add_validate_command(CLI::App& program) {
  CLI::App* command = program.add_subcommand("validate", "Compare the shadows of a scene with ray tracing");
  const auto args = std::make_shared<ValidateArguments>();
  command->add_option("SCENE", args->scene, "Scene, scene file or model file")->type_name("")->check(not_empty());
  command->add_flag("--json", args->json, "Report as JSON, one object per light");
  command->add_option("-o,--output", args->out, "Folder for images, or for the chart of --table")->type_name("DIR")->check(not_empty());
  command->add_flag("--table", args->table, "Score all biases and filters on four scenes (CSV)");
  command->add_flag("--full", args->full, "With --table: all combinations (takes hours)");
  add_set_option(command, args->set);
  command->add_option("--size", args->size, "Size in pixels (default 960x540)")->type_name("WxH");
  command->add_option("--camera", args->camera, "Name of one of the scene's cameras")->type_name("NAME");
  command->add_option("--time", args->time, "Seconds into the animation (default 0)")->type_name("S");
  command->add_flag("--allow-outside", args->model.allow_outside, "Read files outside the folder of the model");
  command->add_option("--rays", args->rays, "Rays per pixel for area lights (default 1024)")->type_name("N");
  command->add_option("--threads", args->threads, "Threads (default: one per core)")->type_name("N");
  add_limit_options(command, args->limits);
  add_primitive_limit_option(command, args->limits);
  command->footer(
      "Examples:\n"
      "  halfspace validate moon --json\n"
      "  halfspace validate shadow-plane --set shadow.bias=constant -o out");
  command->callback([args] { validate_command(*args); });
}

void add_chart_command(CLI::App& program) {
  CLI::App* command = program.add_subcommand("chart", "Chart the error and the time of rendering methods");
  const auto args = std::make_shared<ChartArguments>();
  command->add_option("STUDY", args->study, "One of the studies below, or all")->required()->type_name("");
  command->add_option("-o,--output", args->out, "Output folder (default charts)")->type_name("DIR")->check(not_empty());
  command->add_flag("--quick", args->quick, "Use small images, as a functional test");
  command->add_option("--threads", args->threads, "Threads (default: one per core)")->type_name("N");
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
  CLI::App* command = program.add_subcommand("compare", "Measure the difference between two images");
  const auto args = std::make_shared<CompareArguments>();
  command->add_option("A", args->a, "First image")->required()->type_name("");
  command->add_option("B", args->b, "Second image, of the same size")->required()->type_name("");
  command->add_flag("--json", args->json, "Report as JSON");
  command->add_option("-o,--output", args->out, "Write a color-coded difference image (PNG)")->type_name("DIFF")->check(not_empty());
  command->add_option("--tolerance", args->tolerance, "Exit with 1 if a channel differs by more than T")->type_name("T");
  command->footer(
      "Examples:\n"
      "  halfspace compare before.png after.png -o difference.png\n"
      "  halfspace compare golden.exr moon.exr --tolerance 0.004 --json");
  command->callback([args] { compare_command(*args); });
}

void add_check_lesson_command(CLI::App& program) {
  CLI::App* command = program.add_subcommand("check-lesson", "Compare the picture of an exercise with its solution");
  const auto args = std::make_shared<CheckLessonArguments>();
  command->add_option("N", args->lesson, "Number of the lesson")->required()->type_name("");
  command->add_option("FILE", args->file, "Picture, or a folder of pictures")->required()->type_name("")->check(not_empty());
  command->add_option("-o,--output", args->out, "Difference image (PNG); of a folder: folder for them")
      ->type_name("DIFF")
      ->check(not_empty());
  command->footer(
      "Examples:\n"
      "  halfspace check-lesson 1 lesson01.ppm\n"
      "  halfspace check-lesson 1 submissions -o differences");
  command->callback([args] { check_lesson_command(*args); });
}

void add_list_command(CLI::App& program) {
  CLI::App* command = program.add_subcommand("list", "List the scenes, or the keys of a scene");
  const auto args = std::make_shared<ListArguments>();
  command->add_option("SCENE", args->scene, "Scene or scene file whose keys are listed")->type_name("");
  command->add_flag("--names", args->names, "Print only the names, one per line");
  command->add_flag("--schema", args->schema, "Print the JSON Schema of scene files");
  command->footer("Examples:\n  halfspace list\n  halfspace list moon");
  command->callback([args] { list_command(*args); });
}

void add_info_command(CLI::App& program) {
  CLI::App* command = program.add_subcommand("info", "Describe a model file, or this program");
  const auto args = std::make_shared<InfoArguments>();
  command->add_option("MODEL", args->model, "Model file (default: the program itself)")->type_name("");
  command->add_flag("--json", args->json, "Print as JSON");
  command->add_option("--up-axis", args->up_axis, "Axis that points up: y or z (default: z for STL)")->type_name("AXIS");
  command->add_flag("--allow-outside", args->allow_outside, "Read files outside the folder of the model");
  add_limit_options(command, args->limits);
  command->footer("Examples:\n  halfspace info\n  halfspace info chair.glb --json");
  command->callback([args] { info_command(*args); });
}

void add_completion_command(CLI::App& program) {
  CLI::App* command = program.add_subcommand("completion", "Print a shell completion script");
  const auto args = std::make_shared<CompletionArguments>();
  command->add_option("SHELL", args->shell, "bash, zsh or fish; or a list: words, studies")->required()->type_name("");
  command->add_option("COMMAND", args->command, "With words: the command whose options are listed")->type_name("");
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
  add_explain_command(program);
  add_export_command(program);
  add_convert_normal_command(program);
  add_validate_command(program);
  add_compare_command(program);
  add_check_lesson_command(program);
  add_chart_command(program);
  add_list_command(program);
  add_info_command(program);
  add_completion_command(program);
  program.footer("Run 'halfspace COMMAND --help' for the options of a command.");
  if (argc < 2) throw UsageError("no command" + suggested_command("", program) + " (see 'halfspace --help')");
  program.parse(argc, argv);
}

}  // namespace

}  // namespace halfspace

// The launcher of a portable build calls this function (see cmake/program.cmake).
extern "C" int halfspace_cli_main(int argc, char** argv) {
  CLI::App program("Halfspace: a renderer that runs on the CPU");
  return halfspace::run_program(program, [&] { halfspace::parse_and_run(program, argc, argv); });
}

int main(int argc, char** argv) { return halfspace_cli_main(argc, argv); }
