// SPDX-License-Identifier: Apache-2.0
#include "peers/gl/gl_objects.h"

#include <algorithm>
#include <array>
#include <string>

#include "halfspace/core/check.h"
#include "peers/gl/gl_state.h"

namespace halfspace {

namespace {

void compile(GLuint program, GLenum stage, std::string_view shared, std::string_view source) {
  const std::string text = "#version 330 core\n" + std::string(shared) + std::string(source);
  const char* pointer = text.c_str();
  const GLuint shader = glCreateShader(stage);
  glShaderSource(shader, 1, &pointer, nullptr);
  glCompileShader(shader);
  GLint good = 0;
  glGetShaderiv(shader, GL_COMPILE_STATUS, &good);
  if (good == 0) {
    std::array<char, 2000> log{};
    glGetShaderInfoLog(shader, static_cast<GLsizei>(log.size()), nullptr, log.data());
    throw InputError("GLSL: " + std::string(log.data()) + text);
  }
  glAttachShader(program, shader);
  glDeleteShader(shader);  // takes effect when the program is deleted
}

// Flips an image from OpenGL, which stores the bottom row first.
template <class T>
Image<T> upright(const Image<T>& image) {
  Image<T> out(image.width(), image.height());
  for (int row = 0; row < image.height(); ++row) std::ranges::copy(image.row(image.height() - 1 - row), out.row(row).begin());
  return out;
}

}  // namespace

GlProgram::GlProgram(std::string_view shared, std::string_view vertex, std::string_view fragment) : id_(glCreateProgram()) {
  compile(id_, GL_VERTEX_SHADER, shared, vertex);
  compile(id_, GL_FRAGMENT_SHADER, shared, fragment);
  glLinkProgram(id_);
  GLint good = 0;
  glGetProgramiv(id_, GL_LINK_STATUS, &good);
  if (good == 0) throw InputError("GLSL: cannot link the program: " + std::string(vertex) + std::string(fragment));
  use();
}

GLint GlProgram::location(const char* name) const {
  use();
  const GLint at = glGetUniformLocation(id_, name);
  if (at < 0) throw InputError("GLSL: no uniform named " + std::string(name));
  return at;
}

void GlProgram::set(const char* name, const glm::mat4& value) { glUniformMatrix4fv(location(name), 1, GL_FALSE, &value[0][0]); }
void GlProgram::set(const char* name, const glm::vec4& value) { glUniform4fv(location(name), 1, &value[0]); }
void GlProgram::set(const char* name, const glm::vec3& value) { glUniform3fv(location(name), 1, &value[0]); }
void GlProgram::set(const char* name, float value) { glUniform1f(location(name), value); }
void GlProgram::set(const char* name, int value) { glUniform1i(location(name), value); }

GlMesh::GlMesh(std::span<const float> vertices, std::initializer_list<int> components, std::span<const uint32_t> indices)
    : indexed_(!indices.empty()) {
  int stride = 0;
  for (const int n : components) stride += n;
  count_ = static_cast<GLsizei>(indexed_ ? indices.size() : vertices.size() / static_cast<std::size_t>(stride));
  glGenVertexArrays(1, &array_);
  glGenBuffers(2, buffers_.data());
  glBindVertexArray(array_);
  glBindBuffer(GL_ARRAY_BUFFER, buffers_[0]);
  glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(vertices.size_bytes()), vertices.data(), GL_STATIC_DRAW);
  if (indexed_) {
    glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, buffers_[1]);
    glBufferData(GL_ELEMENT_ARRAY_BUFFER, static_cast<GLsizeiptr>(indices.size_bytes()), indices.data(), GL_STATIC_DRAW);
  }
  GLuint attribute = 0;
  std::size_t offset = 0;
  for (const int n : components) {
    glEnableVertexAttribArray(attribute);
    glVertexAttribPointer(attribute++, n, GL_FLOAT, GL_FALSE, stride * static_cast<GLsizei>(sizeof(float)),
                          reinterpret_cast<const void*>(offset));
    offset += static_cast<std::size_t>(n) * sizeof(float);
  }
}

GlMesh::~GlMesh() {
  glDeleteVertexArrays(1, &array_);
  glDeleteBuffers(2, buffers_.data());
}

void GlMesh::draw(GLenum topology) const {
  bind();
  if (indexed_) {
    glDrawElements(topology, count_, GL_UNSIGNED_INT, nullptr);
  } else {
    glDrawArrays(topology, 0, count_);
  }
}

void GlMesh::draw_part(GLenum topology, std::size_t first, std::size_t count, std::size_t instances) const {
  bind();
  glDrawElementsInstanced(topology, static_cast<GLsizei>(count), GL_UNSIGNED_INT, reinterpret_cast<const void*>(first * sizeof(uint32_t)),
                          static_cast<GLsizei>(instances));
}

void GlTexture::upload(const Texture2D& texels) {
  glGenTextures(1, &id_);
  bind();
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAX_LEVEL, texels.levels() - 1);
  for (int level = 0; level < texels.levels() && texels.format() == TexelFormat::rgba16f; ++level) {
    Image<glm::vec4> image(texels.width(level), texels.height(level));
    for (int row = 0; row < image.height(); ++row) {
      for (int x = 0; x < image.width(); ++x) image.at(x, row) = texels.value(level, x, row);
    }
    glTexImage2D(GL_TEXTURE_2D, level, GL_RGBA16F, image.width(), image.height(), 0, GL_RGBA, GL_FLOAT, image.data());
  }
  const GLint codes = texels.format() == TexelFormat::srgb8a8 ? GL_SRGB8_ALPHA8 : GL_RGBA8;
  for (int level = 0; level < texels.levels() && texels.format() <= TexelFormat::srgb8a8; ++level) {
    Image<glm::u8vec4> image(texels.width(level), texels.height(level));
    for (int row = 0; row < image.height(); ++row) {
      for (int x = 0; x < image.width(); ++x) image.at(x, row) = texels.texel(level, x, row);
    }
    glTexImage2D(GL_TEXTURE_2D, level, codes, image.width(), image.height(), 0, GL_RGBA, GL_UNSIGNED_BYTE, image.data());
  }
}

GlTexture::GlTexture(const Texture2D& texels, const Sampler& sampler) {
  upload(texels);
  set_gl_sampler(sampler, texels.levels() > 1);
}

GlTexture::GlTexture(const Texture2D& texels, GLint wrap_t, float anisotropy) {
  upload(texels);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_REPEAT);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, wrap_t);
  if (anisotropy > 1.0f) glTexParameterf(GL_TEXTURE_2D, GL_TEXTURE_MAX_ANISOTROPY_EXT, anisotropy);
}

GlTarget::GlTarget(WorkloadSize size, GLenum color_format, GLenum depth_format, int samples)
    : size_(size), has_stencil_(depth_format == GL_DEPTH24_STENCIL8) {
  const GLenum kind = samples > 1 ? GL_TEXTURE_2D_MULTISAMPLE : GL_TEXTURE_2D;
  const auto texture = [&](GLenum internal, GLenum format, GLenum type) {
    GLuint id = 0;
    glGenTextures(1, &id);
    glBindTexture(kind, id);
    if (samples > 1) {
      glTexImage2DMultisample(kind, samples, internal, size.width, size.height, GL_TRUE);
      return id;
    }
    glTexImage2D(kind, 0, static_cast<GLint>(internal), size.width, size.height, 0, format, type, nullptr);
    glTexParameteri(kind, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glTexParameteri(kind, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    glTexParameteri(kind, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glTexParameteri(kind, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    return id;
  };
  glGenFramebuffers(1, &framebuffer_);
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
  if (color_format != 0) {
    color_ = texture(color_format, GL_RGBA, color_format == GL_RGBA16F ? GL_HALF_FLOAT : GL_UNSIGNED_BYTE);
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, kind, color_, 0);
  } else {
    glDrawBuffer(GL_NONE);
    glReadBuffer(GL_NONE);
  }
  if (has_stencil_) {
    depth_ = texture(depth_format, GL_DEPTH_STENCIL, GL_UNSIGNED_INT_24_8);
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_STENCIL_ATTACHMENT, kind, depth_, 0);
  } else if (depth_format != 0) {
    depth_ = texture(depth_format, GL_DEPTH_COMPONENT, GL_FLOAT);
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, kind, depth_, 0);
  }
  if (glCheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE) throw InputError("OpenGL: the framebuffer is incomplete");
}

GlTarget::~GlTarget() {
  glDeleteFramebuffers(1, &framebuffer_);
  glDeleteTextures(1, &color_);
  glDeleteTextures(1, &depth_);
}

void GlTarget::bind() const {
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
  glViewport(0, 0, size_.width, size_.height);
  const auto enable = [](GLenum what, bool on) { (on ? glEnable : glDisable)(what); };
  enable(GL_DEPTH_TEST, has_depth());
  enable(GL_CULL_FACE, has_depth());
  glDisable(GL_BLEND);
  glDepthFunc(GL_LESS);
  glDepthMask(GL_TRUE);
  glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
}

void GlTarget::clear(const glm::vec4& color) const {
  glClearColor(color.x, color.y, color.z, color.w);
  glClearDepth(1.0);
  glClear((color_ != 0 ? GL_COLOR_BUFFER_BIT : 0u) | (depth_ != 0 ? GL_DEPTH_BUFFER_BIT : 0u) |
          (has_stencil_ ? GL_STENCIL_BUFFER_BIT : 0u));
}

void GlTarget::resolve_into(const GlTarget& to) const {
  glBindFramebuffer(GL_READ_FRAMEBUFFER, framebuffer_);
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, to.framebuffer_);
  glBlitFramebuffer(0, 0, size_.width, size_.height, 0, 0, size_.width, size_.height, GL_COLOR_BUFFER_BIT, GL_NEAREST);
}

Image<glm::u8vec4> GlTarget::read_color() const {
  Image<glm::u8vec4> image(size_.width, size_.height);
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  glReadPixels(0, 0, size_.width, size_.height, GL_RGBA, GL_UNSIGNED_BYTE, image.data());
  return upright(image);
}

Image<float> GlTarget::read_depth() const {
  Image<float> image(size_.width, size_.height);
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
  glReadPixels(0, 0, size_.width, size_.height, GL_DEPTH_COMPONENT, GL_FLOAT, image.data());
  return upright(image);
}

}  // namespace halfspace
