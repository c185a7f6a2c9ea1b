// SPDX-License-Identifier: Apache-2.0
//
// Draws by OpenGL what a Pass is told to draw: the same vertex views, index lists and draw states.
#pragma once

#include <functional>
#include <vector>

#include "core/image.h"
#include "raster/draw_state.h"
#include "raster/target.h"
#include "raster/vertex_view.h"
#include "shading/texture.h"

namespace halfspace::test {

/// What both renderers draw into: a cleared colour image and a cleared 32-bit float depth image.
struct TargetSpec {
  int width = 320;  ///< not 512: llvmpipe on LLVM 15 crashes there
  int height = 240;
  ColorFormat format = ColorFormat::rgba8;  ///< or srgb8a8
  glm::vec4 clear_color = glm::vec4(0.0f);
  float clear_depth = 1.0f;
};

/// Colour codes and window depths, top row first.
struct Picture {
  Image<glm::u8vec4> color;
  Image<float> depth;
};

/// Sets the uniforms of a linked program by name.
class UniformSetter {
 public:
  explicit UniformSetter(unsigned program) : program_(program) {}
  void operator()(const char* name, float value) const;
  void operator()(const char* name, const glm::vec3& value) const;
  void operator()(const char* name, const glm::vec4& value) const;
  void operator()(const char* name, const glm::mat4& value) const;
  /// Uploads the texture's own levels, one by one. A shader has at most one texture.
  void operator()(const char* name, const Texture2D& texture, const Sampler& sampler) const;

 private:
  int location(const char* name) const;
  unsigned program_;
};

/// One draw call. shared_glsl comes before both sources; stream i of the vertices is the attribute at location i.
struct MesaDraw {
  const char* shared_glsl;
  const char* vertex_glsl;
  const char* fragment_glsl;
  std::function<void(const UniformSetter&)> set_uniforms;
  VertexView vertices;
  std::vector<uint32_t> indices;
  DrawState state;
};

/// Draws with the current context (MesaContext).
Picture draw_with_mesa(const TargetSpec& target, const std::vector<MesaDraw>& draws);

}  // namespace halfspace::test
