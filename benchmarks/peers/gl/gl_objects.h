// SPDX-License-Identifier: Apache-2.0
//
// RAII wrappers for OpenGL objects: programs, meshes, textures, render targets.
#pragma once

#include <epoxy/gl.h>

#include <array>
#include <glm/glm.hpp>
#include <initializer_list>
#include <span>
#include <string_view>
#include <vector>

#include "halfspace/core/image.h"
#include "halfspace/shading/texture/texture.h"
#include "workloads/workload.h"

namespace halfspace {

/// A linked program. Uniforms are set by name; an unknown name throws InputError.
class GlProgram {
 public:
  /// The sources are GLSL 3.30 without the #version line. `shared` is inserted at the start of both stages. Throws InputError if
  /// compiling or linking fails.
  GlProgram(std::string_view shared, std::string_view vertex, std::string_view fragment);
  ~GlProgram() { glDeleteProgram(id_); }
  GlProgram(const GlProgram&) = delete;
  GlProgram& operator=(const GlProgram&) = delete;

  void use() const { glUseProgram(id_); }
  void set(const char* name, const glm::mat4& value);
  void set(const char* name, const glm::vec4& value);
  void set(const char* name, const glm::vec3& value);
  void set(const char* name, float value);
  void set(const char* name, int value);
  GLint location(const char* name) const;

 private:
  GLuint id_;
};

/// A vertex buffer with an optional index buffer.
class GlMesh {
 public:
  /// Attribute i has components[i] floats. Attributes are interleaved without padding.
  GlMesh(std::span<const float> vertices, std::initializer_list<int> components, std::span<const uint32_t> indices = {});
  ~GlMesh();
  GlMesh(const GlMesh&) = delete;
  GlMesh& operator=(const GlMesh&) = delete;

  void bind() const { glBindVertexArray(array_); }
  void draw(GLenum topology) const;
  /// Draws `count` indices, starting with index `first` of the list.
  void draw_part(GLenum topology, std::size_t first, std::size_t count, std::size_t instances) const;

 private:
  GLuint array_ = 0;
  std::array<GLuint, 2> buffers_{};
  GLsizei count_;
  bool indexed_;
};

/// Views an array of structs as an array of floats. The structs must contain only floats.
template <class T>
std::span<const float> floats_of(std::span<const T> structs) {
  static_assert(sizeof(T) % sizeof(float) == 0 && std::is_trivially_copyable_v<T>);
  return {reinterpret_cast<const float*>(structs.data()), structs.size() * (sizeof(T) / sizeof(float))};
}

/// An rgba8, srgb8a8 or rgba16f texture with all its mip levels.
class GlTexture {
 public:
  GlTexture(const Texture2D& texels, const Sampler& sampler);
  /// Like the first constructor, but with trilinear filtering. wrap_t: GL_REPEAT or GL_CLAMP_TO_EDGE.
  GlTexture(const Texture2D& texels, GLint wrap_t, float anisotropy = 1.0f);
  ~GlTexture() { glDeleteTextures(1, &id_); }
  GlTexture(const GlTexture&) = delete;
  GlTexture& operator=(const GlTexture&) = delete;
  void bind() const { glBindTexture(GL_TEXTURE_2D, id_); }

 private:
  void upload(const Texture2D& texels);

  GLuint id_ = 0;
};

/// A framebuffer with a color texture, unless color_format is 0, and an optional depth texture.
class GlTarget {
 public:
  GlTarget(WorkloadSize size, GLenum color_format, bool has_depth, int samples = 1)
      : GlTarget(size, color_format, has_depth ? GLenum{GL_DEPTH_COMPONENT32F} : GLenum{0}, samples) {}
  /// depth_format: GL_DEPTH_COMPONENT32F, GL_DEPTH24_STENCIL8 or 0.
  GlTarget(WorkloadSize size, GLenum color_format, GLenum depth_format, int samples = 1);
  ~GlTarget();
  GlTarget(const GlTarget&) = delete;
  GlTarget& operator=(const GlTarget&) = delete;

  /// Makes this the render target and resets the draw state. With a depth texture, enables the depth test GL_LESS and back-face culling;
  /// without one, disables both.
  void bind() const;
  void clear(const glm::vec4& color) const;
  void bind_color() const { glBindTexture(GL_TEXTURE_2D, color_); }
  void bind_depth() const { glBindTexture(GL_TEXTURE_2D, depth_); }
  /// Resolves the color samples of this target into the pixels of `to`.
  void resolve_into(const GlTarget& to) const;
  Image<glm::u8vec4> read_color() const;
  Image<float> read_depth() const;
  bool has_depth() const { return depth_ != 0; }

 private:
  WorkloadSize size_;
  GLuint framebuffer_ = 0, color_ = 0, depth_ = 0;
  bool has_stencil_ = false;
};

}  // namespace halfspace
