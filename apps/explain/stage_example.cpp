// SPDX-License-Identifier: Apache-2.0
#include "explain/stage_example.h"

#include "halfspace/core/float_mode.h"
#include "halfspace/raster/primitives/primitive_assembly.h"

namespace halfspace {

namespace {

void set_positions(const PreparedScene& scene, const PreparedDraw& draw, StageVertex& v) {
  const std::span<const glm::vec3> positions = draw.source.streams.positions;
  if (v.index >= positions.size()) return;
  const StageTransforms t = stage_transforms(scene.view);
  v.position_os = glm::dvec3(positions[v.index]);
  v.position_ws = glm::dvec3(draw.source.world_from_object * glm::dvec4(*v.position_os, 1.0));
  v.position_vs = glm::dvec3(t.view_from_world * glm::dvec4(*v.position_ws, 1.0));
}

int corners_of(const DrawState& state) { return draws_points(state) ? 1 : is_lines(state.topology) ? 2 : 3; }

}  // namespace

StageTransforms stage_transforms(const View& view) {
  const glm::dvec3 r = view.right_ws, u = view.up_ws, b = -view.forward_ws, e = view.eye_ws;
  const glm::dmat4 from_world(r.x, u.x, b.x, 0.0, r.y, u.y, b.y, 0.0, r.z, u.z, b.z, 0.0,  //
                              -glm::dot(r, e), -glm::dot(u, e), -glm::dot(b, e), 1.0);
  const glm::dmat4 to_world(glm::dvec4(r, 0.0), glm::dvec4(u, 0.0), glm::dvec4(b, 0.0), glm::dvec4(e, 1.0));
  return {from_world, view.clip_from_world * to_world};
}

StageExample stage_example(const PreparedScene& scene, const PassContext& context, const StageGeometry& geometry, uint32_t primitive) {
  StageExample out;
  out.primitive = geometry.primitives[primitive];
  const StagePrimitive& p = out.primitive;
  const PreparedDraw& draw = scene.draws[p.draw];
  const ShadedVertices& shaded = context.shaded[p.draw];
  out.corners = corners_of(context.draws[p.draw].state);
  const std::array<uint32_t, 3> slots = slots_of(context, p);
  const std::array<uint32_t, 3> index = Assembly(context.draws[p.draw], p.index).next();
  const std::array<glm::vec4, 3> clip = clip_positions(context, p);
  for (std::size_t k = 0; k < 3; ++k) {
    StageVertex& v = out.vertices[k];
    v.index = index[k] + static_cast<uint32_t>(context.draws[p.draw].state.base_vertex);
    set_positions(scene, draw, v);
    v.clip = clip[k];
    v.ndc = glm::vec3(v.clip) / v.clip.w;
    v.window = shaded.screen[slots[k]];
    v.outcode = shaded.outcodes[slots[k]];
  }
  out.triangles.assign(geometry.triangles.begin() + p.first_triangle, geometry.triangles.begin() + p.first_triangle + p.triangle_count);
  if (out.corners == 1 && shaded.has_sprites) out.sprite = shaded.sprites[slots[0]];
  return out;
}

StageClip stage_clip(const PassContext& context, const StageGeometry& geometry, uint32_t primitive) {
  const FloatMode mode;
  const StagePrimitive& p = geometry.primitives[primitive];
  const Draw& draw = context.draws[p.draw];
  StageClip out{primitive, clip_positions(context, p), {}, {}};
  out.polygon = clip_triangle(draw.viewport, draw.state.depth, out.clip);
  for (int i = 0; i < out.polygon.count; ++i) {
    const ScreenVertex s = project_corner(draw.viewport, out.polygon.corners[static_cast<std::size_t>(i)].pos_clip);
    out.window.push_back(glm::dvec2(s.x, s.y) / static_cast<double>(kSubPixels));
  }
  return out;
}

}  // namespace halfspace
