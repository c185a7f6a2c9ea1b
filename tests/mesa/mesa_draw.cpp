// SPDX-License-Identifier: Apache-2.0
#include "mesa_draw.h"

#include <array>
#include <optional>
#include <stdexcept>
#include <string>

#include <epoxy/gl.h>

namespace halfspace::test {

namespace {

// ---- objects that delete themselves --------------------------------------------------------------------------------

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
  glDeleteShader(shader);  // when the program goes
}

void link(GLuint program) {
  glLinkProgram(program);
  GLint good = 0;
  glGetProgramiv(program, GL_LINK_STATUS, &good);
  if (!good) throw std::runtime_error("a GLSL program does not link");
}

// ---- state ---------------------------------------------------------------------------------------------------------

GLenum gl(Topology t) {
  switch (t) {
    case Topology::triangles: return GL_TRIANGLES;
    case Topology::triangle_strip: return GL_TRIANGLE_STRIP;
    case Topology::triangle_fan: return GL_TRIANGLE_FAN;
    case Topology::points: return GL_POINTS;
    case Topology::lines: return GL_LINES;
    case Topology::line_strip: return GL_LINE_STRIP;
    case Topology::line_loop: return GL_LINE_LOOP;
  }
  return GL_TRIANGLES;
}

void enable(GLenum what, bool on) { (on ? glEnable : glDisable)(what); }

GLenum gl(CompareOp op) {
  constexpr std::array<GLenum, 8> k{GL_NEVER, GL_LESS, GL_EQUAL, GL_LEQUAL, GL_GREATER, GL_NOTEQUAL, GL_GEQUAL, GL_ALWAYS};
  return k[static_cast<std::size_t>(op)];
}
GLenum gl(BlendFactor f) {
  constexpr std::array<GLenum, 19> k{GL_ZERO,
                                     GL_ONE,
                                     GL_SRC_COLOR,
                                     GL_ONE_MINUS_SRC_COLOR,
                                     GL_DST_COLOR,
                                     GL_ONE_MINUS_DST_COLOR,
                                     GL_SRC_ALPHA,
                                     GL_ONE_MINUS_SRC_ALPHA,
                                     GL_DST_ALPHA,
                                     GL_ONE_MINUS_DST_ALPHA,
                                     GL_CONSTANT_COLOR,
                                     GL_ONE_MINUS_CONSTANT_COLOR,
                                     GL_CONSTANT_ALPHA,
                                     GL_ONE_MINUS_CONSTANT_ALPHA,
                                     GL_SRC_ALPHA_SATURATE,
                                     GL_SRC1_COLOR,
                                     GL_ONE_MINUS_SRC1_COLOR,
                                     GL_SRC1_ALPHA,
                                     GL_ONE_MINUS_SRC1_ALPHA};
  return k[static_cast<std::size_t>(f)];
}
GLenum gl(BlendEquation e) {
  constexpr std::array<GLenum, 5> k{GL_FUNC_ADD, GL_FUNC_SUBTRACT, GL_FUNC_REVERSE_SUBTRACT, GL_MIN, GL_MAX};
  return k[static_cast<std::size_t>(e)];
}

GLenum gl(StencilOp op) {
  constexpr std::array<GLenum, 8> k{GL_KEEP, GL_ZERO, GL_REPLACE, GL_INCR, GL_DECR, GL_INVERT, GL_INCR_WRAP, GL_DECR_WRAP};
  return k[static_cast<std::size_t>(op)];
}

void set_stencil_state(const std::optional<StencilState>& s) {
  enable(GL_STENCIL_TEST, s.has_value());
  if (!s) return;
  for (const auto& [face, f] : {std::pair(GL_FRONT, s->front), std::pair(GL_BACK, s->back)}) {
    glStencilFuncSeparate(face, gl(f.compare), f.reference, f.read_mask);
    glStencilOpSeparate(face, gl(f.fail), gl(f.depth_fail), gl(f.pass));
    glStencilMaskSeparate(face, f.write_mask);
  }
}

void set_sample_state(const DrawState& s) {
  enable(GL_SAMPLE_MASK, s.sample_mask != ~0u);
  glSampleMaski(0, s.sample_mask);
  enable(GL_SAMPLE_ALPHA_TO_COVERAGE, s.alpha_to_coverage);
  enable(GL_SAMPLE_SHADING, s.sample_shading);
  glMinSampleShading(1.0f);
}

void set_depth_state(const DepthState& d) {
  enable(GL_DEPTH_TEST, d.test);
  glDepthFunc(gl(d.compare));
  glDepthMask(d.write);
  glClipControl(GL_LOWER_LEFT, d.clip == ClipDepth::zero_to_one ? GL_ZERO_TO_ONE : GL_NEGATIVE_ONE_TO_ONE);
  enable(GL_DEPTH_CLAMP, d.clamp);
  glDepthRangef(d.range_near, d.range_far);
}

void set_state(const DrawState& s, const TargetSpec& target) {
  const Rect v = s.viewport.value_or(Rect{0, 0, target.width, target.height});
  glViewport(v.x, v.y, v.width, v.height);
  enable(GL_SCISSOR_TEST, s.scissor.has_value());
  if (s.scissor) glScissor(s.scissor->x, s.scissor->y, s.scissor->width, s.scissor->height);
  enable(GL_CULL_FACE, s.cull != CullMode::none);
  if (s.cull != CullMode::none) glCullFace(s.cull == CullMode::front ? GL_FRONT : s.cull == CullMode::back ? GL_BACK : GL_FRONT_AND_BACK);
  glFrontFace(s.front == Winding::counter_clockwise ? GL_CCW : GL_CW);
  glProvokingVertex(s.provoking == ProvokingVertex::last ? GL_LAST_VERTEX_CONVENTION : GL_FIRST_VERTEX_CONVENTION);
  set_depth_state(s.depth);
  set_stencil_state(s.stencil);
  set_sample_state(s);
  enable(GL_POLYGON_OFFSET_FILL, s.offset.slope != 0.0f || s.offset.constant != 0.0f);
  glPolygonOffsetClamp(s.offset.slope, s.offset.constant, s.offset.clamp);
  glPointSize(s.point_size);
  glPointParameteri(GL_POINT_SPRITE_COORD_ORIGIN, s.point_origin == PointOrigin::upper_left ? GL_UPPER_LEFT : GL_LOWER_LEFT);
  glLineWidth(s.line_width);
  glPolygonMode(GL_FRONT_AND_BACK, s.polygon_mode == PolygonMode::fill   ? GL_FILL
                                   : s.polygon_mode == PolygonMode::line ? GL_LINE
                                                                         : GL_POINT);
  glColorMask(s.color_mask.r, s.color_mask.g, s.color_mask.b, s.color_mask.a);
  if (s.blend) glBlendColor(s.blend->constant.x, s.blend->constant.y, s.blend->constant.z, s.blend->constant.w);
  enable(GL_BLEND, s.blend.has_value());
  if (s.blend) {
    glBlendEquationSeparate(gl(s.blend->color_equation), gl(s.blend->alpha_equation));
    glBlendFuncSeparate(gl(s.blend->source_color), gl(s.blend->destination_color), gl(s.blend->source_alpha),
                        gl(s.blend->destination_alpha));
  }
}

// What is of a draw besides its DrawState.
void set_state(const MesaDraw& draw, const TargetSpec& target) {
  set_state(draw.state, target);
  enable(GL_PRIMITIVE_RESTART_FIXED_INDEX, draw.restart);
  enable(GL_PROGRAM_POINT_SIZE, draw.own_point_size);
  for (int i = 0; i < 8; ++i) enable(GL_CLIP_DISTANCE0 + static_cast<GLenum>(i), i < draw.clip_distances);
}

// ---- a draw --------------------------------------------------------------------------------------------------------

void bind_stream(GLuint location, const Buffer& buffer, const VertexStream& s) {
  const std::size_t floats = s.count == 0 ? 0 : (s.count - 1) * static_cast<std::size_t>(s.stride) + static_cast<std::size_t>(s.components);
  glBindBuffer(GL_ARRAY_BUFFER, buffer.id);
  glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(floats * sizeof(float)), s.data, GL_STATIC_DRAW);
  glEnableVertexAttribArray(location);
  glVertexAttribPointer(location, s.components, GL_FLOAT, GL_FALSE, s.stride * static_cast<GLsizei>(sizeof(float)), nullptr);
  glVertexAttribDivisor(location, s.divisor);
}

void run(const MesaDraw& draw, const TargetSpec& target, MesaPrograms& programs) {
  const GLuint program = programs.of(draw);
  glUseProgram(program);
  const GlTexture texture;
  glBindTexture(GL_TEXTURE_2D, texture.id);
  draw.set_uniforms(UniformSetter(program));

  const VertexArray array;
  glBindVertexArray(array.id);
  const std::array<Buffer, kMostStreams> buffers;
  for (int i = 0; i < draw.vertices.stream_count; ++i) {
    const auto s = static_cast<std::size_t>(i);
    bind_stream(static_cast<GLuint>(i), buffers[s], draw.vertices.streams[s]);
  }
  const Buffer indices;
  glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, indices.id);
  glBufferData(GL_ELEMENT_ARRAY_BUFFER, static_cast<GLsizeiptr>(draw.indices.size() * sizeof(uint32_t)), draw.indices.data(),
               GL_STATIC_DRAW);
  set_state(draw, target);
  glDrawElementsInstancedBaseVertex(gl(draw.state.topology), static_cast<GLsizei>(draw.indices.size()), GL_UNSIGNED_INT, nullptr,
                                    static_cast<GLsizei>(draw.state.instances), draw.state.base_vertex);
}

GLenum gl(ColorFormat f) {
  constexpr std::array<GLenum, 5> k{GL_NONE, GL_RGBA8, GL_SRGB8_ALPHA8, GL_RGBA16F, GL_RGBA32F};
  return k[static_cast<std::size_t>(f)];
}
GLenum gl(DepthFormat f) {
  constexpr std::array<GLenum, 6> k{
      GL_NONE, GL_DEPTH_COMPONENT16, GL_DEPTH_COMPONENT24, GL_DEPTH_COMPONENT32F, GL_DEPTH24_STENCIL8, GL_DEPTH32F_STENCIL8};
  return k[static_cast<std::size_t>(f)];
}

// Textures of a size and number of samples as the framebuffer's attachments.
class Attachments {
 public:
  Attachments(const TargetSpec& target, int samples) {
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.id);
    attach(color_, GL_COLOR_ATTACHMENT0, gl(target.format), target, samples);
    const GLenum place = has_stencil(target.depth) ? GL_DEPTH_STENCIL_ATTACHMENT : GL_DEPTH_ATTACHMENT;
    if (target.depth != DepthFormat::none) attach(depth_, place, gl(target.depth), target, samples);
    if (glCheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE) throw std::runtime_error("the framebuffer is not complete");
  }
  GLuint framebuffer() const { return framebuffer_.id; }

 private:
  static void attach(const GlTexture& texture, GLenum attachment, GLenum format, const TargetSpec& target, int samples) {
    const GLenum kind = samples > 1 ? GL_TEXTURE_2D_MULTISAMPLE : GL_TEXTURE_2D;
    glBindTexture(kind, texture.id);
    if (samples > 1) {
      glTexStorage2DMultisample(kind, samples, format, target.width, target.height, GL_TRUE);
    } else {
      glTexStorage2D(kind, 1, format, target.width, target.height);
    }
    glFramebufferTexture2D(GL_FRAMEBUFFER, attachment, kind, texture.id, 0);
  }

  Framebuffer framebuffer_;
  GlTexture color_, depth_;
};

void clear(const TargetSpec& target) {
  glDisable(GL_SCISSOR_TEST);
  glDepthMask(GL_TRUE);
  glStencilMask(0xff);
  glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  glClearColor(target.clear_color.x, target.clear_color.y, target.clear_color.z, target.clear_color.w);
  glClearDepth(static_cast<double>(target.clear_depth));
  glClearStencil(target.clear_stencil);
  glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT | GL_STENCIL_BUFFER_BIT);
}

// Draws into the bound framebuffer.
void draw_all(const TargetSpec& target, const std::vector<MesaDraw>& draws, MesaPrograms& programs) {
  enable(GL_FRAMEBUFFER_SRGB, target.format == ColorFormat::srgb8a8);
  glDisable(GL_DITHER);
  enable(GL_MULTISAMPLE, true);
  clear(target);
  for (const MesaDraw& draw : draws) run(draw, target, programs);
}

void expect_no_error() {
  if (const GLenum error = glGetError(); error != GL_NO_ERROR) throw std::runtime_error("OpenGL error " + std::to_string(error));
}

// GL's first row is the lowest; ours is the top one.
template <class T>
void read(Image<T>& image, GLenum format, GLenum type) {
  for (int row = 0; row < image.height(); ++row)
    glReadPixels(0, image.height() - 1 - row, image.width(), 1, format, type, image.row(row).data());
}

}  // namespace

int UniformSetter::location(const char* name) const { return glGetUniformLocation(program_, name); }
void UniformSetter::operator()(const char* name, float v) const { glUniform1f(location(name), v); }
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
  unsigned& program = programs_[{draw.shared_glsl, draw.vertex_glsl, draw.fragment_glsl}];
  if (program == 0) {
    program = glCreateProgram();
    compile(program, GL_VERTEX_SHADER, draw.shared_glsl, draw.vertex_glsl);
    compile(program, GL_FRAGMENT_SHADER, draw.shared_glsl, draw.fragment_glsl);
    link(program);
  }
  return program;
}

std::vector<glm::vec4> colors_by_mesa(const TargetSpec& target, const std::vector<MesaDraw>& draws, MesaPrograms& programs) {
  const Attachments drawn(target, target.samples);
  draw_all(target, draws, programs);
  std::optional<Attachments> resolved;
  if (target.samples > 1) {
    resolved.emplace(target, 1);
    glBindFramebuffer(GL_READ_FRAMEBUFFER, drawn.framebuffer());
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, resolved->framebuffer());
    glDisable(GL_SCISSOR_TEST);
    glBlitFramebuffer(0, 0, target.width, target.height, 0, 0, target.width, target.height, GL_COLOR_BUFFER_BIT, GL_NEAREST);
    glBindFramebuffer(GL_FRAMEBUFFER, resolved->framebuffer());
  }
  std::vector<glm::vec4> colors(static_cast<std::size_t>(target.width) * static_cast<std::size_t>(target.height));
  glReadPixels(0, 0, target.width, target.height, GL_RGBA, GL_FLOAT, colors.data());
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
