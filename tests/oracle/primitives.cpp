// SPDX-License-Identifier: Apache-2.0
//
// The primitive stage: assembly of primitives, and the functions of Renderer that move them to the window. Input: the indices and the
// shaded vertices of a draw. Output: triangles in the window.
#include "oracle/oracle.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "oracle/arithmetic.h"
#include "oracle/clip.h"
#include "oracle/smooth_area.h"
#include "oracle/transform.h"
#include "oracle/triangle_setup.h"

namespace halfspace::oracle {

std::vector<uint32_t> selected(const std::vector<uint32_t>& indices, const DrawState& state) {
  std::vector<uint32_t> out;
  for (std::size_t i = state.first; i < indices.size() && (!state.count || i - state.first < *state.count); ++i) out.push_back(indices[i]);
  return out;
}

namespace {

// Returns the primitives of a run without restarts, with the vertices of their neighbors (OpenGL 4.6, sections 10.1.11 to 10.1.14).
std::vector<std::vector<uint32_t>> with_neighbors(const std::vector<uint32_t>& run, const DrawState& state) {
  std::vector<std::vector<uint32_t>> out;
  const std::size_t size = is_lines(state.topology) ? 4 : 6;
  if (state.topology != Topology::triangle_strip_adjacency) {
    const std::size_t step = state.topology == Topology::line_strip_adjacency ? 1 : size;
    for (std::size_t i = 0; i + size <= run.size(); i += step)
      out.emplace_back(run.begin() + static_cast<int>(i), run.begin() + static_cast<int>(i + size));
    return out;
  }
  if (run.size() < 6) return out;
  const std::size_t n = run.size() / 2 - 2;
  for (std::size_t i = 0; i < n; ++i) {
    // Table 10.1, whose vertices count from 1.
    const bool odd = i % 2 == 1, first = i == 0, last = i + 1 == n;
    const std::size_t k = 2 * i;
    std::array<std::size_t, 3> corner{k + 1, k + 3, k + 5}, neighbor{first ? 2 : k - 1, last ? k + 6 : k + 7, k + 4};
    if (odd) {
      corner = {k + 3, k + 1, k + 5};
      neighbor = {k - 1, k + 4, last ? k + 6 : k + 7};
      if (state.provoking == ProvokingVertex::first) {  // the same triangle from its second corner on
        corner = {k + 1, k + 5, k + 3};
        neighbor = {k + 4, last ? k + 6 : k + 7, k - 1};
      }
    }
    out.emplace_back();
    for (std::size_t c = 0; c < 3; ++c) {
      out.back().push_back(run[corner[c] - 1]);
      out.back().push_back(run[neighbor[c] - 1]);
    }
  }
  return out;
}

}  // namespace

std::vector<std::vector<uint32_t>> assemble_with_neighbors(const std::vector<uint32_t>& indices, std::optional<uint32_t> restart,
                                                           const DrawState& state) {
  std::vector<std::vector<uint32_t>> out;
  if (!has_adjacency(state.topology)) {
    for (const std::array<uint32_t, 3>& p : assemble(indices, restart, state)) out.emplace_back(p.begin(), p.end());
    return out;
  }
  std::vector<uint32_t> run;
  const auto finish_run = [&] {
    for (std::vector<uint32_t>& p : with_neighbors(run, state)) out.push_back(std::move(p));
    run.clear();
  };
  for (const uint32_t i : indices) {
    if (restart == i) finish_run();
    if (restart != i) run.push_back(i);
  }
  finish_run();
  return out;
}

std::vector<std::vector<uint32_t>> patches_of(const std::vector<uint32_t>& indices, std::optional<uint32_t> restart, std::size_t size) {
  std::vector<std::vector<uint32_t>> out;
  std::vector<uint32_t> patch;
  for (const uint32_t i : indices) {
    if (restart == i) {
      patch.clear();
      continue;
    }
    patch.push_back(i);
    if (patch.size() < size) continue;
    out.push_back(patch);
    patch.clear();
  }
  return out;
}

std::vector<std::array<uint32_t, 3>> assemble(const std::vector<uint32_t>& indices, std::optional<uint32_t> restart,
                                              const DrawState& state) {
  std::vector<std::array<uint32_t, 3>> out;
  std::vector<uint32_t> run;
  const auto finish_run = [&] {
    if (state.topology == Topology::points) {
      for (const uint32_t i : run) out.push_back({i, i, i});
      run.clear();
      return;
    }
    if (has_adjacency(state.topology)) {
      for (const std::vector<uint32_t>& p : with_neighbors(run, state)) {
        if (is_lines(state.topology)) out.push_back({p[1], p[2], p[2]});
        if (!is_lines(state.topology)) out.push_back({p[0], p[2], p[4]});
      }
      run.clear();
      return;
    }
    if (is_lines(state.topology)) {
      const std::size_t step = state.topology == Topology::lines ? 2 : 1;
      for (std::size_t i = 0; i + 2 <= run.size(); i += step) out.push_back({run[i], run[i + 1], run[i + 1]});
      if (state.topology == Topology::line_loop && run.size() > 1) out.push_back({run.back(), run[0], run[0]});
      run.clear();
      return;
    }
    const std::size_t step = state.topology == Topology::triangles ? 3 : 1;
    for (std::size_t i = 0; i + 3 <= run.size(); i += step) {
      std::array<uint32_t, 3> t{run[i], run[i + 1], run[i + 2]};  // table 13.2: the first or last vertex is provoking, except in a fan
      if (state.topology == Topology::triangle_fan) t = {run[i + 1], run[i + 2], run[0]};
      const bool turned = state.topology == Topology::triangle_strip && i % 2 == 1;
      if (state.provoking == ProvokingVertex::first) {
        if (turned) std::swap(t[1], t[2]);
      } else {
        if (state.topology == Topology::triangle_fan) t = {run[0], run[i + 1], run[i + 2]};
        if (turned) std::swap(t[0], t[1]);
      }
      out.push_back(t);
    }
    run.clear();
  };
  for (const uint32_t i : indices) {
    if (restart == i) {
      finish_run();
    } else {
      run.push_back(i);
    }
  }
  finish_run();
  return out;
}

std::vector<WindowTriangle> Renderer::window_points(const DrawState& state, const ShadedVertex& v) {
  ++counts_.primitives_in;
  const glm::vec4& p = v.pos_clip;
  if (!is_finite(v)) {
    ++counts_.culled_non_finite;
    return {};
  }
  const float inv_w = 1.0f / p.w;
  const auto is_negative = [](float d) { return d < 0.0f; };
  const bool beyond = std::ranges::any_of(v.clip_distances, is_negative) || std::ranges::any_of(v.cull_distances, is_negative);
  if (beyond || !(inv_w > 0.0f && inv_w <= 1.0f / kMinW) || (!state.depth.clamp && (beyond_near(state.depth, p) || beyond_far(p)))) {
    ++counts_.culled_outside;
    return {};
  }
  const Transform f = make_transform(state, target_->width(), target_->height(), target_->samples());
  const auto place = [](double ndc, float half, float center) {
    return std::llrint(std::fmin(std::fmax((ndc * static_cast<double>(half) + static_cast<double>(center)) * 256.0, -0x1p28), 0x1p28));
  };
  WindowTriangle t;
  t.is_point = t.front = true;
  t.origin = state.point_origin;
  Corner& c = t.corner[0];
  c.varyings = v.varyings;
  c.inv_w = inv_w;
  c.z = clamped(std::fma(p.z * c.inv_w, f.z_scale, f.z_bias), -1e30f, 1e30f);
  t.z0 = t.z_max = c.z;
  if (v.has_bounds) {
    const auto number = [](float x) { return static_cast<double>(x); };
    t.low = {place(number(v.low.x), f.half_width, f.center_x), place(number(v.low.y), f.half_height, f.center_y)};
    t.high = {place(number(v.high.x), f.half_width, f.center_x), place(number(v.high.y), f.half_height, f.center_y)};
    if (f.half_height < 0.0f) std::swap(t.low.y, t.high.y);
  } else {
    const bool near_by = !needs_clip(f, {.clamp = true}, p);
    const auto x = static_cast<double>(p.x) / static_cast<double>(p.w), y = static_cast<double>(p.y) / static_cast<double>(p.w);
    c.x = near_by ? snap(p.x, p.w, f.half_width, f.center_x) : place(x, f.half_width, f.center_x);
    c.y = near_by ? snap(p.y, p.w, f.half_height, f.center_y) : place(y, f.half_height, f.center_y);
    const int64_t side = std::llrint(std::fmin(std::fmax(static_cast<double>(v.point_size) * 256.0, 0.0), 0x1p28));
    t.low = {c.x - side / 2, c.y - side / 2};
    t.high = {t.low.x + side, t.low.y + side};
  }
  if (t.low.x >= t.high.x || t.low.y >= t.high.y) {
    ++counts_.culled_degenerate;
    return {};
  }
  // The rectangle must intersect the sample bounding box of a drawable pixel.
  const Box allowed = allowed_pixels(*target_, state);
  WindowTriangle closed = t;
  closed.is_point = false;
  closed.corner[0] = {t.low.x, t.low.y, 0, 0, {}};
  closed.corner[1] = closed.corner[2] = {t.high.x - 1, t.high.y - 1, 0, 0, {}};
  if (intersect(covered_box(closed, target_->samples()), allowed).empty()) {
    ++counts_.culled_no_sample;
    return {};
  }
  ++counts_.triangles;
  return {t};
}

// Returns a line that follows the diamond-exit rule or, with several samples per pixel, the two halves of a rectangle.
std::vector<WindowTriangle> Renderer::window_line(const DrawState& state, const Corner& a, const Corner& b, const std::vector<float>& flat,
                                                  bool front) {
  const int64_t dx = b.x - a.x, dy = b.y - a.y;
  if (dx == 0 && dy == 0) return {};
  if (target_->samples() == 1) {
    WindowTriangle t;
    t.is_line = true;
    t.from = {a.x, a.y};
    t.to = {b.x, b.y};
    t.width = static_cast<int>(std::nearbyint(clamped(state.line_width, 1.0f, 4096.0f)));
    t.front = front;
    t.flat = flat;
    const bool swap = b.z < a.z;
    const Corner &near = swap ? b : a, &far = swap ? a : b;
    t.corner = {near, far, near};
    t.corner[2].x = near.x - (far.y - near.y);
    t.corner[2].y = near.y + (far.x - near.x);
    t.area = dx * dx + dy * dy;
    t.z0 = near.z;
    t.z_max = far.z;
    if (is_smooth(state)) t.smooth = smooth_line(near, far, state.line_width);
    t.z_step1 = static_cast<float>((static_cast<double>(far.z) - static_cast<double>(near.z)) / static_cast<double>(t.area));
    return {t};
  }
  const auto length = std::sqrt(static_cast<double>(dx) * static_cast<double>(dx) + static_cast<double>(dy) * static_cast<double>(dy));
  const double scale = static_cast<double>(clamped(state.line_width, 0.0f, 4096.0f)) * 128.0 / length;
  const int64_t nx = std::llrint(static_cast<double>(-dy) * scale), ny = std::llrint(static_cast<double>(dx) * scale);
  const auto moved = [&](Corner c, int64_t by) {
    c.x += by * nx;
    c.y += by * ny;
    return c;
  };
  std::vector<WindowTriangle> halves;
  for (const std::array<Corner, 3>& half :
       {std::array{moved(a, -1), moved(b, -1), moved(b, 1)}, {moved(a, -1), moved(b, 1), moved(a, 1)}}) {
    auto [fate, piece] =
        make_window_triangle(state, allowed_pixels(*target_, state), target_->depth_format(), target_->samples(), half, 0, front);
    piece.flat = flat;
    if (fate == Fate::drawn) halves.push_back(std::move(piece));
  }
  return halves;
}

// Returns the lines or points that are drawn instead of a polygon.
std::vector<WindowTriangle> Renderer::window_outline(const DrawState& state, std::vector<Corner> corners, const std::vector<int>& vertex,
                                                     const std::array<const ShadedVertex*, 3>& v, const std::vector<float>& flat) {
  int64_t area = 0;
  for (std::size_t i = 2; i < corners.size(); ++i) area += orient2d(corners[0], corners[i - 1], corners[i]);
  const bool front = is_front_facing(state, area > 0);
  if (area == 0) ++counts_.culled_degenerate;
  if (area != 0 && culls_face(state.cull, front)) ++counts_.culled_face;
  if (area == 0 || culls_face(state.cull, front)) return {};
  const bool has_offset = state.polygon_mode == PolygonMode::line ? state.offset.outlines : state.offset.corners;
  if (has_offset && (state.offset.slope != 0.0f || state.offset.constant != 0.0f)) {
    // The largest triangle of the fan from the first corner.
    std::size_t largest = 2;
    for (std::size_t i = 3; i < corners.size(); ++i) {
      const auto size = [&](std::size_t k) { return std::abs(orient2d(corners[0], corners[k - 1], corners[k])); };
      if (size(i) > size(largest)) largest = i;
    }
    const float offset = outline_offset(state.offset, target_->depth_format(), {corners[0], corners[largest - 1], corners[largest]});
    for (Corner& c : corners) c.z += offset;
  }
  std::vector<WindowTriangle> out;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    if (state.polygon_mode == PolygonMode::line) {
      for (WindowTriangle& t : window_line(state, corners[i], corners[(i + 1) % corners.size()], flat, front)) out.push_back(std::move(t));
    } else if (vertex[i] >= 0) {
      ShadedVertex point = *v[static_cast<std::size_t>(vertex[i])];
      point.clip_distances.clear();
      point.cull_distances.clear();
      const Counts before = counts_;
      std::vector<WindowTriangle> one = window_points(state, point);
      counts_ = before;
      for (WindowTriangle& t : one) {
        t.front = front;
        t.corner[0].z = t.z0 = t.z_max = corners[i].z;
        t.corner[0].varyings = corners[i].varyings;
        out.push_back(std::move(t));
      }
    }
  }
  return out;
}

std::vector<WindowTriangle> Renderer::window_triangles(const DrawState& state, const ShaderFacts& facts,
                                                       const std::array<const ShadedVertex*, 3>& v) {
  ++counts_.primitives_in;
  const bool line = is_lines(state.topology);
  counts_.has_lines |= line || state.polygon_mode != PolygonMode::fill;
  if (!std::all_of(v.begin(), v.end(), [](const ShadedVertex* s) { return is_finite(*s); })) {
    ++counts_.culled_non_finite;
    return {};
  }
  bool beyond_all = false, beyond_any = false;  // for a single clip distance
  for (std::size_t k = 0; k < v[0]->clip_distances.size(); ++k) {
    const auto beyond = [k](const ShadedVertex* s) { return !(s->clip_distances[k] >= 0.0f); };
    beyond_all |= std::all_of(v.begin(), v.end(), beyond);
    beyond_any |= std::any_of(v.begin(), v.end(), beyond);
  }
  for (std::size_t k = 0; k < v[0]->cull_distances.size(); ++k)
    beyond_all |= std::all_of(v.begin(), v.end(), [k](const ShadedVertex* s) { return s->cull_distances[k] < 0.0f; });
  if (all_outside(state.depth, v) || beyond_all) {
    ++counts_.culled_outside;
    return {};
  }
  const Transform transform = make_transform(state, target_->width(), target_->height(), target_->samples());
  const std::size_t provoking = state.provoking == ProvokingVertex::first ? 0 : 2;
  std::vector<Corner> corners;
  std::vector<int> vertices{0, 1, 2};
  bool corners_are_cut = false;
  if (beyond_any ||
      std::any_of(v.begin(), v.end(), [&](const ShadedVertex* s) { return needs_clip(transform, state.depth, s->pos_clip); })) {
    const Polygon polygon = clip_primitive(transform, state.depth, v, line);
    if (polygon.size() < (line ? 2u : 3u)) {
      ++counts_.culled_outside;
      return {};
    }
    ++counts_.clipped;
    corners_are_cut = true;
    vertices.clear();
    for (const ClipPoint& c : polygon) {
      corners.push_back(clip_corner(transform, c, v, facts, provoking));
      vertices.push_back(c.vertex);
    }
  } else {
    for (std::size_t i = 0; i < (line ? 2 : 3); ++i) corners.push_back(project(transform, *v[i]));
  }
  const std::vector<float>& flat = v[provoking]->varyings;
  if (line || state.polygon_mode != PolygonMode::fill || corners_are_cut) {  // all vertices get the flat values of the provoking vertex
    for (Corner& c : corners) {
      for (std::size_t i = 0; i < c.varyings.size(); ++i) {
        if (facts.interpolations[i] == Interpolation::flat) c.varyings[i] = flat[i];
      }
    }
  }
  if (line) return window_line(state, corners[0], corners[1], flat, true);
  if (state.polygon_mode != PolygonMode::fill) return window_outline(state, corners, vertices, v, flat);

  const Box allowed = allowed_pixels(*target_, state);
  const bool clipped = corners.size() != 3 || corners_are_cut;
  std::vector<WindowTriangle> pieces;
  Fate last = Fate::drawn;
  for (const std::array<Corner, 3>& c : clipped ? fan(corners) : std::vector<std::array<Corner, 3>>{{corners[0], corners[1], corners[2]}}) {
    auto [fate, piece] = make_window_triangle(state, allowed, target_->depth_format(), target_->samples(), c, clipped ? 0 : provoking);
    if (fate == Fate::drawn) pieces.push_back(std::move(piece));
    last = fate;
  }
  counts_.triangles += pieces.size();
  if (pieces.empty()) {
    if (last == Fate::degenerate) ++counts_.culled_degenerate;
    if (last == Fate::wrong_face) ++counts_.culled_face;
    if (last == Fate::no_sample) ++counts_.culled_no_sample;
  }
  return pieces;
}

}  // namespace halfspace::oracle
