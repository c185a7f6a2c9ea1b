// SPDX-License-Identifier: Apache-2.0
#include "halfspace/render/shadow/shadow_renderer.h"

#include <algorithm>
#include <cmath>
#include <deque>

#include "halfspace/core/resource_limits.h"
#include "halfspace/core/trig_double.h"
#include "halfspace/core/units.h"
#include "halfspace/render/shadow/moment_map.h"
#include "halfspace/render/shadow/sphere_camera.h"
#include "halfspace/scene/lights.h"
#include "halfspace/shading/shadow/shadow_bias.h"
#include "halfspace/shading/shadow/shadow_blocks.h"
#include "halfspace/shading/sphere/sphere_depth.h"
#include "halfspace/shading/surface/depth_only.h"

namespace halfspace::HS_LANES {

namespace {

// The filters that use block depths.
bool is_wide_box(ShadowFilter f) { return f == ShadowFilter::pcf5 || f == ShadowFilter::pcf7; }

bool is_moment_filter(ShadowFilter f) { return f == ShadowFilter::vsm || f == ShadowFilter::moments; }

uint64_t map_bytes(std::size_t views, int size, ShadowFilter filter) {
  const std::size_t texel = sizeof(float) + (is_moment_filter(filter) ? sizeof(glm::vec4) : 0);
  const auto squared = [](int side) { return static_cast<uint64_t>(side) * static_cast<uint64_t>(side); };
  const uint64_t blocks = is_wide_box(filter) ? squared(shadow_blocks_per_side(size)) * sizeof(float) : 0;
  return uint64_t{views} * (squared(size) * texel + blocks);
}

ShadowSettings settings_of(const ShadowDescription& d, const LightDescription& light) {
  ShadowSettings s;
  static_assert(static_cast<int>(ShadowMethod::hard) == static_cast<int>(ShadowFilter::hard) + 1 &&
                static_cast<int>(ShadowMethod::moments) == static_cast<int>(ShadowFilter::moments) + 1);
  s.filter = static_cast<ShadowFilter>(static_cast<int>(d.method) - 1);
  s.bias = d.bias;
  s.constant = static_cast<float>(d.constant);
  s.slope = static_cast<float>(d.slope);
  s.max_slope = static_cast<float>(d.max_slope);
  s.radius = static_cast<float>(d.radius);
  if (kind_of(light.type).is_distant) {
    const SinCosDouble half = sincos_radians(light.size * kRadiansPerDegree);
    s.light_radius = static_cast<float>(half.sin / half.cos);
  } else {
    s.light_radius = static_cast<float>(light.size);
  }
  return s;
}

ShadowView to_shading(const LightView& v, int size, const glm::dvec3& eye_ws) {
  glm::dmat4 world_from_rws(1.0);
  world_from_rws[3] = glm::dvec4(eye_ws, 1.0);
  const glm::dmat4 clip_from_rws = v.clip_from_world * world_from_rws;
  ShadowView s;
  s.clip_from_rws = glm::mat4(clip_from_rws);
  s.clip_plane_from_rws = glm::mat4(glm::transpose(glm::inverse(clip_from_rws)));
  s.texel_per_w = static_cast<float>(v.texel_per_w);
  s.depth_per_unit = static_cast<float>(v.depth_per_unit);
  s.perspective = v.perspective;
  s.near = static_cast<float>(v.near);
  s.far = static_cast<float>(v.far);
  s.size = size;
  return s;
}

// Draws the depth of meshes and spheres as seen from a light or from the eye. Spheres always draw their front, regardless of
// `faces`.
PassStatistics draw_depth(const glm::dmat4& clip_from_world, double near, double far, const ShadowScene& scene, bool casters_only,
                          ShadowFaces faces, Image<float>& depth, const Workers& workers) {
  DepthTarget target = d32f_target(depth);
  target.clear_value = 0.0f;
  Pass pass(depth.width(), depth.height(), {}, target);
  std::deque<std::vector<glm::vec3>> centers_cs;  // must outlive the pass, which refers to them
  const SphereCamera camera(clip_from_world, near, far);
  const auto is_drawn = [&](const ShadowExtent& e) { return (e.casts_shadow || !casters_only) && !is_outside(clip_from_world, e.box_ws); };
  for (const ShadowExtent& e : scene.objects) {
    if (e.spheres == nullptr || !is_drawn(e)) continue;
    const PlacedSpheres& spheres = *e.spheres;
    const auto& centers = centers_cs.emplace_back(camera.centers_cs(*spheres.particles));
    pass.draw(SphereDepth{camera.lens({depth.width(), depth.height()})},
              make_vertex_view(stream(centers), stream(spheres.particles->radii)), sprite_state());
  }
  for (const ShadowExtent& e : scene.objects) {
    if (e.mesh == nullptr || !is_drawn(e)) continue;
    const PlacedMesh& m = *e.mesh;
    const CullMode cull = m.two_sided || faces == ShadowFaces::both ? CullMode::none
                          : faces == ShadowFaces::front             ? CullMode::back
                                                                    : CullMode::front;
    const glm::mat4 clip_from_object(clip_from_world * m.world_from_object);
    DrawState state = opaque_state(cull, m.mirrored());
    if (m.clusters != nullptr) state.clusters = ClusterCulling{m.clusters, clip_from_object};
    const StreamOf<glm::vec2> uvs = uv_stream(m.uvs, m.positions.size());
    if (m.opacity && !m.colors.empty()) {
      pass.draw_depth(MaskedDepth<true>{clip_from_object, *m.opacity}, make_vertex_view(stream(m.positions), uvs, stream(m.colors)),
                      *m.indices, state);
    } else if (m.opacity) {
      pass.draw_depth(MaskedDepth<false>{clip_from_object, *m.opacity}, make_vertex_view(stream(m.positions), uvs), *m.indices, state);
    } else {
      pass.draw_depth(DepthOnly{clip_from_object}, make_vertex_view(stream(m.positions)), *m.indices, state);
    }
  }
  return pass.run(workers);
}

// A visible point from a low-resolution depth map of the view, and the width of a pixel at that point.
struct VisiblePoint {
  glm::dvec3 position_rws;
  double pixel;
};
std::vector<VisiblePoint> visible_points(const View& view, const ShadowScene& scene, const Workers& workers) {
  constexpr int kWidth = 96, kHeight = 54;
  Image<float> depth(kWidth, kHeight);
  draw_depth(view.clip_from_world, view.near, view.far, scene, false, ShadowFaces::front, depth, workers);
  const glm::dmat4 world_from_clip = glm::inverse(view.clip_from_world);
  std::vector<VisiblePoint> places;
  for (int row = 0; row < kHeight; ++row) {
    for (int x = 0; x < kWidth; ++x) {
      if (depth.at(x, row) == 0.0f) continue;
      const glm::dvec4 p = world_from_clip * glm::dvec4((x + 0.5) / kWidth * 2.0 - 1.0, 1.0 - (row + 0.5) / kHeight * 2.0,
                                                        static_cast<double>(depth.at(x, row)), 1.0);
      const glm::dvec3 position_rws = glm::dvec3(p) / p.w - view.eye_ws;
      places.push_back({position_rws, pixel_width(view, position_rws)});
    }
  }
  return places;
}

// Returns the 95th percentile of the shadow map texel size, in pixels, over the visible points that are inside a shadow view. Returns 0 if
// there are no such points.
double footprint_of(const std::vector<ShadowView>& views, const std::vector<VisiblePoint>& places, float margin) {
  std::vector<double> footprints;
  for (const VisiblePoint& place : places) {
    for (const ShadowView& view : views) {
      const ShadowCoordinates<float> p = shadow_coordinates(view, vec3<float>(place.position_rws));
      if (!holds(view, p, margin)) continue;
      footprints.push_back(static_cast<double>(view.texel_per_w * p.w) / place.pixel);
      break;
    }
  }
  if (footprints.empty()) return 0.0;
  const auto nth = footprints.begin() + static_cast<std::ptrdiff_t>((footprints.size() - 1) * 95 / 100);
  std::ranges::nth_element(footprints, nth);
  return *nth;
}

}  // namespace

std::vector<LightView> ShadowRenderer::views(const LightDescription& light, const ShadowSettings& settings, int size) const {
  // Half a texel is added to the reach of the filter, so that rounding cannot push a point on the edge between two faces out of
  // both.
  return fitted_views(scene_, light, shadow_, size, static_cast<double>(filter_reach(settings)) + 0.5);
}

int ShadowRenderer::resolution(const LightDescription& light, const ShadowSettings& settings) const {
  if (shadow_.resolution != 0) return shadow_.resolution;
  const std::vector<VisiblePoint> places = visible_points(view_, scene_, workers_);
  int size = 256;
  for (; size < kMaxShadowTexels; size *= 2) {
    std::vector<ShadowView> seen;
    for (const LightView& view : views(light, settings, size)) seen.push_back(to_shading(view, size, view_.eye_ws));
    if (footprint_of(seen, places, filter_reach(settings)) <= shadow_.footprint) break;
  }
  return size;
}

ShadowMaps ShadowRenderer::rendered_maps(const std::string& name, const ShadowMapSource& source, PassStatistics& statistics) const {
  const MemoryClaim claim(map_bytes(source.views.size(), source.size, source.filter), "lights." + name + " (shadow maps)");
  ShadowMaps maps;
  for (const LightView& view : source.views) {
    Image<float>& depth = maps.depths.emplace_back(source.size, source.size);
    statistics += draw_depth(view.clip_from_world, view.near, view.far, scene_, true, source.faces, depth, workers_);
    if (is_wide_box(source.filter)) maps.block_depths.push_back(shadow_block_depths(depth, workers_));
    if (!is_moment_filter(source.filter)) continue;
    maps.moments.push_back(filtered_moments(to_shading(view, source.size, view_.eye_ws), depth, source.mean_radius, workers_));
  }
  return maps;
}

RenderedShadow ShadowRenderer::render(const std::string& name, const LightDescription& light) {
  const ShadowSettings settings = settings_of(shadow_, light);
  ShadowMapSource source;
  source.size = resolution(light, settings);
  source.views = views(light, settings, source.size);
  source.mean_radius = is_moment_filter(settings.filter) ? static_cast<int>(std::lround(shadow_.radius)) : 0;
  source.faces = shadow_.faces;
  source.filter = settings.filter;
  source.casters = casters_;
  RenderedShadow out;
  const std::string key = recipe("shadow maps", name);
  std::shared_ptr<const ShadowMaps> maps;
  if (const auto last = used_.take_last<KeptShadowMaps>(key); last != nullptr && have_same_maps(last->source, source)) maps = last->maps;
  if (maps == nullptr) maps = std::make_shared<const ShadowMaps>(rendered_maps(name, source, out.statistics));
  used_.add(key, std::make_shared<const KeptShadowMaps>(KeptShadowMaps{maps, source}));
  auto shading_views = std::make_shared<std::vector<ShadowView>>();
  for (std::size_t i = 0; i < maps->depths.size(); ++i) {
    ShadowView& s = shading_views->emplace_back(to_shading(source.views[i], source.size, view_.eye_ws));
    s.depth = maps->depths[i].data();
    if (!maps->block_depths.empty()) s.block_depths = maps->block_depths[i].data();
    if (!maps->moments.empty()) s.moments = maps->moments[i].data();
  }
  out.shadow = {*shading_views, settings};
  out.views = std::move(shading_views);
  return out;
}

}  // namespace halfspace::HS_LANES
