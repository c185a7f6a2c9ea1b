// SPDX-License-Identifier: Apache-2.0
#include "oracle/transform.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "oracle/arithmetic.h"

namespace halfspace::oracle {

namespace {

constexpr float kGuard = 16384.0f;  // px

}  // namespace

Transform make_transform(const DrawState& s, int width, int height, int samples) {
  const ViewportRect r = s.viewport ? *s.viewport : ViewportRect(Rect{0, 0, width, height});
  const DepthState& d = s.depth;
  Transform t{};
  t.half_width = r.width / 2.0f;
  t.half_height = r.height / 2.0f;
  t.center_x = r.x + t.half_width;
  t.center_y = r.y + t.half_height;
  if (s.clip_origin == ClipOrigin::upper_left) t.half_height *= -1.0f;
  if (d.clip == ClipDepth::zero_to_one) {
    t.z_scale = d.range_far - d.range_near;
    t.z_bias = d.range_near;
  } else {
    t.z_scale = (d.range_far - d.range_near) * 0.5f;
    t.z_bias = (d.range_near + d.range_far) * 0.5f;
  }
  t.left = (-kGuard - t.center_x) / t.half_width;
  t.right = (kGuard - t.center_x) / t.half_width;
  t.bottom = (-kGuard - t.center_y) / t.half_height;
  t.top = (kGuard - t.center_y) / t.half_height;
  if (t.bottom > t.top) std::swap(t.bottom, t.top);
  const bool has_fractions =
      std::fmod(r.x, 1.0f) != 0 || std::fmod(r.y, 1.0f) != 0 || std::fmod(r.width, 1.0f) != 0 || std::fmod(r.height, 1.0f) != 0;
  if (samples > 1 && has_fractions && is_triangles(s.topology) && s.polygon_mode == PolygonMode::fill)
    t.left = t.bottom = -1.0f, t.right = t.top = 1.0f;
  return t;
}

// Within 2^-20 of a tie, the pipeline may round either way. In that case, this function follows the pipeline's arithmetic: quotient and
// remainder, product and its error, sum and its error.
int64_t snap(float x, float w, float half, float center) {
  const long double exact =
      (static_cast<long double>(x) / static_cast<long double>(w) * static_cast<long double>(half) + static_cast<long double>(center)) *
      256.0L;
  const long double nearest = std::nearbyint(exact);
  if (0.5L - std::fabs(exact - nearest) > 0x1p-20L) return static_cast<int64_t>(nearest);
  const float h = half * 256.0f, c = center * 256.0f, inverse = 1.0f / w;
  const float quotient = x * inverse;
  const float quotient_rest = std::fma(-quotient, w, x) * inverse;
  const float product = quotient * h;
  const float product_rest = std::fma(quotient, h, -product);
  const float sum = product + c;
  const float c_part = sum - product;
  const float sum_rest = (product - (sum - c_part)) + (c - c_part);
  const float whole = std::nearbyint(sum);
  const float rest = (sum - whole) + (sum_rest + std::fma(quotient_rest, h, product_rest));
  return static_cast<int64_t>(whole) + static_cast<int64_t>(std::nearbyint(rest));
}

Corner project(const Transform& t, const ShadedVertex& v) {
  const glm::vec4& p = v.pos_clip;
  Corner c;
  c.x = snap(p.x, p.w, t.half_width, t.center_x);
  c.y = snap(p.y, p.w, t.half_height, t.center_y);
  c.inv_w = 1.0f / p.w;
  c.z = clamped(std::fma(p.z * c.inv_w, t.z_scale, t.z_bias), -1e30f, 1e30f);
  c.varyings = v.varyings;
  return c;
}

bool is_finite(const ShadedVertex& v) {
  const glm::vec4& p = v.pos_clip;
  const auto finite = [](float x) { return std::isfinite(x); };
  return finite(p.x) && finite(p.y) && finite(p.z) && finite(p.w) && std::ranges::all_of(v.clip_distances, finite) &&
         std::ranges::all_of(v.cull_distances, finite);
}

bool beyond_near(const DepthState& d, const glm::vec4& p) { return d.clip == ClipDepth::zero_to_one ? p.z < 0.0f : p.z < -p.w; }
bool beyond_far(const glm::vec4& p) { return p.z > p.w; }

bool needs_clip(const Transform& t, const DepthState& d, const glm::vec4& p) {
  if (!d.clamp && (beyond_near(d, p) || beyond_far(p))) return true;
  const auto times_w = [&](float bound) { return static_cast<double>(bound) * static_cast<double>(p.w); };  // exact
  const auto x = static_cast<double>(p.x), y = static_cast<double>(p.y);
  const bool inside_guard = x >= times_w(t.left) && x <= times_w(t.right) && y >= times_w(t.bottom) && y <= times_w(t.top);
  return !inside_guard || p.w < kMinW;
}

bool all_outside(const DepthState& d, const std::array<const ShadedVertex*, 3>& v) {
  const auto all = [&](auto beyond) { return beyond(v[0]->pos_clip) && beyond(v[1]->pos_clip) && beyond(v[2]->pos_clip); };
  if (all([](const glm::vec4& p) { return p.x < -p.w; }) || all([](const glm::vec4& p) { return p.x > p.w; })) return true;
  if (all([](const glm::vec4& p) { return p.y < -p.w; }) || all([](const glm::vec4& p) { return p.y > p.w; })) return true;
  if (d.clamp) return false;
  return all([&](const glm::vec4& p) { return beyond_near(d, p); }) || all([](const glm::vec4& p) { return beyond_far(p); });
}

}  // namespace halfspace::oracle
