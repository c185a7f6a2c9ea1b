// SPDX-License-Identifier: Apache-2.0
#include "peers/embree/embree_workload.h"

#include <algorithm>
#include <vector>

#include "peers/embree/ray_packet.h"
#include "workloads/sphere_camera.h"

namespace halfspace {

namespace {

using R = RayReal;
using I = RayInt;

enum class Light { pixel, vertex, flat };

// Each task draws a tile. A ray packet covers a block of pixels in the tile.
constexpr int kTile = 32, kBlockWidth = kRays == 4 ? 2 : 4, kBlockHeight = kRays / kBlockWidth;
constexpr int kVerticesPerTask = 4096;

// One triangle per lane: its vertex indices, one vertex and two edges.
struct Triangles {
  I a, b, c;
  vec3<R> corner, edge1, edge2;
};

class RaySphere final : public Workload {
 public:
  RaySphere(const WorkloadKind& twin, WorkloadSize size, WorkloadAssets& assets, SphereDetail detail, Light light)
      : twin_(twin),
        assets_(assets),
        size_(size),
        light_(light),
        sphere_(detail, assets),
        uniforms_(sphere_uniforms(size, *sphere_.texture)),
        rays_(sphere_.mesh),
        color_(size.width, size.height),
        depth_(size.width, size.height) {
    if (light != Light::pixel) vertex_light_.resize(2 * sphere_.mesh->vertices.size() + 2 * kRays);
    // Ray directions are ahead_ + right_·dx + up_·dy, where (dx, dy) is the offset from the image center in pixels.
    const glm::dvec3 eye(uniforms_.eye_ws), ahead = glm::normalize(-eye), right = glm::normalize(glm::cross(ahead, glm::dvec3(0, 1, 0)));
    const double step = 2.0 * kTanHalfAngle / size.height;
    right_ = glm::vec3(step * right);
    up_ = glm::vec3(step * glm::cross(right, ahead));
    ahead_ = glm::vec3(ahead);
  }

  void frame(const Workers& workers) override {
    if (light_ != Light::pixel) {
      const int vertices = static_cast<int>(sphere_.mesh->vertices.size());
      workers.for_each((vertices + kVerticesPerTask - 1) / kVerticesPerTask, [&](int task) { light_vertices(task * kVerticesPerTask); });
    }
    const int columns = (size_.width + kTile - 1) / kTile, rows = (size_.height + kTile - 1) / kTile;
    workers.for_each(columns * rows, [&](int tile) { draw_tile(tile % columns * kTile, tile / columns * kTile); });
  }
  WorkloadPicture picture() const override { return {&color_, &depth_}; }
  WorkloadTruth truth() const override { return twin_.prepare(size_, assets_)->truth(); }

 private:
  const float* floats() const { return &sphere_.mesh->vertices[0].position.x; }
  static I place_of(const I& vertex) { return vertex * I(sizeof(SphereVertex) / sizeof(float)); }
  vec3<R> position(const I& vertex) const { return gather3(place_of(vertex)); }
  vec3<R> normal(const I& vertex) const { return gather3(place_of(vertex) + I(3)); }
  vec2<R> uv(const I& vertex) const {
    const I at = place_of(vertex);
    return {gather(floats(), at + I(6)), gather(floats(), at + I(7))};
  }
  vec3<R> gather3(const I& at) const { return {gather(floats(), at), gather(floats(), at + I(1)), gather(floats(), at + I(2))}; }

  // Computes the diffuse and specular light of up to kVerticesPerTask vertices, starting at `first`.
  void light_vertices(int first) {
    const int vertices = static_cast<int>(sphere_.mesh->vertices.size()), end = std::min(first + kVerticesPerTask, vertices);
    for (int v = first; v < end; v += kRays) {
      I vertex(0);
      for (int k = 0; k < kRays; ++k) set_lane(vertex, k, std::min(v + k, vertices - 1));
      const WorkloadLight<R> light = uniforms_.light_at(position(vertex), normal(vertex));
      for (int k = 0; k < std::min(kRays, end - v); ++k) {
        const auto at = 2 * static_cast<std::size_t>(v + k);
        vertex_light_[at] = lane(light.diffuse, k);
        vertex_light_[at + 1] = lane(light.specular, k);
      }
    }
  }

  void draw_tile(int left, int top) {
    for (int y = top; y < std::min(top + kTile, size_.height); y += kBlockHeight) {
      for (int x = left; x < std::min(left + kTile, size_.width); x += kBlockWidth) draw_block(x, y);
    }
  }

  void draw_block(int left, int top) {
    R dx(0.0f), dy(0.0f);  // offset from the image center, px
    for (int k = 0; k < kRays; ++k) {
      set_lane(dx, k, static_cast<float>(left + k % kBlockWidth) + 0.5f - 0.5f * static_cast<float>(size_.width));
      set_lane(dy, k, 0.5f * static_cast<float>(size_.height) - static_cast<float>(top + k / kBlockWidth) - 0.5f);
    }
    const vec3<R> direction = vec3<R>(ahead_) + vec3<R>(right_) * dx + vec3<R>(up_) * dy;
    const I first = rays_.first_triangles(uniforms_.eye_ws, direction);
    const auto hit = first >= I(0);
    vec4<R> color(kBackground);
    R depth(1.0f);
    if (any(hit)) shade(hit, triangles_of(max(first, I(0))), direction, color, depth);
    store(left, top, color, depth);
  }

  Triangles triangles_of(const I& number) const {
    const auto* const indices = reinterpret_cast<const int32_t*>(sphere_.mesh->indices.data());
    const I at = number * I(3);
    Triangles t;
    t.a = gather(indices, at);
    t.b = gather(indices, at + I(1));
    t.c = gather(indices, at + I(2));
    t.corner = position(t.a);
    t.edge1 = position(t.b) - t.corner;
    t.edge2 = position(t.c) - t.corner;
    return t;
  }

  // With s = eye − first vertex, n = e1 × e2 and ray direction d, the barycentric weights of the second and third vertex are d·(s × e2)/d·n
  // and d·(e1 × s)/d·n (Möller and Trumbore, 1997). If d changes by r, a weight w = d·m/d·n changes by (r·m − w·(r·n))/d·n, to first order.
  void shade(const MaskOf<R>& hit, const Triangles& t, const vec3<R>& direction, vec4<R>& color, R& depth) const {
    const vec3<R> s = vec3<R>(uniforms_.eye_ws) - t.corner, n = cross(t.edge1, t.edge2);
    const vec3<R> m1 = cross(s, t.edge2), m2 = cross(t.edge1, s);
    const R inverse = R(1) / dot(direction, n), w1 = dot(direction, m1) * inverse, w2 = dot(direction, m2) * inverse;
    const vec2<R> uv0 = uv(t.a), uv1 = uv(t.b) - uv0, uv2 = uv(t.c) - uv0;
    const auto step = [&](const vec3<R>& r) {
      const R along = dot(r, n);
      return uv1 * ((dot(r, m1) - w1 * along) * inverse) + uv2 * ((dot(r, m2) - w2 * along) * inverse);
    };
    const vec3<R> p = t.corner + t.edge1 * w1 + t.edge2 * w2;
    const vec3<R> texel =
        uniforms_.texture->sample_rgb(SphereUniforms::kSampler, uv0 + uv1 * w1 + uv2 * w2, step(vec3<R>(right_)), step(vec3<R>(up_)));
    const vec4<R> shaded = lit(texel, light(t, p, w1, w2)), clip = uniforms_.clip_from_world * vec4<R>(p, R(1));
    for (int k = 0; k < 4; ++k) color[k] = select(hit, shaded[k], color[k]);
    depth = select(hit, R(0.5f) + R(0.5f) * (clip.z / clip.w), depth);
  }

  WorkloadLight<R> light(const Triangles& t, const vec3<R>& p, const R& w1, const R& w2) const {
    if (light_ == Light::pixel) {
      const vec3<R> n0 = normal(t.a);
      return uniforms_.light_at(p, n0 + (normal(t.b) - n0) * w1 + (normal(t.c) - n0) * w2);
    }
    const auto of_vertex = [&](const I& vertex, int32_t part) { return gather(vertex_light_.data(), vertex * I(2) + I(part)); };
    if (light_ == Light::flat) return {of_vertex(t.c, 0), of_vertex(t.c, 1)};
    const auto mean = [&](int32_t part) {
      const R at0 = of_vertex(t.a, part);
      return at0 + (of_vertex(t.b, part) - at0) * w1 + (of_vertex(t.c, part) - at0) * w2;
    };
    return {mean(0), mean(1)};
  }

  void store(int left, int top, const vec4<R>& color, const R& depth) {
    std::array<I, 4> codes;
    for (int i = 0; i < 4; ++i)
      codes[static_cast<std::size_t>(i)] = truncate_to_int(fma(min(max(color[i], R(0)), R(1)), R(255.0f), R(0.5f)));
    const I packed = codes[0] | (codes[1] << 8) | (codes[2] << 16) | (codes[3] << 24);
    for (int k = 0; k < kRays; ++k) {
      const int x = left + k % kBlockWidth, row = top + k / kBlockWidth;
      if (x >= size_.width || row >= size_.height) continue;
      color_.at(x, row) = std::bit_cast<glm::u8vec4>(lane(packed, k));
      depth_.at(x, row) = lane(depth, k);
    }
  }

  const WorkloadKind& twin_;
  WorkloadAssets& assets_;
  WorkloadSize size_;
  Light light_;
  SphereAssets sphere_;
  SphereUniforms uniforms_;
  RayMesh rays_;
  glm::vec3 right_, up_, ahead_;  // see the constructor
  std::vector<float> vertex_light_;
  Image<glm::u8vec4> color_;
  Image<float> depth_;
};

WorkloadKind kind_of(const WorkloadKind& twin, SphereDetail detail, Light light) {
  return {twin.name, twin.what, [&twin, detail, light](WorkloadSize size, WorkloadAssets& assets) {
            return std::make_unique<RaySphere>(twin, size, assets, detail, light);
          }};
}

std::vector<WorkloadKind> all_workloads() {
  std::vector<WorkloadKind> kinds;
  const std::pair<const char*, Light> lights[] = {{"phong", Light::pixel}, {"gouraud", Light::vertex}, {"flat", Light::flat}};
  const std::pair<const char*, SphereDetail> details[] = {{"_20k", k20k}, {"_200k", k200k}, {"_2m", k2m}};
  for (const auto& [light_name, light] : lights) {
    for (const auto& [detail_name, detail] : details) {
      const std::string name = std::string("sphere_") + light_name + detail_name;
      kinds.push_back(kind_of(*std::ranges::find(workloads(), name, &WorkloadKind::name), detail, light));
    }
  }
  return kinds;
}

std::vector<Sweep> all_sweeps() {
  const Sweep& twin = *std::ranges::find(sweeps(), "triangle_count", &Sweep::name);
  Sweep out{twin.name, {}};
  for (std::size_t i = 0; i < kTriangleCounts.size(); ++i) out.kinds.push_back(kind_of(twin.kinds[i], kTriangleCounts[i], Light::pixel));
  return {out};
}

}  // namespace

std::span<const WorkloadKind> embree_workloads() {
  static const std::vector<WorkloadKind> kinds = all_workloads();
  return kinds;
}

std::span<const Sweep> embree_sweeps() {
  static const std::vector<Sweep> all = all_sweeps();
  return all;
}

}  // namespace halfspace
