// SPDX-License-Identifier: Apache-2.0
//
// Draws with a shader that is defined in this file, and checks pixels. Prints the number of lanes.
#include <halfspace/raster/pass.h>

#include <cstdio>
#include <vector>

namespace consumer {

struct Stripes {
  float width_px;
  glm::vec4 even, odd;

  template <class R>
  struct Attributes {
    halfspace::vec2<R> position;
  };
  template <class R>
  struct Varyings {};

  template <class R>
  halfspace::vec4<R> vertex(const Attributes<R>& in, Varyings<R>&) const {
    return halfspace::vec4<R>(in.position.x, in.position.y, R(0.0f), R(1.0f));
  }
  template <class R>
  halfspace::Fragment<R> fragment(const Varyings<R>&, const halfspace::Pixel<R>& px) const {
    using halfspace::floor, halfspace::select;
    const R stripe = floor(px.x / R(width_px));
    const auto is_even = floor(stripe * R(0.5f)) * R(2.0f) == stripe;
    halfspace::vec4<R> color;
    for (int i = 0; i < 4; ++i) color[i] = select(is_even, R(even[i]), R(odd[i]));
    return {color};
  }
};

// The same with a geometry function, whose kernel needs private headers and functions of the library.
struct EmittedStripes : Stripes {
  static constexpr halfspace::GeometryLayout geometry_layout{};

  template <class R>
  void geometry(const halfspace::GeometryInput<R, Varyings<R>, 3>& in, halfspace::Emitter<R, Varyings<R>>& out) const {
    for (std::size_t i = 0; i < 3; ++i) out.emit(in.position[i], in.varyings[i]);
  }
};

bool check(const halfspace::Image<glm::u8vec4>& image, int x, int y, glm::u8vec4 expected) {
  const glm::u8vec4 pixel = image.at(x, y);
  if (pixel == expected) return true;
  std::printf("pixel (%d, %d) is %d, %d, %d; expected %d, %d, %d\n", x, y, pixel.r, pixel.g, pixel.b, expected.r, expected.g, expected.b);
  return false;
}

}  // namespace consumer

int main() {
  using namespace halfspace;
  const std::vector<glm::vec2> lower_left{{-1, -1}, {1, -1}, {-1, 1}};
  Image<glm::u8vec4> image(64, 64);
  ColorTarget target = srgb8a8_target(image);
  target.clear_value = {0, 0, 1, 1};
  Pass pass(64, 64, target, {});
  pass.draw(consumer::Stripes{8.0f, {1, 0, 0, 1}, {0, 1, 0, 1}}, make_vertex_view(stream(lower_left)));
  pass.run(Workers(2));
  Image<glm::u8vec4> emitted(64, 64);
  target.data = reinterpret_cast<std::byte*>(emitted.data());
  Pass emitting(64, 64, target, {});
  emitting.draw(consumer::EmittedStripes{{8.0f, {1, 0, 0, 1}, {0, 1, 0, 1}}}, make_vertex_view(stream(lower_left)));
  emitting.run(Workers(2));

  bool ok = emitted == image;
  if (!ok) std::printf("a geometry function that emits its input changes the picture\n");
  for (const int y : {8, 32, 60}) {  // row 0 is the top row
    for (int x = 0; x < 64; ++x) {
      const glm::u8vec4 stripe = x / 8 % 2 == 0 ? glm::u8vec4(255, 0, 0, 255) : glm::u8vec4(0, 255, 0, 255);
      if (x != y) ok &= consumer::check(image, x, y, x < y ? stripe : glm::u8vec4(0, 0, 255, 255));
    }
  }
  std::printf("%d lanes: %s\n", kLanes, ok ? "all pixels are as expected" : "FAILED");
  return ok ? 0 : 1;
}
