// SPDX-License-Identifier: Apache-2.0
#include "cli/statistics.h"

#include <iomanip>
#include <nlohmann/json.hpp>
#include <sstream>

namespace halfspace {

namespace {

struct Count {
  const char* name;
  uint64_t PassStatistics::*member;
};

constexpr Count kCounts[] = {{"vertices_in", &PassStatistics::vertices_in},
                             {"vertices_shaded", &PassStatistics::vertices_shaded},
                             {"primitives_in", &PassStatistics::primitives_in},
                             {"culled_non_finite", &PassStatistics::culled_non_finite},
                             {"culled_outside", &PassStatistics::culled_outside},
                             {"culled_face", &PassStatistics::culled_face},
                             {"culled_degenerate", &PassStatistics::culled_degenerate},
                             {"culled_no_sample", &PassStatistics::culled_no_sample},
                             {"clipped", &PassStatistics::clipped},
                             {"triangles_binned", &PassStatistics::triangles_binned},
                             {"bin_entries", &PassStatistics::bin_entries},
                             {"samples_tested", &PassStatistics::samples_tested},
                             {"samples_passed", &PassStatistics::samples_passed},
                             {"fragments_shaded", &PassStatistics::fragments_shaded},
                             {"layers_merged", &PassStatistics::layers_merged},
                             {"tiles_touched", &PassStatistics::tiles_touched},
                             {"flushes", &PassStatistics::flushes}};
static_assert(sizeof(PassStatistics) == sizeof(uint64_t) * std::size(kCounts) + sizeof(PassStatistics::queries),
              "kCounts does not list every count of PassStatistics");

}  // namespace

std::string text_report(const RenderReport& r) {
  std::ostringstream text;
  text << r.scene << ", " << r.width << 'x' << r.height << ", " << r.threads << (r.threads == 1 ? " thread" : " threads") << ": "
       << r.output << '\n';
  text << std::fixed << std::setprecision(1);
  text << std::left << std::setw(20) << "render_ms" << r.render_ms << '\n' << std::setw(20) << "write_ms" << r.write_ms << '\n';
  for (const Count& c : kCounts) text << std::setw(20) << c.name << r.counts.*c.member << '\n';
  for (const ModelChoice& c : r.choices) text << c.key << '=' << c.value << "  (" << c.why << ")\n";
  return text.str();
}

std::string json_report(const RenderReport& r) {
  nlohmann::ordered_json json = {{"scene", r.scene},     {"output", r.output},       {"width", r.width},      {"height", r.height},
                                 {"threads", r.threads}, {"render_ms", r.render_ms}, {"write_ms", r.write_ms}};
  for (const Count& c : kCounts) json["counts"][c.name] = r.counts.*c.member;
  json["choices"] = nlohmann::ordered_json::array();
  for (const ModelChoice& c : r.choices) json["choices"].push_back({{"key", c.key}, {"value", c.value}, {"why", c.why}});
  return json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

}  // namespace halfspace
