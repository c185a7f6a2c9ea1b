// SPDX-License-Identifier: Apache-2.0
//
// The table of the matrix.
#include <vector>

#include "matrix/matrix.h"

namespace halfspace {

namespace {

using enum MatrixMesh;
using Shader = MatrixShader;

DrawState blending(const BlendState& blend) {
  DrawState state = kAlphaBlendState;
  state.blend = blend;
  return state;
}
// Returns a blend state with the same equation and factors for color and alpha.
BlendState equation(BlendEquation e, BlendFactor source, BlendFactor destination) {
  return {.color_equation = e,
          .source_color = source,
          .destination_color = destination,
          .alpha_equation = e,
          .source_alpha = source,
          .destination_alpha = destination,
          .constant = {0.2f, 0.5f, 0.7f, 0.6f}};
}
BlendState add(BlendFactor source, BlendFactor destination) { return equation(BlendEquation::add, source, destination); }

DrawState stencil(const StencilFace& face) {
  DrawState state;
  state.stencil = StencilState{face, face};
  return state;
}
DrawState topology(Topology t) {
  DrawState state;
  state.topology = t;
  state.point_size = 6.0f;
  return state;
}
DrawState mask(const ColorMask& m) {
  DrawState state;
  state.color_mask = m;
  return state;
}
Sampler filter(Filter f) { return {.mag = f, .min = f}; }
Sampler wrap(Wrap w) { return {.wrap_s = w, .wrap_t = w, .border_color = {0.2f, 0.4f, 0.8f, 1.0f}}; }

void add_targets(std::vector<MatrixRow>& rows) {
  DrawState sample_shading, to_coverage;
  sample_shading.sample_shading = true;
  to_coverage.alpha_to_coverage = true;
  const auto row = [&](const MatrixRow& r) { rows.push_back(r); };
  row({.name = "plain", .what = "one texture, diffuse light, depth test", .is_exact = true});
  row({.name = "srgb", .what = "an sRGB target", .color = ColorFormat::srgb8a8});
  row({.name = "half_target", .what = "a half-float target", .color = ColorFormat::rgba16f});
  row({.name = "d24s8", .what = "24-bit depth and 8-bit stencil", .depth = DepthFormat::d24s8});
  row({.name = "stencil_test",
       .what = "a stencil test without writes",
       .depth = DepthFormat::d24s8,
       .state = stencil({.compare = CompareOp::not_equal, .reference = 1})});
  row({.name = "stencil_write",
       .what = "the stencil test draws each pixel only once",
       .depth = DepthFormat::d24s8,
       .state = stencil({.compare = CompareOp::equal, .pass = StencilOp::increment_clamp})});
  row({.name = "msaa2", .what = "2 samples", .samples = 2});
  row({.name = "msaa4", .what = "4 samples", .samples = 4});
  row({.name = "msaa8", .what = "8 samples", .samples = 8});
  row({.name = "sample_shading", .what = "4 samples, each shaded separately", .samples = 4, .state = sample_shading});
  row({.name = "alpha_to_coverage",
       .what = "4 samples, alpha to coverage",
       .shader = Shader::alpha,
       .samples = 4,
       .state = to_coverage,
       .is_comparable = false});
  row({.name = "scissor", .what = "a scissor rectangle that covers a quarter of the image", .half_scissor = true, .is_exact = true});
  row({.name = "color_mask", .what = "only red and blue are written", .state = mask({true, false, true, false})});
}

void add_blending(std::vector<MatrixRow>& rows) {
  using enum BlendFactor;
  const DrawState over = blending(kAlphaBlend);
  const auto row = [&](std::string_view name, std::string_view what, const BlendState& blend, Shader shader = Shader::alpha) {
    rows.push_back({.name = name, .what = what, .shader = shader, .state = blending(blend)});
  };
  row("blend_over", "straight alpha", kAlphaBlend);
  row("blend_premultiplied", "premultiplied alpha", add(one, one_minus_src_alpha));
  row("blend_additive", "adds source times alpha", kAdditiveBlend);
  row("blend_multiply", "source times destination", add(dst_color, zero));
  row("blend_min", "minimum of source and destination", equation(BlendEquation::min, one, one));
  row("blend_subtract", "destination minus source times alpha", equation(BlendEquation::reverse_subtract, src_alpha, one));
  row("blend_constant", "constant blend factors", add(constant_color, one_minus_constant_color));
  row("blend_dual", "dual-source blending", add(one, src1_color), Shader::dual);
  const auto triangles_row = [&](std::string_view name, std::string_view what, int count, float pixels) {
    rows.push_back(
        {.name = name, .what = what, .mesh = triangles, .shader = Shader::alpha, .count = count, .pixels = pixels, .state = over});
  };
  triangles_row("blend_small", "200,000 blended triangles, about 8 pixels across", 200'000, 8);
  triangles_row("blend_medium", "20,000 blended triangles, about 100 pixels across", 20'000, 100);
  triangles_row("blend_medium_tint", "blend_medium without a texture", 20'000, 100);
  rows.back().shader = Shader::tint;
  triangles_row("blend_large", "200 blended triangles, about 800 pixels across", 200, 800);
}

void add_shaders(std::vector<MatrixRow>& rows) {
  const auto row = [&](const MatrixRow& r) { rows.push_back(r); };
  row({.name = "discard_few", .what = "few holes; no visibility function", .shader = Shader::holes, .threshold = 0.3f});
  row({.name = "discard_many", .what = "many holes; no visibility function", .shader = Shader::holes, .threshold = 0.7f});
  row({.name = "discard_few_visible", .what = "few holes", .shader = Shader::holes_visible, .threshold = 0.3f});
  row({.name = "discard_many_visible", .what = "many holes", .shader = Shader::holes_visible, .threshold = 0.7f});
  row({.name = "depth", .what = "the shader writes depth; no visibility function", .shader = Shader::depth});
  row({.name = "depth_visible", .what = "the shader writes depth", .shader = Shader::depth_visible});
  row({.name = "varyings_0", .what = "no varyings", .shader = Shader::varyings, .varyings = 0, .is_exact = true});
  row({.name = "varyings_4", .what = "4 floats in varyings", .shader = Shader::varyings, .varyings = 4, .is_exact = true});
  row({.name = "varyings_8", .what = "8 floats in varyings", .shader = Shader::varyings, .varyings = 8, .is_exact = true});
  row({.name = "varyings_16", .what = "16 floats in varyings", .shader = Shader::varyings, .varyings = 16, .is_exact = true});
  row({.name = "pass_constant", .what = "a full-screen quad with a constant color", .mesh = quad, .shader = Shader::constant, .draws = 1});
  row({.name = "pass_color", .what = "a full-screen quad with an interpolated color", .mesh = quad, .shader = Shader::color, .draws = 1});
  row({.name = "pass_texture", .what = "a full-screen quad with a texture", .mesh = quad, .shader = Shader::texture, .draws = 1});
  row({.name = "pass_tone",
       .what = "a full-screen quad with the tone curve of a half-float image",
       .mesh = quad,
       .shader = Shader::tone,
       .draws = 1,
       .sampler = {.mag = Filter::bilinear, .min = Filter::bilinear, .wrap_s = Wrap::clamp, .wrap_t = Wrap::clamp}});
}

void add_geometry(std::vector<MatrixRow>& rows) {
  DrawState wireframe = kWireframeState, instances;
  instances.instances = 98;
  const auto row = [&](const MatrixRow& r) { rows.push_back(r); };
  row({.name = "wireframe", .what = "wireframe of all triangles", .state = wireframe});
  row({.name = "lines", .what = "100,000 lines", .mesh = edges, .state = topology(Topology::lines)});
  row({.name = "points", .what = "100,000 points of 6 x 6 pixels", .mesh = points, .state = topology(Topology::points)});
  row({.name = "strips", .what = "strips with primitive restart", .mesh = strips, .draws = 1, .state = topology(Topology::triangle_strip)});
  row({.name = "shuffled_triangles", .what = "triangles in random order", .order = MatrixOrder::shuffled_triangles, .is_exact = true});
  row({.name = "shuffled_vertices", .what = "vertices in random order", .order = MatrixOrder::shuffled_vertices, .is_exact = true});
  row({.name = "unshared",
       .what = "200,000 random triangles, about 20 pixels across, without shared vertices",
       .mesh = triangles,
       .count = 200'000,
       .pixels = 20,
       .is_exact = true});
  row({.name = "draws_1", .what = "one draw call", .draws = 1, .is_exact = true});
  row({.name = "draws_100", .what = "100 draw calls", .draws = 100, .is_exact = true});
  row({.name = "draws_10000", .what = "10,000 draw calls", .draws = 10'000, .is_exact = true});
  row({.name = "instances", .what = "98 instances of 2048 triangles", .mesh = tiles, .draws = 1, .state = instances});
  row({.name = "near_clip", .what = "the near plane clips triangles", .mesh = near, .is_exact = true});
}

void add_textures(std::vector<MatrixRow>& rows) {
  const auto row = [&](const MatrixRow& r) {
    rows.push_back(r);
    rows.back().is_exact = true;
  };
  row({.name = "textures_2", .what = "2 textures", .textures = 2});
  row({.name = "textures_4", .what = "4 textures", .textures = 4});
  row({.name = "textures_8", .what = "8 textures", .textures = 8});
  row({.name = "texture_odd", .what = "textures of 1000 x 602 texels", .texels = MatrixTexture::odd});
  row({.name = "texture_srgb", .what = "sRGB textures", .texels = MatrixTexture::srgb});
  row({.name = "texture_half", .what = "half-float textures", .texels = MatrixTexture::half_float});
  row({.name = "nearest", .what = "nearest filtering", .sampler = filter(Filter::nearest)});
  row({.name = "bilinear", .what = "bilinear filtering, without mip levels", .sampler = filter(Filter::bilinear)});
  row({.name = "mirrored", .what = "mirrored repeat", .sampler = wrap(Wrap::mirrored)});
  row({.name = "border", .what = "a border color", .sampler = wrap(Wrap::border)});
  row({.name = "anisotropy_2", .what = "2x anisotropic filtering", .sampler = {.anisotropy = 2}});
  row({.name = "anisotropy_8", .what = "8x anisotropic filtering", .sampler = {.anisotropy = 8}});
  row({.name = "anisotropy_16", .what = "16x anisotropic filtering", .sampler = {.anisotropy = 16}});
}

// Combinations of states, and states that are less common than those above.
void add_combinations(std::vector<MatrixRow>& rows) {
  using enum BlendFactor;
  const DrawState over = blending(kAlphaBlend);
  DrawState masked = over, stencilled = over;
  masked.color_mask.a = false;
  const DrawState stencil_not_one = stencil({.compare = CompareOp::not_equal, .reference = 1});
  stencilled.stencil = stencil_not_one.stencil;
  const auto row = [&](const MatrixRow& r) { rows.push_back(r); };
  row({.name = "blend_screen",
       .what = "inverse destination times source, plus destination",
       .shader = Shader::alpha,
       .state = blending(add(one_minus_dst_color, one))});
  row({.name = "blend_masked", .what = "straight alpha; alpha is not written", .shader = Shader::alpha, .state = masked});
  row({.name = "blend_srgb",
       .what = "straight alpha, an sRGB target",
       .shader = Shader::alpha,
       .color = ColorFormat::srgb8a8,
       .state = over});
  row({.name = "blend_half",
       .what = "straight alpha, a half-float target",
       .shader = Shader::alpha,
       .color = ColorFormat::rgba16f,
       .state = over});
  row({.name = "blend_stencil",
       .what = "straight alpha and a stencil test",
       .shader = Shader::alpha,
       .depth = DepthFormat::d24s8,
       .state = stencilled});
  row({.name = "discard_stencil",
       .what = "few holes and a stencil test; no visibility function",
       .shader = Shader::holes,
       .threshold = 0.3f,
       .depth = DepthFormat::d24s8,
       .state = stencil_not_one});
  row({.name = "msaa4_blend", .what = "4 samples, straight alpha", .shader = Shader::alpha, .samples = 4, .state = over});
  row({.name = "msaa4_stencil",
       .what = "4 samples and a stencil test",
       .depth = DepthFormat::d24s8,
       .samples = 4,
       .state = stencil_not_one});
  row({.name = "pass_srgb",
       .what = "pass_texture with an sRGB target",
       .mesh = quad,
       .shader = Shader::texture,
       .draws = 1,
       .color = ColorFormat::srgb8a8});
  row({.name = "pass_half",
       .what = "pass_texture with a half-float target",
       .mesh = quad,
       .shader = Shader::texture,
       .draws = 1,
       .color = ColorFormat::rgba16f});
}

}  // namespace

std::span<const MatrixRow> matrix_rows() {
  static const std::vector<MatrixRow> rows = [] {
    std::vector<MatrixRow> all;
    add_targets(all);
    add_blending(all);
    add_shaders(all);
    add_geometry(all);
    add_textures(all);
    add_combinations(all);
    return all;
  }();
  return rows;
}

}  // namespace halfspace
