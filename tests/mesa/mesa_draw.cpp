// SPDX-License-Identifier: Apache-2.0
#include "mesa/mesa_draw.h"

#include <algorithm>
#include <array>
#include <bit>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>

#include <epoxy/gl.h>

#include "mesa/mesa_state.h"

namespace halfspace::test {

namespace {

// ---- RAII wrappers for OpenGL objects -------------------------------------------------------------------------------

template <void (*const* generate)(GLsizei, GLuint*), void (*const* remove)(GLsizei, const GLuint*)>
struct Object {
  GLuint id = 0;
  Object() { (*generate)(1, &id); }
  Object(const Object&) = delete;
  Object& operator=(const Object&) = delete;
  ~Object() { (*remove)(1, &id); }
};
using Buffer = Object<&epoxy_glGenBuffers, &epoxy_glDeleteBuffers>;
using GlTexture = Object<&epoxy_glGenTextures, &epoxy_glDeleteTextures>;
using Framebuffer = Object<&epoxy_glGenFramebuffers, &epoxy_glDeleteFramebuffers>;
using Query = Object<&epoxy_glGenQueries, &epoxy_glDeleteQueries>;
using VertexArray = Object<&epoxy_glGenVertexArrays, &epoxy_glDeleteVertexArrays>;

// ---- shaders -------------------------------------------------------------------------------------------------------

void compile(GLuint program, GLenum stage, const char* shared, const char* source) {
  const std::array<const char*, 2> parts{shared, source};
  const GLuint shader = glCreateShader(stage);
  glShaderSource(shader, 2, parts.data(), nullptr);
  glCompileShader(shader);
  GLint good = 0;
  glGetShaderiv(shader, GL_COMPILE_STATUS, &good);
  if (!good) {
    std::array<char, 2000> log{};
    glGetShaderInfoLog(shader, static_cast<GLsizei>(log.size()), nullptr, log.data());
    throw std::runtime_error(std::string("GLSL: ") + log.data() + source);
  }
  glAttachShader(program, shader);
  glDeleteShader(shader);  // freed together with the program
}

void link(GLuint program) {
  glLinkProgram(program);
  GLint good = 0;
  glGetProgramiv(program, GL_LINK_STATUS, &good);
  if (!good) throw std::runtime_error("a GLSL program cannot be linked");
}

// ---- draw calls ----------------------------------------------------------------------------------------------------

GLenum type_of(const VertexStream& s) {
  if (s.read_as == ReadAs::halves) return GL_HALF_FLOAT;
  constexpr std::array<GLenum, 11> names{GL_FLOAT,
                                         GL_HALF_FLOAT,
                                         GL_DOUBLE,
                                         GL_UNSIGNED_BYTE,
                                         GL_BYTE,
                                         GL_UNSIGNED_SHORT,
                                         GL_SHORT,
                                         GL_UNSIGNED_INT,
                                         GL_INT,
                                         GL_UNSIGNED_INT_2_10_10_10_REV,
                                         GL_INT_2_10_10_10_REV};
  return names[static_cast<std::size_t>(s.type)];
}

void bind_stream(GLuint location, const Buffer& buffer, const VertexStream& s) {
  const std::size_t bytes = s.count == 0 ? 0 : (s.count - 1) * static_cast<std::size_t>(s.stride) + row_bytes(s);
  glBindBuffer(GL_ARRAY_BUFFER, buffer.id);
  glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(bytes), s.data, GL_STATIC_DRAW);
  glEnableVertexAttribArray(location);
  const GLint components = s.bgra ? GL_BGRA : s.components - s.missing;
  if (s.read_as == ReadAs::integers) {
    glVertexAttribIFormat(location, components, type_of(s), 0);
  } else {
    glVertexAttribFormat(location, components, type_of(s), s.read_as == ReadAs::normalized, 0);
  }
  glVertexAttribBinding(location, location);
  glBindVertexBuffer(location, buffer.id, 0, s.stride);  // a stride of 0 is a constant here, but not in glVertexAttribPointer
  glVertexBindingDivisor(location, s.divisor);
}

}  // namespace

void run(const MesaDraw& draw, const TargetSpec& target, MesaPrograms& programs) {
  const GLuint program = programs.of(draw);
  glUseProgram(program);
  const GlTexture texture;
  glBindTexture(GL_TEXTURE_2D, texture.id);
  draw.set_uniforms(UniformSetter(program));

  const VertexArray array;
  glBindVertexArray(array.id);
  const std::array<Buffer, kMaxStreams> buffers;
  for (int i = 0; i < draw.vertices.stream_count; ++i) {
    const auto s = static_cast<std::size_t>(i);
    bind_stream(static_cast<GLuint>(i), buffers[s], draw.vertices.streams[s]);
  }
  const Buffer indices;
  glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, indices.id);
  glBufferData(GL_ELEMENT_ARRAY_BUFFER, static_cast<GLsizeiptr>(draw.indices.size() * sizeof(uint32_t)), draw.indices.data(),
               GL_STATIC_DRAW);
  set_state(draw, target);
  glPatchParameteri(GL_PATCH_VERTICES, draw.patch_vertices);
  const DrawState& s = draw.state;
  const std::size_t first = std::min<std::size_t>(s.first, draw.indices.size()), rest = draw.indices.size() - first;
  glDrawElementsInstancedBaseVertexBaseInstance(gl(s.topology), static_cast<GLsizei>(std::min<std::size_t>(s.count.value_or(~0u), rest)),
                                                GL_UNSIGNED_INT, reinterpret_cast<const void*>(first * sizeof(uint32_t)),
                                                static_cast<GLsizei>(s.instances), s.base_vertex, s.base_instance);
}

namespace {

std::vector<ColorFormat> formats_of(const TargetSpec& target) {
  std::vector<ColorFormat> formats{target.format};
  formats.insert(formats.end(), target.more_formats.begin(), target.more_formats.end());
  return formats;
}

// A framebuffer with textures of the target's size and the given number of samples as attachments.
class Attachments {
 public:
  Attachments(const TargetSpec& target, int samples) {
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.id);
    std::vector<GLenum> places;
    for (const ColorFormat format : formats_of(target)) {
      places.push_back(GL_COLOR_ATTACHMENT0 + static_cast<GLenum>(places.size()));
      attach(colors_[places.size() - 1], places.back(), gl(format), target, samples);
    }
    glDrawBuffers(static_cast<GLsizei>(places.size()), places.data());
    const GLenum place = has_stencil(target.depth) ? GL_DEPTH_STENCIL_ATTACHMENT : GL_DEPTH_ATTACHMENT;
    if (target.depth != DepthFormat::none) attach(depth_, place, gl(target.depth), target, samples);
    if (glCheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE) throw std::runtime_error("the framebuffer is incomplete");
  }
  GLuint framebuffer() const { return framebuffer_.id; }
  GLuint color_texture(std::size_t attachment) const { return colors_[attachment].id; }
  // Selects one of the color attachments. The framebuffer must be bound.
  void draw_into(GLenum attachment) const {
    std::array<GLenum, 8> places{};
    places[attachment] = GL_COLOR_ATTACHMENT0 + attachment;
    glDrawBuffers(static_cast<GLsizei>(attachment + 1), places.data());
  }

 private:
  static void attach(const GlTexture& texture, GLenum attachment, GLenum format, const TargetSpec& target, int samples) {
    if (target.layers > 1) return attach_layers(texture, attachment, format, target);
    const GLenum kind = samples > 1 ? GL_TEXTURE_2D_MULTISAMPLE : GL_TEXTURE_2D;
    glBindTexture(kind, texture.id);
    if (samples > 1) {
      glTexStorage2DMultisample(kind, samples, format, target.width, target.height, GL_TRUE);
    } else {
      glTexStorage2D(kind, 1, format, target.width, target.height);
    }
    glFramebufferTexture2D(GL_FRAMEBUFFER, attachment, kind, texture.id, 0);
  }

  static void attach_layers(const GlTexture& texture, GLenum attachment, GLenum format, const TargetSpec& target) {
    const GLenum kind = gl(target.kind);
    glBindTexture(kind, texture.id);
    if (target.kind == TextureKind::cube) {
      glTexStorage2D(kind, 1, format, target.width, target.height);
    } else {
      glTexStorage3D(kind, 1, format, target.width, target.height, target.layers);
    }
    glFramebufferTexture(GL_FRAMEBUFFER, attachment, texture.id, 0);
  }

  Framebuffer framebuffer_;
  std::array<GlTexture, 8> colors_;
  GlTexture depth_;
};

// Clears a color attachment of the bound framebuffer. Integers are the bits of floats.
void clear_color(ColorFormat format, std::size_t attachment, const glm::vec4& color) {
  const auto number = static_cast<GLint>(attachment);
  const auto bits = std::bit_cast<glm::ivec4>(color);
  const auto unsigned_bits = std::bit_cast<glm::uvec4>(color);
  switch (color_type(format)) {
    case ColorType::real: return glClearBufferfv(GL_COLOR, number, &color.x);
    case ColorType::signed_integer: return glClearBufferiv(GL_COLOR, number, &bits.x);
    case ColorType::unsigned_integer: return glClearBufferuiv(GL_COLOR, number, &unsigned_bits.x);
  }
}

void clear(const TargetSpec& target) {
  glDisable(GL_SCISSOR_TEST);
  glDepthMask(GL_TRUE);
  glStencilMask(0xff);
  glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  glClearDepth(static_cast<double>(target.clear_depth));
  glClearStencil(target.clear_stencil);
  glClear(GL_DEPTH_BUFFER_BIT | GL_STENCIL_BUFFER_BIT);
  const std::vector<ColorFormat> formats = formats_of(target);
  for (std::size_t i = 0; i < formats.size(); ++i) clear_color(formats[i], i, target.clear_color);
}

// Clears a part of the bound framebuffer.
void clear(const ClearValues& values, const std::vector<ColorFormat>& formats) {
  enable(GL_SCISSOR_TEST, values.rect.has_value());
  if (values.rect) glScissor(values.rect->x, values.rect->y, values.rect->width, values.rect->height);
  glColorMask(values.mask.r, values.mask.g, values.mask.b, values.mask.a);
  glDepthMask(GL_TRUE);
  glStencilMask(values.stencil_mask);
  for (std::size_t i = 0; i < formats.size(); ++i) {
    if (values.colors[i]) clear_color(formats[i], i, *values.colors[i]);
  }
  if (values.depth) glClearBufferfv(GL_DEPTH, 0, &*values.depth);
  const GLint stencil = values.stencil.value_or(0);
  if (values.stencil) glClearBufferiv(GL_STENCIL, 0, &stencil);
}

// Draws to the bound framebuffer.
void draw_all(const TargetSpec& target, const std::vector<MesaDraw>& draws, MesaPrograms& programs) {
  enable(GL_FRAMEBUFFER_SRGB, true);  // has no effect on other formats
  glDisable(GL_DITHER);
  enable(GL_MULTISAMPLE, true);
  clear(target);
  std::map<uint32_t, Query> queries;  // of one draw each
  for (const MesaDraw& draw : draws) {
    const DrawState& s = draw.state;
    const auto begin = [&](const DrawCondition& c) {
      glBeginConditionalRender(queries.at(c.query).id, c.inverted ? GL_QUERY_WAIT_INVERTED : GL_QUERY_WAIT);
    };
    if (draw.clear) {
      if (draw.clear->condition) begin(*draw.clear->condition);
      clear(*draw.clear, formats_of(target));
      if (draw.clear->condition) glEndConditionalRender();
    }
    if (s.condition) begin(*s.condition);
    if (s.query) glBeginQuery(GL_SAMPLES_PASSED, queries[*s.query].id);
    run(draw, target, programs);
    if (s.query) glEndQuery(GL_SAMPLES_PASSED);
    if (s.condition) glEndConditionalRender();
  }
}

}  // namespace

void expect_no_error() {
  if (const GLenum error = glGetError(); error != GL_NO_ERROR) throw std::runtime_error("OpenGL error " + std::to_string(error));
}

namespace {

// The first row in OpenGL is the lowest; in our images it is the top row.
template <class T>
void read(Image<T>& image, GLenum format, GLenum type) {
  for (int row = 0; row < image.height(); ++row)
    glReadPixels(0, image.height() - 1 - row, image.width(), 1, format, type, image.row(row).data());
}

}  // namespace

int UniformSetter::location(const char* name) const { return glGetUniformLocation(program_, name); }
void UniformSetter::operator()(const char* name, int v) const { glUniform1i(location(name), v); }
void UniformSetter::operator()(const char* name, float v) const { glUniform1f(location(name), v); }
void UniformSetter::operator()(const char* name, const glm::vec2& v) const { glUniform2fv(location(name), 1, &v.x); }
void UniformSetter::operator()(const char* name, const glm::vec3& v) const { glUniform3fv(location(name), 1, &v.x); }
void UniformSetter::operator()(const char* name, const glm::vec4& v) const { glUniform4fv(location(name), 1, &v.x); }
void UniformSetter::operator()(const char* name, const glm::mat4& v) const { glUniformMatrix4fv(location(name), 1, GL_FALSE, &v[0].x); }

void UniformSetter::operator()(const char* name, const Texture2D& texture, const Sampler& sampler) const {
  glUniform1i(location(name), 0);
  const GLenum format = texture.format() == TexelFormat::srgb8a8 ? GL_SRGB8_ALPHA8 : GL_RGBA8;
  glTexStorage2D(GL_TEXTURE_2D, texture.levels(), format, texture.width(), texture.height());
  for (int level = 0; level < texture.levels(); ++level) {
    std::vector<glm::u8vec4> texels;
    for (int y = 0; y < texture.height(level); ++y)
      for (int x = 0; x < texture.width(level); ++x) texels.push_back(texture.texel(level, x, y));
    glTexSubImage2D(GL_TEXTURE_2D, level, 0, 0, texture.width(level), texture.height(level), GL_RGBA, GL_UNSIGNED_BYTE, texels.data());
  }
  const auto set = [](GLenum what, GLenum value) { glTexParameteri(GL_TEXTURE_2D, what, static_cast<GLint>(value)); };
  const auto wrap = [](Wrap w) -> GLenum {
    constexpr std::array<GLenum, 4> names{GL_REPEAT, GL_MIRRORED_REPEAT, GL_CLAMP_TO_EDGE, GL_CLAMP_TO_BORDER};
    return names[static_cast<std::size_t>(w)];
  };
  set(GL_TEXTURE_MAG_FILTER, sampler.mag == Filter::nearest ? GL_NEAREST : GL_LINEAR);
  set(GL_TEXTURE_MIN_FILTER, sampler.min == Filter::nearest    ? GL_NEAREST
                             : sampler.min == Filter::bilinear ? GL_LINEAR
                                                               : GL_LINEAR_MIPMAP_LINEAR);
  set(GL_TEXTURE_WRAP_S, wrap(sampler.wrap_s));
  set(GL_TEXTURE_WRAP_T, wrap(sampler.wrap_t));
}

MesaPrograms::~MesaPrograms() {
  for (const auto& [sources, program] : programs_) glDeleteProgram(program);
}

unsigned MesaPrograms::of(const MesaDraw& draw) {
  unsigned& program =
      programs_[{draw.shared_glsl, draw.vertex_glsl, draw.control_glsl, draw.evaluation_glsl, draw.geometry_glsl, draw.fragment_glsl}];
  if (program == 0) {
    program = glCreateProgram();
    compile(program, GL_VERTEX_SHADER, draw.shared_glsl, draw.vertex_glsl);
    if (draw.control_glsl != nullptr) {
      compile(program, GL_TESS_CONTROL_SHADER, draw.shared_glsl, draw.control_glsl);
      compile(program, GL_TESS_EVALUATION_SHADER, draw.shared_glsl, draw.evaluation_glsl);
    }
    if (draw.geometry_glsl != nullptr) compile(program, GL_GEOMETRY_SHADER, draw.shared_glsl, draw.geometry_glsl);
    compile(program, GL_FRAGMENT_SHADER, draw.shared_glsl, draw.fragment_glsl);
    link(program);
  }
  return program;
}

namespace {

// Returns the colors of an attachment of the bound framebuffer.
std::vector<glm::dvec4> read_colors(const TargetSpec& target, ColorFormat format, GLenum attachment) {
  const std::size_t pixels = static_cast<std::size_t>(target.width) * static_cast<std::size_t>(target.height);
  glReadBuffer(attachment);
  glClampColor(GL_CLAMP_READ_COLOR, GL_FALSE);  // signed normalized formats would be clamped to [0, 1]
  const auto read_as = [&](auto values, GLenum layout, GLenum type) {
    values.resize(pixels);
    glReadPixels(0, 0, target.width, target.height, layout, type, values.data());
    return std::vector<glm::dvec4>(values.begin(), values.end());
  };
  switch (color_type(format)) {
    case ColorType::signed_integer: return read_as(std::vector<glm::ivec4>(), GL_RGBA_INTEGER, GL_INT);
    case ColorType::unsigned_integer: return read_as(std::vector<glm::uvec4>(), GL_RGBA_INTEGER, GL_UNSIGNED_INT);
    case ColorType::real: break;
  }
  return read_as(std::vector<glm::vec4>(), GL_RGBA, GL_FLOAT);
}

// Returns the real colors of all layers of a texture.
std::vector<glm::dvec4> read_layers(const TargetSpec& target, GLuint texture) {
  std::vector<glm::vec4> colors(static_cast<std::size_t>(target.width) * static_cast<std::size_t>(target.height * target.layers));
  glGetTextureImage(texture, 0, GL_RGBA, GL_FLOAT, static_cast<GLsizei>(colors.size() * sizeof(glm::vec4)), colors.data());
  return {colors.begin(), colors.end()};
}

}  // namespace

std::vector<std::vector<glm::dvec4>> colors_by_mesa(const TargetSpec& target, const std::vector<MesaDraw>& draws, MesaPrograms& programs) {
  const Attachments drawn(target, target.samples);
  draw_all(target, draws, programs);
  const std::vector<ColorFormat> formats = formats_of(target);
  std::optional<Attachments> resolved;
  if (target.samples > 1) {
    resolved.emplace(target, 1);
    glBindFramebuffer(GL_READ_FRAMEBUFFER, drawn.framebuffer());
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, resolved->framebuffer());
    glDisable(GL_SCISSOR_TEST);
    for (GLenum i = 0; i < formats.size(); ++i) {
      glReadBuffer(GL_COLOR_ATTACHMENT0 + i);
      resolved->draw_into(i);
      glBlitFramebuffer(0, 0, target.width, target.height, 0, 0, target.width, target.height, GL_COLOR_BUFFER_BIT, GL_NEAREST);
    }
    glBindFramebuffer(GL_FRAMEBUFFER, resolved->framebuffer());
  }
  std::vector<std::vector<glm::dvec4>> colors;
  for (std::size_t i = 0; target.layers > 1 && i < formats.size(); ++i) colors.push_back(read_layers(target, drawn.color_texture(i)));
  for (GLenum i = 0; target.layers == 1 && i < formats.size(); ++i)
    colors.push_back(read_colors(target, formats[i], GL_COLOR_ATTACHMENT0 + i));
  expect_no_error();
  return colors;
}

Picture draw_with_mesa(const TargetSpec& target, const std::vector<MesaDraw>& draws) {
  HS_CHECK_OP(target.width, !=, 512);
  const Attachments attachments(target, 1);
  MesaPrograms programs;
  draw_all(target, draws, programs);
  Picture picture{Image<glm::u8vec4>(target.width, target.height), Image<float>(target.width, target.height)};
  read(picture.color, GL_RGBA, GL_UNSIGNED_BYTE);
  read(picture.depth, GL_DEPTH_COMPONENT, GL_FLOAT);
  expect_no_error();
  return picture;
}

}  // namespace halfspace::test
