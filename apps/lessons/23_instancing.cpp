// SPDX-License-Identifier: Apache-2.0
//
// Lesson 23: instancing draws one mesh many times, with values that are different for each copy.
#include <cmath>
#include <cstdio>
#include <exception>

#include "halfspace/geometry/camera.h"
#include "halfspace/geometry/shapes.h"
#include "halfspace/image/image_io.h"
#include "halfspace/raster/pass.h"

using namespace halfspace;
constexpr int kTrees = 3000;

struct Trees {  // one entry per copy
  std::vector<glm::vec3> places, colors;
  std::vector<glm::vec2> sizes;  // width and height
};

struct TreeShader {
  glm::mat4 clip_from_world;

  template <class R>
  struct Attributes {
    vec3<R> position, normal;  // one per vertex
    vec3<R> place, color;      // one per instance
    vec2<R> size;
  };
  template <class R>
  struct Varyings {
    vec3<R> normal, color;
  };
  template <class R>
  vec4<R> vertex(const Attributes<R>& in, Varyings<R>& out) const {
    const vec3<R> scale(in.size.x, in.size.y, in.size.x);
    out = {in.normal / scale, in.color};  // the inverse transpose of a scale divides by it
    return clip_from_world * vec4<R>(in.position * scale + in.place, R(1));
  }
  template <class R>
  Fragment<R> fragment(const Varyings<R>& in) const {
    const R diffuse = max(dot(normalize(in.normal), vec3<R>(glm::normalize(glm::vec3(-1, 1.2f, 0.6f)))), R(0));
    return {vec4<R>(in.color * (R(0.1f) + R(0.9f) * diffuse), R(1))};
  }
};

double height(double x, double z) { return 0.8 * std::sin(0.35 * x) * std::cos(0.3 * z) + 0.02 * z * z; }

Trees plant() {
  Trees trees;
  uint32_t random = 1;
  const auto next = [&] { return static_cast<float>((random = random * 1664525u + 1013904223u) >> 8) / 16777216.0f; };  // 0 to 1
  for (int i = 0; i < kTrees; ++i) {
    const float x = next() * 40 - 20, z = next() * -40, tall = 0.5f + 0.7f * next();
    trees.places.emplace_back(x, static_cast<float>(height(static_cast<double>(x), static_cast<double>(z))) + tall / 2, z);
    trees.sizes.emplace_back(0.3f + 0.2f * next(), tall);
    const float autumn = next();
    trees.colors.push_back(glm::vec3(0.08f, 0.25f, 0.06f) +
                           (glm::vec3(0.5f, 0.22f, 0.02f) - glm::vec3(0.08f, 0.25f, 0.06f)) * autumn * autumn);
  }
  return trees;
}

int main(int argc, char** argv) try {
  const Mesh tree = cone(0.6f, 1.0f, 2, 12);
  const Trees trees = plant();
  const glm::mat4 camera(perspective_reversed(0.6, 4.0 / 3.0, 0.1, 200.0) * look_at({0, 5.5, 9}, {0, 1.2, -8}, {0, 1, 0}));

  Image<glm::u8vec4> image(320, 240);
  ColorTarget color = srgb8a8_target(image);
  color.clear_value = {0.4f, 0.55f, 0.7f, 1};
  Pass pass(320, 240, color, {.format = DepthFormat::d32f, .clear_value = 0.0f}, {.samples = 4});
  DrawState state = kReversedZState;
  state.instances = kTrees;
  pass.draw(TreeShader{camera},
            make_vertex_view(stream(tree.positions), stream(tree.normals), per_instance(stream(trees.places)),
                             per_instance(stream(trees.colors)), per_instance(stream(trees.sizes))),
            tree.indices, state);
  pass.run(Workers(1));
  write_image(argc > 1 ? argv[1] : "lesson23.png", image);
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
