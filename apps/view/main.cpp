// SPDX-License-Identifier: Apache-2.0
//
// `halfspace-view SCENE|MODEL`: shows a scene or a model in a window.
#include <fmt/format.h>
#include <malloc.h>
#include <CLI/CLI.hpp>

#include <iostream>

#include "command_line/arguments.h"
#include "command_line/command_line.h"
#include "command_line/errors.h"
#include "command_line/options.h"
#include "command_line/scene_arguments.h"
#include "view/ui_scale.h"
#include "view/view_app.h"

namespace halfspace {

namespace {

// Option values as given on the command line. An empty string means that the option was not given.
struct ViewArguments {
  std::string scene, size = "1280x720", camera, shading, time, threads, ui_scale, frames, events, record;
  std::vector<std::string> set;
  ModelArguments model;
  LimitArguments limits;
  bool no_window = false;
};

void add_options(CLI::App& program, ViewArguments& args) {
  program.add_option("SCENE", args.scene, "Scene, scene file or model file (see --help-model)")->required()->type_name("");
  add_set_option(&program, args.set);
  add_view_options(&program, args.camera, args.shading, args.time);
  program.add_option("--size", args.size, "Size of the window in pixels (default 1280x720)")->type_name("WxH");
  program.add_option("--ui-scale", args.ui_scale, "Scale of text and panels (default: Xft.dpi / 96)")->type_name("F");
  program.add_option("--threads", args.threads, "Threads (default: one per core)")->type_name("N");
  program.add_option("--frames", args.frames, "Show N frames at intervals of 1/30 s, print the mean times and exit")->type_name("N");
  program.add_flag("--no-window", args.no_window, "With --frames: render the same frames without a window");
  program.add_option("--events", args.events, "Replay the input events in the file; for tests")->type_name("FILE");
  program.add_option("--record", args.record, "Write every frame and every note about long work to the folder; for tests")
      ->type_name("DIR");
  add_model_options(&program, args.model);
  add_limit_options(&program, args.limits, false);
  add_primitive_limit_option(&program, args.limits, false);
  program.footer(
      "Press h in the window for the list of keys.\n\n"
      "Examples:\n"
      "  halfspace-view earth\n"
      "  halfspace-view chair.glb --yaw 120 --environment studio.hdr --ui-scale 2");
}

ViewOptions options_of(const ViewArguments& args) {
  const PictureSize size = parse_size(args.size);
  check_picture(size, 2 * sizeof(glm::u8vec4));  // the scene, and the frame with panels
  ViewOptions options;
  options.name = std::filesystem::path(args.scene).stem().string();
  options.width = size.width;
  options.height = size.height;
  options.threads = parse_threads(args.threads);
  options.ui_scale = args.ui_scale.empty() ? default_ui_scale()
                                           : parse_real("--ui-scale", args.ui_scale, 0.5, 4.0, "a factor from 0.5 to 4, for example 2");
  if (!args.frames.empty()) {
    const int frames = parse_number(args.frames);
    if (frames < 1) throw UsageError("--frames is '" + args.frames + "'; expected a number of frames of at least 1");
    options.frames = frames;
  }
  if (args.no_window && !options.frames) throw UsageError("--no-window requires --frames; expected --frames N as well");
  options.events = args.events;
  options.record = args.record;
  return options;
}

void print(const RunTimes& times, const ViewOptions& options) {
  std::cout << fmt::format(
      "frames {}\nsize {}x{}\nthreads {}\nframe_ms {:.3f}\nprepare_ms {:.3f}\ndraw_ms {:.3f}\ninterface_ms {:.3f}\npresent_ms {:.3f}\n"
      "frames_per_second {:.1f}\n",
      times.frames, options.width, options.height, options.threads, times.frame, times.prepare, times.draw, times.interface, times.present,
      1000.0 / times.frame);
}

// Keeps freed memory for the next frame. Otherwise, the C library returns the shadow maps and skies of a frame to the system, which clears
// their pages again for the next frame. In day-night, that took a third of the time of a coarse frame.
void keep_freed_memory() {
  mallopt(M_MMAP_THRESHOLD, 32 << 20);  // the largest value that is allowed
  mallopt(M_TRIM_THRESHOLD, 1 << 30);
}

void run(const ViewArguments& args) {
  keep_freed_memory();
  set_limits(args.limits);
  const ViewOptions options = options_of(args);
  const double time = args.time.empty() ? 0.0 : parse_real("--time", args.time, -1e9, 1e9, "-1e9 to 1e9 seconds, for example 2.5");
  OpenedScene opened = open_scene_or_model(args.scene, args.model, args.camera, static_cast<double>(options.width) / options.height, 30.0,
                                           args.time.empty() ? std::vector<double>{} : std::vector{time});
  set_scene(opened, args.set, args.camera);
  set_shading(opened.scene, args.shading);
  Viewer viewer(std::move(opened), time);
  const RunTimes times = args.no_window ? run_without_window(viewer, options) : ViewApp(std::move(viewer), options).run();
  if (options.frames) print(times, options);
}

void parse_and_run_view(CLI::App& program, int argc, char** argv) {
  program.name("halfspace-view");
  set_common_options(program);
  ViewArguments args;
  add_options(program, args);
  program.parse(argc, argv);
  run(args);
}

}  // namespace

}  // namespace halfspace

// The launcher of a portable build calls this function (see cmake/program.cmake).
extern "C" int halfspace_view_main(int argc, char** argv) {
  CLI::App program("Halfspace: shows scenes and models in a window, rendered on the CPU");
  return halfspace::run_program(program, [&] { halfspace::parse_and_run_view(program, argc, argv); });
}

int main(int argc, char** argv) { return halfspace_view_main(argc, argv); }
