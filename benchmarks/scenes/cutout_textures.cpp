// SPDX-License-Identifier: Apache-2.0
//
// Textures with holes. Texels in a hole have the color of the surrounding texels, so that filtering does not darken edges.
#include <vector>

#include "halfspace/core/trig_double.h"
#include "scenes/texel_painter.h"
#include "workloads/workload_random.h"

namespace halfspace {

namespace {

// A picture whose holes all have the same color.
SceneTexels empty_picture(TexelSize size, glm::vec3 color) {
  return paint(size, [&](int, int, float, float) { return glm::vec4(color, 0.0f); });
}

// A leaf or petal: pointed at both ends, with a lighter rib. `at` is its base in texels.
struct Leaf {
  glm::dvec2 at, along;  // along: from the base to the tip, in texels
  double width;          // relative to the length
  glm::vec3 color;
};

void draw_leaf(SceneTexels& image, const Leaf& leaf) {
  const double length = glm::length(leaf.along);
  const glm::dvec2 axis = leaf.along / length, side(-axis.y, axis.x), tip = leaf.at + leaf.along;
  const double margin = leaf.width * length;
  const glm::dvec2 low = glm::min(leaf.at, tip) - margin, high = glm::max(leaf.at, tip) + margin;
  for (int y = std::max(static_cast<int>(low.y), 0); y < std::min(static_cast<int>(high.y) + 1, image.height()); ++y) {
    for (int x = std::max(static_cast<int>(low.x), 0); x < std::min(static_cast<int>(high.x) + 1, image.width()); ++x) {
      const glm::dvec2 d = glm::dvec2(x + 0.5, y + 0.5) - leaf.at;
      const double t = glm::dot(d, axis) / length, s = std::abs(glm::dot(d, side)) / length;
      if (t < 0 || t > 1) continue;
      const double half = leaf.width * 2.0 * std::sqrt(t) * (1.0 - t);
      if (s > half) continue;
      const float rib = 0.25f * smooth_step(0.03f, 0.0f, static_cast<float>(s)), rim = static_cast<float>(s / (half + 1e-9));
      image.at(x, y) = texel_code(glm::vec4(leaf.color * (0.9f + rib + 0.15f * (1.0f - rim)), 1.0f));
    }
  }
}

void draw_line(SceneTexels& image, glm::dvec2 from, glm::dvec2 to, double width, glm::vec3 color) {
  const glm::dvec2 d = to - from;
  const glm::dvec2 low = glm::min(from, to) - width, high = glm::max(from, to) + width;
  for (int y = std::max(static_cast<int>(low.y), 0); y < std::min(static_cast<int>(high.y) + 1, image.height()); ++y) {
    for (int x = std::max(static_cast<int>(low.x), 0); x < std::min(static_cast<int>(high.x) + 1, image.width()); ++x) {
      const glm::dvec2 p = glm::dvec2(x + 0.5, y + 0.5) - from;
      const double t = std::clamp(glm::dot(p, d) / glm::dot(d, d), 0.0, 1.0);
      if (glm::length(p - t * d) < 0.5 * width) image.at(x, y) = texel_code(glm::vec4(color, 1.0f));
    }
  }
}

glm::dvec2 direction(double turns) {
  const SinCosDouble a = sincos_turns(turns);
  return {a.cos, a.sin};
}

}  // namespace

SceneTexels lattice(TexelSize size, glm::vec3 metal, int bars, float bar_width, bool is_diagonal) {
  return paint(size, [&](int, int, float u, float v) {
    const auto n = static_cast<float>(bars);
    const float a = fraction(is_diagonal ? n * (u + v) : n * u), b = fraction(is_diagonal ? n * (u - v) + n : n * v);
    const float distance = std::min(std::abs(a - 0.5f), std::abs(b - 0.5f));
    const float round = 1.0f - 0.5f * distance / bar_width;
    return glm::vec4(metal * std::max(round, 0.5f), distance < 0.5f * bar_width ? 1.0f : 0.0f);
  });
}

SceneTexels leaves(TexelSize size, glm::vec3 dark, glm::vec3 light, int count, double length, int seed) {
  SceneTexels image = empty_picture(size, 0.5f * (dark + light));
  WorkloadRandom random(static_cast<uint32_t>(seed));
  const glm::dvec2 extent(size.width, size.height), root = extent * glm::dvec2(0.5, 0.98), crown = extent * glm::dvec2(0.5, 0.12);
  draw_line(image, root, crown, 0.015 * size.width, 0.6f * dark);
  for (int i = 0; i < count; ++i) {
    const double t = static_cast<double>(i) / count, side = i % 2 == 0 ? 1.0 : -1.0;
    const glm::dvec2 at = glm::mix(root, crown, 0.1 + 0.9 * t) + extent * glm::dvec2(side * random.between(0.0, 0.22) * (1.1 - t), 0.0);
    const double turns = -0.25 + side * random.between(0.02, 0.24);
    const float shade = random.unit();
    draw_leaf(image, {at, direction(turns) * (length * size.width * random.between(0.7, 1.1)), random.between(0.2, 0.3),
                      glm::mix(dark, light, shade)});
  }
  return image;
}

SceneTexels blades(TexelSize size, glm::vec3 dark, glm::vec3 light, int count, int seed) {
  SceneTexels image = empty_picture(size, 0.5f * (dark + light));
  WorkloadRandom random(static_cast<uint32_t>(seed));
  for (int i = 0; i < count; ++i) {
    const glm::dvec2 at(size.width * random.between(0.2, 0.8), size.height * 1.05);
    const glm::dvec2 tip{at.x + size.width * random.between(-0.3, 0.3), size.height * random.between(0.02, 0.5)};
    draw_leaf(image, {at, tip - at, random.between(0.02, 0.045), glm::mix(dark, light, random.unit())});
  }
  return image;
}

SceneTexels flowers(TexelSize size, glm::vec3 petals, glm::vec3 leaf, int seed) {
  SceneTexels image = blades(size, 0.7f * leaf, leaf, 14, seed);
  WorkloadRandom random(static_cast<uint32_t>(seed + 1));
  for (int i = 0; i < 7; ++i) {
    const glm::dvec2 head{size.width * random.between(0.15, 0.85), size.height * random.between(0.12, 0.5)};
    draw_line(image, {size.width * random.between(0.4, 0.6), size.height}, head, 0.02 * size.width, 0.8f * leaf);
    const double radius = size.width * random.between(0.08, 0.12), turn = random.unit();
    for (int k = 0; k < 7; ++k) draw_leaf(image, {head, radius * direction(turn + k / 7.0), 0.3, petals * (0.85f + 0.15f * random.unit())});
    draw_line(image, head, head + glm::dvec2(0.1, 0), 0.05 * size.width, {0.95f, 0.8f, 0.25f});
  }
  return image;
}

}  // namespace halfspace
