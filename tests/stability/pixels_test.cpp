// SPDX-License-Identifier: Apache-2.0
//
// Tests pixel values where common shaders fail: faces, bumps, seams, derivatives at edges.
#include <cmath>

#include "halfspace/geometry/camera.h"
#include "halfspace/geometry/height_slopes.h"
#include "halfspace/geometry/shapes.h"
#include "halfspace/raster/pass.h"
#include "halfspace/shading/surface/surface_detail.h"
#include "stability/regime.h"
#include "support/constants.h"

namespace halfspace::stability {
namespace {

template <class S>
Image<glm::vec4> drawn(const S& shader, const VertexView& view, const std::vector<uint32_t>& list, int size, std::size_t vertex_count,
                       float outside = -1e9f) {
  Image<glm::vec4> picture(size, size);
  ColorTarget target = rgba32f_target(picture);
  target.clear_value = glm::vec4(outside);
  Pass pass(size, size, target, {.format = DepthFormat::d32f});
  const Indices indices(list, vertex_count);
  DrawState state;
  state.cull = CullMode::back;
  pass.draw(shader, view, indices, state);
  pass.run(Workers(1));
  return picture;
}

// ---- flat shading -------------------------------------------------------------------------------------------------------

// A shader that uses the face normal or the normal of the provoking vertex.
struct FlatLight {
  bool by_face = true;
  template <class R>
  struct Attributes {
    vec3<R> position, normal;
  };
  template <class R>
  struct Varyings {
    vec3<R> position;
    Flat<vec3<R>> normal;
  };
  template <class R>
  struct Primitive {
    vec3<R> normal;
  };
  template <class R>
  vec4<R> vertex(const Attributes<R>& in, Varyings<R>& out) const {
    out = {in.position, {in.normal}};
    return {in.position.x, in.position.y, in.position.z * R(0.1f), R(1)};
  }
  template <class R>
  Primitive<R> primitive(const Varyings<R>& a, const Varyings<R>& b, const Varyings<R>& c) const {
    return {cross(b.position - a.position, c.position - a.position)};
  }
  template <class R>
  Fragment<R> fragment(const Varyings<R>& in, const Primitive<R>& face, const Pixel<R>&) const {
    const vec3<R> n = by_face ? face.normal : in.normal.value;
    const R light = (n.x * R(0.6f) + n.z * R(0.8f)) / sqrt(dot(n, n));
    return {vec4<R>(light)};
  }
};

TEST(Stability, FlatShadingDoesNotDependOnVertexOrder) {
  // A saddle of 8 x 8 quads, each split along the same diagonal; then the same triangles, each starting at a different vertex.
  constexpr int kQuads = 8;
  std::vector<glm::vec3> positions, normals;
  std::vector<uint32_t> list, turned;
  for (int j = 0; j <= kQuads; ++j) {
    for (int i = 0; i <= kQuads; ++i) {
      const float x = -0.9f + 1.8f * static_cast<float>(i) / kQuads, y = -0.9f + 1.8f * static_cast<float>(j) / kQuads;
      positions.emplace_back(x, y, 0.8f * x * y);
      normals.push_back(glm::normalize(glm::vec3(-0.8f * y, -0.8f * x, 1.0f)));
    }
  }
  for (uint32_t j = 0; j < kQuads; ++j) {
    for (uint32_t i = 0; i < kQuads; ++i) {
      const uint32_t a = j * (kQuads + 1) + i, b = a + 1, c = a + kQuads + 2, d = a + kQuads + 1;
      list.insert(list.end(), {a, b, c, a, c, d});
      turned.insert(turned.end(), {b, c, a, c, d, a});
    }
  }
  const auto change = [&](bool by_face) {
    const VertexView view = make_vertex_view(stream(positions), stream(normals));
    const Image<glm::vec4> one = drawn(FlatLight{by_face}, view, list, 64, positions.size()),
                           other = drawn(FlatLight{by_face}, view, turned, 64, positions.size());
    double max_difference = 0.0;
    for (std::size_t i = 0; i < one.texels().size(); ++i)
      max_difference = std::max(max_difference, std::abs(static_cast<double>(one.data()[i].x) - static_cast<double>(other.data()[i].x)));
    return max_difference;
  };
  // The face normal is a cross product of differences of the same vertices, whose rounding depends on their order.
  record_and_check({12, "flat shading of non-planar quads",
                    "a saddle, drawn again with the vertices of each triangle permuted cyclically; lighting at the provoking vertex vs. "
                    "with the face normal",
                    "largest change in brightness"},
                   change(false), 0.05, change(true), 1e-5);
}

// ---- bumps --------------------------------------------------------------------------------------------------------------

constexpr int kMap = 256;
constexpr double kWaves = 12.0;

struct BumpSlope {
  DetailMap detail;
  bool difference = false;
  template <class R>
  struct Attributes {
    vec2<R> position, uv;
  };
  template <class R>
  struct Varyings {
    vec2<R> uv;
  };
  template <class R>
  vec4<R> vertex(const Attributes<R>& in, Varyings<R>& out) const {
    out.uv = in.uv;
    return {in.position.x, in.position.y, R(0), R(1)};
  }
  template <class R>
  Fragment<R> fragment(const Varyings<R>& in, const Pixel<R>& px) const {
    const MapCoordinates<R> at{in.uv, px.ddx(&Varyings<R>::uv), px.ddy(&Varyings<R>::uv)};
    const auto uv_of = [](const Varyings<R>& v) { return v.uv; };
    const HeightSteps<R> h = difference ? height_differences<Varyings<R>>(detail, px, at, uv_of) : height_steps(detail, at);
    return {vec4<R>(h.right, h.up, in.uv.x, in.uv.y)};
  }
};

TEST(Stability, BumpMapsMatchTheAnalyticSlope) {
  Image<float> heights(kMap, kMap);
  for (int y = 0; y < kMap; ++y)
    for (int x = 0; x < kMap; ++x)
      heights.at(x, y) =
          static_cast<float>(0.5 + 0.5 * std::sin(2 * kPi * kWaves * (x + 0.5) / kMap) * std::cos(2 * kPi * kWaves * (y + 0.5) / kMap));
  Image<glm::vec4> as_map(kMap, kMap);
  for (std::size_t i = 0; i < heights.texels().size(); ++i) as_map.data()[i] = glm::vec4(heights.data()[i]);
  const Texture2D height_map(as_map, TexelFormat::rgba32f);
  const Texture2D slope_map(height_slopes(heights, Wrap::repeat, Wrap::repeat), TexelFormat::rgba32f);
  const std::vector<glm::vec2> positions{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}, uvs{{0, 0}, {0.9f, 0.3f}, {0.6f, 1.2f}, {-0.3f, 0.9f}};
  const auto error = [&](bool difference) {
    const BumpSlope shader{{.map = difference ? &height_map : &slope_map,
                            .sampler = {.min = Filter::bilinear},
                            .strength = 1,
                            .flip_green = false,
                            .difference = difference},
                           difference};
    const Image<glm::vec4> picture = drawn(shader, make_vertex_view(stream(positions), stream(uvs)), {0, 1, 2, 0, 2, 3}, 128, 4);
    double squares = 0.0, truth_squares = 0.0;
    for (const glm::vec4& p : picture.texels()) {
      const double u = static_cast<double>(p.z), v = static_cast<double>(p.w), k = 2 * kPi * kWaves;
      const double du = 0.45 / 64, dv = 0.15 / 64;  // change per pixel to the right
      const double truth = 0.5 * k * (std::cos(k * u) * std::cos(k * v) * du - std::sin(k * u) * std::sin(k * v) * dv);
      squares += (static_cast<double>(p.x) - truth) * (static_cast<double>(p.x) - truth);
      truth_squares += truth * truth;
    }
    return std::sqrt(squares / truth_squares);
  };
  // A wave of 21 texels. The slope of the parabola is scaled by sin(x)/x with x = 2 pi/21, and linear filtering scales it again by the same
  // factor: a loss of 3%.
  record_and_check(
      {14, "bump mapping from differences of heights",
       "waves of 21 texels and 9 px; differences in the 2x2 quad vs. slopes of filtered heights", "relative RMS error of the slope"},
      error(true), 0.15, error(false), 0.05);
}

// ---- seams --------------------------------------------------------------------------------------------------------------

// Outputs the level of detail of a texture lookup. u either comes from the mesh, or is computed per pixel from the direction and
// differentiated in the quad.
struct LevelSeen {
  glm::mat4 clip_from_world;
  bool by_direction = false;
  template <class R>
  struct Attributes {
    vec3<R> position;
    vec2<R> uv;
  };
  template <class R>
  struct Varyings {
    vec3<R> position;
    vec2<R> uv;
  };
  template <class R>
  vec4<R> vertex(const Attributes<R>& in, Varyings<R>& out) const {
    out = {in.position, in.uv};
    return clip_from_world * vec4<R>(in.position, R(1));
  }
  template <class R>
  Fragment<R> fragment(const Varyings<R>& in, const Pixel<R>& px) const {
    constexpr int kWidth = 512, kHeight = 256;
    vec2<R> dx = px.ddx(&Varyings<R>::uv), dy = px.ddy(&Varyings<R>::uv);
    if (by_direction) {
      const auto uv_at = [&](int i, int j) {
        const Varyings<R> v = px.template at_quad<Varyings<R>>(i, j);
        const R turns = atan2(-v.position.z, v.position.x) * R(0.159154943f);
        return vec2<R>(turns, v.uv.y);
      };
      dx = uv_at(1, 0) - uv_at(0, 0);
      dy = uv_at(0, 1) - uv_at(0, 0);
    }
    return {vec4<R>(level_of_detail(kWidth, kHeight, dx, dy), in.position.x, in.position.y, in.position.z)};
  }
};

TEST(Stability, LevelOfDetailIsUnaffectedByTheSeam) {
  // atan2 jumps from half a turn to minus half a turn at −x, in the middle of the image. The seam of the mesh is at +x. The globe is viewed
  // from both sides. (At 202 px, the middle of the image is inside a quad.)
  const Mesh ball = uv_sphere(64, 128, 1.0f);
  const auto max_error = [&](bool by_direction, double side) {
    const glm::dmat4 clip = perspective_gl(40.0 * kPi / 180.0, 1.0, 0.1, 10.0) * look_at({side * 3.0, 0, 0}, {0, 0, 0}, {0, 1, 0});
    const Image<glm::vec4> picture =
        drawn(LevelSeen{glm::mat4(clip), by_direction}, make_vertex_view(stream(ball.positions), stream(ball.uvs)), ball.indices, 202,
              ball.positions.size());
    double level = -1e9;
    for (const glm::vec4& p : picture.texels())
      if (std::abs(p.y) > 0.8f) level = std::max(level, static_cast<double>(p.x));  // faces the eye, so a texel is about a pixel
    return level;
  };
  const double ours = std::max(max_error(false, 1.0), max_error(false, -1.0));
  // At the center a pixel is about 1.1 texels. At 0.8 the surface is inclined by 37 degrees, and the level is log2(1.1 / 0.8) = 0.5.
  record_and_check(
      {15, "seam where u wraps around",
       "the seam of a globe in the middle of the image; atan2, differentiated in the quad, vs. derivatives of the mesh's coordinates",
       "largest level of detail where a pixel covers one texel"},
      max_error(true, -1.0), 6.0, ours, 0.7);
}

// ---- derivatives at edges -----------------------------------------------------------------------------------------------

// Outputs du/dx: analytically, or from differences in the quad with values clamped to the range of the triangle.
struct StepSeen {
  bool clamped = false;
  template <class R>
  struct Attributes {
    vec4<R> position;
    R u;
  };
  template <class R>
  struct Varyings {
    R u;
  };
  template <class R>
  vec4<R> vertex(const Attributes<R>& in, Varyings<R>& out) const {
    out.u = in.u;
    return in.position;
  }
  template <class R>
  Fragment<R> fragment(const Varyings<R>& in, const Pixel<R>& px) const {
    R step = px.ddx(&Varyings<R>::u);
    if (clamped) {
      const auto u_at = [&](int i) { return clamp(px.template at_quad<Varyings<R>>(i, 0).u, R(0), R(1)); };
      step = u_at(1) - u_at(0);
    }
    return {vec4<R>(step, in.u, px.x, px.y)};
  }
};

TEST(Stability, DerivativesAreExactAtSilhouettes) {
  // A triangle in perspective (w from 1 to 5) with u = 0, 1, 0 at its vertices.
  const std::array<glm::vec4, 3> corners{{{-0.9f, -0.8f, 0, 1}, {0.8f * 5, -0.3f * 5, 0, 5}, {-0.2f * 3, 0.9f * 3, 0, 3}}};
  const std::vector<glm::vec4> positions(corners.begin(), corners.end());
  const std::vector<float> us{0.0f, 1.0f, 0.0f};
  const auto u_at = [&](double x, double y) {  // from the edges in clip space, in double
    const glm::dvec3 p(2 * x / 128 - 1, 2 * y / 128 - 1, 1);
    const auto row = [&](std::size_t i) { return glm::dvec3(corners[i].x, corners[i].y, corners[i].w); };
    const double e0 = glm::dot(glm::cross(row(1), row(2)), p), e1 = glm::dot(glm::cross(row(2), row(0)), p),
                 e2 = glm::dot(glm::cross(row(0), row(1)), p);
    return e1 / (e0 + e1 + e2);
  };
  const auto error = [&](bool clamped) {
    double max_error = 0.0;
    const Image<glm::vec4> picture = drawn(StepSeen{clamped}, make_vertex_view(stream(positions), stream(us)), {0, 1, 2}, 128, 3);
    for (const glm::vec4& p : picture.texels()) {
      if (p.z < 0.0f) continue;
      const double x = static_cast<double>(p.z), y = static_cast<double>(p.w);
      const double truth = (u_at(x + 1e-3, y) - u_at(x - 1e-3, y)) / 2e-3;
      max_error = std::max(max_error, std::abs(std::log2(std::max(std::abs(static_cast<double>(p.x)), 1e-30) / std::abs(truth))));
    }
    return max_error;
  };
  // Vertices are snapped to 1/256 px and edges are about 100 px long, so the slope changes by a factor of 1e-4 and the level by 2e-4, or
  // more near the far vertex.
  record_and_check({17, "level of detail at silhouettes",
                    "a triangle in perspective; differences of values clamped to the triangle vs. the derivative of its plane",
                    "largest error of the level of detail at its edges"},
                   error(true), 1.0, error(false), 2e-3);
}

}  // namespace
}  // namespace halfspace::stability
