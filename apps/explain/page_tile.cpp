// SPDX-License-Identifier: Apache-2.0
//
// The fragments of the tile of the example pixel, in the order in which the tile was drawn.
#include <algorithm>
#include <limits>
#include <tuple>

#include "explain/page_data.h"
#include "explain/page_encode.h"
#include "explain/stage_tone.h"
#include "halfspace/raster/inspect/inspection.h"

namespace halfspace {

namespace {

// A frame can have any number of fragments and triangles in a tile. The steps end with the triangle that reaches one of these limits, so
// they add at most about 1 MB to the page: 0.5 MB for the fragments, and 120 bytes per triangle.
constexpr std::size_t kMaxTileFragments = 60'000, kMaxTileTriangles = 4'096;

struct TileFragment {
  glm::ivec2 window;  // pixel in window coordinates
  const TracedFragment* fragment;
};

// Returns the fragments of the first round in a tile. Triangle ids increase in submission order.
std::vector<TileFragment> fragments_of_tile(const PageInput& in, glm::ivec2 first, int size) {
  std::vector<TileFragment> out;
  for (int y = first.y; y < std::min(first.y + size, in.trace.height); ++y) {
    for (int x = first.x; x < std::min(first.x + size, in.trace.width); ++x) {
      for (const TracedFragment& f : in.trace.at({x, in.trace.height - 1 - y})) {
        if (f.round == 0) out.push_back({{x, y}, &f});
      }
    }
  }
  std::ranges::sort(out, {}, [](const TileFragment& f) { return std::tuple(f.fragment->id, f.window.y, f.window.x, f.fragment->sample); });
  return out;
}

// The columns of the table of fragments.
struct TileColumns {
  std::vector<uint16_t> triangle;
  std::vector<uint8_t> x, y, sample, outcome, red, green, blue;
  std::vector<float> depth, stored;  // stored: the depth that the fragment was compared with; NaN if it was not tested

  PageJson json() const {
    return {{"count", x.size()},
            {"triangle", packed_planes(std::span<const uint16_t>(triangle))},
            {"x", packed_planes(std::span<const uint8_t>(x))},
            {"y", packed_planes(std::span<const uint8_t>(y))},
            {"sample", packed_planes(std::span<const uint8_t>(sample))},
            {"outcome", packed_planes(std::span<const uint8_t>(outcome))},
            {"red", packed_planes(std::span<const uint8_t>(red))},
            {"green", packed_planes(std::span<const uint8_t>(green))},
            {"blue", packed_planes(std::span<const uint8_t>(blue))},
            {"depth", packed_planes(std::span<const float>(depth))},
            {"stored", packed_planes(std::span<const float>(stored))}};
  }
};

PageJson triangle_json(const PageInput& in, const TriangleInspector& triangles, const TracedFragment& f) {
  InspectedTriangle t;
  triangles.find(f.id, t);
  const Triangle& s = *t.source.triangle;
  return {{"draw", f.draw},
          {"instance", f.instance},
          {"primitive", f.primitive},
          {"edges", s.is_triangle()},
          {"writes_depth", in.scene.draws[f.draw].state.depth.write},
          {"x", s.x},
          {"y", s.y}};
}

}  // namespace

PageJson tile_json(const PageInput& in) {
  const int size = in.context.tile_size;
  const glm::ivec2 first(in.pixel.x / size * size, (in.trace.height - 1 - in.pixel.y) / size * size);
  const std::vector<TileFragment> all = fragments_of_tile(in, first, size);
  const TriangleInspector triangles(in.context);
  const ToneMapping tone = stage_tone(in.scene, in.light, in.workers).tone;
  TileColumns columns;
  PageJson list = PageJson::array();
  const auto starts_triangle = [&](std::size_t i) { return i == 0 || all[i].fragment->id != all[i - 1].fragment->id; };
  std::size_t listed = 0, triangles_left_out = 0;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const TracedFragment& f = *all[i].fragment;
    if (starts_triangle(i)) {
      if (i >= kMaxTileFragments || list.size() == kMaxTileTriangles) break;
      list.push_back(triangle_json(in, triangles, f));
    }
    columns.triangle.push_back(static_cast<uint16_t>(list.size() - 1));
    columns.x.push_back(static_cast<uint8_t>(all[i].window.x - first.x));
    columns.y.push_back(static_cast<uint8_t>(all[i].window.y - first.y));
    columns.sample.push_back(f.sample);
    columns.outcome.push_back(static_cast<uint8_t>(f.outcome));
    columns.depth.push_back(f.depth);
    columns.stored.push_back(f.is_tested ? f.stored_depth : std::numeric_limits<float>::quiet_NaN());
    const glm::ivec3 code = tone_steps(in.scene, tone, glm::vec3(f.value)).code;
    columns.red.push_back(static_cast<uint8_t>(code.x));
    columns.green.push_back(static_cast<uint8_t>(code.y));
    columns.blue.push_back(static_cast<uint8_t>(code.z));
    ++listed;
  }
  for (std::size_t i = listed; i < all.size(); ++i) triangles_left_out += starts_triangle(i);
  const glm::ivec3 clear = tone_steps(in.scene, tone, glm::vec3(in.scene.clear_color)).code;
  return {{"first", {first.x, first.y}},
          {"triangles", list},
          {"fragments", columns.json()},
          {"left_out", all.size() - listed},
          {"triangles_left_out", triangles_left_out},
          {"clear", {clear.x, clear.y, clear.z}}};
}

}  // namespace halfspace
