// SPDX-License-Identifier: Apache-2.0
//
// A study's chart, in gnuplot's language: error across, time up, both logarithmic, the Pareto front as a line, a label at every
// point. gnuplot draws; what is decided here is the ranges and where labels stand.
#pragma once

#include <string>
#include <vector>

#include "halfspace/study/study.h"

namespace halfspace {

/// The script that writes NAME.svg, NAME-dark.svg and NAME.png into the working directory. on_front: as pareto_front says.
std::string chart_script(const Study& study, const std::vector<bool>& on_front);

/// A rectangle in pixels, y up.
struct ChartBox {
  double x0, y0, x1, y1;
};
/// A place for a label beside its point.
struct LabelPlace {
  double x, y;       ///< of the text's middle height at its anchor
  int anchor;        ///< −1: the text ends there, 0: its middle is there, 1: it begins there
  bool far = false;  ///< too far from its point to be read without a line
};
/// Places for labels of `widths` pixels beside points, one after the other, each where it covers the least of points and of labels
/// already placed. All stay within `room`.
std::vector<LabelPlace> place_labels(const std::vector<glm::dvec2>& points, const std::vector<double>& widths, const ChartBox& room);

}  // namespace halfspace
