// SPDX-License-Identifier: Apache-2.0
#include "halfspace/raster/amplify/split_primitives.h"

#include <bit>
#include <map>
#include <utility>

namespace halfspace::HS_LANES {

std::vector<PrimitivePart> split_primitives(const EmittedPrimitives& primitives, const SplitOptions& options) {
  std::vector<PrimitivePart> parts;
  std::map<std::pair<int32_t, int32_t>, std::size_t> open;  // the part to which primitives of a layer and viewport are added
  std::map<int32_t, int32_t> last_viewport;                 // of each layer
  const std::size_t corners = primitives.vertices_per_primitive();
  const std::size_t provoking = options.first_provokes ? 0 : corners - 1;
  for (std::size_t i = 0; i < primitives.indices.size(); i += corners) {
    const float* const row = primitives.rows.data() + primitives.row * primitives.indices[i + provoking];
    const int32_t layer = options.layers == 1 ? 0 : std::bit_cast<int32_t>(row[options.place]);
    const auto viewport = std::bit_cast<int32_t>(row[options.place + 1]);
    if (layer < 0 || layer >= options.layers || viewport < 0 || viewport >= options.viewports) continue;
    const bool changes = options.viewports_overlap && last_viewport.contains(layer) && last_viewport[layer] != viewport;
    last_viewport[layer] = viewport;
    const auto [at, is_new] = open.try_emplace({layer, viewport}, parts.size());
    if (is_new || changes) {
      at->second = parts.size();
      parts.push_back({layer, viewport, {}, {}, {}});
    }
    PrimitivePart& to = parts[at->second];
    to.numbers.push_back(primitives.numbers[i / corners]);
    to.instances.push_back(primitives.instances[i / corners]);
    to.indices.insert(to.indices.end(), primitives.indices.begin() + static_cast<std::ptrdiff_t>(i),
                      primitives.indices.begin() + static_cast<std::ptrdiff_t>(i + corners));
  }
  return parts;
}

}  // namespace halfspace::HS_LANES
