// SPDX-License-Identifier: Apache-2.0
#include "halfspace/raster/visibility/centroid.h"

#include "halfspace/raster/pipeline/edge.h"

namespace halfspace {

namespace {

bool covers_sample(const Triangle& t, int64_t x, int64_t y) {
  if (t.is(kPointSprite)) return x >= t.x[0] && x <= t.x[1] && y >= t.y[0] && y <= t.y[1];
  for (std::size_t i = 0; i < 3; ++i) {
    const Edge e = edge_of(t, i);
    if (e.at(x, y) - fill_bias(e) < 0) return false;
  }
  return true;
}

SamplePosition centroid(const Triangle& t, int samples, int x, int y) {
  const SamplePosition center{kSubPixels / 2, kSubPixels / 2};
  int covered = 0;
  SamplePosition first = center;
  for (int s = samples - 1; s >= 0; --s) {
    const SamplePosition p = sample_position(samples, s);
    if (!covers_sample(t, int64_t{x} * kSubPixels + p.x, int64_t{y} * kSubPixels + p.y)) continue;
    ++covered;
    first = p;
  }
  return covered == samples ? center : first;
}

}  // namespace

void find_centroids(const PassContext& context, int x, int y, const TriangleId* ids, TriangleId uniform, SamplePosition* out) {
  for (int i = 0; i < kLanes; ++i) {
    const TriangleId id = ids != nullptr ? ids[i] : uniform;
    out[i] = {kSubPixels / 2, kSubPixels / 2};
    if (id != kNoTriangle) out[i] = centroid(triangle_of(context, id), context.samples, x + block_x(i), y + block_y(i));
  }
}

const SamplePosition* find_centroids(const PacketBatch& batch, std::span<SamplePosition> out) {
  for (std::size_t i = 0; i < static_cast<std::size_t>(batch.count); ++i) {
    const int packet = batch.packets[i].packet;
    find_centroids(*batch.context, batch.tile_x0 + packet_x(packet), batch.tile_y0 + packet_y(packet), nullptr, batch.packet_ids[i],
                   &out[i * kLanes]);
  }
  return out.data();
}

}  // namespace halfspace
