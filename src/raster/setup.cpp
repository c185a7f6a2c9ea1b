// SPDX-License-Identifier: Apache-2.0
#include "raster/setup.h"

#include <algorithm>
#include <cmath>

#include "raster/assembly.h"
#include "raster/clip.h"
#include "raster/vertex_stage.h"

namespace halfspace {

namespace {

// Largest extent at which every edge function fits in int32 without a shift anywhere in a tile that the triangle meets:
// at most (63 + 64)·256 < 2^15 sub-pixels from a vertex, times an edge of at most 63·256 < 2^14, twice: below 2^30.
constexpr int32_t kSmallExtent = 63 * kSubPixels;

// A point with a smaller w (kMinW of the vertex stage) is behind the eye or in it.
constexpr float kLargestInvW = 0x1p96f;

// The smallest depth step that makes a difference: OpenGL 4.6, section 14.6.5.
double smallest_depth_step(DepthFormat format, float largest_z) {
  switch (format) {
    case DepthFormat::d16: return 1.0 / 65535.0;
    case DepthFormat::d24: return 1.0 / 16777215.0;
    default: return std::ldexp(1.0, (std::fabs(largest_z) > 0.0f ? std::ilogb(largest_z) : -126) - 23);
  }
}

struct DepthPlane {
  double dz1, dz2;  // depth differences of vertices 1, 2 to vertex 0
  double area;      // in (1/256 px)²
};

float depth_offset(const DepthOffset& o, DepthFormat format, const Triangle& t, const DepthPlane& p, float largest_z) {
  double offset = 0.0;
  if (o.slope != 0.0f) {  // 0·Inf is not NaN here: no slope term where none is asked for
    const double e1x = t.x[1] - t.x[0], e1y = t.y[1] - t.y[0], e2x = t.x[2] - t.x[0], e2y = t.y[2] - t.y[0];
    const double dz_dx = (e2y * p.dz1 - e1y * p.dz2) / p.area * kSubPixels;
    const double dz_dy = (e1x * p.dz2 - e2x * p.dz1) / p.area * kSubPixels;
    offset += static_cast<double>(o.slope) * std::max(std::fabs(dz_dx), std::fabs(dz_dy));
  }
  offset += static_cast<double>(o.constant) * smallest_depth_step(format, largest_z);
  if (o.clamp > 0.0f) offset = std::min(offset, static_cast<double>(o.clamp));
  if (o.clamp < 0.0f) offset = std::max(offset, static_cast<double>(o.clamp));
  return static_cast<float>(offset);
}

}  // namespace

PixelBounds pixel_bounds(const Triangle& t, const PixelBounds& b, const SampleSpan& span) {
  const auto [x_low, x_high] = std::minmax({t.x[0], t.x[1], t.x[2]});
  const auto [y_low, y_high] = std::minmax({t.y[0], t.y[1], t.y[2]});
  constexpr int32_t last = kSubPixels - 1;
  // first pixel with a sample at or right of x_low, one past the last with a sample at or left of x_high
  return {std::max(b.x0, (x_low - span.high + last) >> kSubPixelBits), std::max(b.y0, (y_low - span.high + last) >> kSubPixelBits),
          std::min(b.x1, ((x_high - span.low) >> kSubPixelBits) + 1), std::min(b.y1, ((y_high - span.low) >> kSubPixelBits) + 1)};
}

PixelBounds pixel_bounds(const Triangle& t, const PixelBounds& b, const SamplePosition& at) {
  const auto [x_low, x_high] = std::minmax({t.x[0], t.x[1], t.x[2]});
  const auto [y_low, y_high] = std::minmax({t.y[0], t.y[1], t.y[2]});
  constexpr int32_t last = kSubPixels - 1;
  return {std::max(b.x0, (x_low - at.x + last) >> kSubPixelBits), std::max(b.y0, (y_low - at.y + last) >> kSubPixelBits),
          std::min(b.x1, ((x_high - at.x) >> kSubPixelBits) + 1), std::min(b.y1, ((y_high - at.y) >> kSubPixelBits) + 1)};
}

Cull set_up_triangle(const Draw& draw, const Frame& frame, const std::array<const ScreenVertex*, 3>& v,
                     const std::array<uint32_t, 3>& index, uint32_t provoking, Triangle& out) {
  const int64_t e1x = v[1]->x - v[0]->x, e1y = v[1]->y - v[0]->y;
  const int64_t e2x = v[2]->x - v[0]->x, e2y = v[2]->y - v[0]->y;
  const int64_t area = e1x * e2y - e1y * e2x;
  if (area == 0) return Cull::degenerate;
  const bool front = (area > 0) == (draw.state.front == Winding::counter_clockwise);
  if (is_culled(draw.state.cull, front)) return Cull::face;

  // Order: counter-clockwise, starting at the smallest depth; among equals at the first submitted.
  std::array<std::size_t, 3> order{0, 1, 2};
  if (area < 0) std::swap(order[1], order[2]);
  const float z_min = std::min({v[0]->z, v[1]->z, v[2]->z});
  while (v[order[0]]->z != z_min) std::rotate(order.begin(), order.begin() + 1, order.end());

  for (std::size_t i = 0; i < 3; ++i) {
    out.x[i] = v[order[i]]->x;
    out.y[i] = v[order[i]]->y;
    out.vertex[i] = index[order[i]];
    if (order[i] == provoking) out.flags = static_cast<uint32_t>(i) << kProvokingShift;
  }
  if (pixel_bounds(out, draw.bounds, frame.samples_at).empty()) return Cull::no_sample;

  const DepthPlane plane{static_cast<double>(v[order[1]]->z) - static_cast<double>(z_min),
                         static_cast<double>(v[order[2]]->z) - static_cast<double>(z_min), std::fabs(static_cast<double>(area))};
  const float z_max = std::max({v[0]->z, v[1]->z, v[2]->z});
  const float offset = depth_offset(draw.state.offset, frame.depth_format, out, plane, std::max(std::fabs(z_min), std::fabs(z_max)));
  out.z0 = z_min + offset;
  out.z_max = z_max + offset;
  out.z_edge1 = static_cast<float>(plane.dz1 / plane.area);
  out.z_edge2 = static_cast<float>(plane.dz2 / plane.area);

  const auto [x_low, x_high] = std::minmax({out.x[0], out.x[1], out.x[2]});
  const auto [y_low, y_high] = std::minmax({out.y[0], out.y[1], out.y[2]});
  if (x_high - x_low <= kSmallExtent && y_high - y_low <= kSmallExtent) out.flags |= kSmall;
  if (front) out.flags |= kFrontFacing;
  return Cull::none;
}

namespace {

// Twice the area of three corners: > 0 where they turn left.
int64_t turn(const ScreenVertex& a, const ScreenVertex& b, const ScreenVertex& c) {
  return int64_t{b.x - a.x} * (c.y - a.y) - int64_t{b.y - a.y} * (c.x - a.x);
}

// How a clipped polygon becomes a fan of triangles.
//
// Snapping can bend a nearly straight corner inwards; a fan from elsewhere would turn a piece over and draw its samples
// twice. From `apex` all pieces turn one way. Where the outline of a sliver crosses itself there is no such corner; then
// pieces that turn against the whole are left out, and their samples remain drawn by the others.
struct Fan {
  uint32_t apex = 0;
  bool turns_left = false;
};

Fan fan_of(const ClipVertex* v, uint32_t count) {
  Fan fan;
  for (uint32_t apex = 0; apex < count; ++apex) {
    bool left = false, right = false;
    int64_t area = 0;
    for (uint32_t i = 2; i < count; ++i) {
      const int64_t piece = turn(v[apex].screen, v[(apex + i - 1) % count].screen, v[(apex + i) % count].screen);
      left |= piece > 0;
      right |= piece < 0;
      area += piece;
    }
    fan = {apex, area > 0};
    if (!(left && right)) return fan;
  }
  return fan;
}

// Sets up the triangles of one segment.
class SegmentSetup {
 public:
  SegmentSetup(const Frame& frame, Chunk& chunk, uint32_t segment)
      : frame_(frame),
        chunk_(chunk),
        segment_(segment),
        draw_(frame.draws[chunk.segments[segment].draw]),
        shaded_(frame.shaded[chunk.segments[segment].draw]),
        assembly_(draw_, chunk.segments[segment].first),
        instance_(chunk.segments[segment].instance),
        slot_base_(shaded_.first - instance_ * shaded_.count),
        provoking_(draw_.state.provoking == ProvokingVertex::first ? 0 : 2) {}

  void submit_point() {
    ++chunk_.statistics.primitives_in;
    const uint32_t id = assembly_.next()[0] - slot_base_;
    const Outcode code = shaded_.outcodes[id];
    const float w_sign = shaded_.screen[id].inv_w;
    if (code & kOutNonFinite) {
      ++chunk_.statistics.culled_non_finite;
    } else if ((code & (kOutNear | kOutFar)) != 0 || !(w_sign > 0.0f && w_sign <= kLargestInvW)) {
      ++chunk_.statistics.culled_outside;
    } else {
      count(append_point(id), 1);
    }
  }

  void submit_triangle() {
    ++chunk_.statistics.primitives_in;
    std::array<uint32_t, 3> id = assembly_.next();
    Outcode any = 0;
    Outcode all = kOutView;
    for (uint32_t i = 0; i < 3; ++i) {
      id[i] -= slot_base_;
      any |= shaded_.outcodes[id[i]];
      all &= shaded_.outcodes[id[i]];
    }
    if (any & kOutNonFinite) {
      ++chunk_.statistics.culled_non_finite;
    } else if (all) {
      ++chunk_.statistics.culled_outside;
    } else if (any & (kOutNear | kOutFar | kOutGuard)) {
      clip(id);
    } else {
      const std::array<const ScreenVertex*, 3> v{&shaded_.screen[id[0]], &shaded_.screen[id[1]], &shaded_.screen[id[2]]};
      count(append(v, id, 0, provoking_), 1);
    }
  }

 private:
  void count(Cull why, uint64_t n) {
    PassStatistics& s = chunk_.statistics;
    if (why == Cull::degenerate) s.culled_degenerate += n;
    if (why == Cull::face) s.culled_face += n;
    if (why == Cull::no_sample) s.culled_no_sample += n;
  }

  Cull append(const std::array<const ScreenVertex*, 3>& v, const std::array<uint32_t, 3>& index, uint32_t flags, uint32_t provoking) {
    Triangle t;
    const Cull why = set_up_triangle(draw_, frame_, v, index, provoking, t);
    if (why != Cull::none) return why;
    t.flags |= flags | segment_ << kSegmentShift;
    chunk_.triangles.push_back(t);
    return Cull::none;
  }

  Cull append_point(uint32_t id) {
    const SpriteRect& r = shaded_.sprites[id];
    const ScreenVertex& v = shaded_.screen[id];
    if (r.x0 >= r.x1 || r.y0 >= r.y1) return Cull::degenerate;
    Triangle t{.x = {r.x0, r.x1 - 1, r.x0}, .y = {r.y0, r.y1 - 1, r.y0}, .z0 = v.z, .z_edge1 = 0, .z_edge2 = 0, .z_max = v.z,
               .vertex = {id, id, id}, .flags = kSprite | kSmall | kFrontFacing | segment_ << kSegmentShift};
    if (pixel_bounds(t, draw_.bounds, frame_.samples_at).empty()) return Cull::no_sample;
    chunk_.triangles.push_back(t);
    return Cull::none;
  }

  void clip(const std::array<uint32_t, 3>& id) {
    alignas(64) std::array<float, 4 * kVertexBatch> rows{};
    const std::array<uint32_t, 3> index{id[0] + slot_base_, id[1] + slot_base_, id[2] + slot_base_};
    const VertexView view = at_instance(draw_.vertices, instance_);
    draw_.kernels.position(draw_.shader.get(), {&view, index.data(), 0, 3, 0, draw_.state.base_vertex, static_cast<int32_t>(instance_),
                                                nullptr, rows.data(), nullptr});
    std::array<glm::vec4, 3> pos_clip;
    for (std::size_t i = 0; i < 3; ++i) {
      pos_clip[i] = {rows[i], rows[kVertexBatch + i], rows[2 * kVertexBatch + i], rows[3 * kVertexBatch + i]};
    }
    const ClipPolygon polygon = clip_triangle(draw_.viewport, draw_.state.depth, pos_clip);
    if (polygon.count == 0) {
      ++chunk_.statistics.culled_outside;
      return;
    }
    ++chunk_.statistics.clipped;
    append_fan(polygon, id, {static_cast<double>(pos_clip[0].w), static_cast<double>(pos_clip[1].w), static_cast<double>(pos_clip[2].w)});
  }

  // The polygon's corners become clip vertices of the chunk, its fan triangles. Counted as culled only if no piece is left.
  void append_fan(const ClipPolygon& polygon, const std::array<uint32_t, 3>& id, const std::array<double, 3>& w) {
    const auto n = static_cast<std::size_t>(shaded_.varying_count);
    const std::array<const float*, 3> varyings{&shaded_.varyings[id[0] * n], &shaded_.varyings[id[1] * n], &shaded_.varyings[id[2] * n]};
    const auto first = static_cast<uint32_t>(chunk_.clip_vertices.size());
    for (int i = 0; i < polygon.count; ++i) {
      const ClipCorner& c = polygon.corners[static_cast<std::size_t>(i)];
      const auto first_varying = static_cast<uint32_t>(chunk_.clip_varyings.size());
      chunk_.clip_varyings.resize(first_varying + n);
      interpolate_corner(c, w, varyings, static_cast<int>(provoking_), draw_.kernels, chunk_.clip_varyings.data() + first_varying);
      // A corner of the triangle itself keeps the vertex stage's bits.
      const bool cut = c.vertex < 0;
      const ScreenVertex screen = cut ? project_corner(draw_.viewport, c.pos_clip) : shaded_.screen[id[static_cast<std::size_t>(c.vertex)]];
      chunk_.clip_vertices.push_back({screen, first_varying});
    }
    const std::size_t before = chunk_.triangles.size();
    const auto corners = static_cast<uint32_t>(polygon.count);
    const Fan fan = fan_of(chunk_.clip_vertices.data() + first, corners);
    Cull why = Cull::none;
    for (uint32_t i = 2; i < corners; ++i) {
      const std::array<uint32_t, 3> index{first + fan.apex, first + (fan.apex + i - 1) % corners, first + (fan.apex + i) % corners};
      const ClipVertex* v = chunk_.clip_vertices.data();
      const int64_t area = turn(v[index[0]].screen, v[index[1]].screen, v[index[2]].screen);
      if (area != 0 && (area > 0) != fan.turns_left) continue;
      // All corners carry the provoking vertex's flat values.
      why = append({&v[index[0]].screen, &v[index[1]].screen, &v[index[2]].screen}, index, kClipped, 0);
    }
    if (chunk_.triangles.size() != before) {
      chunk_.clip_sources.push_back({static_cast<uint32_t>(before), id});
    } else {
      count(why, 1);
    }
  }

  const Frame& frame_;
  Chunk& chunk_;
  uint32_t segment_;
  const Draw& draw_;
  const ShadedVertices& shaded_;
  Assembly assembly_;
  uint32_t instance_;
  uint32_t slot_base_;  ///< a vertex's slot is its index less this (modulo 2^32)
  uint32_t provoking_;
};

}  // namespace

void set_up_chunk(const Frame& frame, Chunk& chunk) {
  for (uint32_t s = 0; s < chunk.segments.size(); ++s) {
    Segment& segment = chunk.segments[s];
    segment.first_triangle = static_cast<uint32_t>(chunk.triangles.size());
    SegmentSetup setup(frame, chunk, s);
    const bool points = frame.draws[segment.draw].state.topology == Topology::points;
    for (uint32_t i = 0; i < segment.count; ++i) points ? setup.submit_point() : setup.submit_triangle();
  }
  chunk.statistics.triangles_binned = chunk.triangles.size();
}

}  // namespace halfspace
