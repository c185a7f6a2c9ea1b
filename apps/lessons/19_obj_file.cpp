// SPDX-License-Identifier: Apache-2.0
//
// Lesson 19: reads a model in the OBJ format, and draws it with a texture, light and a shadow.
#include <fstream>
#include <sstream>

#include "halfspace/geometry/camera.h"
#include "halfspace/geometry/shapes.h"
#include "halfspace/image/image_io.h"
#include "halfspace/raster/pass.h"
#include "halfspace/shading/texture/texture_memory.h"

using namespace halfspace;
constexpr TextureKind kKind = TextureKind::two_d;
// A knot above a square floor, as the text of an OBJ file. Its last line is a polygon with four corners.
std::string make_text() {
  std::ostringstream text;
  const Mesh knot = torus_knot(0.8f, 0.19f, 16, 160);
  for (const glm::vec3& p : knot.positions) text << "v " << p.x << ' ' << p.y + 1.2f << ' ' << p.z << '\n';
  for (const glm::vec2& uv : knot.uvs) text << "vt " << 12 * uv.x << ' ' << 2 * uv.y << '\n';
  text << "v -3 0 3\nv 3 0 3\nv 3 0 -3\nv -3 0 -3\nvt 0 0\nvt 5 0\nvt 5 5\nvt 0 5\n";
  for (std::size_t i = 0; i < knot.indices.size(); ++i)
    text << (i % 3 == 0 ? "\nf " : " ") << knot.indices[i] + 1 << '/' << knot.indices[i] + 1;
  text << "\nf 2738/2738 2739/2739 2740/2740 2741/2741\n";
  return text.str();
}
using Vertex = std::pair<glm::vec3, glm::vec2>;  // position and texture coordinates

std::vector<Vertex> read_obj(std::istream& file) {
  std::vector<glm::vec3> positions;
  std::vector<glm::vec2> uvs;
  std::vector<Vertex> triangles;  // three entries for each
  for (std::string line, kind, corner; std::getline(file, line);) {
    std::istringstream words(line);
    glm::vec3 p(0);
    std::size_t position = 0, uv = 0;
    std::vector<Vertex> polygon;
    words >> kind;
    if (kind == "v" && words >> p.x >> p.y >> p.z) positions.push_back(p);
    if (kind == "vt" && words >> p.x >> p.y) uvs.emplace_back(p.x, p.y);
    while (kind == "f" && words >> corner && std::sscanf(corner.c_str(), "%zu/%zu", &position, &uv) == 2)
      polygon.push_back({positions.at(position - 1), uvs.at(uv - 1)});  // the file counts from 1
    for (std::size_t i = 2; i < polygon.size(); ++i)                    // a fan of triangles around the first corner
      triangles.insert(triangles.end(), {polygon[0], polygon[i - 1], polygon[i]});
  }
  return triangles;
}

struct ModelShader {
  glm::mat4 clip_from_world, light_from_world;
  glm::vec3 to_light;
  Texture2DView texture, shadow_map;
  template <class R>
  struct Attributes {
    vec3<R> position;
    vec2<R> uv;
  };
  template <class R>
  using Varyings = Attributes<R>;
  template <class R>
  vec4<R> vertex(const Attributes<R>& in, Varyings<R>& out) const {
    out = in;
    return clip_from_world * vec4<R>(in.position, R(1));
  }
  template <class R>
  Fragment<R> fragment(const Varyings<R>& in, const Pixel<R>& px) const {
    const vec3<R> normal = normalize(cross(px.ddx(&Varyings<R>::position), px.ddy(&Varyings<R>::position)));  // flat
    const vec3<R> p = vec3<R>(light_from_world * vec4<R>(in.position, R(1))) * R(0.5f) + vec3<R>(R(0.5f));
    const R lit = shadow_map.sample_compare_level(Sampler{}, vec2<R>(p.x, p.y), p.z - R(0.01f), R(0));
    const R diffuse = max(dot(normal, vec3<R>(to_light)), R(0)) * lit;
    const vec3<R> color(texture.sample(Sampler{}, in.uv, px.ddx(&Varyings<R>::uv), px.ddy(&Varyings<R>::uv)));
    return {vec4<R>(color * (R(0.12f) + R(0.88f) * diffuse), R(1))};
  }
};
int main(int argc, char** argv) try {
  std::istringstream own(make_text());
  std::ifstream file(argc > 2 ? argv[2] : "");  // a model of yours
  const std::vector<Vertex> model = read_obj(argc > 2 ? static_cast<std::istream&>(file) : own);
  if (model.empty()) throw std::runtime_error(std::string(argv[2]) + ": no triangles; expected lines such as f 1/1 2/2 3/3");
  const auto vertices = make_vertex_view(stream(model, &Vertex::first), stream(model, &Vertex::second));
  TextureMemory checks(kKind, TexelFormat::srgb8a8, {64, 64}, 7), map(kKind, TexelFormat::d32f, {512, 512});
  for (int i = 0; i < 64 * 64; ++i)
    checks.set(i % 64, i / 64, 0, 0, (i / 32 + i / 2048) % 2 == 0 ? glm::vec4(0.8f, 0.4f, 0.1f, 1) : glm::vec4(0.1f, 0.2f, 0.5f, 1));
  checks.generate_mipmaps();
  const glm::dvec3 sun(3, 5, 2), center(0, 0.5, 0);
  const glm::mat4 light(orthographic_gl(7.0, 1.0, 0.1, 12.0) * look_at(sun, center, {0, 1, 0}));
  ModelShader shader{light, light, glm::vec3(glm::normalize(sun - center)), checks.view<kKind>(), map.view<kKind>()};
  Pass from_light(512, 512, {}, depth_target(map.level()));
  from_light.draw_depth(shader, vertices);
  Image<glm::u8vec4> image(320, 240);
  Pass pass(320, 240, srgb8a8_target(image), {.format = DepthFormat::d32f, .clear_value = 0.0f}, {.samples = 4});
  pass.clear({.colors = {glm::vec4(0.02f, 0.02f, 0.03f, 1)}});
  shader.clip_from_world = glm::mat4(perspective_reversed(0.7, 4.0 / 3.0, 0.1, 100.0) * look_at({-2.2, 3.2, 5}, {0, 0.8, 0}, {0, 1, 0}));
  pass.draw(shader, vertices, kReversedZState);
  for (Pass* const each : {&from_light, &pass}) each->run(Workers(1));
  write_image(argc > 1 ? argv[1] : "lesson19.png", image);
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
