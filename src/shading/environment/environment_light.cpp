// SPDX-License-Identifier: Apache-2.0
//
// Prefiltering of environments, and the table of directional_reflectance.
#include "halfspace/shading/environment/environment_light.h"

#include <bit>
#include <numbers>

#include "halfspace/core/check.h"
#include "halfspace/core/cube_map.h"
#include "halfspace/core/float_mode.h"
#include "halfspace/core/trig_double.h"
#include "halfspace/shading/light/ggx.h"

namespace halfspace::HS_LANES {

namespace {

using Faces = std::array<Image<glm::vec4>, 6>;

constexpr int kSamples = 64;               // directions per filtered texel
constexpr int kIntegrationSamples = 1024;  // per table entry
constexpr int kTableSize = 32;

// Point i of the Hammersley set with n points in [0, 1)². n is a power of two.
glm::dvec2 hammersley(uint32_t i, uint32_t n) {
  uint32_t reversed = 0;
  for (uint32_t k = 0; k < 32; ++k) reversed |= (i >> k & 1u) << (31 - k);
  return {(i + 0.5) / n, reversed * 0x1p-32};
}

// A half vector distributed as D·(n·h), in the tangent space of the normal +z.
glm::dvec3 ggx_half_vector(const glm::dvec2& point, double alpha) {
  const double cos2 = (1.0 - point.x) / (1.0 + (alpha * alpha - 1.0) * point.x);
  const SinCosDouble turn = sincos_turns(point.y);
  const double sine = std::sqrt(std::max(0.0, 1.0 - cos2));
  return {sine * turn.cos, sine * turn.sin, std::sqrt(cos2)};
}

// ---- filtering -------------------------------------------------------------------------------------------------

Faces make_faces(int size) {
  Faces faces;
  for (Image<glm::vec4>& face : faces) face = Image<glm::vec4>(size, size);
  return faces;
}

// Calls color(direction, step) for every texel of six faces; the lanes are neighboring texels of a row. direction points to the center of
// the texel and has a component of ±1. step is the change to the next texel to the right.
template <class F>
Faces filled_faces(int size, const Workers& workers, const F& color) {
  Faces faces = make_faces(size);
  workers.for_each(6 * size, [&](int row) {
    const int face = row / size, y = row % size;
    const auto along = [&](double i) { return (2.0 * i + 1.0) / size - 1.0; };
    const glm::vec3 origin(cube_direction(face, 0.0, along(y)));
    const glm::vec3 right(cube_direction(face, 1.0, along(y)) - cube_direction(face, 0.0, along(y)));
    const glm::vec3 down(cube_direction(face, 0.0, 1.0) - cube_direction(face, 0.0, 0.0));
    const float width = 2.0f / static_cast<float>(size);
    glm::vec4* texels = faces[static_cast<std::size_t>(face)].row(y).data();
    for (int x = 0; x < size; x += kLanes) {
      const Real s = fma(to_real<Real>(iota<IntOf<Real>>() + IntOf<Real>(x)), Real(width), Real(0.5f * width - 1.0f));
      const vec3<Real> c = color(vec3<Real>(origin) + vec3<Real>(right) * s, right * width, down * width);
      for (int k = 0; k < std::min(kLanes, size - x); ++k) texels[x + k] = {lane(c.x, k), lane(c.y, k), lane(c.z, k), 1.0f};
    }
  });
  return faces;
}

// One direction of incident light relative to the normal +z, its weight, and a level of the base map whose texels cover about the solid
// angle of the sample.
struct LobeSample {
  glm::vec3 l;
  float weight, level;
};

// Returns samples of the GGX lobe for a view along the normal. M. Colbert and J. Křivánek, "GPU-based importance sampling", GPU Gems 3.
std::vector<LobeSample> lobe_samples(double roughness, int base_size) {
  const double alpha = roughness * roughness;
  std::vector<LobeSample> samples;
  double sum = 0.0;
  for (uint32_t i = 0; i < kSamples; ++i) {
    const glm::dvec3 h = ggx_half_vector(hammersley(i, kSamples), alpha);
    const glm::dvec3 l = 2.0 * h.z * h - glm::dvec3(0.0, 0.0, 1.0);
    if (l.z <= 0.0) continue;
    const double d = h.z * h.z * (alpha * alpha - 1.0) + 1.0, density = alpha * alpha / (4.0 * std::numbers::pi * d * d);
    const double solid_angle = 1.0 / (kSamples * density), texel = 4.0 * std::numbers::pi / (6.0 * base_size * base_size);
    const float level = 0.5f * log2(static_cast<float>(solid_angle / texel)) + 0.5f;
    samples.push_back({glm::vec3(l), static_cast<float>(l.z), level});
    sum += l.z;
  }
  for (LobeSample& s : samples) s.weight = static_cast<float>(static_cast<double>(s.weight) / sum);
  return samples;
}

// Any unit vector perpendicular to n. T. Duff et al., "Building an orthonormal basis, revisited", JCGT 6(1), 2017.
template <class R>
vec3<R> tangent_of(const vec3<R>& n) {
  const R sign = select(n.z < R(0), R(-1), R(1));
  const R a = R(-1) / (sign + n.z);
  return {fma(sign * n.x * n.x, a, R(1)), sign * n.x * n.y * a, -sign * n.x};
}

// The roughness for which a level is filtered.
double roughness_of(int level) { return static_cast<double>(level) / (FilteredEnvironment::kLevels - 1); }

Faces filtered_faces(const EnvironmentMap& base, int size, double roughness, const Workers& workers) {
  const std::vector<LobeSample> samples = lobe_samples(roughness, base.width());
  return filled_faces(size, workers, [&](const vec3<Real>& d, const glm::vec3&, const glm::vec3&) {
    const vec3<Real> n = normalize_or_zero(d), t = tangent_of(n), b = cross(n, t);
    vec3<Real> sum(Real(0.0f));
    for (const LobeSample& s : samples) sum += base.sample_level<Real>(t * s.l.x + b * s.l.y + n * s.l.z, Real(s.level)) * Real(s.weight);
    return sum;
  });
}

std::vector<Faces> filtered_levels(const EnvironmentMap& map, int size, const Workers& workers) {
  std::vector<Faces> levels;
  levels.push_back(filled_faces(size, workers, [&](const vec3<Real>& d, const glm::vec3& right, const glm::vec3& down) {
    return map.sample<Real>(d, vec3<Real>(right), vec3<Real>(down));
  }));
  const EnvironmentMap base(levels[0], TexelFormat::rgba32f, &workers);
  for (int i = 1; i < FilteredEnvironment::kLevels; ++i) levels.push_back(filtered_faces(base, size >> i, roughness_of(i), workers));
  return levels;
}

// The same for a map with this light from all directions: faces of one texel, whose filtered light has the same rounding errors.
std::vector<Faces> uniform_levels(const glm::vec3& light, int base_size) {
  std::vector<Faces> levels;
  for (int i = 0; i < FilteredEnvironment::kLevels; ++i) {
    glm::vec3 sum = light;
    if (i > 0) {
      sum = glm::vec3(0.0f);
      for (const LobeSample& s : lobe_samples(roughness_of(i), base_size)) sum += light * s.weight;
    }
    levels.push_back(make_faces(1));
    for (Image<glm::vec4>& face : levels.back()) face.at(0, 0) = glm::vec4(sum, 1.0f);
  }
  return levels;
}

std::vector<Faces> lobe_levels(const EnvironmentMap& map, int size, const Workers& workers) {
  if (!map.is_uniform()) return filtered_levels(map, size, workers);
  const vec3<float> light = map.sample_level<float>(vec3<float>(0, 0, 1), 0.0f);
  return uniform_levels({light.x, light.y, light.z}, size);
}

// Sums of the light of a face times the first nine spherical harmonics, and of the weights of its texels.
struct HarmonicSums {
  std::array<glm::dvec3, 9> light{};
  double weight = 0.0;
};

HarmonicSums harmonic_sums(const Faces& faces, int face) {
  HarmonicSums sums;
  const int size = faces[0].width();
  for (int y = 0; y < size; ++y) {
    for (int x = 0; x < size; ++x) {
      const glm::dvec3 d = cube_direction(face, (2.0 * x + 1.0) / size - 1.0, (2.0 * y + 1.0) / size - 1.0);
      const double squared = glm::dot(d, d), weight = 1.0 / (squared * std::sqrt(squared));
      const glm::dvec3 n = d / std::sqrt(squared), light(faces[static_cast<std::size_t>(face)].at(x, y));
      const double basis[] = {1.0, n.y, n.z, n.x, n.x * n.y, n.y * n.z, 3.0 * n.z * n.z - 1.0, n.x * n.z, n.x * n.x - n.y * n.y};
      for (std::size_t i = 0; i < 9; ++i) sums.light[i] += light * (weight * basis[i]);
      sums.weight += weight;
    }
  }
  return sums;
}

// Projects the light onto the first nine spherical harmonics and convolves it with the clamped cosine, whose factors relative to π are 1,
// 2/3 and 1/4. Returns the coefficients times the squared constants of the basis, since each constant occurs in both projection and
// evaluation.
std::array<glm::vec3, 9> harmonics_of(const Faces& faces, const Workers& workers) {
  std::array<HarmonicSums, 6> by_face;
  workers.for_each(6, [&](int face) { by_face[static_cast<std::size_t>(face)] = harmonic_sums(faces, face); });
  HarmonicSums whole;
  for (const HarmonicSums& sums : by_face) {
    for (std::size_t i = 0; i < 9; ++i) whole.light[i] += sums.light[i];
    whole.weight += sums.weight;
  }
  // Squared constants of the basis times 4π times the factor of the cosine: 1/4π, 3/4π, 15/4π, 5/16π, 15/16π.
  constexpr double kFactors[] = {1.0, 2.0, 2.0, 2.0, 3.75, 3.75, 0.3125, 3.75, 0.9375};
  std::array<glm::vec3, 9> harmonics;
  for (std::size_t i = 0; i < 9; ++i) harmonics[i] = glm::vec3(whole.light[i] * (kFactors[i] / whole.weight));
  return harmonics;
}

}  // namespace

FilteredEnvironment::FilteredEnvironment(const EnvironmentMap& map, int size, const Workers& workers)
    : FilteredEnvironment(lobe_levels(map, size, workers), workers) {}

FilteredEnvironment::FilteredEnvironment(const std::vector<std::array<Image<glm::vec4>, 6>>& levels, const Workers& workers)
    : radiance(levels, TexelFormat::rgba32f, &workers), harmonics(harmonics_of(levels[0], workers)) {}

// ---- directional reflectance -------------------------------------------------------------------------------------

namespace {

// Integrates by importance sampling of D (B. Karis, "Real shading in Unreal Engine 4"), for lanes of n·v.
DirectionalReflectance<Real> integrated_reflectance(const std::vector<glm::vec3>& half_vectors, float alpha, Real n_v) {
  const Real a2(alpha * alpha), rest = Real(1.0f) - a2;
  const Real v_x = sqrt(max(fma(-n_v, n_v, Real(1.0f)), Real(0.0f)));
  const Real view_masking = sqrt(fma(n_v * n_v, rest, a2));
  DirectionalReflectance<Real> sum{Real(0.0f), Real(0.0f)};
  for (const glm::vec3& h : half_vectors) {
    const Real v_h = fma(v_x, Real(h.x), n_v * h.z), n_l = Real(2.0f) * v_h * h.z - n_v;
    const Real masking = n_l * view_masking + n_v * sqrt(fma(n_l * n_l, rest, a2));
    const Real reflected = select(n_l > Real(0.0f) && v_h > Real(0.0f), Real(2.0f) * n_l * v_h / (h.z * masking), Real(0.0f));
    const Real fresnel = schlick_weight(v_h);
    sum.f0 += (Real(1.0f) - fresnel) * reflected;
    sum.f90 += fresnel * reflected;
  }
  const Real scale(1.0f / static_cast<float>(half_vectors.size()));
  return {sum.f0 * scale, sum.f90 * scale};
}

const Texture2D& reflectance_table() {
  const FloatMode float_mode;
  static const Texture2D table = [] {
    Image<glm::vec4> image(kTableSize, kTableSize);
    for (int y = 0; y < kTableSize; ++y) {
      const double roughness = (y + 0.5) / kTableSize, alpha = roughness * roughness;
      std::vector<glm::vec3> half_vectors;
      for (uint32_t i = 0; i < kIntegrationSamples; ++i)
        half_vectors.emplace_back(ggx_half_vector(hammersley(i, kIntegrationSamples), alpha));
      for (int x = 0; x < kTableSize; x += kLanes) {
        const Real n_v = (to_real<Real>(iota<IntOf<Real>>() + IntOf<Real>(x)) + Real(0.5f)) * Real(1.0f / kTableSize);
        const DirectionalReflectance<Real> r = integrated_reflectance(half_vectors, static_cast<float>(alpha), n_v);
        for (int k = 0; k < kLanes; ++k) image.at(x + k, y) = {lane(r.f0, k), lane(r.f90, k), 0.0f, 1.0f};
      }
    }
    return Texture2D(std::span<const Image<glm::vec4>>(&image, 1), TexelFormat::rgba32f);
  }();
  return table;
}

}  // namespace

template <class R>
DirectionalReflectance<R> directional_reflectance(R roughness, R n_v) {
  constexpr Sampler kSampler{.mag = Filter::bilinear, .min = Filter::bilinear, .wrap_s = Wrap::clamp, .wrap_t = Wrap::clamp};
  const vec4<R> value = reflectance_table().sample_level<R>(kSampler, vec2<R>(n_v, roughness), R(0.0f));
  return {value.x, value.y};
}

template DirectionalReflectance<float> directional_reflectance(float, float);
template DirectionalReflectance<double> directional_reflectance(double, double);
template DirectionalReflectance<RealN<4>> directional_reflectance(RealN<4>, RealN<4>);
template DirectionalReflectance<RealN<8>> directional_reflectance(RealN<8>, RealN<8>);
#if HALFSPACE_LANES == 16  // as in texture.cpp
template DirectionalReflectance<RealN<16>> directional_reflectance(RealN<16>, RealN<16>);
#endif
template DirectionalReflectance<FragmentReal> directional_reflectance(FragmentReal, FragmentReal);

}  // namespace halfspace::HS_LANES
