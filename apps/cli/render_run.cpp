// SPDX-License-Identifier: Apache-2.0
#include "cli/render_run.h"

#include <malloc.h>

#include <chrono>
#include <utility>

#include "cli/detail_files.h"
#include "command_line/command_line.h"
#include "halfspace/core/check.h"
#include "halfspace/image/atomic_output.h"
#include "halfspace/render/frame/naive_render.h"
#include "halfspace/render/prepared_scene.h"

namespace halfspace {

namespace {

constexpr uint64_t kMaxCacheBytes = uint64_t{256} << 20;

// Throws InputError if the naive pipeline cannot draw the scene.
void check_naive(const PreparedScene& scene, const SceneDescription& description) {
  if (const std::string obstacle = naive_obstacle(scene, description); !obstacle.empty()) throw InputError(obstacle);
}

// Prepares the scene at a point in time. Adds the name of the scene to error messages.
PreparedScene prepare(const RenderJob& job, double seconds, SceneAssets& assets, RenderReport& report) {
  const RenderOptions& o = job.options;
  SceneDescription scene = job.scene.at(seconds);
  try {
    if (o.allowed) {
      SceneWithinError chosen = assets.choose_within_error(scene, o.size.width, o.size.height, *o.allowed);
      scene = std::move(chosen.scene);
      report.choices = std::move(chosen.choices);
    }
    if (o.wireframe) scene.shadow.method = ShadowMethod::none;
    PreparedScene prepared = assets.prepare(scene, o.size.width, o.size.height);
    report.models.clear();
    for (const SimplifiedObject& s : prepared.simplified) {
      const auto& [name, object] = scene.objects[static_cast<std::size_t>(s.object)];
      report.models.push_back({name, object.shape == Shape::file ? object.model_error : object.mesh_error, s});
    }
    if (o.wireframe) report.spheres_without_wireframe |= make_wireframe(prepared, scene, *o.wireframe);
    if (o.arguments.naive) check_naive(prepared, scene);
    return prepared;
  } catch (const InputError& e) {
    throw InputError(message_in_scene(job.scene, e.what()));
  }
}

}  // namespace

NextIndex indices_of(int total, const Shard& shard) {
  return [i = shard.index, shard, total]() mutable -> std::optional<int> {
    if (i >= total) return std::nullopt;
    const int index = i;
    i = total - i > shard.count ? i + shard.count : total;
    return index;
  };
}

RenderRun::RenderRun(const RenderOptions& options, Progress& progress, ResumeCounts& resumed)
    : options_(options), progress_(progress), resumed_(resumed), workers_(options.threads) {
  if (options.format.to_standard_output) stream_ = make_picture_sink(options, {});
}

void RenderRun::render(const RenderJob& job, const NextIndex& next, JobCounts& counts) {
  protect_inputs(job);
  std::optional<JobFingerprint> fingerprint;
  std::unique_ptr<PictureSink> animation = stream_ != nullptr ? nullptr : make_picture_sink(options_, job.out);
  for (std::optional<int> i = next(); i; i = next()) {
    PictureFiles files = files_of(job, *i);
    files.sink = stream_ != nullptr ? stream_.get() : animation.get();
    if (counts.rendered + counts.kept == 0) {
      if (!options_.format.to_standard_output) check_writable(files.picture);
      begin(job);
      if (options_.has_fingerprints()) fingerprint = fingerprint_of(job, assets_->minimum_sizes());
    }
    if (!options_.format.to_standard_output) clean(files.picture.parent_path());
    if (fingerprint) files.text.fingerprint = picture_fingerprint(job, *fingerprint, *i);
    const auto start = std::chrono::steady_clock::now();
    const bool kept = options_.arguments.resume && keeps(files);
    if (!kept) {
      if (counts.rendered == 0) add_models(*assets_, job.models);
      render_picture(job, *i, files);
    }
    ++(kept ? counts.kept : counts.rendered);
    progress_.advance(kept, files.picture.string(), std::chrono::steady_clock::now() - start);
  }
  if (animation != nullptr) animation->finish();
}

void RenderRun::forget_assets() {
  assets_.reset();
  ::malloc_trim(0);  // the memory limit counts what the process holds, not what it uses
}

void RenderRun::begin(const RenderJob& job) {
  // Frames that were announced for the previous job must not affect this one.
  assets_ =
      assets_ ? std::make_unique<SceneAssets>(*assets_, workers_, print_warning) : std::make_unique<SceneAssets>(workers_, print_warning);
  if (const std::filesystem::path folder = detail_folder(); !folder.empty() && !options_.arguments.no_cache)
    assets_->keep_details(std::make_shared<DetailFiles>(folder, kMaxCacheBytes, print_warning));
  assets_->forget_shadow_maps();  // the scene may need their memory
  // All frames determine the detail of generated maps, so that the pictures do not depend on which process renders them.
  if (options_.frames) {
    expect_frames(
        *assets_, job.scene, options_.pictures_per_scene(), [&](int i) { return time_of(job, i); }, options_.size.width,
        options_.size.height);
  }
}

void RenderRun::clean(const std::filesystem::path& folder) {
  if (cleaned_.insert(folder).second) remove_abandoned_output(folder);
}

bool RenderRun::keeps(const PictureFiles& files) {
  const ResumeState state = resume_state(files);
  resumed_.add(state);
  if (state != ResumeState::kept) return false;
  ++report_.pictures;  // not known to be empty
  return true;
}

// Renders one picture to its files and adds its times and counts to the report.
void RenderRun::render_picture(const RenderJob& job, int i, PictureFiles files) {
  protect_inputs(job, files.picture);
  const auto start = std::chrono::steady_clock::now();
  const PreparedScene scene = prepare(job, time_of(job, i), *assets_, report_);
  const double prepared_ms = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
  report_.counts += scene.shadow_statistics;
  double shadow_ms = 0.0;
  for (const PreparedLight& light : scene.lights) shadow_ms += light.map_ms;
  report_.images_ms += scene.images_ms;
  report_.shadow_ms += shadow_ms;
  report_.prepare_ms += prepared_ms - shadow_ms - scene.images_ms;
  report_.render_ms += prepared_ms;
  if (options_.arguments.naive) files.naive = &report_.naive;
  render_files(scene, files, workers_, report_);
}

}  // namespace halfspace
