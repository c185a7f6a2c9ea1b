// SPDX-License-Identifier: Apache-2.0
//
// The table of `halfspace validate --table` as a study, so that it is charted as all are.
#pragma once

#include <vector>

#include "halfspace/reference/shadow_table.h"
#include "halfspace/study/study.h"

namespace halfspace {

/// Means over the table's scenes, named shadow_table: each bias, filter and resolution once, by the lights' own angles; of a full table
/// every filter with every bias at 2048 texels a side, over its angles. A time is one frame's. rows: at least one; width, height: of the
/// pictures, px.
Study shadow_table_study(const std::vector<TableRow>& rows, int width, int height);

}  // namespace halfspace
