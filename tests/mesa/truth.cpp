// SPDX-License-Identifier: Apache-2.0
#include "mesa/truth.h"

namespace halfspace::test {

bool passes(CompareOp op, double value, double stored) {
  switch (op) {
    case CompareOp::never: return false;
    case CompareOp::less: return value < stored;
    case CompareOp::equal: return value == stored;
    case CompareOp::less_equal: return value <= stored;
    case CompareOp::greater: return value > stored;
    case CompareOp::not_equal: return value != stored;
    case CompareOp::greater_equal: return value >= stored;
    default: return true;
  }
}

glm::u8vec4 truth_codes(const glm::dvec4& color, ColorFormat format) {
  glm::u8vec4 codes;
  for (int k = 0; k < 4; ++k) {
    double v = std::clamp(color[k], 0.0, 1.0);
    if (format == ColorFormat::srgb8a8 && k < 3) v = v <= 0.0031308 ? 12.92 * v : 1.055 * std::pow(v, 1.0 / 2.4) - 0.055;
    codes[k] = static_cast<uint8_t>(std::lround(v * 255.0));
  }
  return codes;
}

namespace {

double factor(BlendFactor f, const glm::dvec4& src, const glm::dvec4& dst, const glm::dvec4& constant, int k) {
  switch (f) {
    case BlendFactor::zero: return 0.0;
    case BlendFactor::one: return 1.0;
    case BlendFactor::src_color: return src[k];
    case BlendFactor::one_minus_src_color: return 1.0 - src[k];
    case BlendFactor::dst_color: return dst[k];
    case BlendFactor::one_minus_dst_color: return 1.0 - dst[k];
    case BlendFactor::src_alpha: return src.w;
    case BlendFactor::one_minus_src_alpha: return 1.0 - src.w;
    case BlendFactor::dst_alpha: return dst.w;
    case BlendFactor::one_minus_dst_alpha: return 1.0 - dst.w;
    case BlendFactor::constant_color: return constant[k];
    case BlendFactor::one_minus_constant_color: return 1.0 - constant[k];
    case BlendFactor::constant_alpha: return constant.w;
    case BlendFactor::one_minus_constant_alpha: return 1.0 - constant.w;
    default: return k == 3 ? 1.0 : std::min(src.w, 1.0 - dst.w);  // src_alpha_saturate; dual-source factors are not used in these tests
  }
}

double equation(BlendEquation e, double s, double s_factor, double d, double d_factor) {
  switch (e) {
    case BlendEquation::add: return s * s_factor + d * d_factor;
    case BlendEquation::subtract: return s * s_factor - d * d_factor;
    case BlendEquation::reverse_subtract: return d * d_factor - s * s_factor;
    case BlendEquation::min: return std::min(s, d);
    default: return std::max(s, d);
  }
}

}  // namespace

glm::u8vec4 truth_blend(const glm::dvec4& source, const glm::u8vec4& stored, const BlendState& b, ColorFormat format) {
  const glm::dvec4 src = glm::clamp(source, 0.0, 1.0), constant = glm::clamp(glm::dvec4(b.constant), 0.0, 1.0);
  glm::dvec4 dst, out;
  for (int k = 0; k < 4; ++k) {
    const double code = stored[k] / 255.0;
    const bool srgb = format == ColorFormat::srgb8a8 && k < 3;
    dst[k] = !srgb ? code : code <= 0.04045 ? code / 12.92 : std::pow((code + 0.055) / 1.055, 2.4);
  }
  for (int k = 0; k < 4; ++k) {
    out[k] = k < 3 ? equation(b.color_equation, src[k], factor(b.source_color, src, dst, constant, k), dst[k],
                              factor(b.destination_color, src, dst, constant, k))
                   : equation(b.alpha_equation, src[k], factor(b.source_alpha, src, dst, constant, k), dst[k],
                              factor(b.destination_alpha, src, dst, constant, k));
  }
  return truth_codes(out, format);
}

TruthTriangle truth_triangle(const std::array<glm::vec4, 3>& pos_clip, const ViewportRect& viewport, const DrawState& state,
                             Positions positions) {
  const DepthState& depth = state.depth;
  const double up = state.clip_origin == ClipOrigin::upper_left ? -1.0 : 1.0;
  TruthTriangle t;
  const double near = static_cast<double>(depth.range_near), far = static_cast<double>(depth.range_far);
  const bool in_front = std::all_of(pos_clip.begin(), pos_clip.end(), [](const glm::vec4& p) { return p.w > 0.0f; });
  for (std::size_t i = 0; i < 3; ++i) {
    const glm::dvec4 p(pos_clip[i]);
    t.q[i] = 1.0 / p.w;
    t.x[i] = (static_cast<double>(viewport.x) + (p.x / p.w + 1.0) * 0.5 * static_cast<double>(viewport.width)) * 256.0;
    t.y[i] = (static_cast<double>(viewport.y) + (up * p.y / p.w + 1.0) * 0.5 * static_cast<double>(viewport.height)) * 256.0;
    t.z[i] = near + (far - near) * (depth.clip == ClipDepth::zero_to_one ? p.z / p.w : 0.5 * p.z / p.w + 0.5);
    if (positions == Positions::snapped && in_front) {
      t.x[i] = std::nearbyint(t.x[i]);
      t.y[i] = std::nearbyint(t.y[i]);
    }
  }
  t.area = (t.x[1] - t.x[0]) * (t.y[2] - t.y[0]) - (t.y[1] - t.y[0]) * (t.x[2] - t.x[0]);
  return t;
}

std::array<double, 3> TruthTriangle::weights(double px, double py) const {
  std::array<double, 3> b;
  for (std::size_t i = 0; i < 3; ++i) {  // exact for snapped positions, because products are below 2^53
    const std::size_t s = (i + 1) % 3, e = (i + 2) % 3;
    b[i] = ((x[e] - x[s]) * (py - y[s]) - (y[e] - y[s]) * (px - x[s])) / area;
  }
  return b;
}

bool TruthTriangle::covers(const std::array<double, 3>& b, bool fill_rule) const {
  if (!(b[0] * q[0] + b[1] * q[1] + b[2] * q[2] > 0.0)) return false;  // behind the eye
  for (std::size_t i = 0; i < 3; ++i) {
    const double p = b[i] * (q[i] > 0.0 ? 1.0 : -1.0);
    if (p < 0.0) return false;
    if (p > 0.0 || !fill_rule) continue;
    // On the edge: samples on left edges and on horizontal edges below the interior belong to the triangle.
    const std::size_t s = (i + 1) % 3, e = (i + 2) % 3;
    const double turn = area > 0.0 ? 1.0 : -1.0;
    const double ex = (x[e] - x[s]) * turn, ey = (y[e] - y[s]) * turn;
    if (!(ey < 0.0 || (ey == 0.0 && ex > 0.0))) return false;
  }
  return true;
}

bool truth_culled(const TruthTriangle& t, const DrawState& state) {
  const bool counter_clockwise = t.area * t.q[0] * t.q[1] * t.q[2] > 0.0;
  const bool is_reversed = (state.front == Winding::clockwise) != (state.clip_origin == ClipOrigin::upper_left);
  const bool front = counter_clockwise != is_reversed;
  return state.cull == CullMode::front_and_back || (state.cull == CullMode::front && front) || (state.cull == CullMode::back && !front);
}

}  // namespace halfspace::test
