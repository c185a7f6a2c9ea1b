// SPDX-License-Identifier: Apache-2.0
#include "halfspace/geometry/height_field.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "halfspace/core/check.h"
#include "halfspace/core/float_mode.h"
#include "halfspace/core/lane_math.h"
#include "halfspace/core/trig_double.h"

namespace halfspace::HS_LANES {

namespace {

// ---- filters ---------------------------------------------------------------------------------------------------

// Filter weights for the offsets first, first + 1, …; they add up to 1.
struct Kernel {
  int first = 0;
  std::vector<double> weights;
};

void normalize(std::vector<double>& weights) {
  double sum = 0;
  for (const double w : weights) sum += w;
  for (double& w : weights) w /= sum;
}

// A Gaussian with a standard deviation of `sigma` texels, truncated at 3.5 sigma. The truncated tails have a weight of 5e-4.
Kernel gaussian(double sigma) {
  if (sigma <= 0) return {0, {1.0}};
  const int reach = static_cast<int>(std::ceil(3.5 * sigma));
  Kernel k{-reach, {}};
  for (int i = -reach; i <= reach; ++i) {
    const double x = i / sigma;
    k.weights.push_back(static_cast<double>(halfspace::exp(static_cast<float>(-0.5 * x * x))));
  }
  normalize(k.weights);
  return k;
}

// Wraps a filter onto a ring of `period` texels: weights that fall on the same texel are added.
Kernel on_ring(const Kernel& k, int period) {
  const int count = static_cast<int>(k.weights.size());
  if (count <= period) return k;
  Kernel ring{0, std::vector<double>(static_cast<std::size_t>(period))};
  for (int i = 0; i < count; ++i) {
    const int offset = (k.first + i) % period;
    ring.weights[static_cast<std::size_t>(offset < 0 ? offset + period : offset)] += k.weights[static_cast<std::size_t>(i)];
  }
  return ring;
}

int wrapped(int x, int width) {
  const int r = x % width;
  return r < 0 ? r + width : r;
}

int column_at(int x, int width, MapEdges edges) { return edges == MapEdges::sheet ? std::clamp(x, 0, width - 1) : wrapped(x, width); }

struct FoldedRow {
  int row;
  int shift;  // added to the column
};

// A row beyond a pole is the mirrored row, half a turn away.
FoldedRow fold(int row, int width, int height, MapEdges edges) {
  if (edges == MapEdges::torus) return {wrapped(row, height), 0};
  if (edges != MapEdges::sphere) return {std::clamp(row, 0, height - 1), 0};
  const int r = wrapped(row, 2 * height);
  return r < height ? FoldedRow{r, 0} : FoldedRow{2 * height - 1 - r, width / 2};
}

// Smooths one row along u, in place.
void smooth_row(std::span<float> row, const Kernel& kernel, MapEdges edges) {
  const int width = static_cast<int>(row.size());
  const Kernel k = edges == MapEdges::sheet ? kernel : on_ring(kernel, width);
  const int count = static_cast<int>(k.weights.size());
  std::vector<double> ring(static_cast<std::size_t>(width + count));
  for (int x = 0; x < width + count; ++x) {
    const int column = x + k.first;
    const bool inside = column >= 0 && column < width;  // almost always true; computing a remainder for every column would be slow
    ring[static_cast<std::size_t>(x)] =
        static_cast<double>(row[static_cast<std::size_t>(inside ? column : column_at(column, width, edges))]);
  }
  std::vector<double> sum(static_cast<std::size_t>(width));
  for (std::size_t i = 0; i < k.weights.size(); ++i) {
    for (std::size_t x = 0; x < sum.size(); ++x) sum[x] += k.weights[i] * ring[x + i];
  }
  for (std::size_t x = 0; x < sum.size(); ++x) row[x] = static_cast<float>(sum[x]);
}

// Smooths along v, across the edges of the map.
Image<float> smooth_columns(const Image<float>& map, const Kernel& k, MapEdges edges, const Workers& workers) {
  const int width = map.width(), height = map.height();
  Image<float> out(width, height);
  workers.for_each(height, [&](int row) {
    std::vector<double> sum(static_cast<std::size_t>(width));
    for (std::size_t i = 0; i < k.weights.size(); ++i) {
      const FoldedRow from = fold(row + k.first + static_cast<int>(i), width, height, edges);
      const std::span<const float> texels = map.row(from.row);
      const auto shift = static_cast<std::size_t>(from.shift), before_seam = sum.size() - shift;
      for (std::size_t x = 0; x < before_seam; ++x) sum[x] += k.weights[i] * static_cast<double>(texels[x + shift]);
      for (std::size_t x = before_seam; x < sum.size(); ++x) sum[x] += k.weights[i] * static_cast<double>(texels[x - before_seam]);
    }
    std::transform(sum.begin(), sum.end(), out.row(row).begin(), [](double s) { return static_cast<float>(s); });
  });
  return out;
}

double sin_of_row(int row, int height) { return sincos_turns(0.5 * (row + 0.5) / height).sin; }

// Caps sigma at the width of the ring. A filter of that width already averages the whole ring: it scales the lowest frequency by
// exp(−2π²).
Kernel capped_gaussian(double sigma, int width) { return gaussian(std::min(sigma, static_cast<double>(width))); }

// ---- resampling ------------------------------------------------------------------------------------------------

// Returns the box filter weights of texel `i` when a row of `from` texels is reduced to `to` ≤ from texels.
Kernel overlap(int i, int from, int to) {
  // In units of 1/(from·to) of the map, all texel edges are integers.
  const int64_t begin = static_cast<int64_t>(i) * from, end = begin + from;
  Kernel k{static_cast<int>(begin / to), {}};
  for (int64_t texel = begin / to; texel * to < end; ++texel) {
    k.weights.push_back(static_cast<double>(std::min(end, (texel + 1) * to) - std::max(begin, texel * to)));
  }
  normalize(k.weights);
  return k;
}

// Box filters the map to a coarser grid.
Image<float> averaged(const Image<float>& map, int width, int height, const Workers& workers) {
  Image<float> out(width, height);
  std::vector<Kernel> columns;
  for (int x = 0; x < width; ++x) columns.push_back(overlap(x, map.width(), width));
  workers.for_each(height, [&](int y) {
    const Kernel rows = overlap(y, map.height(), height);
    for (int x = 0; x < width; ++x) {
      const Kernel& k = columns[static_cast<std::size_t>(x)];
      double sum = 0;
      for (std::size_t j = 0; j < rows.weights.size(); ++j) {
        double row = 0;
        for (std::size_t i = 0; i < k.weights.size(); ++i) {
          row += k.weights[i] * static_cast<double>(map.at(k.first + static_cast<int>(i), rows.first + static_cast<int>(j)));
        }
        sum += rows.weights[j] * row;
      }
      out.at(x, y) = static_cast<float>(sum);
    }
  });
  return out;
}

// ---- the spline ------------------------------------------------------------------------------------------------

// The four weights of the uniform cubic B-spline at 0 ≤ t < 1 between the middle two control points, and their derivatives with
// respect to t (Farin, Curves and Surfaces for CAGD, chapter 8).
struct SplineWeights {
  std::array<double, 4> value, slope;
};

SplineWeights spline_weights(double t) {
  const double s = 1.0 - t;
  return {{s * s * s / 6.0, (t * t * (3.0 * t - 6.0) + 4.0) / 6.0, (s * s * (3.0 * s - 6.0) + 4.0) / 6.0, t * t * t / 6.0},
          {-0.5 * s * s, t * (1.5 * t - 2.0), -s * (1.5 * s - 2.0), 0.5 * t * t}};
}

}  // namespace

HeightField::HeightField(const Image<float>& map, double smoothing, const Workers& workers, MapEdges edges) : edges_(edges) {
  const FloatMode float_mode;
  HS_CHECK_OP(map.width(), >=, 2, "HeightField: the map is too narrow; expected at least 2 columns");
  HS_CHECK_OP(map.height(), >=, 1, "HeightField: the map has no rows; expected at least 1");
  HS_CHECK_OP(smoothing, >=, 0.0, "HeightField: the smoothing is negative; expected at least 0");
  base_ = map.at(0, 0);
  texels_ = Image<float>(map.width(), map.height());
  workers.for_each(map.height(), [&](int row) {
    std::transform(map.row(row).begin(), map.row(row).end(), texels_.row(row).begin(), [this](float t) { return t - base_; });
  });
  const int even_width = map.width() / 2 * 2;
  if (edges == MapEdges::sphere && even_width != map.width()) texels_ = averaged(texels_, even_width, map.height(), workers);
  if (smoothing == 0) return;
  texels_ = smooth_columns(texels_, gaussian(smoothing), edges, workers);
  workers.for_each(height(), [&](int row) {
    const double scale = edges == MapEdges::sphere ? sin_of_row(row, height()) : 1.0;
    smooth_row(texels_.row(row), capped_gaussian(smoothing / scale, width()), edges);
  });
}

std::pair<double, double> HeightField::range() const {
  const auto [low, high] = std::ranges::minmax(texels_.texels());
  return {static_cast<double>(base_) + static_cast<double>(low), static_cast<double>(base_) + static_cast<double>(high)};
}

HeightTaps HeightField::taps(double u) const {
  const double x = (edges_ == MapEdges::sheet ? u : u - std::floor(u)) * width() - 0.5;
  const double left = std::floor(x);
  const SplineWeights weights = spline_weights(x - left);
  HeightTaps taps{{}, weights.value, weights.slope};
  for (int i = 0; i < 4; ++i) taps.column[static_cast<std::size_t>(i)] = column_at(static_cast<int>(left) - 1 + i, width(), edges_);
  return taps;
}

void HeightField::at(std::span<const HeightTaps> taps, double v, std::span<HeightSample> samples) const {
  const double y = (edges_ == MapEdges::torus ? v - std::floor(v) : v) * height() - 0.5;
  const double top = std::floor(y);
  const SplineWeights along_v = spline_weights(y - top);
  std::fill(samples.begin(), samples.end(), HeightSample{});
  for (std::size_t j = 0; j < 4; ++j) {
    const FoldedRow from = fold(static_cast<int>(top) - 1 + static_cast<int>(j), width(), height(), edges_);
    const std::span<const float> row = texels_.row(from.row);
    for (std::size_t k = 0; k < taps.size(); ++k) {
      double value = 0, slope = 0;
      for (std::size_t i = 0; i < 4; ++i) {
        const int column = taps[k].column[i] + from.shift;
        const double texel = static_cast<double>(row[static_cast<std::size_t>(column < width() ? column : column - width())]);
        value += taps[k].value[i] * texel;
        slope += taps[k].slope[i] * texel;
      }
      samples[k].value += along_v.value[j] * value;
      samples[k].du += along_v.value[j] * slope;
      samples[k].dv += along_v.slope[j] * value;
    }
  }
  for (HeightSample& s : samples) s = {static_cast<double>(base_) + s.value, width() * s.du, height() * s.dv};
}

void HeightField::at_texels(int row, std::span<HeightSample> samples) const {
  const SplineWeights w = spline_weights(0.0);  // the fourth weight is 0
  const auto n = static_cast<std::size_t>(width());
  std::array<std::vector<double>, 3> lines;  // the row and its neighbors, padded by one texel at both ends
  for (std::size_t j = 0; j < 3; ++j) {
    const FoldedRow from = fold(row - 1 + static_cast<int>(j), width(), height(), edges_);
    const std::span<const float> texels = texels_.row(from.row);
    std::vector<double>& line = lines[j];
    line.reserve(n + 2);
    line.push_back(0.0);
    line.insert(line.end(), texels.begin() + from.shift, texels.end());
    line.insert(line.end(), texels.begin(), texels.begin() + from.shift);
    line.front() = edges_ == MapEdges::sheet ? line[1] : line[n];
    line.push_back(edges_ == MapEdges::sheet ? line[n] : line[1]);
  }
  const double columns = width(), rows = height(), base = static_cast<double>(base_);
  for (std::size_t x = 0; x < n; ++x) {
    HeightSample s{};
    for (std::size_t j = 0; j < 3; ++j) {
      const double* texel = lines[j].data() + x;
      const double across = w.value[0] * texel[0] + w.value[1] * texel[1] + w.value[2] * texel[2];
      s.value += w.value[j] * across;
      s.du += w.value[j] * (w.slope[0] * texel[0] + w.slope[1] * texel[1] + w.slope[2] * texel[2]);
      s.dv += w.slope[j] * across;
    }
    samples[x] = {base + s.value, columns * s.du, rows * s.dv};
  }
}

HeightSample HeightField::at(double u, double v) const {
  const HeightTaps one = taps(u);
  HeightSample sample;
  at({&one, 1}, v, {&sample, 1});
  return sample;
}

HeightField HeightField::filtered(int max_width, const Workers& workers) const {
  const FloatMode float_mode;
  HS_CHECK_OP(max_width, >=, 2, "HeightField::filtered: the width is too small; expected at least 2");
  if (width() <= max_width) return *this;
  const int to_width = max_width / 2 * 2;
  const int64_t rounded = (static_cast<int64_t>(height()) * to_width * 2 + width()) / (2 * static_cast<int64_t>(width()));
  HeightField coarse;
  coarse.base_ = base_;
  coarse.edges_ = edges_;
  coarse.texels_ = averaged(texels_, to_width, std::max(static_cast<int>(rounded), 1), workers);
  if (edges_ != MapEdges::sphere) return coarse;
  workers.for_each(coarse.height(), [&](int row) {
    const SinCosDouble angle = sincos_turns(0.5 * (row + 0.5) / coarse.height());
    smooth_row(coarse.texels_.row(row), capped_gaussian(0.5 * std::fabs(angle.cos) / angle.sin, to_width), edges_);
  });
  return coarse;
}

}  // namespace halfspace::HS_LANES
