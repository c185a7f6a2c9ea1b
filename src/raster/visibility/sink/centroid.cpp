// SPDX-License-Identifier: Apache-2.0
#include "halfspace/raster/visibility/sink/centroid.h"

#include "halfspace/raster/pipeline/edge.h"

namespace halfspace::HS_LANES {

bool covers_sample(const Triangle& t, int64_t x, int64_t y) {
  if (t.is_point()) {
    const PointSpriteRect r = t.sprite();
    return x >= r.x0 && x < r.x1 && y >= r.y0 && y < r.y1;
  }
  for (std::size_t i = 0; i < 3; ++i) {
    const Edge e = edge_of(t, i);
    if (e.at(x, y) - fill_bias(e) < 0) return false;
  }
  return true;
}

namespace {

SamplePosition centroid(const Triangle& t, int samples, int x, int y) {
  int covered = 0;
  SamplePosition first = kPixelCenter;
  for (int s = samples - 1; s >= 0; --s) {
    const SamplePosition p = sample_position(samples, s);
    if (!covers_sample(t, int64_t{x} * kSubPixels + p.x, int64_t{y} * kSubPixels + p.y)) continue;
    ++covered;
    first = p;
  }
  return covered == samples ? kPixelCenter : first;
}

// Computes the centroid positions of packet i of a batch.
void find_packet_centroids(const PacketBatch& batch, std::size_t i, SamplePosition* out) {
  const int packet = batch.packets[i].packet;
  const int x = batch.tile_x0 + packet_x(packet), y = batch.tile_y0 + packet_y(packet);
  for (int lane = 0; lane < kLanes; ++lane) {
    const TriangleId id = batch.ids != nullptr ? batch.ids[packet * kLanes + lane] : batch.packet_ids[i];
    out[lane] = id == kNoTriangle ? kPixelCenter
                                  : centroid(triangle_of(*batch.context, id), batch.context->samples, x + block_x(lane), y + block_y(lane));
  }
}

}  // namespace

const SamplePosition* find_centroids(const PacketBatch& batch, std::span<SamplePosition> out) {
  for (std::size_t i = 0; i < static_cast<std::size_t>(batch.count); ++i) find_packet_centroids(batch, i, &out[i * kLanes]);
  return out.data();
}

}  // namespace halfspace::HS_LANES
