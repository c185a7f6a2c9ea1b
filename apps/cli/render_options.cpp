// SPDX-License-Identifier: Apache-2.0
#include "cli/render_options.h"

#include <fmt/format.h>

#include <map>
#include <utility>

#include "cli/scene_list.h"
#include "command_line/arguments.h"
#include "command_line/errors.h"
#include "halfspace/image/atomic_output.h"
#include "halfspace/render/model_file/input_files.h"
#include "halfspace/render/model_file/model_scene.h"

namespace halfspace {

namespace {

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

std::vector<std::string> scenes_of(const RenderArguments& args) {
  std::vector<std::string> scenes = read_scenes(args.scenes, args.list);
  if (scenes.empty())
    throw UsageError("SCENE is required; expected a scene, a scene file, a model file or --list FILE; see 'halfspace render --help'");
  return scenes;
}

// Returns the frames of --frames or --turntable.
std::optional<FrameRange> frames_of(const RenderArguments& args) {
  const std::optional<int> turn = turntable_frames(args.model);
  if (turn && !args.frames.empty()) throw UsageError("--turntable sets the frames itself; expected it without --frames");
  if (turn) return FrameRange{0, *turn - 1};
  if (args.frames.empty()) return std::nullopt;
  return parse_frames(args.frames);
}

int parse_loop(const std::string& text) {
  const int loop = parse_number(text);
  if (loop >= 0 && loop <= 65535) return loop;
  throw UsageError("--loop is '" + text + "'; expected 0 to 65535, where 0 plays an animation forever");
}

// Refuses options that would have no effect.
void check_options(const RenderOptions& o) {
  const RenderArguments& args = o.arguments;
  const bool has_one_picture = !o.frames && !o.is_list();
  for (const auto& [option, given] : {std::pair{"--resume", args.resume}, {"--shard", !args.shard.empty()}}) {
    if (given && has_one_picture)
      throw UsageError(std::string(option) + " applies only to multiple pictures; expected --frames FIRST..LAST or --list FILE as well");
  }
  if (!args.shard.empty() && !o.is_list() && o.format.animation)
    throw UsageError("--shard would give each process an animation with some of the frames; expected a file per frame");
  if (!args.fps.empty() && !o.frames) throw UsageError("--fps applies only to multiple frames; expected --frames FIRST..LAST as well");
  if (!args.loop.empty() && !o.format.animation)
    throw UsageError("--loop applies only to animations; expected -o with a file name ending in .webp or .gif");
  if (!args.report.empty() && !o.is_list())
    throw UsageError("--report applies only to several scenes; expected more scenes, or --list FILE");
  if (o.is_list() && args.print) throw UsageError("--print prints one scene; expected it without other scenes and --list");
  if (!args.progress.empty() && args.progress != "json") throw UsageError("--progress is '" + args.progress + "'; expected json");
  if (args.quiet && (args.verbose || !args.progress.empty()))
    throw UsageError("--quiet cannot be combined with --verbose and --progress; expected only one of them");
  if (args.resume && (o.format.to_standard_output || !o.format.is_picture()))
    throw UsageError("--resume keeps files of single pictures; expected -o with a file name ending in .png, .jpg, .tif, .exr or .hdr");
  if (!args.statistics.empty() && args.statistics != "text" && args.statistics != "json")
    throw UsageError("--stats is '" + args.statistics + "'; expected --stats or --stats=json");
  if (!o.output.values.empty() && !args.wireframe.empty())
    throw UsageError("--aov does not apply to --wireframe; expected only one of the two");
  if (args.naive && (!o.output.values.empty() || o.output.crop))
    throw UsageError("--naive draws only whole pictures; expected it without --aov and --crop");
}

// Throws UsageError if two scenes have the same output file, or if the place for a number has no number.
void check_names(RenderOptions& o) {
  if (!o.frames && OutputPattern::has_place(o.out))
    throw UsageError("-o is '" + o.out + "', which has a place for the number of a frame; expected --frames FIRST..LAST as well");
  (void)pattern_of(o, o.scenes[0]);
  if (o.frames && o.format.animation && (OutputPattern::has_place(o.out) || o.out.find('%') != std::string::npos))
    throw UsageError("-o is '" + o.out + "', an animation of all frames; expected a name without a place for the number of a frame");
  if (o.format.to_standard_output) return;
  std::map<std::filesystem::path, std::string> owners;
  for (const std::string& scene : o.scenes) {
    if (o.is_list() && !o.frames) o.outputs.insert(std::filesystem::absolute(output_of(o, scene)).lexically_normal());
    const auto [entry, is_new] = owners.emplace(output_of(o, scene).lexically_normal(), scene);
    if (!is_new)
      throw UsageError(fmt::format("'{}' and '{}' have the same output file, {}; expected {}", entry->second, scene, entry->first.string(),
                                   o.out.find("{name}") == std::string::npos ? "-o with {name} as the place for the name of the scene"
                                                                             : "scenes with different names"));
  }
}

// Before hours of rendering: the report must be writable, and must not replace a file of the run.
void check_report(const RenderOptions& o) {
  const std::string& report = o.arguments.report;
  check_writable(report);
  std::vector<std::filesystem::path> files(o.scenes.begin(), o.scenes.end());
  files.emplace_back(o.arguments.list);
  reject_overwriting(report, files);
  if (o.outputs.contains(std::filesystem::absolute(report).lexically_normal()))
    throw UsageError("--report is '" + report + "', which is also the picture of a scene; expected another name");
}

}  // namespace

RenderOptions parse_options(const RenderArguments& args) {
  set_limits(args.limits);
  RenderOptions o{
      .arguments = args,
      .scenes = scenes_of(args),
      .out = args.out,
      .format = {},
      .size = parse_size(args.size),
      .time = args.time.empty() ? 0.0 : parse_real("--time", args.time, -1e9, 1e9, "-1e9 to 1e9 seconds, for example 2.5"),
      .fps = args.fps.empty() ? 30.0 : parse_real("--fps", args.fps, 1e-3, 1e6, "0.001 to 1000000 frames per second, for example 30"),
      .loop = args.loop.empty() ? 0 : parse_loop(args.loop),
      .frames = frames_of(args),
      .shard = args.shard.empty() ? Shard{} : parse_shard(args.shard),
      .threads = parse_threads(args.threads),
      .allowed = allowed_error(args),
      .wireframe = wireframe_of(args.wireframe),
      .output = {}};
  const std::filesystem::path out = output_of(o, o.scenes[0]);
  o.format = parse_output_format(args.out.empty() ? out.string() : args.out, args.format, o.frames.has_value());
  o.output = parse_output(args.output, o.size, out, o.format);
  check_options(o);
  check_names(o);
  if (!args.report.empty()) check_report(o);
  check_picture(o.size, bytes_per_pixel(o.output, o.format));
  return o;
}

PictureSize picture_size(const RenderOptions& options) {
  const std::optional<ImageRect>& crop = options.output.crop;
  return crop ? PictureSize{crop->width, crop->height} : options.size;
}

std::filesystem::path output_of(const RenderOptions& options, const std::string& scene) {
  if (options.out == "-") return "/dev/stdout";
  if (!options.out.empty()) return named_output(options.out, scene);
  return short_name(scene) + (is_model_file(scene) ? "-render.png" : ".png");
}

std::optional<OutputPattern> pattern_of(const RenderOptions& options, const std::string& scene) {
  if (!options.frames || !options.format.is_picture() || options.format.to_standard_output) return std::nullopt;
  const std::string default_name = is_model_file(scene) ? "{name}-render.png" : "{name}.png";
  return OutputPattern(options.out.empty() ? default_name : options.out, scene, *options.frames);
}

}  // namespace halfspace
