// SPDX-License-Identifier: Apache-2.0
#include "scenes/scene_textures.h"

#include <array>

#include "halfspace/core/hash.h"
#include "halfspace/procedural/noise.h"
#include "scenes/texel_painter.h"

namespace halfspace {

Image<float> noise_map(TexelSize size, glm::ivec2 cells, int octaves, int seed) {
  Image<float> map(size.width, size.height);
  const int texels = std::min(size.width, size.height);
  for (int y = 0; y < size.height; ++y) {
    const Real v((static_cast<float>(y) + 0.5f) / static_cast<float>(size.height));
    for (int x = 0; x < size.width; x += kLanes) {
      std::array<float, kLanes> u{}, value{};
      for (int k = 0; k < kLanes; ++k) u[static_cast<std::size_t>(k)] = (static_cast<float>(x + k) + 0.5f) / static_cast<float>(size.width);
      store(value.data(), procedural::tiled_cloud(load<Real>(u.data()), v, cells.x, cells.y, octaves, texels, seed));
      for (int k = 0; k < kLanes && x + k < size.width; ++k) map.at(x + k, y) = value[static_cast<std::size_t>(k)];
    }
  }
  return map;
}

float cell_value(int i, int j, int seed) { return unit_fraction<float>(mix_bits(mix_bits(mix_bits(i) ^ j) ^ seed)); }

SceneTexels mottled(TexelSize size, glm::vec3 dark, glm::vec3 light, glm::ivec2 cells, int octaves, int seed) {
  const Image<float> noise = noise_map(size, cells, octaves, seed);
  return paint(size,
               [&](int x, int y, float, float) { return glm::mix(dark, light, std::clamp(0.5f + 0.6f * noise.at(x, y), 0.0f, 1.0f)); });
}

SceneTexels masonry(TexelSize size, glm::vec3 stone, glm::vec3 mortar, glm::ivec2 blocks, int seed) {
  const Image<float> noise = noise_map(size, 2 * blocks, 4, seed);
  return paint(size, [&](int x, int y, float u, float v) {
    const float row = v * static_cast<float>(blocks.y);
    const int j = static_cast<int>(row);
    const float column = u * static_cast<float>(blocks.x) + (j % 2 == 1 ? 0.5f : 0.0f);
    const int i = static_cast<int>(column) % blocks.x;
    const float to_edge_x = (0.5f - std::abs(fraction(column) - 0.5f)) / static_cast<float>(blocks.x);
    const float to_edge_y = (0.5f - std::abs(fraction(row) - 0.5f)) / static_cast<float>(blocks.y);
    const float edge = smooth_step(0.003f, 0.012f, std::min(to_edge_x, to_edge_y));
    const float shade = 0.9f + 0.2f * cell_value(i, j, seed) + 0.1f * noise.at(x, y);
    return glm::mix(mortar, stone * shade, edge);
  });
}

SceneTexels marble_tiles(TexelSize size, glm::vec3 a, glm::vec3 b, int squares) {
  const Image<float> veins = noise_map(size, {5, 5}, 5, 71), cloud = noise_map(size, {9, 9}, 4, 72);
  return paint(size, [&](int x, int y, float u, float v) {
    const auto n = static_cast<float>(squares);
    const int i = static_cast<int>(u * n), j = static_cast<int>(v * n);
    const float vein = smooth_step(0.12f, 0.0f, std::abs(veins.at(x, y)));
    const glm::vec3 color = (i + j) % 2 == 0 ? a * (1.0f - 0.12f * vein) : b + 0.10f * vein;
    const float to_edge = std::min(0.5f - std::abs(fraction(u * n) - 0.5f), 0.5f - std::abs(fraction(v * n) - 0.5f));
    return color * (0.93f + 0.1f * cell_value(i, j, 73) + 0.06f * cloud.at(x, y)) * (0.7f + 0.3f * smooth_step(0.005f, 0.02f, to_edge));
  });
}

SceneTexels boards(TexelSize size, glm::vec3 dark, glm::vec3 light, int count, int seed) {
  const Image<float> grain = noise_map(size, {12 * count, 2}, 3, seed), wide = noise_map(size, {2 * count, 3}, 3, seed + 1);
  return paint(size, [&](int x, int y, float u, float) {
    const float at = u * static_cast<float>(count);
    const float rings = 0.5f + 0.35f * grain.at(x, y) + 0.3f * wide.at(x, y) + 0.3f * (cell_value(static_cast<int>(at), 0, seed) - 0.5f);
    const float joint = smooth_step(0.0f, 0.03f, 0.5f - std::abs(fraction(at) - 0.5f));
    return glm::mix(dark, light, std::clamp(rings, 0.0f, 1.0f)) * (0.55f + 0.45f * joint);
  });
}

SceneTexels roof_tiles(TexelSize size, glm::vec3 clay, glm::ivec2 tiles) {
  const Image<float> noise = noise_map(size, 3 * tiles, 3, 81);
  return paint(size, [&](int x, int y, float u, float v) {
    const float row = v * static_cast<float>(tiles.y);
    const int j = static_cast<int>(row);
    const float column = u * static_cast<float>(tiles.x) + (j % 2 == 1 ? 0.5f : 0.0f);
    const float across = 2.0f * fraction(column) - 1.0f;
    const float round = 1.0f - 0.35f * across * across, lip = smooth_step(0.0f, 0.15f, fraction(row));
    const float shade = 0.8f + 0.3f * cell_value(static_cast<int>(column) % tiles.x, j, 82) + 0.1f * noise.at(x, y);
    return clay * (round * shade * (0.6f + 0.4f * lip));
  });
}

SceneTexels carpet(TexelSize size) {
  const Image<float> pile = noise_map(size, {60, 60}, 2, 91);
  return paint(size, [&](int x, int y, float u, float v) {
    const glm::vec3 red(0.55f, 0.10f, 0.11f), gold(0.80f, 0.62f, 0.25f), blue(0.16f, 0.18f, 0.36f);
    const float side = 0.5f - std::abs(u - 0.5f);
    const float diamond = std::abs(fraction(3.0f * v) - 0.5f) * 1.6f + std::abs(u - 0.5f) * 2.4f;
    glm::vec3 color = red;
    color = glm::mix(color, blue, smooth_step(0.52f, 0.50f, diamond));
    color = glm::mix(color, gold, smooth_step(0.03f, 0.01f, std::abs(diamond - 0.52f)));
    color = glm::mix(color, gold, smooth_step(0.26f, 0.24f, diamond));
    color = glm::mix(color, blue, smooth_step(0.12f, 0.11f, side));
    color = glm::mix(color, gold, smooth_step(0.02f, 0.01f, std::abs(side - 0.09f)));
    return color * (1.0f + 0.08f * pile.at(x, y));
  });
}

SceneTexels starry_vault(TexelSize size) {
  const Image<float> plaster = noise_map(size, {6, 6}, 5, 95);
  return paint(size, [&](int x, int y, float u, float v) {
    const int j = static_cast<int>(6.0f * v);
    const float shift = j % 2 == 1 ? 0.5f : 0.0f;
    const glm::vec2 at(fraction(6.0f * u + shift) - 0.5f, fraction(6.0f * v) - 0.5f);
    const float rays = std::abs(at.x * at.y) * 60.0f + 6.0f * glm::length(at);
    const glm::vec3 blue = glm::vec3(0.22f, 0.30f, 0.52f) * (1.0f + 0.15f * plaster.at(x, y));
    return glm::mix(blue, glm::vec3(0.92f, 0.78f, 0.42f), smooth_step(1.1f, 0.7f, rays));
  });
}

SceneTexels stained_glass(TexelSize size, int seed) {
  constexpr std::array<glm::vec3, 5> kColors{
      {{0.75f, 0.20f, 0.16f}, {0.20f, 0.36f, 0.70f}, {0.88f, 0.70f, 0.28f}, {0.30f, 0.58f, 0.36f}, {0.72f, 0.82f, 0.88f}}};
  return paint(size, [&](int, int, float u, float v) {
    const float a = 4.0f * u + 6.0f * v, b = 4.0f * u - 6.0f * v + 16.0f;
    const int i = static_cast<int>(std::floor(a)), j = static_cast<int>(std::floor(b));
    const float edge = std::min(0.5f - std::abs(fraction(a) - 0.5f), 0.5f - std::abs(fraction(b) - 0.5f));
    const float lead = smooth_step(0.09f, 0.05f, edge);
    const glm::vec3 pane = kColors[static_cast<std::size_t>(5.0f * cell_value(i, j, seed))];
    return glm::mix(glm::vec4(pane, 0.75f), glm::vec4(0.08f, 0.08f, 0.09f, 1.0f), lead);
  });
}

SceneTexels cloudy_sky(TexelSize size, glm::vec3 horizon, glm::vec3 zenith) {
  const Image<float> clouds = noise_map(size, {9, 6}, 6, 61), wide = noise_map(size, {4, 3}, 3, 62);
  return paint(size, [&](int x, int y, float, float v) {
    const glm::vec3 blue = glm::mix(horizon, zenith, smooth_step(0.0f, 0.8f, std::sqrt(v)));
    const float cover = smooth_step(0.05f, 0.55f, clouds.at(x, y) + 0.5f * wide.at(x, y));
    const float fade = smooth_step(0.02f, 0.2f, v) * smooth_step(1.0f, 0.7f, v);
    return glm::mix(blue, glm::vec3(0.97f, 0.97f, 0.98f), 0.85f * cover * fade);
  });
}

SceneTexels natural(Pattern pattern, int width, float brightness) {
  SceneTexels image = procedural_pattern(pattern, width, Workers(1)).color;
  for (std::size_t i = 0; i < image.texels().size(); ++i) {
    image.data()[i] = texel_code(glm::vec4(glm::vec3(image.data()[i]) * (brightness / 255.0f), 1.0f));
  }
  return image;
}

}  // namespace halfspace
