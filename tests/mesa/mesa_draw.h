// SPDX-License-Identifier: Apache-2.0
//
// Draws with OpenGL from the inputs of a Pass: the same vertex views, index lists and draw states.
#pragma once

#include <array>
#include <functional>
#include <map>
#include <optional>
#include <vector>

#include "halfspace/core/image.h"
#include "halfspace/raster/draw_state.h"
#include "halfspace/raster/pass.h"
#include "halfspace/raster/target.h"
#include "halfspace/raster/vertex_input.h"
#include "halfspace/shading/texture/texture.h"

namespace halfspace::test {

class TwinTexture;

/// The render target for both renderers: a cleared color image and a cleared depth image.
struct TargetSpec {
  int width = 320;  ///< must not be 512: llvmpipe on LLVM 15 crashes at that width
  int height = 240;
  ColorFormat format = ColorFormat::rgba8;
  glm::vec4 clear_color = glm::vec4(0.0f);
  float clear_depth = 1.0f;
  DepthFormat depth = DepthFormat::d32f;
  uint8_t clear_stencil = 0;
  int samples = 1;                          ///< 1 or 4
  std::vector<ColorFormat> more_formats{};  ///< of attachments 1 to 7
  int layers = 1;                           ///< with one sample
  TextureKind kind = TextureKind::two_d;    ///< of textures with these layers
};

/// 8-bit colors and window-space depths, top row first.
struct Picture {
  Image<glm::u8vec4> color;
  Image<float> depth;
};

/// Sets the uniforms of a linked program by name.
class UniformSetter {
 public:
  explicit UniformSetter(unsigned program) : program_(program) {}
  void operator()(const char* name, int value) const;
  void operator()(const char* name, float value) const;
  void operator()(const char* name, const glm::vec2& value) const;
  void operator()(const char* name, const glm::vec3& value) const;
  void operator()(const char* name, const glm::vec4& value) const;
  void operator()(const char* name, const glm::mat4& value) const;
  /// Uploads the levels of the texture one by one. A shader has at most one texture.
  void operator()(const char* name, const Texture2D& texture, const Sampler& sampler) const;
  /// Binds a texture of any kind to a unit of its own. A texture has one sampler per draw. compares: for shadow samplers.
  void operator()(const char* name, const TwinTexture& texture, const Sampler& sampler, bool compares = false) const;

 private:
  int location(const char* name) const;
  unsigned program_;
  mutable unsigned units_ = 1;  ///< unit 0 is that of a Texture2D
};

/// One draw call. shared_glsl is prepended to all sources. Stream i of the vertices is the attribute at location i.
struct MesaDraw {
  const char* shared_glsl;
  const char* vertex_glsl;
  const char* fragment_glsl;
  std::function<void(const UniformSetter&)> set_uniforms;
  VertexView vertices;
  std::vector<uint32_t> indices;
  DrawState state;
  bool restart = false;         ///< the index 2^32 − 1 restarts a primitive
  bool own_point_size = false;  ///< the vertex shader writes gl_PointSize
  int clip_distances = 0;
  const char* geometry_glsl = nullptr;  ///< null: no geometry shader
  const char* control_glsl = nullptr;   ///< null: no tessellation
  const char* evaluation_glsl = nullptr;
  int patch_vertices = 3;
  std::optional<ClearValues> clear{};  ///< executed before the draw
};

/// Cache of linked programs, kept between images. Must be destroyed before the context.
class MesaPrograms {
 public:
  MesaPrograms() = default;
  MesaPrograms(const MesaPrograms&) = delete;
  MesaPrograms& operator=(const MesaPrograms&) = delete;
  ~MesaPrograms();
  /// Returns the program of a draw. Sources are compared by address.
  unsigned of(const MesaDraw& draw);

 private:
  std::map<std::array<const char*, 6>, unsigned> programs_;
};

/// Draws to the bound framebuffer, which has the size of the target.
void run(const MesaDraw& draw, const TargetSpec& target, MesaPrograms& programs);
/// Throws if OpenGL reports an error.
void expect_no_error();
/// Draws with the current context (see MesaContext) and returns the stored colors or integers of each attachment (codes are divided by the
/// largest one), bottom row first, one layer after the other. Multisampled targets are resolved.
std::vector<std::vector<glm::dvec4>> colors_by_mesa(const TargetSpec& target, const std::vector<MesaDraw>& draws, MesaPrograms& programs);
/// Returns 8-bit colors and depth. The target must be rgba8 or srgb8a8 with d32f and a single sample.
Picture draw_with_mesa(const TargetSpec& target, const std::vector<MesaDraw>& draws);

}  // namespace halfspace::test
