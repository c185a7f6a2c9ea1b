// SPDX-License-Identifier: Apache-2.0
#include "halfspace/render/shadow/moment_map.h"

#include <algorithm>
#include <vector>

#include "halfspace/core/lanes.h"

namespace halfspace::HS_LANES {

namespace {

// Four interleaved floats per texel, padded for the last SIMD packet.
using MomentRow = std::vector<float>;
MomentRow make_row(int texels) { return MomentRow(static_cast<std::size_t>(4 * texels + kLanes - 1)); }

// Computes the mean of `count` rows of `floats` values; row k starts at rows(k).
template <class Rows>
void mean_of(int count, int floats, const Rows& rows, float* out) {
  const Real share(1.0f / static_cast<float>(count));
  for (int i = 0; i < floats; i += kLanes) {
    Real sum = load<Real>(rows(0) + i);
    for (int k = 1; k < count; ++k) sum += load<Real>(rows(k) + i);
    store(out + i, sum * share);
  }
}

// Filters one row of depths horizontally.
class RowFilter {
 public:
  RowFilter(const ShadowView& view, int size, int radius)
      : view_(view), size_(size), radius_(radius), powers_(make_row(size + 2 * radius)) {}

  void operator()(const float* depths, float* out) {
    for (int x = -radius_; x < size_ + radius_; ++x) {
      const float d = linear(depths[std::clamp(x, 0, size_ - 1)]), d2 = d * d;
      store(powers_.data() + 4 * (x + radius_), glm::vec4(d, d2, d2 * d, d2 * d * d));
    }
    mean_of(
        2 * radius_ + 1, 4 * size_, [&](int k) { return powers_.data() + 4 * k; }, out);
  }

 private:
  float linear(float z) const {
    if (!view_.perspective) return 1.0f - z;
    const float b = -view_.near / (view_.far - view_.near);  // z = depth_per_unit / w + b
    return (view_.depth_per_unit / (z - b) - view_.near) / (view_.far - view_.near);
  }

  const ShadowView& view_;
  int size_, radius_;
  MomentRow powers_;
};

}  // namespace

Image<glm::vec4> filtered_moments(const ShadowView& view, const Image<float>& depth, int radius, const Workers& workers) {
  constexpr int kBand = 128;  // rows per task; both neighboring tasks filter the 2·radius rows around their boundary
  const int size = depth.width(), count = 2 * radius + 1;
  Image<glm::vec4> out(size, size);
  workers.for_each((size + kBand - 1) / kBand, [&](int band) {
    const int first = band * kBand, end = std::min(first + kBand, size);
    RowFilter filter(view, size, radius);
    // The last `count` rows, filtered horizontally. Row r is in slot r modulo count.
    std::vector<MomentRow> slots(static_cast<std::size_t>(count), make_row(size));
    const auto slot = [&](int row) { return slots[static_cast<std::size_t>((row + count) % count)].data(); };
    MomentRow mean = make_row(size);
    for (int row = first - radius; row < end + radius; ++row) {
      filter(depth.row(std::clamp(row, 0, size - 1)).data(), slot(row));
      const int done = row - radius;
      if (done < first) continue;
      mean_of(
          count, 4 * size, [&](int k) { return slot(done - radius + k); }, mean.data());
      std::copy_n(mean.data(), 4 * size, &out.at(0, done).x);
    }
  });
  return out;
}

}  // namespace halfspace::HS_LANES
