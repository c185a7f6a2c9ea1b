// SPDX-License-Identifier: Apache-2.0
//
// Cameras and meshes of the ported shaders, and the vertex shader of passes that draw the whole window.
#pragma once

#include <vector>

#include "halfspace/core/glsl.h"
#include "halfspace/geometry/camera.h"
#include "halfspace/geometry/shapes.h"
#include "mesa/mesa_context.h"
#include "mesa/twin_frame.h"

namespace halfspace::test::ported {

constexpr int kSize = 128;  ///< of the pictures
class Ported : public MesaTest {};

inline const std::vector<uint32_t> kNoIndices;

/// A color or depth texture without further levels, of the size of the pictures.
struct Flat2D : TwinTexture {
  explicit Flat2D(TexelFormat format, int size = kSize) : TwinTexture(TextureKind::two_d, format, {size, size}) {}
};

inline glm::mat4 camera(const glm::vec3& eye, const glm::vec3& target = {0, 0, 0}, double fovy = 0.8) {
  return glm::mat4(perspective_gl(fovy, 1.0, 0.1, 50.0) * look_at(glm::dvec3(eye), glm::dvec3(target), {0, 1, 0}));
}

/// Returns the mesh moved by an offset.
inline Mesh moved(Mesh mesh, const glm::vec3& offset) {
  for (glm::vec3& p : mesh.positions) p += offset;
  return mesh;
}
/// Returns a mesh with the triangles of both.
inline Mesh joined(Mesh a, const Mesh& b) {
  const auto first = static_cast<uint32_t>(a.positions.size());
  a.positions.insert(a.positions.end(), b.positions.begin(), b.positions.end());
  a.normals.insert(a.normals.end(), b.normals.begin(), b.normals.end());
  a.tangents.insert(a.tangents.end(), b.tangents.begin(), b.tangents.end());
  a.uvs.insert(a.uvs.end(), b.uvs.begin(), b.uvs.end());
  for (const uint32_t i : b.indices) a.indices.push_back(first + i);
  return a;
}
/// A sphere and a cube on a floor.
inline Mesh still_life() {
  return joined(joined(plane(5.0f), moved(cube(0.8f), {-0.7f, 0.4f, 0.1f})), moved(icosphere(3, 0.5f), {0.6f, 0.5f, 0.2f}));
}

inline const std::vector<glm::vec2> kFullScreenVertices{{-1, -1}, {3, -1}, {-1, 3}};

// [full_screen]
/// Draws one triangle that covers the window.
struct FullScreen {
  template <class R>
  struct Attributes {
    vec2<R> position;
  };
  template <class R>
  struct Varyings {
    vec2<R> uv;
  };
  template <class R>
  vec4<R> vertex(const Attributes<R>& in, Varyings<R>& out) const {
    out.uv = in.position * 0.5f + 0.5f;
    return vec4<R>(in.position, R(0), R(1));
  }
};
// [end]
inline constexpr const char* kFullScreenVertex = R"glsl(#version 330 core
layout(location = 0) in vec2 position;
out vec2 uv;

void main() {
  uv = position * 0.5 + 0.5;
  gl_Position = vec4(position, 0.0, 1.0);
}
)glsl";

inline const DrawState kWithoutDepth{.depth = {.test = false, .write = false}};

/// Draws the whole window in one pass.
template <class S, class F>
void draw_full_screen(std::vector<TwinTarget> targets, const S& shader, const char* fragment_glsl, const F& set) {
  TwinStage stage(std::move(targets));
  stage.draw(shader, kFullScreenVertex, fragment_glsl, make_vertex_view(stream(kFullScreenVertices)), kNoIndices, set, kWithoutDepth);
  stage.run();
}

// [copy]
/// Copies a texture of the size of the window.
struct Copy : FullScreen {
  Texture2DView image;

  template <class R>
  Fragment<R> fragment(const Varyings<R>&, const Pixel<R>& px) const {
    return {image.fetch<R>(ivec3<R>(truncate_to_int(px.x), truncate_to_int(px.y), IntOf<R>(0)))};
  }
};
// [end]
inline constexpr const char* kCopyFragment = R"glsl(#version 330 core
uniform sampler2D image;
out vec4 color;

void main() { color = texelFetch(image, ivec2(gl_FragCoord.xy), 0); }
)glsl";

}  // namespace halfspace::test::ported
