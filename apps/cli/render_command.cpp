// SPDX-License-Identifier: Apache-2.0
//
// `halfspace render SCENE`: validates all arguments, then renders one image or a range of frames.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <iostream>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "cli/commands.h"
#include "cli/output_files.h"
#include "cli/render_comment.h"
#include "cli/stage_display.h"
#include "cli/statistics.h"
#include "command_line/arguments.h"
#include "command_line/command_line.h"
#include "command_line/errors.h"
#include "command_line/frames.h"
#include "command_line/scene_arguments.h"
#include "halfspace/core/check.h"
#include "halfspace/core/parallel.h"
#include "halfspace/core/text.h"
#include "halfspace/image/atomic_output.h"
#include "halfspace/image/image_io.h"
#include "halfspace/render/frame/naive_render.h"
#include "halfspace/render/model_file/input_files.h"
#include "halfspace/render/prepare/wireframe.h"
#include "halfspace/render/prepared_scene.h"
#include "halfspace/render/scene_assets.h"
#include "halfspace/scene/scene_file.h"

namespace halfspace {

namespace {

// The parsed and validated arguments.
struct RenderJob {
  SceneFile scene;
  ReadModels models;
  std::vector<std::filesystem::path> inputs;  // files that must not be overwritten
  std::filesystem::path out;
  ImageFile format;
  PictureSize size;
  double time, fps;
  std::optional<FrameRange> frames;
  int threads;
  bool resume;
  std::optional<AllowedError> allowed;
  std::optional<HiddenLines> wireframe;
  OutputChoice output;
  const RenderArguments& arguments;
};

std::filesystem::path output_path(const RenderArguments& args) {
  if (!args.out.empty()) return args.out;
  return std::filesystem::path(args.scene).stem().string() + (is_model_file(args.scene) ? "-render.png" : ".png");
}

ImageFile output_format(const std::filesystem::path& path) {
  if (const std::optional<ImageFile> format = image_file_of(path)) return *format;
  if (is_stream(path) && !path.has_extension()) return ImageFile::png;
  throw UsageError("-o is '" + path.string() + "'; expected a file name ending in .png, .jpg, .tif, .exr or .hdr");
}

std::optional<AllowedError> allowed_error(const RenderArguments& args) {
  if (args.max_error.empty() && args.max_error_color.empty()) return std::nullopt;
  AllowedError allowed;
  if (!args.max_error.empty())
    allowed.edge_px = parse_real("--max-error", args.max_error, 0.01, 100.0, "0.01 to 100 pixels, for example 0.5");
  if (!args.max_error_color.empty())
    allowed.color = parse_real("--max-error-color", args.max_error_color, 0.1, 255.0, "0.1 to 255 8-bit steps, for example 4");
  return allowed;
}

std::optional<HiddenLines> wireframe_of(const std::string& text) {
  if (text.empty()) return std::nullopt;
  if (text != "lines" && text != "hidden") throw UsageError("--wireframe is '" + text + "'; expected --wireframe or --wireframe=hidden");
  return text == "hidden" ? HiddenLines::removed : HiddenLines::shown;
}

// Throws UsageError if the background is transparent and the format cannot store transparency.
void check_alpha(const SceneFile& scene, const std::filesystem::path& out, ImageFile format) {
  const bool stores_alpha = format == ImageFile::png || format == ImageFile::tiff || format == ImageFile::exr;
  if (scene.description().background.type == BackgroundType::transparent && !stores_alpha)
    throw UsageError("-o is '" + out.string() + "', but the background is transparent; expected a file name ending in .png, .tif or .exr");
}

// Returns the times at which a model is shown. Returns an empty list if the options do not ask for motion.
std::vector<double> animated_times(const RenderArguments& args, double time, double fps, const std::optional<FrameRange>& frames) {
  const bool moves = !args.time.empty() || !args.frames.empty() || (frames && !args.model.animation.empty());
  if (!moves) return {};
  return frames ? frame_times(*frames, time, fps) : std::vector{time};
}

RenderJob parse_job(const RenderArguments& args) {
  set_limits(args.limits);
  const PictureSize size = parse_size(args.size);
  const int threads = parse_threads(args.threads);
  if (args.statistics != "" && args.statistics != "text" && args.statistics != "json") {
    throw UsageError("--stats is '" + args.statistics + "'; expected --stats or --stats=json");
  }
  const double time = args.time.empty() ? 0.0 : parse_real("--time", args.time, -1e9, 1e9, "-1e9 to 1e9 seconds, for example 2.5");
  const double fps =
      args.fps.empty() ? 30.0 : parse_real("--fps", args.fps, 1e-3, 1e6, "0.001 to 1000000 frames per second, for example 30");
  std::optional<FrameRange> frames;
  if (!args.frames.empty()) frames = parse_frames(args.frames);
  if (const std::optional<int> turn = turntable_frames(args.model)) {
    if (frames) throw UsageError("--turntable sets the frames itself; expected it without --frames");
    frames = FrameRange{0, *turn - 1};
  }
  if (!frames && (args.resume || !args.fps.empty())) {
    throw UsageError(std::string(args.resume ? "--resume" : "--fps") +
                     " applies only to multiple frames; expected --frames FIRST..LAST as well");
  }
  const std::filesystem::path out = output_path(args);
  if (frames && !out.has_extension())
    throw UsageError("-o is '" + out.string() + "'; expected, with --frames, a file name ending in .png, .jpg, .tif, .exr or .hdr");
  const ImageFile format = output_format(out);
  const OutputChoice output = parse_output(args.output, size, out, format);
  if (!output.values.empty() && !args.wireframe.empty())
    throw UsageError("--aov does not apply to --wireframe; expected only one of the two");
  if (args.naive && (!output.values.empty() || output.crop))
    throw UsageError("--naive draws only whole pictures; expected it without --aov and --crop");
  check_picture(size, bytes_per_pixel(output, format));
  OpenedScene opened = open_scene_or_model(args.scene, args.model, args.camera, static_cast<double>(size.width) / size.height, fps,
                                           animated_times(args, time, fps, frames));
  set_scene(opened, args.set, args.camera);
  set_shading(opened.scene, args.shading);
  check_alpha(opened.scene, out, format);
  ReadModels models;
  std::vector<std::filesystem::path> inputs;
  if (!args.print) {
    models = read_models(opened);
    inputs = input_files(opened.scene.description(), args.scene, models);
  }
  return {std::move(opened.scene),
          std::move(models),
          std::move(inputs),
          out,
          format,
          size,
          time,
          fps,
          frames,
          threads,
          args.resume,
          allowed_error(args),
          wireframe_of(args.wireframe),
          output,
          args};
}

// Throws InputError if the naive pipeline cannot draw the scene.
void check_naive(const PreparedScene& scene, const SceneDescription& description) {
  if (const std::string obstacle = naive_obstacle(scene, description); !obstacle.empty()) throw InputError(obstacle);
}

// Prepares the scene at a point in time. Adds the name of the scene to error messages.
PreparedScene prepare(const RenderJob& job, double seconds, SceneAssets& assets, RenderReport& report) {
  SceneDescription scene = job.scene.at(seconds);
  try {
    if (job.allowed) {
      SceneWithinError chosen = assets.choose_within_error(scene, job.size.width, job.size.height, *job.allowed);
      scene = std::move(chosen.scene);
      report.choices = std::move(chosen.choices);
    }
    if (job.wireframe) scene.shadow.method = ShadowMethod::none;
    PreparedScene prepared = assets.prepare(scene, job.size.width, job.size.height);
    if (job.wireframe) report.spheres_without_wireframe |= make_wireframe(prepared, scene, *job.wireframe);
    if (job.arguments.naive) check_naive(prepared, scene);
    return prepared;
  } catch (const InputError& e) {
    throw InputError(message_in_scene(job.scene, e.what()));
  }
}

PictureFiles files_of(const RenderJob& job, double seconds, const std::filesystem::path& path, NaiveReport* naive = nullptr) {
  const std::optional<ImageRect>& crop = job.output.crop;
  return {path,
          job.format,
          job.output,
          crop ? PictureSize{crop->width, crop->height} : job.size,
          {.software = "Halfspace " HALFSPACE_VERSION, .comment = render_comment(job.arguments, seconds)},
          naive};
}

double milliseconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

// Throws OutputError if one of the files of a picture is a file that the scene reads.
void protect_inputs(const RenderJob& job, const std::filesystem::path& picture) {
  reject_overwriting(picture, job.inputs);
  for (const std::filesystem::path& file : value_files(job.output, picture)) reject_overwriting(file, job.inputs);
}

// Renders one image to its files and adds its times and counts to the report.
void render_picture(const RenderJob& job, double seconds, const std::filesystem::path& path, SceneAssets& assets, const Workers& workers,
                    RenderReport& report) {
  protect_inputs(job, path);
  const auto start = std::chrono::steady_clock::now();
  const PreparedScene scene = prepare(job, seconds, assets, report);
  const double prepared_ms = milliseconds_since(start);
  report.counts += scene.shadow_statistics;
  double shadow_ms = 0.0;
  for (const PreparedLight& light : scene.lights) shadow_ms += light.map_ms;
  report.images_ms += scene.images_ms;
  report.shadow_ms += shadow_ms;
  report.prepare_ms += prepared_ms - shadow_ms - scene.images_ms;
  report.render_ms += prepared_ms;
  render_files(scene, files_of(job, seconds, path, job.arguments.naive ? &report.naive : nullptr), workers, report);
}

// Returns the scene with the settings that --max-error chooses.
SceneFile chosen(const RenderJob& job) {
  SceneFile scene = job.scene;
  if (!job.allowed) return scene;
  const Workers workers(job.threads);
  SceneAssets assets(workers);
  std::vector<std::string> settings;
  for (const ApproximationChoice& c :
       assets.choose_within_error(scene.at(job.time), job.size.width, job.size.height, *job.allowed).choices) {
    if (c.is_setting) settings.push_back(c.key + "=" + c.value);
  }
  scene.set(settings);
  return scene;
}

double time_of(const RenderJob& job, int frame) { return job.time + frame / job.fps; }

bool shows_background(const SceneDescription& scene) {
  return scene.background.type == BackgroundType::environment || scene.background.type == BackgroundType::stars;
}

// Returns what to change in a scene that draws nothing from any camera, or an empty string if it draws something.
std::string advice_for_empty(const SceneDescription& scene) {
  const auto has_spheres = [](const ParticlesDescription& p) { return p.count > 0 || !p.file.path.empty(); };
  const auto is_shown = [](const auto& entry) { return entry.second.visible && !entry.second.shadow_only; };
  const auto is_hidden = [](const auto& entry) { return !entry.second.visible && !entry.second.shadow_only; };
  if (has_spheres(scene.particles) || std::ranges::any_of(scene.objects, is_shown) ||
      std::ranges::any_of(scene.particle_systems, [&](const auto& entry) { return has_spheres(entry.second); }))
    return {};
  const auto hidden = std::ranges::find_if(scene.objects, is_hidden);
  if (hidden == scene.objects.end()) return "a scene with objects or particles";
  return "--set objects." + hidden->first + ".visible=true, because all objects are hidden";
}

// Returns what to change if a picture is empty.
std::string advice_for_empty(const RenderArguments& args) {
  if (!args.output.crop.empty()) return "the picture without --crop";
  if (!is_model_file(args.scene)) return "another camera, or another position or target of the camera";
  if (args.model.inside) return "--eye X,Y,Z and --look-at X,Y,Z, or leave out --inside: surfaces are visible only from their fronts";
  if (!args.model.eye.empty() || !args.camera.empty()) return "another view, or leave out --eye and --camera to show the whole model";
  return "another --yaw, --pitch or --zoom";
}

RenderReport run(const RenderJob& job) {
  const Workers workers(job.threads);
  SceneAssets assets(workers, print_warning);
  add_models(assets, job.models);
  RenderReport report;
  if (!job.frames) {
    check_writable(job.out);
    const StageDisplay rendering("rendering " + job.out.string());
    render_picture(job, job.time, job.out, assets, workers, report);
    return report;
  }
  check_writable(frame_path(job.out, job.frames->first, *job.frames));
  const auto time_of_frame = [&](int i) { return time_of(job, job.frames->first + i); };
  expect_frames(assets, job.scene, job.frames->count(), time_of_frame, job.size.width, job.size.height);
  Progress progress(job.frames->count());
  for (int frame = job.frames->first; frame <= job.frames->last; ++frame) {
    const std::filesystem::path path = frame_path(job.out, frame, *job.frames);
    const bool skip = job.resume && are_complete(files_of(job, time_of(job, frame), path));
    if (skip) {
      ++report.pictures;  // not known to be empty
    } else {
      render_picture(job, time_of(job, frame), path, assets, workers, report);
    }
    progress.advance(skip);
  }
  return report;
}

// Like protect_inputs, for all frames, so that a long animation does not fail at its last frame. With --resume, throws UsageError if a
// frame was rendered with other options, and warns if this is unknown.
void check_existing_frames(const RenderJob& job) {
  if (!job.frames) return protect_inputs(job, job.out);
  std::filesystem::path unknown;
  for (const int frame : existing_frames(job.out, *job.frames)) {
    const std::filesystem::path path = frame_path(job.out, frame, *job.frames);
    protect_inputs(job, path);
    std::error_code error;
    if (!job.resume || !std::filesystem::exists(path, error)) continue;
    if (!record_same_options(files_of(job, time_of(job, frame), path)) && unknown.empty()) unknown = path;
  }
  if (unknown.empty()) return;
  print_warning("--resume: files such as " + unknown.string() + " do not record their options; complete ones are kept, whatever they were");
}

}  // namespace

void render_command(const RenderArguments& args) {
  const auto start = std::chrono::steady_clock::now();
  std::optional<StageDisplay> reading(std::in_place, "reading " + args.scene);
  const RenderJob job = parse_job(args);
  if (args.print) {
    std::cout << chosen(job).print();
    return;
  }
  reading.reset();
  const double read_ms = milliseconds_since(start);
  check_existing_frames(job);
  RenderReport report = run(job);
  report.read_ms = read_ms;
  // A single frame of an animation may be empty on purpose.
  const std::string advice = advice_for_empty(job.scene.description());
  // A floor covers pixels even if nothing casts a shadow on it.
  const bool shows_floor_only = !advice.empty() && !shows_background(job.scene.description()) && !job.wireframe;
  if (report.pictures > 0 && (shows_floor_only || report.empty_pictures == report.pictures))
    print_warning("nothing is visible in the picture; try " + (advice.empty() ? advice_for_empty(args) : advice));
  if (report.spheres_without_wireframe) print_warning("spheres that are not meshes have no wireframe; they are drawn as surfaces");
  // If the image goes to standard output, print the reports to standard error.
  std::ostream& out = is_standard_output(job.out) ? std::cerr : std::cout;
  if (args.naive && report.naive.pixels > 0) out << naive_line(report.naive, job.threads);
  if (args.statistics.empty()) return;
  report.scene = args.scene;
  report.output = job.out.string();
  const PictureSize size = files_of(job, job.time, job.out).size;
  report.width = size.width;
  report.height = size.height;
  report.threads = job.threads;
  out << (args.statistics == "json" ? json_report(report) : text_report(report));
}

}  // namespace halfspace
