// SPDX-License-Identifier: Apache-2.0
//
// Checks that fragments do no unnecessary work. Scenes are drawn by the naive pipeline with a number type that counts texture lookups and
// lights. A table lists the expected costs.
#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "halfspace/core/parallel.h"
#include "halfspace/render/prepared_scene.h"
#include "halfspace/scene/scene_file.h"

namespace halfspace {

// A wrapper around double. Shaders instantiated with this type count their texture lookups and lights.
struct Counted {
  double value;

  Counted() = default;
  Counted(double v) : value(v) {}
  Counted(float v) : value(static_cast<double>(v)) {}
  Counted(int v) : value(v) {}
  explicit Counted(int64_t v) : value(static_cast<double>(v)) {}
  explicit operator double() const { return value; }

  friend Counted operator+(Counted a, Counted b) { return a.value + b.value; }
  friend Counted operator-(Counted a, Counted b) { return a.value - b.value; }
  friend Counted operator*(Counted a, Counted b) { return a.value * b.value; }
  friend Counted operator/(Counted a, Counted b) { return a.value / b.value; }
  friend Counted operator-(Counted a) { return -a.value; }
  Counted& operator+=(Counted b) { return *this = *this + b; }
  Counted& operator-=(Counted b) { return *this = *this - b; }
  Counted& operator*=(Counted b) { return *this = *this * b; }
  Counted& operator/=(Counted b) { return *this = *this / b; }
  friend bool operator<(Counted a, Counted b) { return a.value < b.value; }
  friend bool operator>(Counted a, Counted b) { return a.value > b.value; }
  friend bool operator<=(Counted a, Counted b) { return a.value <= b.value; }
  friend bool operator>=(Counted a, Counted b) { return a.value >= b.value; }
  friend bool operator==(Counted a, Counted b) { return a.value == b.value; }
  friend bool operator!=(Counted a, Counted b) { return a.value != b.value; }
};

template <>
inline constexpr bool kIsLanes<Counted> = true;  // R can be this type
template <>
struct LaneTraits<Counted> : LaneTraits<float> {};

inline Counted lane(Counted a, int) { return a; }
inline Counted abs(Counted a) { return std::abs(a.value); }
inline int32_t truncate_to_int(Counted a) { return static_cast<int32_t>(a.value); }
inline Counted select(bool m, Counted a, Counted b) { return m ? a : b; }
inline Counted sqrt(Counted a) { return std::sqrt(a.value); }
inline Counted floor(Counted a) { return std::floor(a.value); }
inline Counted fma(Counted a, Counted b, Counted c) { return std::fma(a.value, b.value, c.value); }
inline Counted min(Counted a, Counted b) { return a < b ? a : b; }
inline Counted max(Counted a, Counted b) { return a > b ? a : b; }
inline Counted unit_pow(Counted a, Counted b) { return unit_pow(a.value, b.value); }
inline Counted inverse_sqrt(Counted a) { return inverse_sqrt(a.value); }

}  // namespace halfspace

template <>
struct std::numeric_limits<halfspace::Counted> : std::numeric_limits<double> {};

#include "halfspace/raster/naive.h"
#include "halfspace/render/scene_assets.h"

namespace halfspace {

namespace {

// The number of invocations of a stage, and the total work done by them.
struct Stage {
  int runs = 0, fetches = 0, lights = 0, shadows = 0;
  double lights_each() const { return static_cast<double>(lights) / runs; }
};
struct Counts {
  Stage vertex, primitive, fragment;
  Stage* now = nullptr;
};
Counts counts;

}  // namespace

template <>
vec3<Counted> Texture2D::sample_rgb<Counted>(const Sampler& sampler, const vec2<Counted>& uv, const vec2<Counted>& duv_dx,
                                             const vec2<Counted>& duv_dy) const {
  ++counts.now->fetches;
  const auto plain = [](const vec2<Counted>& v) { return vec2<double>(v.x.value, v.y.value); };
  const vec3<double> c = sample_rgb<double>(sampler, plain(uv), plain(duv_dx), plain(duv_dy));
  return {c.x, c.y, c.z};
}

template <>
vec4<Counted> Texture2D::sample_level<Counted>(const Sampler& sampler, const vec2<Counted>& uv, std::type_identity_t<Counted> lod) const {
  ++counts.now->fetches;
  const vec4<double> c = sample_level<double>(sampler, vec2<double>(uv.x.value, uv.y.value), lod.value);
  return {c.x, c.y, c.z, c.w};
}

// A lookup in an environment counts as one fetch.
template <>
vec3<Counted> EnvironmentMap::sample<Counted>(const vec3<Counted>& d_ms, const vec3<Counted>& dx_ms, const vec3<Counted>& dy_ms) const {
  ++counts.now->fetches;
  const auto plain = [](const vec3<Counted>& v) { return vec3<double>(v.x.value, v.y.value, v.z.value); };
  const vec3<double> c = sample<double>(plain(d_ms), plain(dx_ms), plain(dy_ms));
  return {c.x, c.y, c.z};
}

template <>
Counted shadow_factor<Counted>(const Shadow&, const ShadowReceiver<Counted>&) {
  ++counts.now->shadows;
  return 1;
}

template <>
IncidentLight<Counted> light_at<Counted>(const Light& light, const vec3<Counted>& position_rws) {
  ++counts.now->lights;
  const IncidentLight<double> a = light_at<double>(light, {position_rws.x.value, position_rws.y.value, position_rws.z.value});
  return {{a.l_ws.x, a.l_ws.y, a.l_ws.z}, a.strength};
}

namespace {

// The shader S, extended to record which stage is running.
template <class S>
struct Counting : S {
  template <class R>
  using V = typename S::template Varyings<R>;

  template <class R>
  auto vertex(const typename S::template Attributes<R>& in, V<R>& out) const {
    enter(counts.vertex);
    return S::vertex(in, out);
  }
  template <class R>
  requires HasPrimitive<S>
  auto primitive(const V<R>& v0, const V<R>& v1, const V<R>& v2) const {
    enter(counts.primitive);
    return S::primitive(v0, v1, v2);
  }
  template <class R>
  requires(!HasPrimitive<S>) auto fragment(const V<R>& in, const Pixel<R>& px) const {
    enter(counts.fragment);
    return S::fragment(in, px);
  }
  template <class R>
  requires HasPrimitive<S>
  auto fragment(const V<R>& in, const PrimitiveOf<S, R>& face, const Pixel<R>& px) const {
    enter(counts.fragment);
    return S::fragment(in, face, px);
  }

 private:
  static void enter(Stage& stage) {
    counts.now = &stage;
    ++stage.runs;
  }
};

// Returns the number of interpolated varyings. Flat varyings cost a fragment nothing.
template <class S>
int interpolated() {
  int n = 0;
  for (const Interpolation i : kInterpolations<typename S::template Varyings<float>>) n += i != Interpolation::flat;
  return n;
}

// Cost per fragment of a draw call.
struct PerFragment {
  int fetches, varyings, lights;
  friend auto operator<=>(const PerFragment&, const PerFragment&) = default;
  friend std::ostream& operator<<(std::ostream& out, const PerFragment& f) {
    return out << '{' << f.fetches << ", " << f.varyings << ", " << f.lights << '}';
  }
};

// Shades the fragment at the center of every point.
template <class S>
void shade_points(const S& shader, const PreparedDraw& draw, const glm::dvec2& size_px) {
  const TriangleLanes<Counted> square{
      .x0 = 0, .y0 = 0, .e1x = 1, .e1y = 0, .e2x = 0, .e2y = 1, .area = 1, .q0 = 1, .q1 = 1, .q2 = 1, .q_unscale = 1};
  for (std::size_t i = 0; i < draw.indices->size(); ++i) {
    const auto in = naive::attributes_of<typename S::template Attributes<Counted>, Counted>(draw.vertices, (*draw.indices)[i]);
    typename S::template Varyings<Counted> out{};
    (void)shader.vertex(in, out);
    const double z = shader.lens.perspective ? in.center_cs.z.value : 1.0;
    Pixel<Counted> px{};
    px.triangle = &square;
    px.dx = px.dy = 0.5;
    px.x = (in.center_cs.x.value / (z * static_cast<double>(shader.lens.half.x)) + 1.0) / 2.0 * size_px.x;
    px.y = (in.center_cs.y.value / (z * static_cast<double>(shader.lens.half.y)) + 1.0) / 2.0 * size_px.y;
    EXPECT_TRUE(shader.fragment(out, px).keep);
  }
}

// Work is counted for the shaders of shapes in scene files, but not for those of model files.
template <class S>
constexpr bool kIsCounted = !std::is_same_v<S, StarSky> && !std::is_base_of_v<MetallicMaterial, S> &&
                            !std::is_same_v<S, ColoredPrimitives> && !std::is_same_v<S, NormalLines> && !std::is_same_v<S, ShadowCatcher>;

struct Cost {
  std::set<PerFragment> draws;  // visible draws only
  double shadows, vertex_lights, face_lights;
};

Cost cost_of(const char* scene_name, const std::vector<std::string>& settings) {
  constexpr int kWidth = 96, kHeight = 54;
  SceneFile file = SceneFile::open(scene_name);
  file.set(settings);
  const Workers workers(1);
  SceneAssets assets(workers);
  const PreparedScene scene = assets.prepare(file.description(), kWidth, kHeight);
  counts = {};
  Cost cost{};
  NaiveTarget<Counted> target(kWidth, kHeight, vec4<Counted>(Counted(0)), Counted(0));
  for (const PreparedDraw& draw : scene.draws) {
    std::visit(
        [&]<class S>(const S& shader) {
          if constexpr (kIsCounted<S>) {
            const Stage before = counts.fragment;
            if constexpr (std::is_base_of_v<SphereImpostors, S>) {
              shade_points(Counting<S>{shader}, draw, {kWidth, kHeight});
            } else {
              draw_naive(target, Counting<S>{shader}, draw.vertices, *draw.indices, draw.state);
            }
            const int runs = counts.fragment.runs - before.runs;
            if (runs == 0) return;
            const auto each = [&](int now, int then) {
              EXPECT_EQ((now - then) % runs, 0) << "all fragments of a draw do the same work";
              return (now - then) / runs;
            };
            cost.draws.insert(
                {each(counts.fragment.fetches, before.fetches), interpolated<S>(), each(counts.fragment.lights, before.lights)});
          }
        },
        draw.shader);
  }
  EXPECT_GE(counts.fragment.runs, 12) << "at least one per particle; meshes have thousands";
  cost.vertex_lights = counts.vertex.lights_each();
  cost.face_lights = counts.primitive.runs == 0 ? 0 : counts.primitive.lights_each();
  EXPECT_EQ(counts.vertex.fetches + counts.primitive.fetches, 0) << "maps are sampled per pixel";
  EXPECT_EQ(counts.vertex.shadows, 0) << "shadows are looked up per pixel, or per triangle together with its light";
  EXPECT_LE(counts.primitive.shadows, counts.primitive.lights);
  cost.shadows = static_cast<double>(counts.fragment.shadows) / counts.fragment.runs;
  return cost;
}

struct Row {
  const char* scene;
  std::vector<std::string> settings;
  std::set<PerFragment> draws;             // texture fetches, varyings and lights per fragment, for each kind of draw
  int shadows = 0;                         // upper bound; surfaces that face away from a light need no lookup
  int vertex_lights = 0, face_lights = 0;  // per vertex, per triangle
};

// Components of varyings: position 3, normal 3, tangent 3, uv 2. Light per vertex: diffuse 3, specular 3.
const std::vector<Row> kTable{
    // the texture scales both color and highlight, but is sampled once
    {"three-lights", {}, {{1, 8, 3}}, 3},
    {"three-lights", {"shadow.method=none"}, {{1, 8, 3}}},
    {"three-lights", {"red.shadow=false"}, {{1, 8, 3}}, 2},
    {"shadow-plane", {"ground.receives_shadow=false", "earth.receives_shadow=false", "ground.color=surface"}, {{1, 8, 1}}},
    // color and normal map
    {"earth", {}, {{2, 11, 1}}},
    // plus the reflection
    {"earth", {"earth.reflection=0.5"}, {{3, 11, 1}}},
    // color and slopes
    {"earth", {"earth.normal=bump"}, {{2, 8, 1}}},
    // color and three heights
    {"earth", {"earth.normal=bump", "earth.bump_method=difference"}, {{4, 8, 1}}},
    {"earth", {"earth.normal=none"}, {{1, 8, 1}}},
    {"earth", {"earth.normal=none", "earth.textured=false"}, {{0, 6, 1}}},
    {"earth", {"earth.shading=gouraud"}, {{1, 8, 0}}, 0, 1},
    {"earth", {"earth.shading=gouraud", "earth.specular=0"}, {{1, 5, 0}}, 0, 1},
    {"earth", {"earth.shading=gouraud", "earth.model=lambert"}, {{1, 5, 0}}, 0, 1},
    {"earth", {"earth.shading=provoking"}, {{1, 2, 0}}, 0, 1},
    {"earth", {"earth.shading=flat"}, {{1, 2, 0}}, 0, 0, 1},
    {"earth", {"earth.shading=none"}, {{1, 2, 0}}},
    {"earth", {"earth.shading=none", "earth.textured=false"}, {{0, 0, 0}}},
    {"earth", {"earth.shading=gouraud", "earth.textured=false"}, {{0, 3, 0}}, 0, 1},
    // color, and slopes of a displaced sphere, which are looked up by position; with a shadow, also the slopes of the mesh
    {"moon", {}, {{3, 5, 1}}, 1},
    {"moon", {"shadow.method=none"}, {{2, 5, 1}}},
    {"moon-normals", {}, {{1, 8, 1}, {2, 5, 1}}},
    {"moon-tessellation", {}, {{1, 8, 1}}},
    {"shadow-plane", {}, {{0, 6, 1}, {1, 8, 1}}, 1},
    {"shadow-contact", {}, {{0, 6, 1}}, 1},
    {"shadow-knot", {}, {{0, 6, 1}}, 1},
    // color, and emission for the house
    {"shapes", {}, {{1, 8, 1}, {2, 8, 1}}},
    // a map indexed by direction
    {"environment", {}, {{1, 3, 0}}},
    // an exact sphere interpolates nothing
    {"particles", {}, {{0, 0, 1}}},
    {"particles", {"particles.sprite=original"}, {{0, 0, 1}}},
    // the sky, roofs lit per triangle, houses with window panes
    {"day-night", {}, {{0, 0, 0}, {1, 3, 0}, {1, 8, 1}, {2, 8, 1}}, 1, 0, 1},
    // while one sky fades into the other
    {"day-night", {"background.weight=0.5"}, {{0, 0, 0}, {2, 3, 0}, {1, 8, 1}, {2, 8, 1}}, 1, 0, 1},
};

TEST(Cost, MatchesTheTable) {
  for (const Row& row : kTable) {
    std::string name = row.scene;
    for (const std::string& s : row.settings) name += " " + s;
    const Cost cost = cost_of(row.scene, row.settings);
    EXPECT_EQ(cost.draws, row.draws) << name;
    EXPECT_LE(cost.shadows, row.shadows) << name;
    EXPECT_GE(cost.shadows, 0.3 * row.shadows) << name;
    EXPECT_EQ(cost.vertex_lights, row.vertex_lights) << name;
    EXPECT_EQ(cost.face_lights, row.face_lights) << name;
  }
}

}  // namespace
}  // namespace halfspace
