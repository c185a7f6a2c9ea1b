// SPDX-License-Identifier: Apache-2.0
#include "halfspace/raster/amplify/tessellator.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <span>
#include <utility>

namespace halfspace::HS_LANES {
namespace {

/// Coordinates are integers in units of 2^-24. This is the finest step for which every coordinate x in [0, 1] and 1 − x are exact floats
/// (section A.4, rule 8).
constexpr int32_t kOne = 1 << 24;

/// The shortest segment, in units. Inner points of the triangle are computed from a third of a position (place_on_triangle), which must
/// not be zero.
constexpr int32_t kShortestSegment = 3;

/// A level after clamping, and the number of segments that it is rounded up to. With equal spacing, both are the same.
struct RoundedLevel {
  double level;
  uint32_t segments;
};

/// Section 11.2.2: levels are clamped to 1 … 64 and rounded up, to 2 … 64 and rounded up to an even number, or to 1 … 63 and rounded up to
/// an odd number. NaN, which only inner levels can be, is clamped to the lower limit.
RoundedLevel round_level(TessellationSpacing spacing, float level) {
  const uint32_t low = spacing == TessellationSpacing::fractional_even ? 2 : 1;
  const uint32_t high = spacing == TessellationSpacing::fractional_odd ? kMaxTessellationLevel - 1 : kMaxTessellationLevel;
  const uint32_t step = spacing == TessellationSpacing::equal ? 1 : 2;
  const double wanted = level;
  const double clamped = wanted > low ? std::min<double>(wanted, high) : low;
  uint32_t segments = low;
  while (segments < clamped) segments += step;
  return {spacing == TessellationSpacing::equal ? segments : clamped, segments};
}

/// The points of an edge, from 0 to kOne. They are symmetric: the position of point j and of point (segments − j) add up to kOne. It
/// therefore does not matter at which end of an edge the first point is.
struct DividedEdge {
  uint32_t segments;
  std::array<int32_t, kMaxTessellationLevel + 1> position;
};

/// Divides an edge into n segments at level f. The segments at the ends are short ones of length s = (f − n + 2) / (2f), so that their
/// length relative to the others, s / (1/f), decreases linearly from 1 to 0 as n − f approaches 2. The position of point j is
///   s + (j − 1) / f = (f − n + 2j) / (2f),
/// which is j/n if f = n, and exactly 1/2 in the middle of an edge. Only the first half is computed, and the other half mirrors it.
DividedEdge divide_edge(const RoundedLevel& rounded) {
  const uint32_t n = rounded.segments;
  DividedEdge edge{.segments = n, .position = {}};
  edge.position[n] = kOne;
  for (uint32_t j = 1; 2 * j <= n; ++j) {
    const double exact = 0.5 * kOne * (rounded.level - (n - 2 * j)) / rounded.level;
    edge.position[j] = std::max(static_cast<int32_t>(exact + 0.5), kShortestSegment);
    edge.position[n - j] = kOne - edge.position[j];
  }
  return edge;
}

/// Vertices along one edge of a polygon, counterclockwise. Only `last` does not have to follow the step, because the last edge of a ring
/// ends at the first vertex of the ring.
struct Side {
  const int32_t* position;  ///< of segments + 1 vertices, projected onto the outer edge
  uint32_t segments;        ///< 0: the side is the single vertex `first`
  uint32_t first, last;     ///< vertex indices
  int32_t step;

  uint32_t vertex(uint32_t k) const { return k == segments ? last : static_cast<uint32_t>(int64_t{first} + int64_t{k} * step); }
  int32_t twice_middle(uint32_t k) const { return position[k] + position[k + 1]; }
};

/// Appends vertices and primitives to a tessellation.
class DomainWriter {
 public:
  DomainWriter(bool clockwise, Tessellation& out) : clockwise_(clockwise), out_(out) {}

  /// Returns the index of the next vertex.
  uint32_t count() const { return static_cast<uint32_t>(out_.coordinates.size()); }

  void vertex(int32_t u, int32_t v, int32_t w) {
    out_.coordinates.emplace_back(static_cast<float>(u) * 0x1p-24f, static_cast<float>(v) * 0x1p-24f, static_cast<float>(w) * 0x1p-24f);
  }

  void line(uint32_t a, uint32_t b) { out_.indices.insert(out_.indices.end(), {a, b}); }

  /// Appends a triangle whose vertices are given in counterclockwise order.
  void triangle(uint32_t a, uint32_t b, uint32_t c) {
    if (clockwise_) std::swap(b, c);
    out_.indices.insert(out_.indices.end(), {a, b, c});
  }

  /// Appends the vertices of a ring of divided edges without the first and last `skipped` points of each edge, and returns its sides. Each
  /// side begins with its corner. place(side, position) appends a vertex. If no segments remain, the caller appends the only vertex.
  template <std::size_t kCorners, class Place>
  std::array<Side, kCorners> ring(const std::array<const DividedEdge*, kCorners>& edges, uint32_t skipped, Place place) {
    std::array<Side, kCorners> sides;
    for (uint32_t i = 0; i < kCorners; ++i) {
      const int32_t* position = edges[i]->position.data() + skipped;
      const uint32_t segments = edges[i]->segments - 2 * skipped;
      sides[i] = {position, segments, count(), count() + segments, 1};
      for (uint32_t k = 0; k < segments; ++k) place(i, position[k]);
    }
    sides.back().last = sides.front().first;
    return sides;
  }

  /// Fills the area between parallel sides of two rings. Each triangle advances along the side whose next segment has its middle first,
  /// or along the outer side if both are at the same position. The choice depends on nothing but the levels of the two sides (section A.4,
  /// rule 7). Because the sides are parallel, and positions increase along each, all triangles have a positive area.
  void stitch(const Side& outer, const Side& inner) {
    uint32_t i = 0, j = 0;
    while (i < outer.segments || j < inner.segments) {
      const bool along_outer = j == inner.segments || (i < outer.segments && outer.twice_middle(i) <= inner.twice_middle(j));
      if (along_outer) {
        triangle(outer.vertex(i), outer.vertex(i + 1), inner.vertex(j));
        ++i;
      } else {
        triangle(outer.vertex(i), inner.vertex(j + 1), inner.vertex(j));
        ++j;
      }
    }
  }

 private:
  bool clockwise_;
  Tessellation& out_;
};

/// The divided edges of the outer polygon in counterclockwise order, which begins with v = 0, and the divisions of the inner levels.
template <std::size_t kCorners, std::size_t kInner>
struct DividedPatch {
  std::array<DividedEdge, kCorners> outer;
  std::array<DividedEdge, kInner> inner;
  bool undivided;  ///< all levels are 1

  std::array<const DividedEdge*, kCorners> outer_edges() const {
    std::array<const DividedEdge*, kCorners> edges;
    for (std::size_t i = 0; i < kCorners; ++i) edges[i] = &outer[i];
    return edges;
  }
};

/// Divides the edges of a triangle or quad. Sections 11.2.2.1 and 11.2.2.2: if not all levels are 1 after rounding, inner levels of 1 are
/// treated as 1 + ε, which results in two or three segments.
template <std::size_t kCorners, std::size_t kInner>
DividedPatch<kCorners, kInner> divide_patch(TessellationSpacing spacing, const TessellationLevels<float>& levels) {
  DividedPatch<kCorners, kInner> patch;
  patch.undivided = true;
  for (std::size_t i = 0; i < kCorners; ++i) {
    patch.outer[i] = divide_edge(round_level(spacing, levels.outer[(i + 1) % kCorners]));
    patch.undivided &= patch.outer[i].segments == 1;
  }
  for (std::size_t i = 0; i < kInner; ++i) patch.undivided &= round_level(spacing, levels.inner[i]).segments == 1;
  for (std::size_t i = 0; i < kInner; ++i) {
    const float least = patch.undivided ? 1.0f : 1.0f + 0x1p-23f;
    patch.inner[i] = divide_edge(round_level(spacing, levels.inner[i] > least ? levels.inner[i] : least));
  }
  return patch;
}

/// Appends a vertex of the triangle. `side` 0 is the edge v = 0, from the corner w = 1 to u = 1, and so on. The vertex is at distance
/// 2·inset from the side in barycentric coordinates; the foot of its perpendicular in the equilateral triangle is at `position`.
void place_on_triangle(DomainWriter& writer, uint32_t side, int32_t position, int32_t inset) {
  std::array<int32_t, 3> uvw;
  uvw[(side + 2) % 3] = kOne - position - inset;
  uvw[side] = position - inset;
  uvw[(side + 1) % 3] = 2 * inset;
  writer.vertex(uvw[0], uvw[1], uvw[2]);
}

/// Rounds a position to a multiple of 3 units, counted from the nearer end of the edge. The middle stays in the middle.
int32_t multiple_of_three(int32_t position) {
  if (2 * position > kOne) return kOne - multiple_of_three(kOne - position);
  return 2 * position == kOne ? position : (position + 1) / 3 * 3;
}

/// Section 11.2.2.1. A corner of the inner triangle is where the perpendiculars of two edges, at distance p from their common corner, meet.
/// Its barycentric coordinates are (1 − 4p/3, 2p/3, 2p/3). If p is a multiple of 3 units, they are exact, and so are the other points of
/// the ring. The inner triangles then have straight edges and coordinates whose sum is exactly 1.
void tessellate_triangle(TessellationSpacing spacing, const TessellationLevels<float>& levels, DomainWriter& writer) {
  const DividedPatch<3, 1> patch = divide_patch<3, 1>(spacing, levels);
  const DividedEdge& inner = patch.inner[0];
  std::array<Side, 3> ring = writer.ring(patch.outer_edges(), 0, [&](uint32_t side, int32_t p) { place_on_triangle(writer, side, p, 0); });
  for (uint32_t depth = 1; 2 * depth <= inner.segments; ++depth) {
    const int32_t inset = multiple_of_three(inner.position[depth]) / 3;
    const std::array<Side, 3> next = writer.ring<3>(
        {&inner, &inner, &inner}, depth, [&](uint32_t side, int32_t p) { place_on_triangle(writer, side, multiple_of_three(p), inset); });
    if (2 * depth == inner.segments) writer.vertex(kOne / 3, kOne / 3, kOne - 2 * (kOne / 3));  // the innermost triangle is a point
    for (std::size_t i = 0; i < 3; ++i) writer.stitch(ring[i], next[i]);
    ring = next;
  }
  if (inner.segments % 2 == 1) writer.triangle(ring[0].first, ring[1].first, ring[2].first);
}

/// Appends a vertex of the square's outline. `side` 0 is the edge v = 0, from the corner (0, 0) to (1, 0), and so on.
void place_on_square(DomainWriter& writer, uint32_t side, int32_t position) {
  const std::array<int32_t, 4> along{position, kOne, kOne - position, 0};
  writer.vertex(along[side], along[(side + 3) % 4], 0);
}

/// Appends the inner rectangle of a quad, which is a segment or a point if a level is 2, and returns its sides.
std::array<Side, 4> append_inner_rectangle(const DividedEdge& along_u, const DividedEdge& along_v, DomainWriter& writer) {
  const uint32_t columns = along_u.segments - 1, rows = along_v.segments - 1, base = writer.count();
  for (uint32_t y = 1; y <= rows; ++y) {
    for (uint32_t x = 1; x <= columns; ++x) writer.vertex(along_u.position[x], along_v.position[y], 0);
  }
  for (uint32_t y = 0; y + 1 < rows; ++y) {
    for (uint32_t x = 0; x + 1 < columns; ++x) {
      const uint32_t low = base + y * columns + x, high = low + columns;
      writer.triangle(low, low + 1, high + 1);
      writer.triangle(low, high + 1, high);
    }
  }
  const std::array<uint32_t, 4> corner{base, base + columns - 1, base + rows * columns - 1, base + (rows - 1) * columns};
  const int32_t row = static_cast<int32_t>(columns);
  return {{{along_u.position.data() + 1, columns - 1, corner[0], corner[1], 1},
           {along_v.position.data() + 1, rows - 1, corner[1], corner[2], row},
           {along_u.position.data() + 1, columns - 1, corner[2], corner[3], -1},
           {along_v.position.data() + 1, rows - 1, corner[3], corner[0], -row}}};
}

/// Section 11.2.2.2.
void tessellate_quad(TessellationSpacing spacing, const TessellationLevels<float>& levels, DomainWriter& writer) {
  const DividedPatch<4, 2> patch = divide_patch<4, 2>(spacing, levels);
  const std::array<Side, 4> outer =
      writer.ring(patch.outer_edges(), 0, [&](uint32_t side, int32_t p) { place_on_square(writer, side, p); });
  if (patch.undivided) {
    writer.triangle(outer[0].first, outer[1].first, outer[2].first);
    writer.triangle(outer[0].first, outer[2].first, outer[3].first);
    return;
  }
  const std::array<Side, 4> inner = append_inner_rectangle(patch.inner[0], patch.inner[1], writer);
  for (std::size_t i = 0; i < 4; ++i) writer.stitch(outer[i], inner[i]);
}

/// Section 11.2.2.3. The lines are always equally spaced. The line at v = 1 is not drawn.
void tessellate_isolines(TessellationSpacing spacing, const TessellationLevels<float>& levels, DomainWriter& writer) {
  const DividedEdge lines = divide_edge(round_level(TessellationSpacing::equal, levels.outer[0]));
  const DividedEdge points = divide_edge(round_level(spacing, levels.outer[1]));
  for (uint32_t i = 0; i < lines.segments; ++i) {
    for (uint32_t k = 0; k <= points.segments; ++k) {
      if (k > 0) writer.line(writer.count() - 1, writer.count());
      writer.vertex(points.position[k], lines.position[i], 0);
    }
  }
}

/// Section 11.2.2: a patch is discarded if a relevant outer level is zero, negative or NaN.
bool is_discarded(TessellationDomain domain, const TessellationLevels<float>& levels) {
  const std::size_t relevant = domain == TessellationDomain::triangles ? 3 : domain == TessellationDomain::quads ? 4 : 2;
  return !std::ranges::all_of(std::span(levels.outer).first(relevant), [](float level) { return level > 0.0f; });
}

}  // namespace

void tessellate(const TessellatorOptions& options, const TessellationLevels<float>& levels, Tessellation& out) {
  out.coordinates.clear();
  out.indices.clear();
  if (is_discarded(options.domain, levels)) return;
  DomainWriter writer(options.clockwise, out);
  switch (options.domain) {
    case TessellationDomain::triangles: tessellate_triangle(options.spacing, levels, writer); break;
    case TessellationDomain::quads: tessellate_quad(options.spacing, levels, writer); break;
    case TessellationDomain::isolines: tessellate_isolines(options.spacing, levels, writer); break;
  }
  if (options.point_mode) {  // one point per vertex replaces the primitives
    out.indices.resize(out.coordinates.size());
    std::iota(out.indices.begin(), out.indices.end(), 0u);
  }
}

}  // namespace halfspace::HS_LANES
