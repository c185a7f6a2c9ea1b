// SPDX-License-Identifier: Apache-2.0
//
// Writes the chart of a study as a gnuplot script: error on the x axis and time on the y axis, both logarithmic, with the Pareto front as
// a line and a label at every point. The axis ranges and label positions are computed here rather than by gnuplot.
#pragma once

#include <string>
#include <vector>

#include "halfspace/study/study.h"

namespace halfspace {

/// Returns a script that writes NAME.svg, NAME-dark.svg and NAME.png to the working directory. on_front: result of pareto_front.
std::string chart_script(const Study& study, const std::vector<bool>& on_front);

/// A rectangle in pixels with y up.
struct ChartBox {
  double x0, y0, x1, y1;
};
/// Position of a label.
struct LabelPlace {
  double x, y;       ///< anchor point, at half the height of the text
  int anchor;        ///< which part of the text is at x: −1 the right end, 0 the center, 1 the left end
  bool far = false;  ///< the label is so far from its point that it needs a leader line
};
/// Places labels that are `widths` pixels wide next to their points. The algorithm is greedy: each label in turn is placed where
/// it overlaps the points and the labels already placed the least. Any part of a label outside `room` counts three times.
std::vector<LabelPlace> place_labels(const std::vector<glm::dvec2>& points, const std::vector<double>& widths, const ChartBox& room);

}  // namespace halfspace
