// SPDX-License-Identifier: Apache-2.0
//
// Draws by OpenGL what a Pass is told to draw: the same vertex views, index lists and draw states.
#pragma once

#include <array>
#include <functional>
#include <map>
#include <vector>

#include "halfspace/core/image.h"
#include "halfspace/raster/draw_state.h"
#include "halfspace/raster/target.h"
#include "halfspace/raster/vertex_input.h"
#include "halfspace/shading/texture.h"

namespace halfspace::test {

/// What both renderers draw into: a cleared colour image and a cleared depth image.
struct TargetSpec {
  int width = 320;  ///< not 512: llvmpipe on LLVM 15 crashes there
  int height = 240;
  ColorFormat format = ColorFormat::rgba8;
  glm::vec4 clear_color = glm::vec4(0.0f);
  float clear_depth = 1.0f;
  DepthFormat depth = DepthFormat::d32f;
  uint8_t clear_stencil = 0;
  int samples = 1;  ///< or 4
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
  bool restart = false;         ///< the index 2^32 − 1 ends a primitive
  bool own_point_size = false;  ///< the vertex shader gives it
  int clip_distances = 0;
};

/// Linked programs, kept from picture to picture; to be destroyed before the context.
class MesaPrograms {
 public:
  MesaPrograms() = default;
  MesaPrograms(const MesaPrograms&) = delete;
  MesaPrograms& operator=(const MesaPrograms&) = delete;
  ~MesaPrograms();
  /// The draw's program; sources are told apart by their addresses.
  unsigned of(const MesaDraw& draw);

 private:
  std::map<std::array<const char*, 3>, unsigned> programs_;
};

/// Draws with the current context (MesaContext), and returns the colours as they are stored (of 8-bit formats codes/255), in rows from
/// the bottom. Samples are resolved.
std::vector<glm::vec4> colors_by_mesa(const TargetSpec& target, const std::vector<MesaDraw>& draws, MesaPrograms& programs);
/// The same as codes, with the depth: of rgba8 or srgb8a8 and d32f, of one sample.
Picture draw_with_mesa(const TargetSpec& target, const std::vector<MesaDraw>& draws);

}  // namespace halfspace::test
