// SPDX-License-Identifier: Apache-2.0
//
// The shader for metallic-roughness materials (glTF 2.0, section 3.9 and appendix B), with per-pixel lighting by lights and an environment.
//
//   color = Σ lights · (diffuse + specular) + occlusion · environment · (diffuse + specular) + emissive
//
// with optional sheen (KHR_materials_sheen, shading/environment/sheen.h) and, on top of it, an optional clearcoat
// (KHR_materials_clearcoat). The reflection model is that of shading/light/ggx.h.
#pragma once

#include <array>

#include "halfspace/shading/contract.h"
#include "halfspace/shading/environment/environment_light.h"
#include "halfspace/shading/environment/sheen.h"
#include "halfspace/shading/light/ggx.h"
#include "halfspace/shading/shadow/terminator.h"
#include "halfspace/shading/surface/surface_uniforms.h"

namespace halfspace::HS_LANES {

/// The maps of a metallic-roughness material, in the order in which they are sampled.
enum MetallicMap : uint8_t {
  kBaseColorMap,
  kOpacityMap,
  kMetallicMap,
  kRoughnessMap,
  kSpecularMap,
  kSpecularColorMap,
  kClearcoatMap,
  kClearcoatRoughnessMap,
  kNormalMap,
  kClearcoatNormalMap,
  kOcclusionMap,
  kEmissiveMap,
  kSheenMap,
  kSheenColorMap,
  kSheenRoughnessMap
};
inline constexpr std::size_t kMetallicMaps = 15;

/// A texture, its placement, and the channel that a scalar property reads.
struct MaterialMap {
  const Texture2D* map = nullptr;  ///< null: none; not owned
  Sampler sampler{};
  int uv_set = 0;                  ///< 0 or 1
  glm::mat3x2 uv_transform{1.0f};  ///< uv' = uv_transform · (u, v, 1)
  glm::vec4 channel{1, 0, 0, 0};   ///< weights of red, green, blue and alpha
  bool repeats = false;            ///< the lookup equals that of the previous map with a texture, so its texel is used again
  friend bool operator==(const MaterialMap&, const MaterialMap&) = default;
};

/// Transforms texture coordinates, uv' = transform · (u, v, 1), and their derivatives.
template <class R>
HS_INLINE MapCoordinates<R> transformed(const glm::mat3x2& transform, const MapCoordinates<R>& at) {
  if (transform == glm::mat3x2(1.0f)) return at;
  const auto turned = [&](const vec2<R>& v) {
    return vec2<R>(R(transform[0].x) * v.x + R(transform[1].x) * v.y, R(transform[0].y) * v.x + R(transform[1].y) * v.y);
  };
  return {turned(at.uv) + vec2<R>(transform[2]), turned(at.duv_dx), turned(at.duv_dy)};
}

/// Uniforms of a metallic-roughness surface. Each factor is multiplied by its map, if there is one.
struct MetallicMaterial : SurfaceUniforms {
  glm::vec4 base_color{1.0f};  ///< linear; w is the opacity
  float metallic = 0.0f, roughness = 1.0f;
  float specular = 1.0f;
  glm::vec3 specular_color{1.0f};
  float normal_reflectance = 0.04f;  ///< of a dielectric at normal incidence: ((ior − 1) / (ior + 1))²
  float clearcoat = 0.0f, clearcoat_roughness = 0.0f;
  float sheen = 0.0f, sheen_roughness = 0.0f;
  glm::vec3 sheen_color{1.0f};
  float normal_scale = 1.0f, clearcoat_normal_scale = 1.0f;
  float occlusion_strength = 1.0f;
  glm::vec3 emissive{0.0f};
  glm::vec3 ambient{0.0f};  ///< constant light from all directions, in addition to the environment
  float alpha_cutoff = 0.5f;
  bool unlit = false;                                  ///< the result is the base color plus the emitted light
  bool blends = false;                                 ///< the result has the opacity as alpha; otherwise alpha is 1
  const EnvironmentLightBlend* environment = nullptr;  ///< null: none; not owned
  std::array<MaterialMap, kMetallicMaps> maps;
};

/// The streams that a mesh has. They select a variant of the shader.
enum class MetallicStreams : uint8_t {
  basic,     ///< no maps
  colored,   ///< no maps, but vertex colors
  mapped,    ///< maps with one set of texture coordinates; no normal maps
  detailed,  ///< the same, with tangents for normal maps
  full       ///< two sets of texture coordinates, tangents and vertex colors
};

/// masked: pixels whose opacity is below alpha_cutoff are discarded.
template <MetallicStreams streams, bool masked = false>
struct MetallicSurface : MetallicMaterial {
  static constexpr bool kFull = streams == MetallicStreams::full;
  static constexpr bool kMapped = streams >= MetallicStreams::mapped;
  static constexpr bool kTangents = streams >= MetallicStreams::detailed;
  static constexpr bool kColors = streams == MetallicStreams::colored || kFull;

  template <class R>
  struct Attributes {
    vec3<R> position_os;
    vec3<R> normal_os;
    [[no_unique_address]] MemberIf<kTangents, vec4<R>, 0> tangent_os;  ///< w is the sign of the bitangent
    [[no_unique_address]] MemberIf<kMapped, vec2<R>, 1> uv;
    [[no_unique_address]] MemberIf<kFull, vec2<R>, 2> second_uv;
    [[no_unique_address]] MemberIf<kColors, vec4<R>, 3> color;
  };

  template <class R>
  struct Varyings {
    vec3<R> position_rws;
    vec3<R> normal_ws;
    [[no_unique_address]] MemberIf<kTangents, vec3<R>, 0> tangent_ws;
    [[no_unique_address]] MemberIf<kTangents, Flat<R>, 1> side;
    [[no_unique_address]] MemberIf<kMapped, vec2<R>, 2> uv;
    [[no_unique_address]] MemberIf<kFull, vec2<R>, 3> second_uv;
    [[no_unique_address]] MemberIf<kColors, vec4<R>, 4> color;
  };

  template <class R>
  using Result = std::conditional_t<masked, DiscardingFragment<R>, Fragment<R>>;

  template <class R>
  vec4<R> vertex(const Attributes<R>& in, Varyings<R>& out) const {
    out.position_rws = position_rws(in.position_os);
    out.normal_ws = normalize_or_zero(normal_from_object * in.normal_os);
    if constexpr (kTangents) {
      out.tangent_ws = normalize_or_zero(glm::mat3(world_from_object) * vec3<R>(in.tangent_os));
      out.side = {in.tangent_os.w * R(handedness)};
    }
    if constexpr (kMapped) out.uv = in.uv;
    if constexpr (kFull) out.second_uv = in.second_uv;
    if constexpr (kColors) out.color = in.color;
    return clip_from_object * vec4<R>(in.position_os, R(1));
  }

  template <class R>
  Result<R> fragment(const Varyings<R>& in, const Pixel<R>& px) const {
    const Texels<R> texels = texels_at(in, px);
    vec4<R> base(base_color);
    if constexpr (kColors) base = base * in.color;
    base = base * vec4<R>(texels.base_color, texels.opacity);
    const vec3<R> color = unlit ? vec3<R>(base) + emissive * texels.emissive : shaded(in, px, texels, vec3<R>(base));
    const vec4<R> result(color, blends ? clamp(base.w, R(0), R(1)) : R(1));
    if constexpr (masked) {
      return {result, base.w >= R(alpha_cutoff)};
    } else {
      return {result};
    }
  }

 private:
  /// The values of all maps at a pixel; 1 where there is no map.
  template <class R>
  struct Texels {
    vec3<R> base_color{R(1)};
    R opacity{1};
    std::array<R, kMetallicMaps> number;  ///< of scalar properties
    vec3<R> specular_color{R(1)}, emissive{R(1)}, sheen_color{R(1)};
    vec3<R> normal{R(0), R(0), R(1)}, clearcoat_normal{R(0), R(0), R(1)};  ///< tangent space
  };

  template <class R>
  HS_INLINE MapCoordinates<R> map_coordinates(const MaterialMap& m, const Varyings<R>& in, const Pixel<R>& px) const {
    using V = Varyings<R>;
    MapCoordinates<R> at;
    if constexpr (kFull) {
      if (m.uv_set == 1) {
        at = {in.second_uv, px.ddx(&V::second_uv), px.ddy(&V::second_uv)};
      } else {
        at = {in.uv, px.ddx(&V::uv), px.ddy(&V::uv)};
      }
    } else {
      at = {in.uv, px.ddx(&V::uv), px.ddy(&V::uv)};
    }
    return transformed(m.uv_transform, at);
  }

  template <class R>
  HS_INLINE Texels<R> texels_at(const Varyings<R>& in, const Pixel<R>& px) const {
    Texels<R> out;
    out.number.fill(R(1));
    if constexpr (kMapped) {
      vec4<R> texel(R(1));
      for (std::size_t i = 0; i < kMetallicMaps; ++i) {  // a loop, so that the lookup is inlined only once
        const MaterialMap& m = maps[i];
        if (m.map == nullptr) continue;
        if (!m.repeats) {
          const MapCoordinates<R> at = map_coordinates(m, in, px);
          texel = m.map->sample(m.sampler, at.uv, at.duv_dx, at.duv_dy);
        }
        switch (i) {
          case kBaseColorMap:
            out.base_color = vec3<R>(texel);
            out.opacity = texel.w;
            break;
          case kOpacityMap: out.opacity *= dot(texel, vec4<R>(m.channel)); break;
          case kSpecularColorMap: out.specular_color = vec3<R>(texel); break;
          case kEmissiveMap: out.emissive = vec3<R>(texel); break;
          case kSheenColorMap: out.sheen_color = vec3<R>(texel); break;
          case kNormalMap: out.normal = tilted(texel, normal_scale); break;
          case kClearcoatNormalMap: out.clearcoat_normal = tilted(texel, clearcoat_normal_scale); break;
          default: out.number[i] = dot(texel, vec4<R>(m.channel));
        }
      }
    }
    return out;
  }

  template <class R>
  static HS_INLINE vec3<R> tilted(const vec4<R>& texel, float scale) {
    const R tilt(2.0f * scale);
    return {(texel.x - R(0.5f)) * tilt, (texel.y - R(0.5f)) * tilt, max(fma(R(2), texel.z, R(-1)), R(0))};
  }

  /// Returns the unit normal on the visible side. `detail` is in tangent space, with green up. As in MikkTSpace, the interpolated vectors
  /// are not normalized.
  template <class R>
  HS_INLINE vec3<R> normal_at(const Varyings<R>& in, const Pixel<R>& px, const vec3<R>& detail) const {
    vec3<R> n = in.normal_ws;
    if constexpr (kTangents) {
      const vec3<R> turned = in.tangent_ws * detail.x + cross(n, in.tangent_ws) * (in.side.value * detail.y) + n * detail.z;
      n = select(dot(turned, turned) > R(0), turned, n);
    }
    n = normalize_or_zero(n);
    return two_sided ? n * select(px.front_facing, R(1), R(-1)) : n;
  }

  /// Sets the normal of the triangle and the smooth surface above it.
  template <class R>
  HS_INLINE void set_triangle(const Varyings<R>& in, const Pixel<R>& px, SurfacePoint<R>& p) const {
    using V = Varyings<R>;
    const vec3<R> p_x = px.ddx(&V::position_rws), p_y = px.ddy(&V::position_rws);
    const R side = two_sided ? select(px.front_facing, R(1), R(-1)) : R(1);
    p.face_ws = face_towards(cross(p_x, p_y), p.v_ws);
    if constexpr (kTangents) p.smooth_ws = normalize_or_zero(in.normal_ws) * side;
    p.smooth_height = smooth_height(in.normal_ws, px.ddx(&V::normal_ws) * side, px.ddy(&V::normal_ws) * side, p_x, p_y);
  }

  /// A reflecting layer at a pixel.
  template <class R>
  struct Layer {
    vec3<R> n_ws;
    R n_v, roughness;
    vec3<R> f0, f90;  ///< reflectance at normal and at grazing incidence
  };

  template <class R>
  static HS_INLINE vec3<R> reflectance(const vec3<R>& color) {
    return {min(color.x, R(1)), min(color.y, R(1)), min(color.z, R(1))};
  }
  template <class R>
  static HS_INLINE Layer<R> layer_of(const vec3<R>& n_ws, const vec3<R>& v_ws, R roughness, const vec3<R>& f0, const vec3<R>& f90) {
    return {n_ws, max(dot(n_ws, v_ws), R(1e-4f)), clamp(roughness, R(kMinRoughness), R(1)), f0, f90};
  }

  template <class R>
  static HS_INLINE R largest(const vec3<R>& v) {
    return max(v.x, max(v.y, v.z));
  }

  template <class R>
  HS_INLINE vec3<R> shaded(const Varyings<R>& in, const Pixel<R>& px, const Texels<R>& texels, const vec3<R>& base) const {
    const vec3<R> v_ws = to_eye(in.position_rws), n_ws = normal_at(in, px, texels.normal);
    const R metal = clamp(R(metallic) * texels.number[kMetallicMap], R(0), R(1));
    const R strength = R(specular) * texels.number[kSpecularMap];
    vec3<R> f0 = specular_color * texels.specular_color * R(normal_reflectance);
    f0 = reflectance(f0) * strength;
    const vec3<R> f90 = mix(vec3<R>(strength), vec3<R>(R(1)), metal);
    const Layer<R> layer = layer_of(n_ws, v_ws, R(roughness) * texels.number[kRoughnessMap], mix(f0, reflectance(base), metal), f90);
    const vec3<R> diffuse = base * (R(1) - metal);

    // The coat reflects part of all light and transmits the rest.
    const bool has_coat = clearcoat > 0.0f;
    Layer<R> coat = layer;
    R coverage(0), through(1);
    if (has_coat) {
      coat = layer_of(normal_at(in, px, texels.clearcoat_normal), v_ws, R(clearcoat_roughness) * texels.number[kClearcoatRoughnessMap],
                      vec3<R>(R(0.04f)), vec3<R>(R(1)));
      coverage = R(clearcoat) * texels.number[kClearcoatMap];
      through = R(1) - coverage * fma(R(0.96f), schlick_weight(coat.n_v), R(0.04f));
    }

    SurfacePoint<R> p{in.position_rws, n_ws, v_ws, n_ws, px.x, px.y};
    if (shadowed) set_triangle(in, px, p);
    vec3<R> sum = emissive * texels.emissive;
    vec3<R> coat_sum(R(0));
    const LightRange reaching = lights.at_pixel(px.x, px.y);
    for (const Light& light : reaching) {
      const IncidentLight<R> arriving = light_at(light, p.position_rws);
      if (none(arriving.strength > R(0))) continue;
      const R n_l = dot(n_ws, arriving.l_ws), coat_n_l = has_coat ? dot(coat.n_ws, arriving.l_ws) : R(0);
      R received = arriving.strength;
      if (light.shadow != nullptr && any(n_l > R(0) || coat_n_l > R(0)))
        received *= shadow_factor(*light.shadow, shadow_receiver(p, arriving.l_ws));
      const R share = select(n_l > R(0), received, R(0));
      const vec3<R> h = normalize_or_zero(arriving.l_ws + v_ws);
      const R fresnel = schlick_weight(dot(v_ws, h));
      const vec3<R> f = layer.f0 + (layer.f90 - layer.f0) * fresnel;
      const R lobe = ggx_reflection(layer.roughness * layer.roughness, n_ws, h, max(n_l, R(1e-6f)), layer.n_v);
      sum += light.diffuse * share * (diffuse * (max(n_l, R(0)) * (R(1) - largest(f)))) + light.specular * share * (f * lobe);
      if (has_coat) {
        const R coat_lobe = ggx_reflection(coat.roughness * coat.roughness, coat.n_ws, h, max(coat_n_l, R(1e-6f)), coat.n_v);
        coat_sum += light.specular * select(coat_n_l > R(0), received * coat_lobe * fma(R(0.96f), fresnel, R(0.04f)), R(0));
      }
    }

    // Ambient and environment light. `single` is the fraction that microfacets reflect once, `multiple` the fraction reflected after
    // further bounces.
    const R occlusion = fma(R(occlusion_strength), texels.number[kOcclusionMap] - R(1), R(1));
    const DirectionalReflectance<R> table = directional_reflectance(layer.roughness, layer.n_v);
    const vec3<R> single = layer.f0 * table.f0 + layer.f90 * table.f90;
    const R lost = R(1) - (table.f0 + table.f90);
    const vec3<R> mean = layer.f0 + (layer.f90 - layer.f0) * R(1.0f / 21.0f);
    const vec3<R> multiple = single * mean * lost / (vec3<R>(R(1)) - mean * lost);
    const vec3<R> transmitted = diffuse * (R(1) - min(largest(single + multiple), R(1)));
    vec3<R> around = ambient * (transmitted + single + multiple);
    const R coat_fresnel = has_coat ? fma(R(0.96f), schlick_weight(coat.n_v), R(0.04f)) : R(0);
    coat_sum += ambient * (occlusion * coat_fresnel);
    if (environment != nullptr) {
      const AmbientLight<R> light = environment->at<R>(n_ws, v_ws, layer.roughness);
      around += light.diffuse * (transmitted + multiple) + light.specular * single;
      if (has_coat) {
        const vec3<R> mirrored = environment->at<R>(coat.n_ws, v_ws, coat.roughness).specular;
        coat_sum += mirrored * (occlusion * coat_fresnel);
      }
    }
    sum += around * occlusion;
    if (sheen > 0.0f) {  // between the coat and the surface
      const SheenLayer<R> sheen_layer{sheen_color * texels.sheen_color * (R(sheen) * texels.number[kSheenMap]),
                                      R(sheen_roughness) * texels.number[kSheenRoughnessMap]};
      const vec3<R> around_n = environment != nullptr ? vec3<R>(ambient) + environment->diffuse_at<R>(n_ws) : vec3<R>(ambient);
      sum = with_sheen(sum, sheen_layer, p, reaching, around_n * occlusion);
    }
    return has_coat ? sum * through + coat_sum * coverage : sum;
  }
};

}  // namespace halfspace::HS_LANES
