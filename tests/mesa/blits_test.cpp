// SPDX-License-Identifier: Apache-2.0
//
// Blits and resolves by Mesa's glBlitFramebuffer: the cases of tests/conformance/blits.h with the same texels.
//
// HALFSPACE_MESA_PIXELS=1 prints the texels that differ.
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>

#include <epoxy/gl.h>

#include "conformance/blits.h"
#include "mesa/mesa_context.h"
#include "mesa/mesa_draw.h"
#include "mesa/twin_frame.h"
#include "support/long_tests.h"

namespace halfspace::test {
namespace framebuffer_blits {
namespace {

using conformance::blits::blit_cases;
using conformance::blits::BlitCase;
using conformance::blits::compared_channels;
using conformance::blits::fill_source;
using conformance::blits::Texel;
using conformance::blits::texels_in_double;
using conformance::blits::value_of;

/// A framebuffer with a texture as its only attachment.
class Framebuffer {
 public:
  explicit Framebuffer(const TwinTexture& texture) {
    const TexelFormat format = texture.format();
    const GLenum place = has_stencil(format) ? GL_DEPTH_STENCIL_ATTACHMENT : is_depth(format) ? GL_DEPTH_ATTACHMENT : GL_COLOR_ATTACHMENT0;
    glCreateFramebuffers(1, &id_);
    glNamedFramebufferTexture(id_, place, texture.mesa(), 0);
  }
  Framebuffer(const Framebuffer&) = delete;
  Framebuffer& operator=(const Framebuffer&) = delete;
  ~Framebuffer() { glDeleteFramebuffers(1, &id_); }

  GLuint id() const { return id_; }
  /// Whether Mesa can draw to the format.
  bool is_complete() const { return glCheckNamedFramebufferStatus(id_, GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE; }

 private:
  GLuint id_ = 0;
};

void blit_by_mesa(const BlitCase& c, const Framebuffer& from, const Framebuffer& to) {
  const GLbitfield what = has_stencil(c.from) ? GL_DEPTH_BUFFER_BIT | GL_STENCIL_BUFFER_BIT
                          : is_depth(c.from)  ? GL_DEPTH_BUFFER_BIT
                                              : GL_COLOR_BUFFER_BIT;
  const Rect all{0, 0, c.to_size.width, c.to_size.height};
  const Rect f = c.resolve ? all : c.from_rect, t = c.resolve ? all : c.to_rect;
  glEnable(GL_FRAMEBUFFER_SRGB);  // colors are converted and blended in linear light
  glDisable(GL_SCISSOR_TEST);
  glBlitNamedFramebuffer(from.id(), to.id(), f.x, f.y, f.x + f.width, f.y + f.height, t.x, t.y, t.x + t.width, t.y + t.height, what,
                         c.filter == BlitFilter::linear ? GL_LINEAR : GL_NEAREST);
  glDisable(GL_FRAMEBUFFER_SRGB);
  expect_no_error();
}

struct Agreement {
  int cases = 0, unsupported = 0, texels = 0, differing = 0;
};

/// Returns the allowed difference of a channel.
double tolerance(const BlitCase& c, const Texel& expected, int k) {
  // Both round to the format, maybe to different sides.
  double allowed = expected.step[k] + 2.0 * expected.error[k];
  // Mesa computes positions in float, with an error of up to 2^-19 texels, which is the error of a weight.
  if (c.filter == BlitFilter::linear) allowed += 16.0 * expected.error[k];
  // llvmpipe approximates the sRGB curve by a polynomial.
  if (texel_info(c.from).kind == TexelKind::srgb || texel_info(c.to).kind == TexelKind::srgb) allowed += 0.0012;
  // It copies depths of 24 bits as floats, with an error of a code.
  if (k == 0 && (c.to == TexelFormat::d24 || c.to == TexelFormat::d24s8)) allowed += 1.01 / 16777215.0;
  return allowed;
}

void compare_with_mesa(const BlitCase& c, Agreement& sum) {
  const bool has_samples = c.resolve && c.from_size.depth > 1;
  TwinTexture layers(has_samples ? TextureKind::two_d_array : TextureKind::two_d, c.from, c.from_size),
      to(TextureKind::two_d, c.to, c.to_size);
  fill_source(layers.ours());
  layers.upload();
  to.upload();
  std::optional<TwinTexture> samples;
  if (has_samples) samples.emplace(TextureKind::multisample, c.from, c.from_size);
  TwinTexture& from = has_samples ? *samples : layers;
  const Framebuffer source(from), destination(to);
  if (!source.is_complete() || !destination.is_complete()) {
    ++sum.unsupported;
    return;
  }
  if (has_samples) from.copy_samples(layers);
  blit_by_mesa(c, source, destination);
  conformance::blits::run(c, from.ours(), to.ours());
  TextureMemory mesa(TextureKind::two_d, c.to, c.to_size);
  to.download(mesa);

  const std::vector<Texel> expected = texels_in_double(c, from.ours());
  int differing = 0;
  for (int y = 0; y < c.to_size.height; ++y) {
    for (int x = 0; x < c.to_size.width; ++x) {
      const glm::dvec4 ours = value_of(c.to, to.ours().level().at(x, y)), theirs = value_of(c.to, mesa.level().at(x, y));
      const Texel& e = expected[static_cast<std::size_t>(y * c.to_size.width + x)];
      if (e.varies) continue;
      ++sum.texels;
      bool differs = false;
      for (int k = 0; k < compared_channels(c.to); ++k) differs |= !(std::fabs(ours[k] - theirs[k]) <= tolerance(c, e, k));
      differing += differs;
      if (differs && std::getenv("HALFSPACE_MESA_PIXELS") != nullptr)
        std::printf("    %s, x %d y %d: Halfspace %.9g %.9g %.9g %.9g, Mesa %.9g %.9g %.9g %.9g, reference %.9g %.9g %.9g %.9g\n",
                    c.name.c_str(), x, y, ours.x, ours.y, ours.z, ours.w, theirs.x, theirs.y, theirs.z, theirs.w, e.value.x, e.value.y,
                    e.value.z, e.value.w);
    }
  }
  EXPECT_EQ(differing, 0) << c.name;
  ++sum.cases;
  sum.differing += differing;
}

class MesaBlits : public MesaTest {};

TEST_F(MesaBlits, Agree) {
  Agreement sum;
  const std::size_t step = runs_long_tests() ? 1 : 17;  // llvmpipe compiles code for each pair of formats
  const conformance::blits::BlitCases cases = blit_cases();
  for (std::size_t i = 0; i < cases.size(); i += step) {
    if (cases[i].not_by_mesa == nullptr) compare_with_mesa(cases[i], sum);
  }
  std::printf("%d cases, %d texels, %d differ; %d cases have formats that Mesa does not draw to\n", sum.cases, sum.texels, sum.differing,
              sum.unsupported);
  EXPECT_GT(sum.cases, 0);
}

}  // namespace
}  // namespace framebuffer_blits
}  // namespace halfspace::test
