// SPDX-License-Identifier: Apache-2.0
#include "cli/statistics.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

namespace halfspace {

namespace {

struct Count {
  const char* name;
  uint64_t PassStatistics::*member;
  uint64_t PassStatistics::*whole = nullptr;  // the text also gives the share of this count
};

constexpr Count kCounts[] = {{"vertices_in", &PassStatistics::vertices_in},
                             {"vertices_shaded", &PassStatistics::vertices_shaded},
                             {"patches_in", &PassStatistics::patches_in},
                             {"vertices_evaluated", &PassStatistics::vertices_evaluated},
                             {"geometry_invocations", &PassStatistics::geometry_invocations},
                             {"primitives_in", &PassStatistics::primitives_in},
                             {"culled_non_finite", &PassStatistics::culled_non_finite, &PassStatistics::primitives_in},
                             {"culled_outside", &PassStatistics::culled_outside, &PassStatistics::primitives_in},
                             {"culled_face", &PassStatistics::culled_face, &PassStatistics::primitives_in},
                             {"culled_degenerate", &PassStatistics::culled_degenerate, &PassStatistics::primitives_in},
                             {"culled_cluster", &PassStatistics::culled_cluster, &PassStatistics::primitives_in},
                             {"culled_no_sample", &PassStatistics::culled_no_sample, &PassStatistics::primitives_in},
                             {"clipped", &PassStatistics::clipped},
                             {"triangles_binned", &PassStatistics::triangles_binned, &PassStatistics::primitives_in},
                             {"bin_entries", &PassStatistics::bin_entries},
                             {"samples_tested", &PassStatistics::samples_tested},
                             {"samples_passed", &PassStatistics::samples_passed, &PassStatistics::samples_tested},
                             {"fragments_shaded", &PassStatistics::fragments_shaded},
                             {"layers_merged", &PassStatistics::layers_merged},
                             {"tiles_touched", &PassStatistics::tiles_touched},
                             {"flushes", &PassStatistics::flushes}};
static_assert(sizeof(PassStatistics) == sizeof(uint64_t) * std::size(kCounts) + 3 * sizeof(PassStatistics::queries),
              "kCounts does not list every count of PassStatistics");

// Returns a line such as "culled_face          1919 (41.5 %)".
std::string line_of(const Count& c, const PassStatistics& s) {
  const uint64_t whole = c.whole == nullptr ? 0 : s.*c.whole;
  const std::string share =
      whole == 0 ? "" : fmt::format(" ({:.1f} %)", 100.0 * static_cast<double>(s.*c.member) / static_cast<double>(whole));
  return fmt::format("{:20} {}{}\n", c.name, s.*c.member, share);
}

}  // namespace

std::string text_report(const RenderReport& r) {
  std::string text =
      fmt::format("{}, {}x{}, {} thread{}: {}\n", r.scene, r.width, r.height, r.threads, r.threads == 1 ? "" : "s", r.output);
  for_each_stage(r, [&](const char* name, double ms) { text += fmt::format("{:20} {:.1f}\n", name, ms); });
  for (const Count& c : kCounts) text += line_of(c, r.counts);
  for (const ApproximationChoice& c : r.choices) text += fmt::format("{}={}  ({})\n", c.key, c.value, c.why);
  for (const SimplifiedModel& m : r.models)
    text += fmt::format("objects.{}: draws {} of {} triangles, {} {:.3f} px off; {} px are allowed\n", m.name, m.counts.drawn,
                        m.counts.triangles, m.counts.is_estimate ? "about" : "at most", m.counts.error_px, m.allowed_px);
  return text;
}

std::string json_report(const RenderReport& r) {
  nlohmann::ordered_json json = {
      {"scene", r.scene}, {"output", r.output}, {"width", r.width}, {"height", r.height}, {"threads", r.threads}};
  for_each_stage(r, [&](const char* name, double ms) { json[name] = ms; });
  for (const Count& c : kCounts) json["counts"][c.name] = r.counts.*c.member;
  json["choices"] = nlohmann::ordered_json::array();
  for (const ApproximationChoice& c : r.choices) json["choices"].push_back({{"key", c.key}, {"value", c.value}, {"why", c.why}});
  json["models"] = nlohmann::ordered_json::array();
  for (const SimplifiedModel& m : r.models)
    json["models"].push_back({{"object", m.name},
                              {"triangles", m.counts.triangles},
                              {"drawn", m.counts.drawn},
                              {"error_px", m.counts.error_px},
                              {"allowed_px", m.allowed_px}});
  return json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

}  // namespace halfspace
