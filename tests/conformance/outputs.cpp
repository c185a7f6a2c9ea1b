// SPDX-License-Identifier: Apache-2.0
#include "conformance/outputs.h"

#include <algorithm>
#include <cmath>

#include "conformance/geometry.h"

namespace halfspace::conformance {

IntegerRange integer_range(const std::vector<ColorFormat>& formats) {
  const auto has = [&](ColorType type) { return std::ranges::any_of(formats, [=](ColorFormat f) { return color_type(f) == type; }); };
  IntegerRange range;
  int bits = 32;
  for (const ColorFormat f : formats) {
    if (!is_integer(f)) continue;
    bits = std::min(bits, channel_bits(f, 0));
    if (texel_info(f).channels == 4 && channel_bits(f, 3) == 2) range.has_alpha = false;
  }
  range.factor = std::ldexp(1.0f, bits - 4);
  range.low = has(ColorType::unsigned_integer) ? 0 : -8;
  range.high = has(ColorType::signed_integer) ? 7 : 15;
  return range;
}

glm::vec4 random_integers(const IntegerRange& range, Random& random) {
  glm::vec4 v;
  for (int k = 0; k < 4; ++k) v[k] = k == 3 && !range.has_alpha ? 0.0f : static_cast<float>(random.between(range.low, range.high));
  return v;
}

Picture with_outputs(const std::vector<ColorFormat>& formats, const OutputTypes& types, uint64_t seed) {
  Picture p;
  p.colors = formats;
  const IntegerRange range = integer_range(formats);
  Drawing d;
  d.kind = Kind::outputs;
  d.outputs = types;
  d.value = range.factor;
  Random random(seed);
  for (int x = 0; x < p.width; x += kOutputCell) {
    for (int y = 0; y < p.height; y += kOutputCell) {
      Vertex v;
      for (int k = 0; k < 4; ++k) v.color[k] = random.real(-1.25f, 1.5f);
      v.extra = random_integers(range, random);
      const double x0 = x, y0 = y, x1 = x + kOutputSize, y1 = y + kOutputSize;
      const auto corner = [&](double cx, double cy) { return Vertex{clip_at(p, cx, cy), v.color, v.extra}; };
      add_quad(d, {corner(x0, y0), corner(x1, y0), corner(x1, y1), corner(x0, y1)});
    }
  }
  p.draws.push_back(std::move(d));
  return p;
}

}  // namespace halfspace::conformance
