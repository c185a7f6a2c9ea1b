// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <bit>

#include "explain/example_pixel.h"
#include "explain/page_data.h"
#include "explain/page_encode.h"
#include "halfspace/core/hash.h"
#include "halfspace/raster/inspect/inspection.h"
#include "halfspace/raster/pipeline/edge.h"
#include "halfspace/raster/pipeline/pixel_box.h"
#include "halfspace/raster/pipeline/sample_pattern.h"
#include "halfspace/scene/scene_paths.h"

namespace halfspace {

namespace {

// kMaxWireTriangles limits the wireframe of the example's draw and, separately, that of all other draws. A larger wireframe is a random
// sample of runs of kWireRun consecutive triangles, which are usually neighbors. Every n-th run would follow the rows of the mesh instead,
// and a sphere would look like a spiral. kMaxClipped limits the clipped triangles.
constexpr std::size_t kMaxWireTriangles = 12000, kWireRun = 8, kMaxClipped = 24;

// Returns true for one in `every` runs of primitives, on average.
bool is_in_sample(uint32_t primitive, std::size_t every) {
  const auto run = static_cast<int32_t>(primitive / kWireRun);
  return static_cast<uint32_t>(mix_bits(run)) % every == 0;
}

PageJson json_of_triangle(const PassContext& context, const Draw& draw, const Triangle& t) {
  PageJson json{{"x", t.x},
                {"y", t.y},
                {"z0", t.z0},
                {"z_edge1", t.z_edge1},
                {"z_edge2", t.z_edge2},
                {"z_max", t.z_max},
                {"front", t.is(kFrontFacing)},
                {"small", t.is(kNarrow)},
                {"clipped", t.is(kClipped)}};
  const auto json_of_box = [](const PixelBounds& b) { return PageJson{b.x0, b.y0, b.x1, b.y1}; };
  json["box"] = json_of_box(pixel_bounds(draw, t, draw.bounds, context.samples_at));
  for (int s = 0; s < context.samples; ++s)
    json["boxes"].push_back(json_of_box(pixel_bounds(draw, t, draw.bounds, sample_position(context.samples, s))));
  json["covered"] = covered_pixels(context, draw, std::span(&t, 1));
  if (!t.is_triangle()) return json;
  for (std::size_t i = 0; i < 3; ++i) {
    const Edge e = edge_of(t, i);
    json["edges"].push_back({{"x0", e.x0}, {"y0", e.y0}, {"ex", e.ex}, {"ey", e.ey}, {"bias", fill_bias(e)}});
  }
  return json;
}

PageJson json_of_vertex(const StageVertex& v) {
  PageJson json{{"index", v.index}};
  const auto put = [&](const char* key, const std::optional<glm::dvec3>& p) {
    if (p) json[key] = json_of(*p);
  };
  put("os", v.position_os);
  put("ws", v.position_ws);
  put("vs", v.position_vs);
  json["clip"] = json_of(glm::dvec4(v.clip));
  json["ndc"] = json_of(glm::dvec3(v.ndc));
  json["x"] = v.window.x;
  json["y"] = v.window.y;
  json["z"] = v.window.z;
  json["inv_w"] = v.window.inv_w;
  json["outcode"] = v.outcode;
  return json;
}

int example_sample(const PageInput& in) { return in.visible == nullptr ? 0 : in.visible->sample; }

// Returns the index of the triangle that covers the visible sample of the example pixel. A clipped primitive consists of several triangles.
std::size_t shown_triangle(const PageInput& in, const Draw& draw, const std::vector<Triangle>& triangles) {
  const int y = in.trace.height - 1 - in.pixel.y;
  const auto covered = [&](const Triangle& t) { return covers(in.context, draw, t, in.pixel.x, y, example_sample(in)); };
  const auto found = std::ranges::find_if(triangles, covered);
  return found == triangles.end() ? 0 : static_cast<std::size_t>(found - triangles.begin());
}

// Returns the covered samples of each pixel of the 8x8 block of the example pixel as bits, row by row from the lower left.
PageJson block_coverage_json(const PageInput& in, const Draw& draw, const Triangle& t) {
  const int x0 = in.pixel.x / 8 * 8, y0 = (in.trace.height - 1 - in.pixel.y) / 8 * 8;
  PageJson json = PageJson::array();
  for (int i = 0; i < 64; ++i) {
    int bits = 0;
    for (int s = 0; s < in.context.samples; ++s) bits |= int{covers(in.context, draw, t, x0 + i % 8, y0 + i / 8, s)} << s;
    json.push_back(bits);
  }
  return json;
}

bool is_triangle(const Draw& draw) { return !draws_points(draw.state) && !is_lines(draw.state.topology); }

// Returns the world-space positions of the vertices of a primitive, or nullopt if its draw has no mesh.
std::optional<std::array<glm::vec3, 3>> corners_ws(const PageInput& in, const StagePrimitive& p) {
  const PreparedDraw& draw = in.scene.draws[p.draw];
  const std::span<const glm::vec3> positions = draw.source.streams.positions;
  if (positions.empty()) return std::nullopt;
  const StageExample e = stage_example(in.scene, in.context, in.geometry, static_cast<uint32_t>(&p - in.geometry.primitives.data()));
  std::array<glm::vec3, 3> out;
  for (std::size_t k = 0; k < 3; ++k) out[k] = glm::vec3(e.vertices[k].position_ws.value_or(glm::dvec3(0.0)));
  return out;
}

// The largest difference between an affine and a perspective-correct weight on an edge, for the inverse w of the vertices.
double weight_difference(const std::array<float, 3>& inv_w) {
  double most = 0.0;
  for (std::size_t i = 0; i < 3; ++i) {
    const double q = std::sqrt(static_cast<double>(inv_w[i]) / static_cast<double>(inv_w[(i + 1) % 3]));
    most = std::max(most, std::fabs(1.0 - q) / (1.0 + q));
  }
  return most;
}

// A triangle whose interpolation the page shows.
struct ShownTriangle {
  std::array<int32_t, 3> x, y;
  std::array<float, 3> inv_w;

  double error() const { return affine_error(x, y, inv_w); }
  // The checkerboard of the page has ten squares per edge: a quarter of a square can be seen next to the other picture.
  bool is_clear() const { return weight_difference(inv_w) >= 0.025; }
  PageJson json(const char* kind) const {
    return {{"kind", kind},
            {"xy", {{x[0], y[0]}, {x[1], y[1]}, {x[2], y[2]}}},
            {"inv_w", inv_w},
            {"error", error()},
            {"difference", weight_difference(inv_w)}};
  }
};

// Part of a floor: its farthest vertex is four times as far away as the other two. It is not part of the frame.
constexpr ShownTriangle kConstructed{{0, 600 * kSubPixels, 300 * kSubPixels}, {0, 0, 400 * kSubPixels}, {1.0f, 1.0f, 0.25f}};

// Returns the triangle of the visible fragment after setup, or nullopt if it is not a triangle.
std::optional<ShownTriangle> example_triangle(const PageInput& in) {
  if (in.primitive == kNoPrimitive || in.visible->round > 0) return std::nullopt;
  if (!is_triangle(in.context.draws[in.geometry.primitives[in.primitive].draw])) return std::nullopt;
  const TriangleInspector triangles(in.context);
  InspectedTriangle t;
  triangles.find(in.visible->id, t);
  ShownTriangle out{t.source.triangle->x, t.source.triangle->y, {}};
  for (std::size_t k = 0; k < 3; ++k) out.inv_w[k] = t.source.vertex[k]->inv_w;
  return out;
}

bool is_on_screen(const PassContext& context, const Triangle& t) {
  for (std::size_t i = 0; i < 3; ++i) {
    if (t.x[i] < 0 || t.x[i] > context.width * kSubPixels || t.y[i] < 0 || t.y[i] > context.height * kSubPixels) return false;
  }
  return true;
}

// The triangle inside the window with the largest displacement that its height can show, which excludes slivers.
struct WorstTriangle {
  uint32_t primitive = kNoPrimitive;
  ShownTriangle triangle{};
};
WorstTriangle worst_triangle(const PageInput& in) {
  double worst = -1.0;
  WorstTriangle out;
  for (uint32_t i = 0; i < in.geometry.primitives.size(); ++i) {
    const StagePrimitive& p = in.geometry.primitives[i];
    if (p.outcome != StageOutcome::kept || !is_triangle(in.context.draws[p.draw])) continue;
    const Triangle& t = in.geometry.triangles[p.first_triangle];
    if (!is_on_screen(in.context, t)) continue;
    const std::array<uint32_t, 3> slots = slots_of(in.context, p);
    ShownTriangle here{};
    for (std::size_t k = 0; k < 3; ++k) {
      const ScreenVertex& v = in.context.shaded[p.draw].screen[slots[k]];
      here.x[k] = v.x;
      here.y[k] = v.y;
      here.inv_w[k] = v.inv_w;
    }
    const double visible = std::min(here.error(), height_above_longest_edge(here.x, here.y));
    if (!(visible > worst)) continue;
    worst = visible;
    out = {i, here};
  }
  return out;
}

// Returns the name of the plane that a new corner of a clipped polygon is on: a limit of the integer grid, or the near plane. Returns an
// empty name for other planes. A corner on several planes gets the name of the first limit.
const char* plane_of(const Viewport& v, const glm::dvec4& p) {
  const auto is_equal = [](double a, double b) { return std::fabs(a - b) <= 1e-9 * (std::fabs(a) + std::fabs(b)); };
  if (is_equal(p.x, double{v.guard_left} * p.w)) return "left";
  if (is_equal(p.x, double{v.guard_right} * p.w)) return "right";
  if (is_equal(p.y, double{v.guard_bottom} * p.w)) return "bottom";
  if (is_equal(p.y, double{v.guard_top} * p.w)) return "top";
  return is_equal(p.z, p.w) ? "near" : "";
}

bool is_cut_by_near_plane_only(const Draw& draw, const ClipPolygon& polygon) {
  const auto corners = std::span(polygon.corners).first(static_cast<std::size_t>(polygon.count));
  return std::ranges::all_of(
      corners, [&](const ClipCorner& c) { return c.vertex >= 0 || std::string_view(plane_of(draw.viewport, c.pos_clip)) == "near"; });
}

}  // namespace

PageJson json_of(const glm::dvec2& v) { return {v.x, v.y}; }
PageJson json_of(const glm::dvec3& v) { return {v.x, v.y, v.z}; }
PageJson json_of(const glm::dvec4& v) { return {v.x, v.y, v.z, v.w}; }
PageJson json_of(const glm::dmat4& m) {
  PageJson json = PageJson::array();
  for (int c = 0; c < 4; ++c) {
    for (int r = 0; r < 4; ++r) json.push_back(m[c][r]);
  }
  return json;
}

PageJson draws_json(const PageInput& in) {
  static constexpr std::array kCull{"none", "front", "back", "front and back"};
  PageJson json = PageJson::array();
  for (std::size_t i = 0; i < in.scene.draws.size(); ++i) {
    const PreparedDraw& draw = in.scene.draws[i];
    const Draw& d = in.context.draws[i];  // of what a geometry function has emitted, if there is one
    json.push_back({{"object", object_name(in.description, draw.source.object)},
                    {"copy", draw.source.instance},
                    {"kind", draws_points(d.state)        ? "points"
                             : is_lines(d.state.topology) ? "lines"
                                                          : "triangles"},
                    {"vertices", d.vertex_count},
                    {"primitives", d.primitive_count * d.state.instances},
                    {"cull", kCull[static_cast<std::size_t>(draw.state.cull)]},
                    {"layered", draw.state.order_independent},
                    {"blended", draw.state.blend.has_value()},
                    {"world_from_object", json_of(draw.source.world_from_object)}});
  }
  return json;
}

PageJson transforms_json(const PageInput& in) {
  const View& v = in.scene.view;
  const StageTransforms t = stage_transforms(v);
  return {{"view_from_world", json_of(t.view_from_world)},
          {"clip_from_view", json_of(t.clip_from_view)},
          {"perspective", v.to_eye_ws == glm::dvec3(0.0)},
          {"near", v.near},
          {"far", v.far},
          {"eye", json_of(v.eye_ws)}};
}

PageJson example_json(const PageInput& in) {
  if (in.primitive == kNoPrimitive) return nullptr;
  const StageExample e = stage_example(in.scene, in.context, in.geometry, in.primitive);
  PageJson json{{"draw", e.primitive.draw},
                {"instance", e.primitive.instance},
                {"primitive", e.primitive.index},
                {"object", object_name(in.description, in.scene.draws[e.primitive.draw].source.object)},
                {"corners", e.corners}};
  for (int k = 0; k < e.corners; ++k) json["vertices"].push_back(json_of_vertex(e.vertices[static_cast<std::size_t>(k)]));
  const Draw& draw = in.context.draws[e.primitive.draw];
  for (const Triangle& t : e.triangles) json["triangles"].push_back(json_of_triangle(in.context, draw, t));
  if (!e.triangles.empty()) {
    const std::size_t shown = shown_triangle(in, draw, e.triangles);
    json["shown"] = shown;
    json["covered"] = covered_pixels(in.context, draw, e.triangles);
    json["block"] = block_coverage_json(in, draw, e.triangles[shown]);
  }
  if (e.sprite) json["sprite"] = {e.sprite->x0, e.sprite->y0, e.sprite->x1, e.sprite->y1};
  return json;
}

PageJson outcomes_json(const PageInput& in) {
  std::array<uint64_t, kStageOutcomes> counts{};
  for (const StagePrimitive& p : in.geometry.primitives) ++counts[static_cast<std::size_t>(p.outcome)];
  return counts;
}

PageJson clip_json(const PageInput& in) {
  PageJson json = PageJson::array();
  const std::vector<StagePrimitive>& all = in.geometry.primitives;
  std::vector<uint32_t> clipped, others;  // the triangles that only the near plane cuts come first
  for (uint32_t i = 0; i < all.size() && clipped.size() < kMaxClipped; ++i) {
    const Draw& draw = in.context.draws[all[i].draw];
    if (all[i].outcome != StageOutcome::clipped || !is_triangle(draw)) continue;
    (is_cut_by_near_plane_only(draw, stage_clip(in.context, in.geometry, i).polygon) ? clipped : others).push_back(i);
  }
  clipped.insert(clipped.end(), others.begin(), others.end());
  clipped.resize(std::min(clipped.size(), kMaxClipped));
  for (const uint32_t i : clipped) {
    const StageClip c = stage_clip(in.context, in.geometry, i);
    const Draw& draw = in.context.draws[all[i].draw];
    PageJson item{{"object", object_name(in.description, in.scene.draws[all[i].draw].source.object)}, {"primitive", all[i].index}};
    for (const glm::vec4& v : c.clip) item["before"].push_back(json_of(glm::dvec4(v)));
    for (int k = 0; k < c.polygon.count; ++k) {
      const ClipCorner& corner = c.polygon.corners[static_cast<std::size_t>(k)];
      item["after"].push_back({{"clip", json_of(corner.pos_clip)}, {"weights", json_of(corner.weights)}, {"vertex", corner.vertex}});
      if (corner.vertex < 0) item["after"].back()["plane"] = plane_of(draw.viewport, corner.pos_clip);
      item["window"].push_back(json_of(c.window[static_cast<std::size_t>(k)]));
    }
    json.push_back(item);
  }
  return json;
}

PageJson wireframe_json(const PageInput& in) {
  const std::vector<StagePrimitive>& all = in.geometry.primitives;
  const uint32_t example = in.primitive == kNoPrimitive ? kNoPrimitive : all[in.primitive].draw;
  const auto own = static_cast<std::size_t>(std::ranges::count(all, example, &StagePrimitive::draw));
  const auto step_for = [](std::size_t count) { return (count + kMaxWireTriangles - 1) / kMaxWireTriangles; };
  const std::size_t step = step_for(all.size() - own), own_step = step_for(own);
  std::vector<glm::vec3> positions;
  std::vector<uint16_t> draws;
  std::vector<uint8_t> outcomes;
  for (uint32_t i = 0; i < all.size(); ++i) {
    const std::size_t every = all[i].draw == example ? own_step : step;
    if (i != in.primitive && !is_in_sample(i, every)) continue;
    const auto corners = corners_ws(in, all[i]);
    if (!corners) continue;
    positions.insert(positions.end(), corners->begin(), corners->end());
    draws.push_back(static_cast<uint16_t>(all[i].draw));
    outcomes.push_back(static_cast<uint8_t>(all[i].outcome));
  }
  return {{"step", step},
          {"own_step", own_step},
          {"count", draws.size()},
          {"positions", packed_planes(std::span<const glm::vec3>(positions))},
          {"draws", packed_planes(std::span<const uint16_t>(draws))},
          {"outcomes", packed_planes(std::span<const uint8_t>(outcomes))}};
}

PageJson bins_json(const PageInput& in) {
  const PassContext& c = in.context;
  return {{"tile", c.tile_size}, {"columns", c.tiles_x}, {"rows", c.tiles_y}, {"counts", triangles_per_tile(c)}};
}

PageJson perspective_json(const PageInput& in) {
  const auto name = [&](PageJson& json, uint32_t primitive) {
    const StagePrimitive& p = in.geometry.primitives[primitive];
    json["object"] = object_name(in.description, in.scene.draws[p.draw].source.object);
    json["primitive"] = p.index;
  };
  const std::optional<ShownTriangle> example = example_triangle(in);
  const WorstTriangle worst = worst_triangle(in);
  PageJson json;
  if (example && example->is_clear()) {
    json = example->json("example");
    name(json, in.primitive);
  } else if (worst.primitive != kNoPrimitive && worst.triangle.is_clear() && worst.triangle.error() >= 0.5) {
    json = worst.triangle.json("frame");
    name(json, worst.primitive);
  } else {
    json = kConstructed.json("constructed");
  }
  if (example) json["example_error"] = example->error();
  if (worst.primitive != kNoPrimitive) json["largest_error"] = worst.triangle.error();
  return json;
}

}  // namespace halfspace
