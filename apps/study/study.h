// SPDX-License-Identifier: Apache-2.0
//
// A study measures several variants of the same rendering task: the error of each variant, compared with a reference (struct Truth), and
// its time. Each study has its own file. studies() lists them, and study_files.h writes the results.
//
// The error and the time of a variant come from the same run. All variants of a study have the same parameters (inputs, such as the number
// of triangles) and the same measures (metrics other than the error), so that models of cost and error can be fitted to the data.
#pragma once

#include <functional>
#include <glm/glm.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "halfspace/core/image.h"
#include "halfspace/core/parallel.h"

namespace halfspace {

struct StudyOptions {
  bool quick = false;  ///< small images and few variants, as a functional test; the numbers are not meaningful
};

/// Wall-clock time over several runs.
struct Timing {
  double median_ms = 0.0;
  double low_ms = 0.0, high_ms = 0.0;  ///< lower and upper quartile
  int runs = 0;
};

/// Runs `work` once to warm up, then measures at least 9 and at most 101 runs, stopping once 0.3 s have passed. With options.quick,
/// measures 3 runs.
Timing time_of(const std::function<void()>& work, const StudyOptions& options);

struct Quantity {
  std::string name;
  double value;
};

struct Variant {
  std::string name;                    ///< label of its point in the chart
  std::string group;                   ///< variants of a group have the same color in the chart
  std::vector<Quantity> parameters{};  ///< inputs, such as triangles or samples
  double error = 0.0;                  ///< see Study::error_name; a value below the error of the reference is not significant
  std::vector<Quantity> measures{};    ///< other metrics
  Timing time{};
  Image<glm::u8vec4> picture{}, difference{};  ///< may be empty
};

/// The reference for the errors of a study.
struct Truth {
  std::string method;            ///< how the reference was computed
  double error = 0.0;            ///< error of the reference itself, in the unit of the study
  std::string error_method;      ///< how that error was estimated
  Image<glm::u8vec4> picture{};  ///< may be empty
};

struct Study {
  std::string name, title;
  std::string setting;     ///< what was drawn, and the image size
  std::string error_name;  ///< title of the error axis, with the unit
  std::string time_name;   ///< what was timed; part of the title of the time axis
  Truth truth;
  std::vector<Variant> variants{};
};

/// Marks the variants on the Pareto front of error and median time. Errors below `floor` are treated as equal to it.
std::vector<bool> pareto_front(const std::vector<Variant>& variants, double floor);

struct StudyEntry {
  std::string_view name;
  Study (*run)(const StudyOptions&, const Workers&);
};

/// Returns all studies in display order.
std::vector<StudyEntry> studies();

// Each study is defined in the file of the same name.
Study study_shading_rate(const StudyOptions& options, const Workers& workers);
Study study_sphere_model(const StudyOptions& options, const Workers& workers);
Study study_displacement(const StudyOptions& options, const Workers& workers);
Study study_shadows(const StudyOptions& options, const Workers& workers);
Study study_terminator(const StudyOptions& options, const Workers& workers);
Study study_texture_filter(const StudyOptions& options, const Workers& workers);
Study study_antialiasing(const StudyOptions& options, const Workers& workers);
Study study_depth(const StudyOptions& options, const Workers& workers);
Study study_interpolation(const StudyOptions& options, const Workers& workers);
Study study_tone(const StudyOptions& options, const Workers& workers);
Study study_normals(const StudyOptions& options, const Workers& workers);
Study study_raster_vs_rays(const StudyOptions& options, const Workers& workers);
Study study_max_error(const StudyOptions& options, const Workers& workers);
Study study_levels_of_detail(const StudyOptions& options, const Workers& workers);
Study study_adaptive_tessellation(const StudyOptions& options, const Workers& workers);
Study study_specular(const StudyOptions& options, const Workers& workers);

}  // namespace halfspace
