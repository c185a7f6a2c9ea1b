// SPDX-License-Identifier: Apache-2.0
//
// `halfspace render SCENE`: validates all arguments, then renders one image or a range of frames.
#include <chrono>
#include <iostream>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "cli/empty_picture.h"
#include "cli/render_job.h"
#include "cli/stage_display.h"
#include "command_line/command_line.h"
#include "command_line/errors.h"
#include "command_line/progress.h"
#include "halfspace/core/parallel.h"
#include "halfspace/image/atomic_output.h"
#include "halfspace/render/frame/naive_render.h"
#include "halfspace/render/prepared_scene.h"

namespace halfspace {

namespace {

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

double milliseconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
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

RenderReport run(const RenderJob& job) {
  const Workers workers(job.threads);
  SceneAssets assets(workers, print_warning);
  add_models(assets, job.models);
  RenderReport report;
  if (!job.frames) {
    const std::filesystem::path path = picture_of(job);
    check_writable(path);
    const StageDisplay rendering("rendering " + path.string());
    render_picture(job, job.time, path, assets, workers, report);
    return report;
  }
  if (job.shard.index < job.frames->count()) check_writable(picture_of(job, job.frames->at(job.shard.index)));
  // All frames determine the detail of generated maps, so that the shards do not affect the pictures.
  const auto time_of_frame = [&](int i) { return time_of(job, job.frames->at(i)); };
  expect_frames(assets, job.scene, job.frames->count(), time_of_frame, job.size.width, job.size.height);
  Progress progress((job.frames->count() - job.shard.index + job.shard.count - 1) / job.shard.count);
  for (int i = job.shard.index; i < job.frames->count(); i += job.shard.count) {
    const int frame = job.frames->at(i);
    const std::filesystem::path path = picture_of(job, frame);
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
  if (const std::string advice = advice_for_empty_pictures(job, report); !advice.empty())
    print_warning("nothing is visible in the picture; try " + advice);
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
