// SPDX-License-Identifier: Apache-2.0
#include "halfspace/raster/sample_location.h"

#include "halfspace/core/check.h"
#include "halfspace/raster/pipeline/sample_pattern.h"

namespace halfspace::HS_LANES {

glm::vec2 sample_location(int samples, int sample) {
  HS_CHECK(samples == 1 || samples == 2 || samples == 4 || samples == 8,
           "sample_location: the number of samples is not supported; expected 1, 2, 4 or 8");
  HS_CHECK(sample >= 0 && sample < samples, "sample_location: there is no such sample; expected less than the number of samples");
  const SamplePosition p = sample_position(samples, sample);
  return glm::vec2(p.x, p.y) / static_cast<float>(kSubPixels);
}

}  // namespace halfspace::HS_LANES
