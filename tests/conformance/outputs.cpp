// SPDX-License-Identifier: Apache-2.0
#include "conformance/outputs.h"

#include <algorithm>
#include <cmath>

#include "conformance/geometry.h"
#include "support/random.h"

namespace halfspace::conformance {

Picture with_outputs(const std::vector<ColorFormat>& formats, const OutputTypes& types, uint64_t seed) {
  Picture p;
  p.colors = formats;
  Drawing d;
  d.kind = Kind::outputs;
  d.outputs = types;
  int bits = 32, alpha_bits = 32;  // of the smallest integers
  bool has_unsigned = false;
  for (const ColorFormat f : formats) {
    if (!is_integer(f)) continue;
    bits = std::min(bits, channel_bits(f, 0));
    if (texel_info(f).channels == 4) alpha_bits = std::min(alpha_bits, channel_bits(f, 3));
    has_unsigned |= color_type(f) == ColorType::unsigned_integer;
  }
  const bool has_signed = std::ranges::any_of(formats, [](ColorFormat f) { return color_type(f) == ColorType::signed_integer; });
  // From −8 to 7, 0 to 15 or, for both types, 0 to 7, in units of 1/16 of the range. The shader adds 0 to 3.
  d.value = std::ldexp(1.0f, bits - 4);
  Random random(seed);
  const int low = has_unsigned ? 0 : -8, high = has_signed ? 7 : 15;
  for (int x = 0; x < p.width; x += kOutputCell) {
    for (int y = 0; y < p.height; y += kOutputCell) {
      Vertex v;
      for (int k = 0; k < 4; ++k) {
        v.color[k] = random.real(-1.25f, 1.5f);
        v.extra[k] = k == 3 && alpha_bits == 2 ? 0.0f : static_cast<float>(random.between(low, high));
      }
      const double x0 = x, y0 = y, x1 = x + kOutputSize, y1 = y + kOutputSize;
      const auto corner = [&](double cx, double cy) { return Vertex{clip_at(p, cx, cy), v.color, v.extra}; };
      add_quad(d, {corner(x0, y0), corner(x1, y0), corner(x1, y1), corner(x0, y1)});
    }
  }
  p.draws.push_back(std::move(d));
  return p;
}

}  // namespace halfspace::conformance
