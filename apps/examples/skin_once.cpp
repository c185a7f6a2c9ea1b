// SPDX-License-Identifier: Apache-2.0
//
// Bends a cylinder once, and draws the captured vertices twelve times.
#include <cstdio>
#include <exception>

#include "halfspace/geometry/shapes.h"
#include "halfspace/image/image_io.h"
#include "halfspace/raster/capture.h"
#include "halfspace/raster/pass.h"

using namespace halfspace;

struct Bend {  // has no fragment function, because nothing is drawn
  template <class R>
  struct Attributes {
    vec3<R> position, normal;
  };
  template <class R>
  struct Varyings {
    vec3<R> normal;
  };
  template <class R>
  vec4<R> vertex(const Attributes<R>& in, Varyings<R>& out) const {
    out.normal = normalize(vec3<R>(in.normal.x, in.normal.y - in.normal.x * in.position.y * R(4), in.normal.z));
    return vec4<R>(in.position.x + in.position.y * in.position.y * R(2), in.position.y, -in.position.z, R(1));
  }
};
struct Lit {
  template <class R>
  struct Attributes {
    vec4<R> position;
    vec3<R> normal;
  };
  template <class R>
  using Varyings = Bend::Varyings<R>;
  template <class R>
  vec4<R> vertex(const Attributes<R>& in, const VertexId<R>& id, Varyings<R>& out) const {
    out.normal = in.normal;
    const float x = static_cast<float>(id.instance % 4) * 0.5f - 0.8f, y = static_cast<float>(id.instance / 4) * 0.65f - 0.65f;
    return in.position + vec4<R>(R(x), R(y), R(0), R(0));
  }
  template <class R>
  Fragment<R> fragment(const Varyings<R>& in) const {
    return {vec4<R>(vec3<R>(max(dot(in.normal, vec3<R>(glm::vec3(0.5f, 0.6f, 0.62f))), R(0.05f))), R(1))};
  }
};

int main(int, char** argv) try {
  const Mesh mesh = cylinder(0.12f, 0.5f, 24, 40);
  const auto bent = capture(Bend{}, make_vertex_view(stream(mesh.positions), stream(mesh.normals)), mesh.indices, Workers(1));
  Image<glm::u8vec4> image(480, 480);
  Pass pass(480, 480, srgb8a8_target(image), {.format = DepthFormat::d32f});
  pass.draw(Lit{}, make_vertex_view(stream(bent.positions), stream(bent.varyings, &Bend::Varyings<float>::normal)), {.instances = 12});
  pass.run(Workers(Workers::cores()));
  write_image(argv[1] != nullptr ? argv[1] : "skin_once.png", image);
} catch (const std::exception& error) {
  return std::fprintf(stderr, "%s\n", error.what()), 1;
}
