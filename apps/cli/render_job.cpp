// SPDX-License-Identifier: Apache-2.0
#include "cli/render_job.h"

#include <string>
#include <utility>

#include "cli/render_comment.h"
#include "command_line/arguments.h"
#include "command_line/command_line.h"
#include "command_line/errors.h"
#include "command_line/scene_arguments.h"
#include "halfspace/image/atomic_output.h"
#include "halfspace/image/image_io.h"

namespace halfspace {

namespace {

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

// Returns the frames of --frames or --turntable. Throws UsageError, also for options that apply only to them.
std::optional<FrameRange> frames_of(const RenderArguments& args) {
  const std::optional<int> turn = turntable_frames(args.model);
  if (turn && !args.frames.empty()) throw UsageError("--turntable sets the frames itself; expected it without --frames");
  if (turn) return FrameRange{0, *turn - 1};
  if (!args.frames.empty()) return parse_frames(args.frames);
  for (const auto& [option, given] : {std::pair{"--resume", args.resume}, {"--fps", !args.fps.empty()}, {"--shard", !args.shard.empty()}}) {
    if (given) throw UsageError(std::string(option) + " applies only to multiple frames; expected --frames FIRST..LAST as well");
  }
  return std::nullopt;
}

// Returns the files of the frames. Throws UsageError if the name of the output does not fit.
std::optional<OutputPattern> pattern_of(const RenderArguments& args, const std::filesystem::path& out,
                                        const std::optional<FrameRange>& frames) {
  if (!frames) {
    if (OutputPattern::has_place(args.out))
      throw UsageError("-o is '" + args.out + "', which has a place for the number of a frame; expected --frames FIRST..LAST as well");
    return std::nullopt;
  }
  if (!out.has_extension())
    throw UsageError("-o is '" + out.string() + "'; expected, with --frames, a file name ending in .png, .jpg, .tif, .exr or .hdr");
  return OutputPattern(out, *frames);
}

}  // namespace

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
  const std::optional<FrameRange> frames = frames_of(args);
  const Shard shard = args.shard.empty() ? Shard{} : parse_shard(args.shard);
  const std::filesystem::path out = output_path(args);
  const std::optional<OutputPattern> pattern = pattern_of(args, out, frames);
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
          pattern,
          shard,
          threads,
          args.resume,
          allowed_error(args),
          wireframe_of(args.wireframe),
          output,
          args};
}

std::filesystem::path picture_of(const RenderJob& job, int frame) { return job.pattern ? job.pattern->path(frame) : job.out; }

double time_of(const RenderJob& job, int frame) { return job.time + frame / job.fps; }

PictureFiles files_of(const RenderJob& job, double seconds, const std::filesystem::path& path, NaiveReport* naive) {
  const std::optional<ImageRect>& crop = job.output.crop;
  return {path,
          job.format,
          job.output,
          crop ? PictureSize{crop->width, crop->height} : job.size,
          {.software = "Halfspace " HALFSPACE_VERSION, .comment = render_comment(job.arguments, seconds)},
          naive};
}

void protect_inputs(const RenderJob& job, const std::filesystem::path& picture) {
  reject_overwriting(picture, job.inputs);
  for (const std::filesystem::path& file : value_files(job.output, picture)) reject_overwriting(file, job.inputs);
}

void check_existing_frames(const RenderJob& job) {
  if (!job.frames) return protect_inputs(job, picture_of(job));
  std::filesystem::path unknown;
  for (const int frame : job.pattern->existing_frames()) {
    if (!job.shard.contains((frame - job.frames->first) / job.frames->step)) continue;
    const std::filesystem::path path = picture_of(job, frame);
    protect_inputs(job, path);
    std::error_code error;
    if (!job.resume || !std::filesystem::exists(path, error)) continue;
    if (!record_same_options(files_of(job, time_of(job, frame), path)) && unknown.empty()) unknown = path;
  }
  if (unknown.empty()) return;
  print_warning("--resume: files such as " + unknown.string() + " do not record their options; complete ones are kept, whatever they were");
}

}  // namespace halfspace
