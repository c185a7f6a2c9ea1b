// SPDX-License-Identifier: Apache-2.0
#include "cli/render_job.h"

#include <utility>

#include "cli/file_hash.h"
#include "cli/render_comment.h"
#include "command_line/errors.h"
#include "command_line/scene_arguments.h"
#include "halfspace/image/image_text.h"

namespace halfspace {

namespace {

// Throws UsageError if the background is transparent and the format cannot store transparency.
void check_alpha(const SceneFile& scene, const RenderOptions& options) {
  if (scene.description().background.type != BackgroundType::transparent || options.format.stores_alpha()) return;
  if (options.format.stream)
    throw UsageError("--format is '" + options.arguments.format + "', but the background is transparent; expected png, rgba or rgbaf32");
  throw UsageError("-o is '" + options.out + "', but the background is transparent; expected a file name ending in .png, .tif or .exr");
}

// Returns the times at which a model is shown. Returns an empty list if the options do not ask for motion.
std::vector<double> animated_times(const RenderOptions& o) {
  const RenderArguments& args = o.arguments;
  const bool moves = !args.time.empty() || !args.frames.empty() || (o.frames && !args.model.animation.empty());
  if (!moves) return {};
  return o.frames ? frame_times(*o.frames, o.time, o.fps) : std::vector{o.time};
}

// Throws OutputError if a file that the scene reads is the picture of a scene of the list.
void protect_from_others(const RenderOptions& options, const std::string& scene, const std::vector<std::filesystem::path>& inputs) {
  if (options.outputs.empty()) return;
  for (const std::filesystem::path& input : inputs) {
    if (options.outputs.contains(std::filesystem::absolute(input).lexically_normal()))
      throw OutputError(scene + ": reads " + input.string() + ", which this command writes; expected another output file");
  }
}

}  // namespace

RenderJob open_job(const RenderOptions& options, const std::string& scene) {
  const RenderArguments& args = options.arguments;
  OpenedScene opened = open_scene_or_model(scene, args.model, args.camera, static_cast<double>(options.size.width) / options.size.height,
                                           options.fps, animated_times(options));
  set_scene(opened, args.set, args.camera);
  set_shading(opened.scene, args.shading);
  check_alpha(opened.scene, options);
  ReadModels models;
  std::vector<std::filesystem::path> inputs;
  if (!args.print) {
    models = read_models(opened);
    inputs = input_files(opened.scene.description(), scene, models);
    protect_from_others(options, scene, inputs);
  }
  // Before the scene is rendered: a file that changes later must not have the fingerprint of the pixels.
  std::string hash = options.has_fingerprints() && !args.print ? hash_of_files(inputs) : "";
  return {options,           scene,           std::move(opened.scene),   std::move(models),
          std::move(inputs), std::move(hash), output_of(options, scene), pattern_of(options, scene)};
}

std::filesystem::path picture_of(const RenderJob& job, int i) {
  return job.pattern ? job.pattern->path(job.options.frames->at(i)) : job.out;
}

double time_of(const RenderJob& job, int i) {
  return job.options.frames ? job.options.time + job.options.frames->at(i) / job.options.fps : job.options.time;
}

PictureFiles files_of(const RenderJob& job, int i) {
  return {picture_of(job, i),
          job.options.format,
          job.options.output,
          picture_size(job.options),
          {.software = std::string(kSoftwareName) + HALFSPACE_VERSION,
           .comment = render_comment(job.options.arguments, job.name, time_of(job, i))}};
}

void protect_inputs(const RenderJob& job, const std::filesystem::path& picture) {
  std::vector<std::filesystem::path> files = value_files(job.options.output, picture);
  files.push_back(picture);
  for (const std::filesystem::path& file : files) {
    reject_overwriting(file, job.inputs);
    // It could be a texture of a later scene of the list, whose files are not known yet.
    if (job.options.is_list() && job.options.has_fingerprints()) check_own_image(file);
  }
}

void protect_inputs(const RenderJob& job) {
  if (!job.pattern) return protect_inputs(job, job.out);
  if (job.options.is_list()) return;  // the folder would be read once per scene; each picture is checked before it is rendered
  for (const int frame : job.pattern->existing_frames()) {
    const int i = (frame - job.options.frames->first) / job.options.frames->step;
    if (job.options.shard.contains(i)) protect_inputs(job, picture_of(job, i));
  }
}

}  // namespace halfspace
