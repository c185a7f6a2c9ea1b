// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "view/overlay.h"

namespace halfspace {

namespace {

constexpr int kTile = 64;  // pixels; the tile size of passes with one sample per pixel

// Adds alpha, which is 1 for opaque surfaces.
constexpr BlendState kCountFragments{.source_color = BlendFactor::zero,
                                     .destination_color = BlendFactor::zero,
                                     .source_alpha = BlendFactor::one,
                                     .destination_alpha = BlendFactor::one};

// Mixes a color of the picture in half.
glm::u8vec4 mixed(const glm::u8vec4& a, const glm::u8vec4& b) { return glm::u8vec4((glm::ivec4(a) + glm::ivec4(b)) / 2); }

// The rectangle of tiles that a triangle can touch.
struct TileBox {
  int x0, y0, x1, y1;  // inclusive; empty if x1 < x0
};

// Returns the tiles of the bounds of a triangle. A triangle that is partly behind the eye is not counted.
TileBox tiles_of(const std::array<glm::dvec4, 3>& clip, int width, int height) {
  glm::dvec2 low(INFINITY), high(-INFINITY);
  for (const glm::dvec4& v : clip) {
    if (v.w <= 0.0) return {0, 0, -1, -1};
    const glm::dvec2 window((v.x / v.w * 0.5 + 0.5) * width, (0.5 - v.y / v.w * 0.5) * height);
    low = glm::min(low, window);
    high = glm::max(high, window);
  }
  if (!(high.x > 0.0 && high.y > 0.0 && low.x < width && low.y < height)) return {0, 0, -1, -1};
  const auto tile = [](double at, int size) { return static_cast<int>(std::clamp(at, 0.0, size - 1.0)) / kTile; };
  return {tile(low.x, width), tile(low.y, height), tile(high.x, width), tile(high.y, height)};
}

void count_mesh(const PlacedMesh& mesh, const View& view, Image<int>& counts) {
  const glm::dmat4 clip_from_object = view.clip_from_world * mesh.world_from_object;
  std::vector<glm::dvec4> clip;
  clip.reserve(mesh.positions.size());
  for (const glm::vec3& p : mesh.positions) clip.push_back(clip_from_object * glm::dvec4(p, 1.0));
  const Indices& indices = *mesh.indices;
  for (std::size_t i = 0; i + 2 < indices.size(); i += 3) {
    const TileBox box = tiles_of({clip[indices[i]], clip[indices[i + 1]], clip[indices[i + 2]]}, view.width_px, view.height_px);
    for (int y = box.y0; y <= box.y1; ++y) {
      for (int x = box.x0; x <= box.x1; ++x) ++counts.at(x, y);
    }
  }
}

}  // namespace

std::string draw_overdraw_overlay(OverlayFrame frame) {
  const int width = frame.picture.width(), height = frame.picture.height();
  Image<glm::vec4> counts(width, height);
  Pass pass(width, height, rgba32f_target(counts), {});
  for (const PreparedDraw& draw : frame.scene.draws) {
    if (draw.source.object < 0) continue;  // the background
    DrawState state = draw.state;
    state.depth.test = state.depth.write = state.order_independent = false;
    state.blend = kCountFragments;
    add_draw(pass, draw, state);
  }
  pass.run(frame.workers);
  constexpr double kMost = 8.0;
  float largest = 0.0f;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const float count = counts.at(x, y).w;
      largest = std::max(largest, count);
      frame.picture.at(x, y) = heat_color(count / kMost);
    }
  }
  return fmt::format("fragments per pixel without the depth test: dark 0, white 8 or more; largest {:.0f}", largest);
}

std::string draw_tiles_overlay(OverlayFrame frame) {
  const int width = frame.picture.width(), height = frame.picture.height();
  Image<int> counts((width + kTile - 1) / kTile, (height + kTile - 1) / kTile);
  for (const PlacedMesh& mesh : frame.scene.meshes) count_mesh(mesh, frame.scene.view, counts);
  const int largest = std::max(1, std::ranges::max(counts.texels()));
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      glm::u8vec4& pixel = frame.picture.at(x, y);
      const bool border = x % kTile == 0 || y % kTile == 0;
      const double heat = std::log2(1.0 + counts.at(x / kTile, y / kTile)) / std::log2(1.0 + largest);
      pixel = border ? glm::u8vec4(255, 255, 255, 255) : mixed(pixel, heat_color(heat));
    }
  }
  return fmt::format("tiles of 64x64 pixels, by the logarithm of the number of triangles whose bounds reach them; largest {}", largest);
}

}  // namespace halfspace
