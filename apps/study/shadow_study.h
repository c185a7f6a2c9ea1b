// SPDX-License-Identifier: Apache-2.0
//
// Converts the table of `halfspace validate --table` to a study, so that it can be charted.
#pragma once

#include <vector>

#include "halfspace/reference/shadow_table.h"
#include "study/study.h"

namespace halfspace {

/// Returns a study named shadow_table, whose variants are means over the scenes of the table. A normal table gives one variant for each
/// bias, filter and resolution; rows that vary the angle are ignored. A full table gives one variant for each pair of filter and bias at
/// a resolution of 2048, averaged over the angles. Times are per frame. `rows` must not be empty; width and height are the size of the
/// validated images in pixels.
Study shadow_table_study(const std::vector<TableRow>& rows, int width, int height);

}  // namespace halfspace
