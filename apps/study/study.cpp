// SPDX-License-Identifier: Apache-2.0
#include "study/study.h"

#include <algorithm>
#include <chrono>

namespace halfspace {

Timing time_of(const std::function<void()>& work, const StudyOptions& options) {
  using Clock = std::chrono::steady_clock;
  const int min_runs = options.quick ? 3 : 9, max_runs = options.quick ? 3 : 101;
  constexpr double kSeconds = 0.3;
  work();
  std::vector<double> ms;
  const auto begin = Clock::now();
  const auto passed = [&] { return std::chrono::duration<double>(Clock::now() - begin).count(); };
  while (static_cast<int>(ms.size()) < min_runs || (static_cast<int>(ms.size()) < max_runs && passed() < kSeconds)) {
    const auto start = Clock::now();
    work();
    ms.push_back(std::chrono::duration<double, std::milli>(Clock::now() - start).count());
  }
  std::ranges::sort(ms);
  const auto at = [&](std::size_t quarter) { return ms[(ms.size() - 1) * quarter / 4]; };
  return {at(2), at(1), at(3), static_cast<int>(ms.size())};
}

std::vector<bool> pareto_front(const std::vector<Variant>& variants, double floor) {
  const auto error = [&](const Variant& v) { return std::max(v.error, floor); };
  std::vector<bool> on_front;
  for (const Variant& a : variants) {
    on_front.push_back(std::ranges::none_of(variants, [&](const Variant& b) {
      const bool no_worse = error(b) <= error(a) && b.time.median_ms <= a.time.median_ms;
      return no_worse && (error(b) < error(a) || b.time.median_ms < a.time.median_ms);
    }));
  }
  return on_front;
}

std::vector<StudyEntry> studies() {
  return {{"shading_rate", study_shading_rate},
          {"sphere_model", study_sphere_model},
          {"displacement", study_displacement},
          {"normals", study_normals},
          {"shadows", study_shadows},
          {"terminator", study_terminator},
          {"texture_filter", study_texture_filter},
          {"antialiasing", study_antialiasing},
          {"depth", study_depth},
          {"interpolation", study_interpolation},
          {"raster_vs_rays", study_raster_vs_rays},
          {"specular", study_specular},
          {"tone", study_tone},
          {"max_error", study_max_error},
          {"levels_of_detail", study_levels_of_detail},
          {"adaptive_tessellation", study_adaptive_tessellation}};
}

}  // namespace halfspace
