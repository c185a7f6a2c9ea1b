// SPDX-License-Identifier: Apache-2.0
#include "cli/resume.h"

#include <fmt/format.h>

#include <string_view>
#include <utility>

#include "cli/build_commit.h"
#include "cli/file_hash.h"
#include "halfspace/core/text.h"
#include "halfspace/core/tool_folder.h"
#include "halfspace/image/image_text.h"
#include "halfspace/image/image_tool.h"

namespace halfspace {

namespace {

// Identifies the program.
std::string build() { return std::string(HALFSPACE_VERSION) + "-" + build_commit(); }

// Returns the word after "NAME ", or an empty text.
std::string_view part_of(std::string_view fingerprint, std::string_view name) {
  const std::size_t at = fingerprint.find(name);
  if (at == std::string_view::npos) return {};
  const std::string_view rest = fingerprint.substr(at + name.size());
  return rest.substr(0, rest.find(' '));
}

ResumeState state_of(const std::filesystem::path& file, const std::string& expected) {
  std::error_code error;
  if (!std::filesystem::exists(file, error)) return ResumeState::missing;
  if (!is_whole_image(file)) return ResumeState::incomplete;
  const std::string found = read_image_text(file).fingerprint;
  if (found == expected) return ResumeState::kept;
  const auto is_same = [&](std::string_view name) { return part_of(found, name) == part_of(expected, name); };
  if (part_of(found, "files ").empty()) return ResumeState::unmarked;
  if (!is_same("scene ")) return ResumeState::other_scene;
  return is_same("files ") ? ResumeState::other_build : ResumeState::other_files;
}

}  // namespace

JobFingerprint fingerprint_of(const RenderJob& job, const MinimumSizes& minimum) {
  const RenderOptions& o = job.options;
  std::string settings =
      fmt::format("{}{}x{} {} {}\n", job.scene.print(), o.size.width, o.size.height, static_cast<int>(o.format.picture), o.output.fine);
  if (o.output.crop)
    settings += fmt::format("crop {} {} {} {}\n", o.output.crop->x, o.output.crop->y, o.output.crop->width, o.output.crop->height);
  settings += fmt::format("values {} {}\n", value_names(o.output), o.output.separate);
  if (o.allowed) settings += fmt::format("error {} {}\n", o.arguments.max_error, o.arguments.max_error_color);
  settings += fmt::format("wireframe {} naive {}\n", o.arguments.wireframe, o.arguments.naive);
  // Without a decoder, models are drawn without their textures.
  settings +=
      fmt::format("decoders {} {} {}\n", !find_image_tool().empty(), !find_jpeg_tool().empty(), !find_tool("halfspace-draco-tool").empty());
  for (const auto& [name, width] : minimum.map_widths) settings += fmt::format("map {} {}\n", name, width);
  settings += fmt::format("environments {} {}\n", minimum.environments.panorama_width, minimum.environments.face);
  return {std::move(settings), job.input_hash};
}

std::string picture_fingerprint(const RenderJob& job, const JobFingerprint& shared, int i) {
  return fmt::format("build {} scene {} files {}", build(), hash_of(shared.settings + number_text(time_of(job, i))), shared.files);
}

ResumeState resume_state(const PictureFiles& files) {
  for (const std::filesystem::path& file : all_files(files)) {
    if (const ResumeState state = state_of(file, files.text.fingerprint); state != ResumeState::kept) return state;
  }
  return ResumeState::kept;
}

void ResumeCounts::add(const Counts& other) {
  for (std::size_t k = 0; k < counts_.size(); ++k) counts_[k] += other[k];
}

std::string ResumeCounts::line() const {
  constexpr std::pair<ResumeState, const char*> kReasons[] = {{ResumeState::missing, "missing"},
                                                              {ResumeState::incomplete, "incomplete"},
                                                              {ResumeState::unmarked, "without a fingerprint"},
                                                              {ResumeState::other_build, "of another build"},
                                                              {ResumeState::other_scene, "of another scene, time or setting"},
                                                              {ResumeState::other_files, "of other input files"}};
  int rendered = 0;
  std::string reasons;
  for (const auto& [state, reason] : kReasons) {
    const int count = counts_[static_cast<std::size_t>(state)];
    rendered += count;
    if (count > 0) reasons += fmt::format("{}{} {}", reasons.empty() ? ": " : ", ", count, reason);
  }
  return fmt::format("kept {} picture{}, rendered {}{}", kept(), kept() == 1 ? "" : "s", rendered, reasons);
}

}  // namespace halfspace
