// SPDX-License-Identifier: Apache-2.0
//
// A study: variants of one thing, each with its error against a truth and its time. One file a study; study_list.cpp names them,
// study_files.h writes what they found.
//
// Error and time of a variant come from the same run. Every variant of a study tells the same parameters (what it was made of) and
// the same measures (what came out besides its error), so that models of cost and error can be fitted to the data.
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
  bool quick = false;  ///< small and few: to see that all works; the figures mean little
};

/// Wall time of one piece of work, done several times.
struct Timing {
  double median_ms = 0.0;
  double low_ms = 0.0, high_ms = 0.0;  ///< lower and upper quartile
  int runs = 0;
};

/// Times `work`, after once to warm up: at least 9 times and until 0.3 s have passed, at most 101 times; with quick 3 times.
Timing time_of(const std::function<void()>& work, const StudyOptions& options);

struct Quantity {
  std::string name;
  double value;
};

struct Variant {
  std::string name;                    ///< stands at its point on the chart
  std::string group;                   ///< points of one group have one colour
  std::vector<Quantity> parameters{};  ///< what the variant was made of
  double error = 0.0;                  ///< of Study::error_name; below the truth's own it means nothing but "at most that"
  std::vector<Quantity> measures{};    ///< what else was found
  Timing time{};
  Image<glm::u8vec4> picture{}, difference{};  ///< may be empty
};

/// What errors are measured from.
struct Truth {
  std::string method;            ///< how it was computed
  double error = 0.0;            ///< its own, in the study's unit
  std::string error_method;      ///< how that is known
  Image<glm::u8vec4> picture{};  ///< may be empty
};

struct Study {
  std::string name, title;
  std::string setting;     ///< what was drawn, at which size
  std::string error_name;  ///< with its unit; the chart's axis
  std::string time_name;   ///< of what one time is; the chart's axis
  Truth truth;
  std::vector<Variant> variants{};
};

/// Which variants no other one beats in error and time. Errors below `floor` count as it.
std::vector<bool> pareto_front(const std::vector<Variant>& variants, double floor);

struct StudyEntry {
  std::string_view name;
  Study (*run)(const StudyOptions&, const Workers&);
};

/// All studies, in the order in which they are shown.
std::vector<StudyEntry> studies();

// Each in the file of its name.
Study study_shading_rate(const StudyOptions& options, const Workers& workers);
Study study_sphere_model(const StudyOptions& options, const Workers& workers);
Study study_displacement(const StudyOptions& options, const Workers& workers);
Study study_shadows(const StudyOptions& options, const Workers& workers);
Study study_texture_filter(const StudyOptions& options, const Workers& workers);
Study study_antialiasing(const StudyOptions& options, const Workers& workers);
Study study_depth(const StudyOptions& options, const Workers& workers);
Study study_interpolation(const StudyOptions& options, const Workers& workers);
Study study_tone(const StudyOptions& options, const Workers& workers);
Study study_normals(const StudyOptions& options, const Workers& workers);
Study study_raster_vs_rays(const StudyOptions& options, const Workers& workers);
Study study_max_error(const StudyOptions& options, const Workers& workers);
Study study_specular(const StudyOptions& options, const Workers& workers);

}  // namespace halfspace
