// SPDX-License-Identifier: Apache-2.0
#include "halfspace/raster/amplify/emitting_stages.h"

#include <algorithm>

namespace halfspace::HS_LANES {

void copy_emitted_vertices(const void*, const VertexBatch& batch) {
  const VertexStream &positions = batch.streams[0], &others = batch.streams[1], &varyings = batch.streams[2];
  // The last vertex is repeated, because whole registers of positions are read.
  for (int i = 0; i < (batch.count + kLanes - 1) / kLanes * kLanes; ++i) {
    const int from = std::min(i, batch.count - 1);
    const uint32_t id = batch.ids != nullptr ? batch.ids[from] : batch.first + static_cast<uint32_t>(from);
    const auto values = [&](const VertexStream& s) {
      return reinterpret_cast<const float*>(s.data + std::size_t{id} * static_cast<std::size_t>(s.stride));
    };
    for (int k = 0; k < 4; ++k) batch.clip[k * kVertexBatch + i] = values(positions)[k];
    for (int k = 0; batch.extra != nullptr && k < others.components; ++k) batch.extra[k * kVertexBatch + i] = values(others)[k];
    const auto n = static_cast<std::size_t>(varyings.components);
    if (batch.varyings != nullptr && i == from) std::copy_n(values(varyings), n, batch.varyings + std::size_t{id - batch.slot_base} * n);
  }
}

}  // namespace halfspace::HS_LANES
