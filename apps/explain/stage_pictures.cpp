// SPDX-License-Identifier: Apache-2.0
#include "explain/stage_pictures.h"

#include <algorithm>
#include <cmath>

#include "halfspace/raster/pipeline/sample_pattern.h"
#include "halfspace/render/frame/add_draw.h"
#include "halfspace/render/frame/frame.h"
#include "halfspace/shading/texture/footprint.h"

namespace halfspace {

namespace {

// Computes the level of detail with the formulas of the texture lookup.
struct MipLevels {
  glm::mat4 clip_from_object;
  MaterialMap map;

  template <class R>
  struct Attributes {
    vec3<R> position_os;
    vec2<R> uv, second_uv;
  };
  template <class R>
  struct Varyings {
    vec2<R> uv, second_uv;
  };

  template <class R>
  vec4<R> vertex(const Attributes<R>& in, Varyings<R>& out) const {
    out.uv = in.uv;
    out.second_uv = in.second_uv;
    return clip_from_object * vec4<R>(in.position_os, R(1));
  }

  template <class R>
  Fragment<R> fragment(const Varyings<R>& in, const Pixel<R>& px) const {
    using V = Varyings<R>;
    if (map.map == nullptr) return {vec4<R>(R(0))};
    const MapCoordinates<R> first{in.uv, px.ddx(&V::uv), px.ddy(&V::uv)};
    const MapCoordinates<R> second{in.second_uv, px.ddx(&V::second_uv), px.ddy(&V::second_uv)};
    const MapCoordinates<R> at = transformed(map.uv_transform, map.uv_set == 1 ? second : first);
    const int width = map.map->width(), height = map.map->height();
    const vec2<R> size(static_cast<float>(width), static_cast<float>(height));
    const vec2<R> dx = at.duv_dx * size, dy = at.duv_dy * size;
    if (map.sampler.anisotropy <= 1) {
      const R lod = level_of_detail(width, height, at.duv_dx, at.duv_dy);
      return {vec4<R>(clamp(lod, R(-99), R(99)), R(-1), sqrt(dot(dx, dx)), sqrt(dot(dy, dy)))};
    }
    // The axes of the footprint, with the formulas of footprint().
    const Footprint<R> f = footprint(width, height, at.duv_dx, at.duv_dy, map.sampler.anisotropy);
    const R a = fma(dx.x, dx.x, dy.x * dy.x), b = fma(dx.x, dx.y, dy.x * dy.y), c = fma(dx.y, dx.y, dy.y * dy.y), d = R(0.5f) * (a - c);
    const R major2 = fma(R(0.5f), a + c, sqrt(fma(d, d, b * b))), det = difference_of_products(dx.x, dy.y, dy.x, dx.y);
    return {vec4<R>(clamp(f.lod, R(-99), R(99)), to_real<R>(f.probes), sqrt(major2), sqrt(max(det * det / major2, R(1))))};
  }
};

struct ColorMapOf {
  template <class S>
  requires std::derived_from<S, LitSurface> MipLevels operator()(const S& s) const {
    MaterialMap map;
    map.map = s.factors[kColor].map;
    map.sampler = s.factors[kColor].sampler;
    return {s.clip_from_object, map};
  }
  template <class S>
  requires std::derived_from<S, MetallicMaterial> MipLevels operator()(const S& s) const {
    return {s.clip_from_object, s.maps[kBaseColorMap]};
  }
  template <class S>
  MipLevels operator()(const S&) const {
    return {glm::mat4(0.0f), {}};
  }
};

}  // namespace

Image<float> depth_buffer(const PreparedScene& scene, const Workers& workers) {
  Image<float> depth(scene.view.width_px, scene.view.height_px);
  Pass pass(depth.width(), depth.height(), ColorTarget{.format = ColorFormat::rgba32f, .store = StoreOp::dont_care},
            d32f_target(depth, 0.0f), {.samples = scene.samples});
  for (const PreparedDraw& draw : scene.draws) add_draw(pass, draw, draw.state);
  pass.run(workers);
  return depth;
}

DepthBlocks depth_blocks(const PreparedScene& scene, const FrameTrace& trace) {
  DepthBlocks out{(trace.width + 7) / 8, (trace.height + 7) / 8, {}, {}};
  const auto count = static_cast<std::size_t>(out.columns) * static_cast<std::size_t>(out.rows);
  out.low.assign(count, 1.0f);
  out.high.assign(count, 0.0f);
  std::array<float, kMaxSamples> stored;
  for (int y = 0; y < trace.height; ++y) {
    for (int x = 0; x < trace.width; ++x) {
      stored.fill(0.0f);
      for (const TracedFragment& f : trace.at({x, y})) {
        const bool passed = f.outcome >= FragmentOutcome::hidden_before_shading && f.outcome <= FragmentOutcome::blended;
        if (passed && scene.draws[f.draw].state.depth.write) stored[f.sample] = std::max(stored[f.sample], f.depth);
      }
      const auto block = static_cast<std::size_t>((trace.height - 1 - y) / 8 * out.columns + x / 8);
      for (int s = 0; s < trace.samples; ++s) {
        out.low[block] = std::min(out.low[block], stored[static_cast<std::size_t>(s)]);
        out.high[block] = std::max(out.high[block], stored[static_cast<std::size_t>(s)]);
      }
    }
  }
  return out;
}

ValuePictures value_pictures(const PreparedScene& scene, const Workers& workers) {
  const int w = scene.view.width_px, h = scene.view.height_px;
  ValuePictures v{Image<glm::vec3>(w, h), Image<glm::vec3>(w, h), Image<glm::vec3>(w, h), Image<glm::vec2>(w, h),
                  Image<uint32_t>(w, h),  Image<uint32_t>(w, h),  Image<uint32_t>(w, h),  Image<glm::vec3>(w, h)};
  render_frame(scene,
               {.normal = &v.normal,
                .albedo = &v.albedo,
                .position = &v.position,
                .uv = &v.uv,
                .object = &v.object,
                .instance = &v.instance,
                .triangle = &v.triangle,
                .barycentrics = &v.barycentrics},
               workers);
  return v;
}

Image<MipLookup> mip_levels(const PreparedScene& scene, const Workers& workers) {
  Image<glm::vec4> values(scene.view.width_px, scene.view.height_px);
  Pass pass(values.width(), values.height(), rgba32f_target(values), {.format = DepthFormat::d32f, .clear_value = 0.0f});
  for (const PreparedDraw& draw : scene.draws) {
    const MeshStreams& s = draw.source.streams;
    if (draw.source.object < 0 || draw.state.order_independent || s.positions.empty()) continue;
    const MipLevels shader = std::visit(ColorMapOf{}, draw.shader);
    if (shader.clip_from_object == glm::mat4(0.0f)) continue;
    pass.draw(shader, make_vertex_view(s.position_stream(), s.uv_stream(), s.second_uv_stream()), *draw.indices, draw.state);
  }
  pass.run(workers);
  Image<MipLookup> out(values.width(), values.height());
  for (int y = 0; y < values.height(); ++y) {
    for (int x = 0; x < values.width(); ++x) {
      const glm::vec4& v = values.at(x, y);
      out.at(x, y) = {v.x, std::fabs(v.y), v.y > 0.0f, {v.z, v.w}};  // the sign of the probes tells the kinds of lookup apart
    }
  }
  return out;
}

}  // namespace halfspace
