// SPDX-License-Identifier: Apache-2.0
//
// `render --resume`: which pictures of an earlier run are those that this run would write. Each picture stores a fingerprint of everything
// that determines its pixels (ImageText::fingerprint). Threads, lanes, shards and the other pictures of the run are not part of it.
#pragma once

#include <array>
#include <string>

#include "cli/render_job.h"
#include "halfspace/render/assets/minimum_sizes.h"

namespace halfspace {

/// The part of the fingerprint that all pictures of a job share.
struct JobFingerprint {
  std::string settings;  ///< the text that is hashed for the scene: all settings except the time
  std::string files;     ///< hash of the contents of all input files
};

/// minimum: sizes of generated maps, which depend on all frames of a range.
JobFingerprint fingerprint_of(const RenderJob& job, const MinimumSizes& minimum);

/// Returns the fingerprint of picture i: "build COMMIT scene HASH files HASH".
std::string picture_fingerprint(const RenderJob& job, const JobFingerprint& shared, int i);

/// Why a picture is rendered, or `kept`.
enum class ResumeState { kept, missing, incomplete, unmarked, other_build, other_scene, other_files };

/// Compares the files of a picture with files.text.fingerprint. Does not decode pixels.
ResumeState resume_state(const PictureFiles& files);

/// The numbers of pictures in each state.
class ResumeCounts {
 public:
  using Counts = std::array<int, 7>;  // by ResumeState

  void add(ResumeState state) { ++counts_[static_cast<std::size_t>(state)]; }
  void add(const Counts& other);
  const Counts& counts() const { return counts_; }
  int kept() const { return counts_[static_cast<std::size_t>(ResumeState::kept)]; }
  /// Returns one line: how many pictures were kept and how many were rendered, and why.
  std::string line() const;

 private:
  Counts counts_{};
};

}  // namespace halfspace
