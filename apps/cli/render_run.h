// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <set>
#include <string>

#include "cli/output_files.h"
#include "cli/picture_sink.h"
#include "cli/render_job.h"
#include "cli/run_results.h"
#include "command_line/progress.h"
#include "halfspace/core/parallel.h"
#include "halfspace/render/scene_assets.h"

namespace halfspace {

/// Returns the index of the next piece of work of this process, or nothing after the last one.
using NextIndex = std::function<std::optional<int>()>;

/// Returns those of 0 … total − 1 that belong to a shard; by default, all of them.
NextIndex indices_of(int total, const Shard& shard = {});

/// Renders the pictures of one job after another. Assets that two jobs in a row share are prepared once.
class RenderRun {
 public:
  /// progress: is advanced by each picture. resumed: counts the pictures of --resume. All arguments must outlive this object.
  RenderRun(const RenderOptions& options, Progress& progress, ResumeCounts& resumed);

  /// Renders the pictures of a job that `next` selects, and adds them to the counts. Throws UsageError, InputError and OutputError.
  void render(const RenderJob& job, const NextIndex& next, JobCounts& counts);

  /// Frees what the previous job left for the next one.
  void forget_assets();

  const RenderReport& report() const { return report_; }

 private:
  void begin(const RenderJob& job);
  // Removes what killed processes left behind in a folder, once per run.
  void clean(const std::filesystem::path& folder);
  bool keeps(const PictureFiles& files);
  void render_picture(const RenderJob& job, int i, PictureFiles files);

  const RenderOptions& options_;
  Progress& progress_;
  ResumeCounts& resumed_;
  Workers workers_;
  std::unique_ptr<SceneAssets> assets_;  // of the current job
  std::unique_ptr<PictureSink> stream_;  // receives the pictures of all jobs, if they go to standard output
  std::set<std::filesystem::path> cleaned_;
  RenderReport report_;
};

}  // namespace halfspace
