// SPDX-License-Identifier: Apache-2.0
//
// `halfspace render SCENE`: checks all arguments, renders a picture or a range of frames, writes them.
#include <algorithm>
#include <chrono>
#include <cstdint>
#include <iostream>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "cli/arguments.h"
#include "cli/commands.h"
#include "cli/frames.h"
#include "cli/scene_arguments.h"
#include "cli/statistics.h"
#include "halfspace/core/check.h"
#include "halfspace/core/parallel.h"
#include "halfspace/core/text.h"
#include "halfspace/image/atomic_output.h"
#include "halfspace/image/image_io.h"
#include "halfspace/render/prepared_scene.h"
#include "halfspace/scene/scene_file.h"

namespace halfspace {

namespace {

struct RenderArguments {
  std::string scene;
  std::string out;  // empty: SCENE.png
  std::string size = "1920x1080";
  std::vector<std::string> set;
  std::string camera;   // empty: the scene's
  std::string shading;  // empty: the objects'
  std::string time;     // empty: 0
  std::string frames;   // empty: one picture
  std::string fps;      // empty: 30
  std::string threads;  // empty: one a core
  std::string statistics;
  std::string max_error, max_error_color;  // empty: the scene as it is
  bool resume = false;
  bool print = false;
};

// Arguments understood.
struct RenderJob {
  SceneFile scene;
  std::filesystem::path out;
  ImageFile format;
  PictureSize size;
  double time, fps;
  std::optional<FrameRange> frames;
  int threads;
  bool resume;
  std::optional<AllowedError> allowed;
};

std::filesystem::path output_path(const RenderArguments& args) {
  if (!args.out.empty()) return args.out;
  return std::filesystem::path(args.scene).stem().string() + ".png";
}

ImageFile output_format(const std::filesystem::path& path) {
  if (const std::optional<ImageFile> format = image_file_of(path)) return *format;
  if (is_stream(path) && !path.has_extension()) return ImageFile::png;
  throw UsageError("-o is '" + path.string() + "'; expected a name that ends in .png, .jpg, .tif, .exr or .hdr");
}

// One shading rate for every object.
void set_shading(SceneFile& scene, const std::string& rate) {
  if (rate.empty()) return;
  ObjectDescription any;
  const std::span<const std::string_view> rates = find_field(section_of(any), "shading").key->choices;
  if (std::ranges::find(rates, rate) == rates.end()) {
    throw UsageError("--shading is '" + rate + "'" + suggestion(rate, rates));
  }
  std::vector<std::string> settings;
  for (const auto& [name, object] : scene.description().objects) settings.push_back("objects." + name + ".shading=" + rate);
  scene.set(settings);
}

std::optional<AllowedError> allowed_error(const RenderArguments& args) {
  if (args.max_error.empty() && args.max_error_color.empty()) return std::nullopt;
  AllowedError allowed;
  if (!args.max_error.empty()) allowed.edge_px = parse_real("--max-error", args.max_error, 0.01, 100.0, "pixels, for example 0.5");
  if (!args.max_error_color.empty())
    allowed.color = parse_real("--max-error-color", args.max_error_color, 0.1, 255.0, "8-bit codes, for example 4");
  return allowed;
}

RenderJob understand(const RenderArguments& args) {
  const PictureSize size = parse_size(args.size);
  const int threads = parse_threads(args.threads);
  if (args.statistics != "" && args.statistics != "text" && args.statistics != "json") {
    throw UsageError("--stats is '" + args.statistics + "'; expected --stats or --stats=json");
  }
  const double time = args.time.empty() ? 0.0 : parse_real("--time", args.time, -1e9, 1e9, "seconds, for example 2.5");
  const double fps = args.fps.empty() ? 30.0 : parse_real("--fps", args.fps, 1e-3, 1e6, "frames per second, for example 30");
  std::optional<FrameRange> frames;
  if (!args.frames.empty()) frames = parse_frames(args.frames);
  if (!frames && (args.resume || !args.fps.empty())) {
    throw UsageError(std::string(args.resume ? "--resume" : "--fps") + " is for several frames; expected --frames FIRST..LAST too");
  }
  const std::filesystem::path out = output_path(args);
  if (frames && !out.has_extension())
    throw UsageError("-o is '" + out.string() + "'; expected, with --frames, a name that ends in .png, .jpg, .tif, .exr or .hdr");
  const ImageFile format = output_format(out);
  SceneFile scene = open_scene(args.scene, args.set, args.camera);
  set_shading(scene, args.shading);
  return {std::move(scene), out, format, size, time, fps, frames, threads, args.resume, allowed_error(args)};
}

double milliseconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

void write_picture(const std::filesystem::path& path, const Image<glm::vec4>& picture) { write_image(path, picture); }
void write_picture(const std::filesystem::path& path, const Image<glm::u8vec4>& picture) {
  path.has_extension() ? write_image(path, picture) : write_png(path, picture);  // /dev/stdout
}

// What the scene asks for and cannot have is told with its name.
PreparedScene prepare(const RenderJob& job, double seconds, SceneAssets& assets, RenderReport& report) {
  SceneDescription scene = job.scene.at(seconds);
  try {
    if (job.allowed) {
      FittedScene fitted = assets.fit(scene, job.size.width, job.size.height, *job.allowed);
      scene = std::move(fitted.scene);
      report.choices = std::move(fitted.choices);
    }
    return assets.prepare(scene, job.size.width, job.size.height);
  } catch (const InputError& e) {
    throw InputError(job.scene.source() + ": " + e.what());
  }
}

// Renders one picture into a file and adds to the report.
template <class Pixel>
void render_picture(const RenderJob& job, double seconds, const std::filesystem::path& path, SceneAssets& assets, const Workers& workers,
                    RenderReport& report) {
  const auto start = std::chrono::steady_clock::now();
  Image<Pixel> picture(job.size.width, job.size.height);
  const PreparedScene scene = prepare(job, seconds, assets, report);
  report.counts += scene.shadow_statistics;
  report.counts += render(scene, picture, workers);
  const double render_ms = milliseconds_since(start);
  write_picture(path, picture);
  report.render_ms += render_ms;
  report.write_ms += milliseconds_since(start) - render_ms;
}

void render_picture(const RenderJob& job, double seconds, const std::filesystem::path& path, SceneAssets& assets, const Workers& workers,
                    RenderReport& report) {
  if (is_linear(job.format)) {
    render_picture<glm::vec4>(job, seconds, path, assets, workers, report);
  } else {
    render_picture<glm::u8vec4>(job, seconds, path, assets, workers, report);
  }
}

// A file of an earlier run counts where it holds a whole picture of the right size.
bool is_whole(const std::filesystem::path& path, const RenderJob& job) {
  std::error_code error;
  if (!std::filesystem::exists(path, error)) return false;
  try {
    const auto fits = [&](const auto& picture) { return picture.width() == job.size.width && picture.height() == job.size.height; };
    return is_linear(job.format) ? fits(read_linear(path)) : fits(read_image(path));
  } catch (const InputError&) {
    return false;
  }
}

// The scene with what is chosen for it.
SceneFile chosen(const RenderJob& job) {
  SceneFile scene = job.scene;
  if (!job.allowed) return scene;
  const Workers workers(job.threads);
  SceneAssets assets(workers);
  std::vector<std::string> settings;
  for (const ModelChoice& c : assets.fit(scene.at(job.time), job.size.width, job.size.height, *job.allowed).choices)
    settings.push_back(c.key + "=" + c.value);
  scene.set(settings);
  return scene;
}

double time_of(const RenderJob& job, int frame) { return job.time + frame / job.fps; }

// Generated maps are as fine as the nearest of all views needs, so that none changes its width on the way. A thousand looks
// along a longer range are enough to find it.
void expect_frames(const RenderJob& job, SceneAssets& assets) {
  constexpr int kMaxLooks = 1000;
  const bool stands = job.scene.description().animations.empty();
  const int looks = stands ? 1 : std::min(job.frames->count(), kMaxLooks);
  for (int i = 0; i < looks; ++i) {
    const int frame = job.frames->first + static_cast<int>(static_cast<int64_t>(job.frames->count() - 1) * i / std::max(looks - 1, 1));
    assets.expect(job.scene.at(time_of(job, frame)), job.size.width, job.size.height);
  }
}

RenderReport run(const RenderJob& job) {
  const Workers workers(job.threads);
  SceneAssets assets(workers);
  RenderReport report;
  if (!job.frames) {
    check_writable(job.out);
    render_picture(job, job.time, job.out, assets, workers, report);
    return report;
  }
  check_writable(frame_path(job.out, job.frames->first, *job.frames));
  expect_frames(job, assets);
  Progress progress(job.frames->count());
  for (int frame = job.frames->first; frame <= job.frames->last; ++frame) {
    const std::filesystem::path path = frame_path(job.out, frame, *job.frames);
    const bool skip = job.resume && is_whole(path, job);
    if (!skip) render_picture(job, time_of(job, frame), path, assets, workers, report);
    progress.advance(skip);
  }
  return report;
}

void render_command(const RenderArguments& args) {
  const RenderJob job = understand(args);
  if (args.print) {
    std::cout << chosen(job).print();
    return;
  }
  RenderReport report = run(job);
  if (args.statistics.empty()) return;
  report.scene = args.scene;
  report.output = job.out.string();
  report.width = job.size.width;
  report.height = job.size.height;
  report.threads = job.threads;
  // Not into the picture.
  std::ostream& out = is_standard_output(job.out) ? std::cerr : std::cout;
  out << (args.statistics == "json" ? json_report(report) : text_report(report));
}

}  // namespace

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

}  // namespace halfspace
