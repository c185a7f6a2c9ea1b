// SPDX-License-Identifier: Apache-2.0
#include "oracle/oracle.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <optional>
#include <utility>

#include "halfspace/core/srgb.h"

namespace halfspace::oracle {

// ---- images ----------------------------------------------------------------------------------------------------

namespace {

float clamped(float x, float low, float high) {  // NaN becomes low
  const float raised = x > low ? x : low;
  return raised < high ? raised : high;
}

uint8_t encode_unorm8(float x) {
  return static_cast<uint8_t>(std::lround(static_cast<double>(clamped(x, 0.0f, 1.0f)) * 255.0));  // the product is exact and never a tie
}

float decode_half(uint16_t h) {
  const int exponent = h >> 10 & 31;
  const int mantissa = h & 1023;
  if (exponent == 31 && mantissa != 0)
    return std::bit_cast<float>((h & 0x8000u) << 16 | 0x7fc00000u | static_cast<uint32_t>(mantissa) << 13);
  const double size = exponent == 31 ? HUGE_VAL : exponent == 0 ? std::ldexp(mantissa, -24) : std::ldexp(1024 + mantissa, exponent - 25);
  return static_cast<float>((h & 0x8000) != 0 ? -size : size);
}

// Rounds to the nearest half, ties to even. Infinities and values that are too large become the largest finite half.
uint16_t encode_half(float x) {
  const uint32_t sign = std::bit_cast<uint32_t>(x) >> 16 & 0x8000u;
  if (std::isnan(x)) return static_cast<uint16_t>(sign | 0x7e00u | (std::bit_cast<uint32_t>(x) >> 13 & 0x3ffu));
  const double size = std::fmin(std::fabs(static_cast<double>(x)), 65504.0);
  if (size < 0x1p-14) return static_cast<uint16_t>(sign | static_cast<uint32_t>(std::nearbyint(size * 0x1p24)));
  const int exponent = std::ilogb(size);
  const auto mantissa =
      static_cast<uint32_t>(std::nearbyint(std::ldexp(size, 10 - exponent)));  // 1024 to 2048; 2048 carries into the exponent
  return static_cast<uint16_t>(sign | ((static_cast<uint32_t>(exponent + 14) << 10) + mantissa));
}

template <class T>
T read(const std::vector<std::byte>& bytes, std::size_t index) {
  T t;
  std::memcpy(&t, &bytes[index * sizeof(T)], sizeof t);
  return t;
}
template <class T>
void write(std::vector<std::byte>& bytes, std::size_t index, T t) {
  std::memcpy(&bytes[index * sizeof(T)], &t, sizeof t);
}

}  // namespace

Framebuffer::Framebuffer(int width, int height, std::vector<ColorFormat> colors, DepthFormat depth, int samples)
    : width_(width), height_(height), samples_(samples), color_formats_(std::move(colors)), depth_format_(depth) {
  const std::size_t pixels = static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * static_cast<std::size_t>(samples);
  for (const ColorFormat f : color_formats_) color_bytes.emplace_back(pixels * static_cast<std::size_t>(bytes_per_pixel(f)));
  depth_bytes.resize(pixels * static_cast<std::size_t>(bytes_per_pixel(depth)));
}

std::size_t Framebuffer::pixel(const Sample& s) const {
  const int row = s.number * height_ + (height_ - 1 - s.y);
  return static_cast<std::size_t>(row) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(s.x);
}

namespace {

// Calls f for every sample of a framebuffer.
template <class F>
void for_each_sample(const Framebuffer& b, F f) {
  for (int y = 0; y < b.height(); ++y) {
    for (int x = 0; x < b.width(); ++x) {
      for (int s = 0; s < b.samples(); ++s) f(Sample{x, y, s});
    }
  }
}

}  // namespace

void Framebuffer::clear_color(std::size_t attachment, glm::vec4 value) {
  for_each_sample(*this, [&](const Sample& s) { set_color(attachment, s, value); });
}

void Framebuffer::clear_depth(float value, uint8_t stencil_value) {
  for_each_sample(*this, [&](const Sample& s) {
    set_depth(s, depth_value(clamped(value, 0.0f, 1.0f)));
    set_stencil(s, stencil_value);
  });
}

glm::vec4 Framebuffer::color(std::size_t attachment, const Sample& s) const {
  glm::vec4 c(0.0f);
  const std::vector<std::byte>& bytes = color_bytes[attachment];
  for (int k = 0; k < 4; ++k) {
    const std::size_t i = pixel(s) * 4 + static_cast<std::size_t>(k);
    switch (color_formats_[attachment]) {
      case ColorFormat::none: break;
      case ColorFormat::rgba8: c[k] = static_cast<float>(read<uint8_t>(bytes, i)) / 255.0f; break;
      case ColorFormat::srgb8a8:
        c[k] = k == 3 ? static_cast<float>(read<uint8_t>(bytes, i)) / 255.0f : kSrgbToLinear[read<uint8_t>(bytes, i)];
        break;
      case ColorFormat::rgba16f: c[k] = decode_half(read<uint16_t>(bytes, i)); break;
      case ColorFormat::rgba32f: c[k] = read<float>(bytes, i); break;
      default: break;  // formats with fewer channels have tests of their own
    }
  }
  return c;
}

void Framebuffer::set_color(std::size_t attachment, const Sample& s, glm::vec4 value) {
  std::vector<std::byte>& bytes = color_bytes[attachment];
  for (int k = 0; k < 4; ++k) {
    const std::size_t i = pixel(s) * 4 + static_cast<std::size_t>(k);
    switch (color_formats_[attachment]) {
      case ColorFormat::none: break;
      case ColorFormat::rgba8: write(bytes, i, encode_unorm8(value[k])); break;
      case ColorFormat::srgb8a8: write(bytes, i, k == 3 ? encode_unorm8(value[k]) : static_cast<uint8_t>(linear_to_srgb(value[k]))); break;
      case ColorFormat::rgba16f: write(bytes, i, encode_half(value[k])); break;
      case ColorFormat::rgba32f: write(bytes, i, value[k]); break;
      default: break;
    }
  }
}

double Framebuffer::depth(const Sample& s) const {
  const std::size_t i = pixel(s);
  switch (depth_format_) {
    case DepthFormat::none: break;
    case DepthFormat::d16: return read<uint16_t>(depth_bytes, i);
    case DepthFormat::d24: return read<uint32_t>(depth_bytes, i);
    case DepthFormat::d32f: return static_cast<double>(read<float>(depth_bytes, i));
    case DepthFormat::d24s8: return read<uint32_t>(depth_bytes, i) / 256;
    case DepthFormat::d32fs8: return static_cast<double>(read<float>(depth_bytes, 2 * i));
  }
  return 0.0;
}

void Framebuffer::set_depth(const Sample& s, double value) {
  const std::size_t i = pixel(s);
  switch (depth_format_) {
    case DepthFormat::none: break;
    case DepthFormat::d16: write(depth_bytes, i, static_cast<uint16_t>(value)); break;
    case DepthFormat::d24: write(depth_bytes, i, static_cast<uint32_t>(value)); break;
    case DepthFormat::d32f: write(depth_bytes, i, static_cast<float>(value)); break;
    case DepthFormat::d24s8: write(depth_bytes, i, static_cast<uint32_t>(value) * 256 + stencil(s)); break;
    case DepthFormat::d32fs8: write(depth_bytes, 2 * i, static_cast<float>(value)); break;
  }
}

uint8_t Framebuffer::stencil(const Sample& s) const {
  if (depth_format_ == DepthFormat::d24s8) return read<uint8_t>(depth_bytes, 4 * pixel(s));  // little endian: the low byte
  if (depth_format_ == DepthFormat::d32fs8) return read<uint8_t>(depth_bytes, 8 * pixel(s) + 4);
  return 0;
}

void Framebuffer::set_stencil(const Sample& s, uint8_t value) {
  if (depth_format_ == DepthFormat::d24s8) write(depth_bytes, 4 * pixel(s), value);
  if (depth_format_ == DepthFormat::d32fs8) write(depth_bytes, 8 * pixel(s) + 4, value);
}

Framebuffer Framebuffer::resolved() const {
  if (samples_ == 1) return *this;
  Framebuffer to(width_, height_, color_formats_, depth_format_);
  for_each_sample(to, [&](const Sample& pixel) {
    for (std::size_t a = 0; a < color_formats_.size(); ++a) {
      std::vector<glm::vec4> c;
      for (int s = 0; s < samples_; ++s) c.push_back(color(a, {pixel.x, pixel.y, s}));
      while (c.size() > 1) {  // add adjacent pairs
        for (std::size_t i = 0; i < c.size() / 2; ++i) c[i] = c[2 * i] + c[2 * i + 1];
        c.resize(c.size() / 2);
      }
      to.set_color(a, pixel, c[0] * (1.0f / static_cast<float>(samples_)));
    }
    to.set_depth(pixel, depth(pixel));
    to.set_stencil(pixel, stencil(pixel));
  });
  return to;
}

Point center_of(int x, int y) { return {int64_t{x} * 256 + 128, int64_t{y} * 256 + 128}; }

Point position_of(const Sample& s, int samples) {
  // In 1/16 px, from the standard sample locations in the Vulkan specification.
  static const std::vector<std::pair<int, int>> two{{12, 12}, {4, 4}}, four{{6, 2}, {14, 6}, {2, 10}, {10, 14}},
      eight{{9, 5}, {7, 11}, {13, 9}, {5, 3}, {3, 13}, {1, 7}, {11, 15}, {15, 1}};
  if (samples == 1) return center_of(s.x, s.y);
  const auto [x, y] = (samples == 2 ? two : samples == 4 ? four : eight)[static_cast<std::size_t>(s.number)];
  return {int64_t{s.x} * 256 + x * 16, int64_t{s.y} * 256 + y * 16};
}

double Framebuffer::depth_value(float z) const {
  switch (depth_format_) {
    case DepthFormat::d16: return std::nearbyint(static_cast<double>(z) * 65535.0);  // the products are exact
    case DepthFormat::d24s8:
    case DepthFormat::d24: return std::nearbyint(static_cast<double>(z) * 16777215.0);
    default: return static_cast<double>(z);
  }
}

// ---- clip space → window -----------------------------------------------------------------------------------------

namespace {

constexpr float kGuard = 16384.0f;  // px
constexpr float kMinW = 0x1p-96f;

// Maps clip space to the window for one viewport and depth range.
struct Transform {
  float half_width, half_height, center_x, center_y;
  float z_scale, z_bias;
  float left, right, bottom, top;  // the guard band in units of w
};

Transform make_transform(const Rect& r, const DepthState& d) {
  Transform t{};
  t.half_width = static_cast<float>(r.width) / 2.0f;
  t.half_height = static_cast<float>(r.height) / 2.0f;
  t.center_x = static_cast<float>(r.x) + t.half_width;
  t.center_y = static_cast<float>(r.y) + t.half_height;
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
  return t;
}

// Rounds x/w·half + center to the nearest multiple of 1/256 px. Within 2^-20 of a tie, the pipeline may round either way. In that case,
// this function follows the pipeline's arithmetic: quotient and remainder, product and its error, sum and its error.
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

// Whether the position and the clip distances of a vertex are finite.
bool is_finite(const ShadedVertex& v) {
  const glm::vec4& p = v.pos_clip;
  const auto finite = [](float x) { return std::isfinite(x); };
  return finite(p.x) && finite(p.y) && finite(p.z) && finite(p.w) && std::ranges::all_of(v.clip_distances, finite);
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

// Returns whether all three vertices are outside of the same plane of the view volume.
bool all_outside(const DepthState& d, const std::array<const ShadedVertex*, 3>& v) {
  const auto all = [&](auto beyond) { return beyond(v[0]->pos_clip) && beyond(v[1]->pos_clip) && beyond(v[2]->pos_clip); };
  if (all([](const glm::vec4& p) { return p.x < -p.w; }) || all([](const glm::vec4& p) { return p.x > p.w; })) return true;
  if (all([](const glm::vec4& p) { return p.y < -p.w; }) || all([](const glm::vec4& p) { return p.y > p.w; })) return true;
  if (d.clamp) return false;
  return all([&](const glm::vec4& p) { return beyond_near(d, p); }) || all([](const glm::vec4& p) { return beyond_far(p); });
}

// ---- clipping ----------------------------------------------------------------------------------------------------

// A vertex of a clipped polygon: its position, its weights with respect to the vertices of the triangle, and the triangle's vertex that it
// equals, if any.
struct ClipPoint {
  std::array<double, 4> p;
  std::array<double, 3> weight;
  int vertex = -1;
};
using Polygon = std::vector<ClipPoint>;

// A point is inside if a·x + b·y + c·z + d·w + k ≥ 0.
struct Plane {
  double a, b, c, d, k;
  std::optional<std::array<double, 3>> by_vertex{};  // for a clip distance: the values at the vertices of the triangle

  double operator()(const ClipPoint& q) const {
    if (!by_vertex) return a * q.p[0] + b * q.p[1] + c * q.p[2] + d * q.p[3] + k;
    if (q.vertex >= 0) return (*by_vertex)[static_cast<std::size_t>(q.vertex)];
    return q.weight[0] * (*by_vertex)[0] + q.weight[1] * (*by_vertex)[1] + q.weight[2] * (*by_vertex)[2];
  }
};

// Returns the planes in clipping order.
std::vector<Plane> clip_planes(const Transform& t, const DepthState& state) {
  std::vector<Plane> planes{{0, 0, 0, 1, -static_cast<double>(kMinW)}};
  if (!state.clamp) {
    planes.push_back(state.clip == ClipDepth::zero_to_one ? Plane{0, 0, 1, 0, 0} : Plane{0, 0, 1, 1, 0});
    planes.push_back({0, 0, -1, 1, 0});
  }
  planes.push_back({1, 0, 0, -static_cast<double>(t.left), 0});
  planes.push_back({-1, 0, 0, static_cast<double>(t.right), 0});
  planes.push_back({0, 1, 0, -static_cast<double>(t.bottom), 0});
  planes.push_back({0, -1, 0, static_cast<double>(t.top), 0});
  return planes;
}

// Returns (a·p − b·q) / (a − b) for all members of p and q.
ClipPoint mix(double a, const ClipPoint& p, double b, const ClipPoint& q) {
  ClipPoint r{};
  for (std::size_t i = 0; i < 4; ++i) r.p[i] = (a * p.p[i] - b * q.p[i]) / (a - b);
  for (std::size_t i = 0; i < 3; ++i) r.weight[i] = (a * p.weight[i] - b * q.weight[i]) / (a - b);
  r.vertex = -1;
  return r;
}

// Returns the intersection of the plane with the edge from an inside point to an outside point.
ClipPoint meet(const Plane& plane, const ClipPoint& in, const ClipPoint& out) { return mix(plane(in), out, plane(out), in); }

// Returns the intersection of the edge with w = kMinW: first intersects the edge with w = 0, and then moves back along it.
ClipPoint meet_least_w(const ClipPoint& in, const ClipPoint& out) {
  ClipPoint r = mix(in.p[3], out, out.p[3], in);
  const double back = static_cast<double>(kMinW) / (in.p[3] - out.p[3]);
  for (std::size_t i = 0; i < 3; ++i) r.p[i] += back * (in.p[i] - out.p[i]);
  for (std::size_t i = 0; i < 3; ++i) r.weight[i] += back * (in.weight[i] - out.weight[i]);
  r.p[3] = static_cast<double>(kMinW);
  return r;
}

Polygon cut(const Plane& plane, bool is_least_w, const Polygon& polygon) {
  const auto cut_edge = [&](const ClipPoint& in, const ClipPoint& out) {
    return is_least_w ? meet_least_w(in, out) : meet(plane, in, out);
  };
  Polygon kept;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const ClipPoint& here = polygon[i];
    const ClipPoint& next = polygon[(i + 1) % polygon.size()];
    const bool here_inside = plane(here) >= 0, next_inside = plane(next) >= 0;
    if (here_inside) kept.push_back(here);
    if (here_inside && !next_inside) kept.push_back(cut_edge(here, next));
    if (!here_inside && next_inside) kept.push_back(cut_edge(next, here));
  }
  return kept;
}

// Returns the part of a line that is inside the plane: two points or none.
Polygon cut_line(const Plane& plane, bool is_least_w, const Polygon& line) {
  if (line.empty()) return {};
  const bool in0 = plane(line[0]) >= 0, in1 = plane(line[1]) >= 0;
  const auto meeting = [&](const ClipPoint& in, const ClipPoint& out) { return is_least_w ? meet_least_w(in, out) : meet(plane, in, out); };
  if (!in0 && !in1) return {};
  return {in0 ? line[0] : meeting(line[1], line[0]), in1 ? line[1] : meeting(line[0], line[1])};
}

int64_t snap_corner(double ndc, float half, float center) {
  return std::llrint((ndc * static_cast<double>(half) + static_cast<double>(center)) * 256.0);
}

// Returns a vertex of a polygon in the window. A vertex that is also one of the triangle is bit-identical to the result without clipping.
Corner clip_corner(const Transform& t, const ClipPoint& c, const std::array<const ShadedVertex*, 3>& v, const ShaderFacts& facts,
                   std::size_t provoking) {
  Corner r;
  const double inverse = 1.0 / c.p[3];
  r.x = snap_corner(c.p[0] * inverse, t.half_width, t.center_x);
  r.y = snap_corner(c.p[1] * inverse, t.half_height, t.center_y);
  const double z = c.p[2] * inverse * static_cast<double>(t.z_scale) + static_cast<double>(t.z_bias);
  r.z = static_cast<float>(std::fmin(std::fmax(z, -1e30), 1e30));
  r.inv_w = static_cast<float>(inverse);
  if (c.vertex >= 0) r = project(t, *v[static_cast<std::size_t>(c.vertex)]);
  r.varyings.resize(facts.interpolations.size());
  for (std::size_t i = 0; i < r.varyings.size(); ++i) {
    std::array<double, 3> weight = c.weight;
    if (facts.interpolations[i] == Interpolation::linear) {  // linear in the window: weights are proportional to w
      for (std::size_t k = 0; k < 3; ++k) weight[k] = c.weight[k] * static_cast<double>(v[k]->pos_clip.w) / c.p[3];
    }
    double sum = 0.0;
    for (std::size_t k = 0; k < 3; ++k) sum += weight[k] * static_cast<double>(v[k]->varyings[i]);
    r.varyings[i] = facts.interpolations[i] == Interpolation::flat ? v[provoking]->varyings[i] : static_cast<float>(sum);
  }
  return r;
}

// ---- triangles in the window -----------------------------------------------------------------------------------------

struct Box {
  int64_t x0, y0, x1, y1;  // in pixels; x1 and y1 are exclusive
  bool empty() const { return x0 >= x1 || y0 >= y1; }
};

Box intersect(const Box& a, const Box& b) {
  return {std::max(a.x0, b.x0), std::max(a.y0, b.y0), std::min(a.x1, b.x1), std::min(a.y1, b.y1)};
}
Box box_of(const Rect& r) { return {r.x, r.y, int64_t{r.x} + r.width, int64_t{r.y} + r.height}; }

Box allowed_pixels(const Framebuffer& target, const DrawState& state) {
  Box b{0, 0, target.width(), target.height()};
  if (state.viewport) b = intersect(b, box_of(*state.viewport));
  if (state.scissor) b = intersect(b, box_of(*state.scissor));
  return b;
}

// Returns the pixels that may have a sample in the closed bounding box, based on the bounding box of the sample positions.
Box covered_box(const WindowTriangle& t, int samples) {
  if (t.is_line) {
    const int64_t margin = t.width / 2 + 3;
    const auto [xl, xh] = std::minmax(t.from.x, t.to.x);
    const auto [yl, yh] = std::minmax(t.from.y, t.to.y);
    return {xl / 256 - margin, yl / 256 - margin, xh / 256 + margin, yh / 256 + margin};
  }
  if (t.is_point) return {t.low.x / 256 - 2, t.low.y / 256 - 2, t.high.x / 256 + 2, t.high.y / 256 + 2};
  double low = 256.0, high = 0.0;
  for (int s = 0; s < samples; ++s) {
    const Point p = position_of({0, 0, s}, samples);
    low = std::fmin(low, static_cast<double>(std::min(p.x, p.y)));
    high = std::fmax(high, static_cast<double>(std::max(p.x, p.y)));
  }
  const auto [xl, xh] = std::minmax({t.corner[0].x, t.corner[1].x, t.corner[2].x});
  const auto [yl, yh] = std::minmax({t.corner[0].y, t.corner[1].y, t.corner[2].y});
  const auto first = [&](int64_t v) { return static_cast<int64_t>(std::ceil((static_cast<double>(v) - high) / 256.0)); };
  const auto last = [&](int64_t v) { return static_cast<int64_t>(std::floor((static_cast<double>(v) - low) / 256.0)); };
  return {first(xl), first(yl), last(xh) + 1, last(yh) + 1};
}

int64_t cross(int64_t ax, int64_t ay, int64_t bx, int64_t by) { return ax * by - ay * bx; }

int64_t orient2d(const Corner& a, const Corner& b, const Corner& c) { return cross(b.x - a.x, b.y - a.y, c.x - a.x, c.y - a.y); }

// Splits a clipped polygon into a fan. The apex is the first vertex for which all triangles have the same orientation. If there is none,
// the apex is the last vertex, and triangles with the opposite orientation are dropped.
std::vector<std::array<Corner, 3>> fan(const std::vector<Corner>& polygon) {
  std::vector<std::array<Corner, 3>> pieces;
  for (std::size_t apex = 0; apex < polygon.size(); ++apex) {
    std::vector<Corner> from(polygon);
    std::rotate(from.begin(), from.begin() + static_cast<std::ptrdiff_t>(apex), from.end());
    pieces.clear();
    int64_t area = 0;
    for (std::size_t i = 2; i < from.size(); ++i) {
      pieces.push_back({from[0], from[i - 1], from[i]});
      area += orient2d(from[0], from[i - 1], from[i]);
    }
    const auto against = [area](const std::array<Corner, 3>& p) {
      const int64_t own = orient2d(p[0], p[1], p[2]);
      return own != 0 && (own > 0) != (area > 0);
    };
    if (std::none_of(pieces.begin(), pieces.end(), against)) break;
    if (apex + 1 == polygon.size()) std::erase_if(pieces, against);
  }
  return pieces;
}

bool culls_face(CullMode mode, bool front) {
  return mode == CullMode::front_and_back || (mode == CullMode::front && front) || (mode == CullMode::back && !front);
}

// Polygon offset, OpenGL 4.6, section 14.6.5. dz1 and dz2 are the depths of vertices 1 and 2 relative to vertex 0.
float polygon_offset(const DepthOffset& o, DepthFormat format, const WindowTriangle& t, double dz1, double dz2) {
  double offset = 0.0;
  const auto dx = [&](std::size_t i) { return static_cast<double>(t.corner[i].x - t.corner[0].x); };
  const auto dy = [&](std::size_t i) { return static_cast<double>(t.corner[i].y - t.corner[0].y); };
  const double area = static_cast<double>(t.area);
  if (o.slope != 0.0f) {
    const double by_x = std::fabs((dy(2) * dz1 - dy(1) * dz2) / area * 256.0);
    const double by_y = std::fabs((dx(1) * dz2 - dx(2) * dz1) / area * 256.0);
    offset = static_cast<double>(o.slope) * std::fmax(by_x, by_y);
  }
  double unit = 1.0 / 16777215.0;
  if (format == DepthFormat::d16) unit = 1.0 / 65535.0;
  if (format == DepthFormat::d32f || format == DepthFormat::d32fs8 || format == DepthFormat::none) {
    float largest = 0.0f;
    for (const Corner& c : t.corner) largest = std::fmax(largest, std::fabs(c.z));
    unit = std::ldexp(1.0, largest > 0.0f ? std::ilogb(largest) - 23 : -149);
  }
  offset += static_cast<double>(o.constant) * unit;
  if (o.clamp > 0.0f) offset = std::fmin(offset, static_cast<double>(o.clamp));
  if (o.clamp < 0.0f) offset = std::fmax(offset, static_cast<double>(o.clamp));
  return static_cast<float>(offset);
}

enum class Fate { drawn, degenerate, wrong_face, no_sample };

bool covers_none_of_few(const WindowTriangle& t, const Box& box);

// Determines the facing, vertex order and depth of a triangle. Its vertices are given in submission order.
std::pair<Fate, WindowTriangle> make_window_triangle(const DrawState& state, const Box& allowed, DepthFormat format, int samples,
                                                     const std::array<Corner, 3>& submitted, std::size_t provoking,
                                                     std::optional<bool> faces_front = {}) {
  WindowTriangle t;
  t.corner = submitted;
  t.flat = submitted[provoking].varyings;
  auto& c = t.corner;
  t.area = cross(c[1].x - c[0].x, c[1].y - c[0].y, c[2].x - c[0].x, c[2].y - c[0].y);
  if (t.area == 0) return {Fate::degenerate, t};
  const bool counter_clockwise = t.area > 0;
  t.front = counter_clockwise == (state.front == Winding::counter_clockwise);
  if (faces_front) t.front = *faces_front;
  if (!faces_front && culls_face(state.cull, t.front)) return {Fate::wrong_face, t};
  if (intersect(covered_box(t, samples), allowed).empty()) return {Fate::no_sample, t};
  if (!counter_clockwise) {
    std::swap(c[1], c[2]);
    t.area = -t.area;
  }
  // The vertex with the smallest depth comes first. Among equal ones, it is the first in counter-clockwise order, starting from the first
  // submitted vertex.
  const auto nearest = std::min_element(c.begin(), c.end(), [](const Corner& a, const Corner& b) { return a.z < b.z; });
  std::rotate(c.begin(), nearest, c.end());
  if (samples == 1 && covers_none_of_few(t, intersect(covered_box(t, samples), allowed))) return {Fate::no_sample, t};
  const double dz1 = static_cast<double>(c[1].z) - static_cast<double>(c[0].z);
  const double dz2 = static_cast<double>(c[2].z) - static_cast<double>(c[0].z);
  const float offset = faces_front ? 0.0f : polygon_offset(state.offset, format, t, dz1, dz2);
  t.z0 = c[0].z + offset;
  t.z_max = std::max({c[0].z, c[1].z, c[2].z}) + offset;
  t.z_step1 = static_cast<float>(dz1 / static_cast<double>(t.area));
  t.z_step2 = static_cast<float>(dz2 / static_cast<double>(t.area));
  return {Fate::drawn, t};
}

// ---- coverage and depth of a pixel -------------------------------------------------------------------------------------

// ---- lines: the diamond-exit rule (OpenGL 4.6, section 14.5.1) ---------------------------------------------------------

__extension__ typedef __int128 Wide;
struct WidePoint {
  Wide x, y;
};

// Returns whether the segment intersects the open diamond |x| + |y| < h. Each of the four sides restricts the segment to an open interval.
bool meets_diamond(const WidePoint& a, const WidePoint& b, Wide h) {
  Wide low_n = -1, low_d = 1, high_n = 2, high_d = 1;
  for (const auto& [sx, sy] : {std::pair{1, 1}, {1, -1}, {-1, 1}, {-1, -1}}) {
    const Wide fa = sx * a.x + sy * a.y - h, fb = sx * b.x + sy * b.y - h;
    if (fa >= 0 && fb >= 0) return false;
    if (fa < 0 && fb < 0) continue;
    const Wide n = fa >= 0 ? fa : -fa, d = fa >= 0 ? fa - fb : fb - fa;
    if (fa >= 0 && n * low_d > low_n * d) {
      low_n = n;
      low_d = d;
    }
    if (fa < 0 && n * high_d < high_n * d) {
      high_n = n;
      high_d = d;
    }
  }
  return low_n * high_d < high_n * low_d;
}

// Returns whether a line of width 1 produces the pixel. Both endpoints are moved by (-e, -e^2).
bool produces(const Point& from, const Point& to, int64_t x, int64_t y) {
  const bool near_by = std::max({std::abs(from.x), std::abs(from.y), std::abs(to.x), std::abs(to.y)}) < int64_t{1} << 19;
  const int bits = near_by ? 40 : 34;
  const auto moved = [&](const Point& p) {
    return WidePoint{(Wide{p.x - (x * 256 + 128)} << bits) - (Wide{1} << (bits / 2)), (Wide{p.y - (y * 256 + 128)} << bits) - 1};
  };
  const WidePoint a = moved(from), b = moved(to);
  const Wide h = Wide{128} << bits;
  const auto size = [](Wide v) { return v < 0 ? -v : v; };
  const bool ends_in_it = size(b.x) + size(b.y) < h;
  return !ends_in_it && meets_diamond(a, b, h);
}

bool line_covers(const WindowTriangle& t, int64_t x, int64_t y) {
  const int64_t dx = t.to.x - t.from.x, dy = t.to.y - t.from.y;
  const bool y_major = std::abs(dy) > std::abs(dx);
  // Reject pixels far from the line early.
  const auto along = static_cast<double>(y_major ? y * 256 + 128 - t.from.y : x * 256 + 128 - t.from.x);
  const double slope = static_cast<double>(y_major ? dx : dy) / static_cast<double>(y_major ? dy : dx);
  const double across = static_cast<double>(y_major ? x * 256 + 128 - t.from.x : y * 256 + 128 - t.from.y) - slope * along;
  if (std::fabs(across) > 128.0 * t.width + 512.0) return false;
  const int64_t shift = 128 * (t.width - 1);
  const Point from = y_major ? Point{t.from.x - shift, t.from.y} : Point{t.from.x, t.from.y - shift};
  const Point to = y_major ? Point{t.to.x - shift, t.to.y} : Point{t.to.x, t.to.y - shift};
  for (int k = 0; k < t.width; ++k) {
    if (produces(from, to, y_major ? x - k : x, y_major ? y : y - k)) return true;
  }
  return false;
}

// Returns whether a point is inside. A point on an edge is treated as if it were slightly further to the right and, by a smaller amount,
// further up.
bool covers(const WindowTriangle& t, const Point& at) {
  if (t.is_line) return line_covers(t, at.x >> 8, at.y >> 8);
  if (t.is_point) return at.x >= t.low.x && at.x < t.high.x && at.y >= t.low.y && at.y < t.high.y;
  for (std::size_t i = 0; i < 3; ++i) {
    const Corner& a = t.corner[i];
    const Corner& b = t.corner[(i + 1) % 3];
    const int64_t e = cross(b.x - a.x, b.y - a.y, at.x - a.x, at.y - a.y);
    const int64_t to_right = -(b.y - a.y), upwards = b.x - a.x;  // change in e per step in this direction
    const bool inside = e != 0 ? e > 0 : to_right != 0 ? to_right > 0 : upwards > 0;
    if (!inside) return false;
  }
  return true;
}

// a·b − c·d by Kahan's method.
float determinant(float a, float b, float c, float d) {
  const float product = c * d;
  const float lost = std::fma(-c, d, product);
  return std::fma(a, b, -product) + lost;
}

// Maximum extent of triangles for which the depth is computed from exact integer edge functions.
constexpr int64_t kExactExtent = 63 * 256;

bool is_small(const WindowTriangle& t) {
  const auto [xl, xh] = std::minmax({t.corner[0].x, t.corner[1].x, t.corner[2].x});
  const auto [yl, yh] = std::minmax({t.corner[0].y, t.corner[1].y, t.corner[2].y});
  return xh - xl <= kExactExtent && yh - yl <= kExactExtent;
}

// Returns whether a small triangle covers none of the pixel centers in a box of at most 4 x 4 pixels.
bool covers_none_of_few(const WindowTriangle& t, const Box& box) {
  if (!is_small(t) || box.x1 - box.x0 > 4 || box.y1 - box.y0 > 4) return false;
  for (int64_t y = box.y0; y < box.y1; ++y) {
    for (int64_t x = box.x0; x < box.x1; ++x) {
      if (covers(t, position_of({static_cast<int>(x), static_cast<int>(y), 0}, 1))) return false;
    }
  }
  return true;
}

float depth_sum(const WindowTriangle& t, const DepthState& state, float e1, float e2) {
  const float high = std::max(state.range_near, state.range_far);
  float low = std::min(state.range_near, state.range_far);
  if (t.is_line) low = clamped(t.z0, low, high);
  return clamped(std::fma(e1, t.z_step1, std::fma(e2, t.z_step2, t.z0)), low, clamped(t.z_max, low, high));
}

// Returns the determinants E1 = d × e2 and E2 = e1 × d in float, where d is the vector from vertex 0 to the point.
std::pair<float, float> float_determinants(const WindowTriangle& t, const Point& at) {
  const auto& c = t.corner;
  const auto f = [](int64_t v) { return static_cast<float>(v); };
  const float dx = f(at.x - c[0].x), dy = f(at.y - c[0].y);
  return {determinant(dx, f(c[2].y - c[0].y), dy, f(c[2].x - c[0].x)), determinant(f(c[1].x - c[0].x), dy, f(c[1].y - c[0].y), dx)};
}

// Returns the window depth for the depth test.
float tested_depth(const WindowTriangle& t, const DepthState& state, const Point& at) {
  if (t.is_point) return depth_sum(t, state, 0.0f, 0.0f);
  if (!t.is_line && is_small(t)) {
    const auto& c = t.corner;
    const int64_t dx = at.x - c[0].x, dy = at.y - c[0].y;
    const int64_t e1 = cross(dx, dy, c[2].x - c[0].x, c[2].y - c[0].y);
    const int64_t e2 = cross(c[1].x - c[0].x, c[1].y - c[0].y, dx, dy);
    return depth_sum(t, state, static_cast<float>(e1), static_cast<float>(e2));
  }
  const auto [e1, e2] = float_determinants(t, at);
  return depth_sum(t, state, e1, e2);
}

// ---- blending --------------------------------------------------------------------------------------------------------

float blend_factor(BlendFactor f, const glm::vec4& src, const glm::vec4& src1, const glm::vec4& dst, const glm::vec4& constant, int k) {
  switch (f) {
    case BlendFactor::zero: return 0.0f;
    case BlendFactor::one: return 1.0f;
    case BlendFactor::src_color: return src[k];
    case BlendFactor::one_minus_src_color: return 1.0f - src[k];
    case BlendFactor::dst_color: return dst[k];
    case BlendFactor::one_minus_dst_color: return 1.0f - dst[k];
    case BlendFactor::src_alpha: return src.w;
    case BlendFactor::one_minus_src_alpha: return 1.0f - src.w;
    case BlendFactor::dst_alpha: return dst.w;
    case BlendFactor::one_minus_dst_alpha: return 1.0f - dst.w;
    case BlendFactor::constant_color: return constant[k];
    case BlendFactor::one_minus_constant_color: return 1.0f - constant[k];
    case BlendFactor::constant_alpha: return constant.w;
    case BlendFactor::one_minus_constant_alpha: return 1.0f - constant.w;
    case BlendFactor::src_alpha_saturate: return k == 3 ? 1.0f : src.w < 1.0f - dst.w ? src.w : 1.0f - dst.w;
    case BlendFactor::src1_color: return src1[k];
    case BlendFactor::one_minus_src1_color: return 1.0f - src1[k];
    case BlendFactor::src1_alpha: return src1.w;
    case BlendFactor::one_minus_src1_alpha: return 1.0f - src1.w;
  }
  return 0.0f;
}

float blend_channel(BlendEquation equation, float s, float s_factor, float d, float d_factor) {
  const float from_source = s * s_factor;
  switch (equation) {
    case BlendEquation::add: return std::fma(d, d_factor, from_source);
    case BlendEquation::subtract: return std::fma(-d, d_factor, from_source);
    case BlendEquation::reverse_subtract: return std::fma(d, d_factor, -from_source);
    case BlendEquation::min: return s < d ? s : d;
    case BlendEquation::max: return s > d ? s : d;
  }
  return 0.0f;
}

// unit: number of steps from 0 to 1 in the result. An attachment of rgba8 is blended in units of its codes.
glm::vec4 blend(const BlendState& b, const glm::vec4& src, const glm::vec4& src1, const glm::vec4& dst, const glm::vec4& constant,
                float unit) {
  glm::vec4 out;
  for (int k = 0; k < 4; ++k) {
    const bool alpha = k == 3;
    const float s = blend_factor(alpha ? b.source_alpha : b.source_color, src, src1, dst, constant, k);
    const float d = blend_factor(alpha ? b.destination_alpha : b.destination_color, src, src1, dst, constant, k);
    const float existing = unit == 1.0f ? dst[k] : std::round(dst[k] * unit);
    out[k] = blend_channel(alpha ? b.alpha_equation : b.color_equation, src[k] * unit, s, existing, d);
  }
  return out;
}

// ---- tests -----------------------------------------------------------------------------------------------------------

template <class T>
bool compares(CompareOp op, T a, T b) {
  switch (op) {
    case CompareOp::never: return false;
    case CompareOp::less: return a < b;
    case CompareOp::equal: return a == b;
    case CompareOp::less_equal: return a <= b;
    case CompareOp::greater: return a > b;
    case CompareOp::not_equal: return a != b;
    case CompareOp::greater_equal: return a >= b;
    case CompareOp::always: return true;
  }
  return false;
}

uint8_t stencil_result(const StencilFace& f, StencilOp op, uint8_t stored) {
  int v = stored;
  switch (op) {
    case StencilOp::keep: break;
    case StencilOp::zero: v = 0; break;
    case StencilOp::replace: v = f.reference; break;
    case StencilOp::increment_clamp: v = std::min(stored + 1, 255); break;
    case StencilOp::decrement_clamp: v = std::max(stored - 1, 0); break;
    case StencilOp::invert: v = 255 - stored; break;
    case StencilOp::increment_wrap: v = (stored + 1) % 256; break;
    case StencilOp::decrement_wrap: v = (stored + 255) % 256; break;
  }
  return static_cast<uint8_t>((stored & ~f.write_mask) | (v & f.write_mask));
}

}  // namespace

// ---- interpolation -----------------------------------------------------------------------------------------------------

namespace {

// Returns a plane in which corner 1 is one step in s, and corner 2 is one step in t, from the origin of the point coordinate.
Surface point_surface(const WindowTriangle& t) {
  const auto f = [](int64_t v) { return static_cast<float>(v); };
  const bool from_top = t.origin == PointOrigin::upper_left;
  const int64_t height = from_top ? t.low.y - t.high.y : t.high.y - t.low.y;
  Surface s{};
  s.lanes = {f(t.low.x),
             f(from_top ? t.high.y : t.low.y),
             f(t.high.x - t.low.x),
             0.0f,
             0.0f,
             f(height),
             f((t.high.x - t.low.x) * height),
             0.0f,
             0.0f,
             0.0f,
             0.0f};
  const int exponent = std::max(std::ilogb(t.corner[0].inv_w), -127);
  s.lanes.q0 = s.lanes.q1 = s.lanes.q2 = std::ldexp(t.corner[0].inv_w, -exponent);
  s.lanes.q_unscale = exponent == -127 ? 0.0f : std::ldexp(1.0f, exponent);
  s.value0 = t.corner[0].varyings;
  s.delta1.assign(s.value0.size(), 0.0f);
  s.delta2 = s.delta1;
  return s;
}

}  // namespace

Surface make_surface(const WindowTriangle& t, std::span<const Interpolation> interpolations) {
  if (t.is_point) return point_surface(t);
  std::array<const Corner*, 3> c{&t.corner[0], &t.corner[1], &t.corner[2]};
  const auto farthest = std::min_element(c.begin(), c.end(), [](const Corner* a, const Corner* b) { return a->inv_w < b->inv_w; });
  std::rotate(c.begin(), farthest, c.end());
  Surface s{};
  TriangleLanes<float>& l = s.lanes;
  l.x0 = static_cast<float>(c[0]->x);
  l.y0 = static_cast<float>(c[0]->y);
  l.e1x = static_cast<float>(c[1]->x - c[0]->x);
  l.e1y = static_cast<float>(c[1]->y - c[0]->y);
  l.e2x = static_cast<float>(c[2]->x - c[0]->x);
  l.e2y = static_cast<float>(c[2]->y - c[0]->y);
  l.area = determinant(l.e1x, l.e2y, l.e1y, l.e2x);
  // Scale by a power of two so that the largest 1/w is in [1, 2), or below 1 if it is a denormal.
  const float largest = std::max({c[0]->inv_w, c[1]->inv_w, c[2]->inv_w});
  const int exponent = std::max(std::ilogb(largest), -127);
  l.q0 = std::ldexp(c[0]->inv_w, -exponent);
  l.q1 = std::ldexp(c[1]->inv_w, -exponent);
  l.q2 = std::ldexp(c[2]->inv_w, -exponent);
  l.q_unscale = exponent == -127 ? 0.0f : std::ldexp(1.0f, exponent);
  for (std::size_t i = 0; i < interpolations.size(); ++i) {
    const bool flat = interpolations[i] == Interpolation::flat;
    s.value0.push_back(flat ? t.flat[i] : c[0]->varyings[i]);
    s.delta1.push_back(flat ? 0.0f : c[1]->varyings[i] - c[0]->varyings[i]);
    s.delta2.push_back(flat ? 0.0f : c[2]->varyings[i] - c[0]->varyings[i]);
  }
  return s;
}

namespace {

// The part of a triangle's extent along one axis that lies in a cell of 64 pixels, in 1/256 px.
struct CellPart {
  int64_t begin, end;

  int64_t center() const { return begin + (end - begin) / 2; }
  double reach() const { return static_cast<double>(end - center()); }
};

constexpr int64_t kCellSize = 64;

CellPart part_in_cell(int64_t a, int64_t b, int64_t c, int64_t cell) {
  const int64_t low = cell * kCellSize * 256;
  return {std::max(std::min({a, b, c}), low), std::min(std::max({a, b, c}), low + kCellSize * 256)};
}

// A barycentric weight as a plane, relative to the center of the part of the cell.
struct WeightPlane {
  double at_center, along_x, along_y;

  // Whether the rounding errors of a value that is 1 at this vertex and −1 at the others stay below 5 · 2^-24. The errors are those of the
  // value at the center, the step along x, the step along y, the sum of the first two, and the result:
  // |1 − 2 · at_center| + step_x + step_y + (1 + step_y) + 1.
  bool is_accurate(const CellPart& x, const CellPart& y) const {
    const double step_x = 2 * std::abs(along_x) * x.reach(), step_y = 2 * std::abs(along_y) * y.reach();
    return std::abs(1 - 2 * at_center) + step_x + 2 * step_y <= 3;
  }
};

}  // namespace

// If w is constant, the values of a large triangle are evaluated as planes. They are relative to the center of the part of the cell that
// the triangle's bounding box overlaps. Planes are not used if the rounding errors of some values could exceed 5 · 2^-24 of the largest
// value.
Surface surface_in_cell(const WindowTriangle& t, const Surface& whole, std::span<const Interpolation> interpolations, int64_t cell_x,
                        int64_t cell_y) {
  const auto& [a, b, c] = t.corner;
  constexpr int64_t large = 63 * 256;
  const auto extent = [](int64_t u, int64_t v, int64_t w) { return std::max({u, v, w}) - std::min({u, v, w}); };
  if (t.is_point || t.is_line || a.inv_w != b.inv_w || a.inv_w != c.inv_w) return whole;
  if (extent(a.x, b.x, c.x) <= large && extent(a.y, b.y, c.y) <= large) return whole;
  const CellPart x = part_in_cell(a.x, b.x, c.x, cell_x), y = part_in_cell(a.y, b.y, c.y, cell_y);
  const double scale = 1.0 / static_cast<double>((b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x));
  // Returns the weight of the vertex opposite to the edge from `from` to `to`.
  const auto weight = [&](const Corner& from, const Corner& to) {
    const int64_t ex = to.x - from.x, ey = to.y - from.y;
    return WeightPlane{static_cast<double>(ex * (y.center() - from.y) - ey * (x.center() - from.x)) * scale,
                       static_cast<double>(-ey) * scale, static_cast<double>(ex) * scale};
  };
  const WeightPlane of_b = weight(c, a), of_c = weight(a, b);
  const WeightPlane of_a{1.0 - (of_b.at_center + of_c.at_center), of_b.along_x + of_c.along_x, of_b.along_y + of_c.along_y};
  if (!of_a.is_accurate(x, y) || !of_b.is_accurate(x, y) || !of_c.is_accurate(x, y)) return whole;
  Surface s = whole;
  s.lanes = TriangleLanes<float>{.x0 = static_cast<float>(x.center()),
                                 .y0 = static_cast<float>(y.center()),
                                 .e1x = 0,
                                 .e1y = 0,
                                 .e2x = 0,
                                 .e2y = 0,
                                 .area = 1,
                                 .q0 = whole.lanes.q0,
                                 .q1 = whole.lanes.q1,
                                 .q2 = whole.lanes.q2,
                                 .q_unscale = whole.lanes.q_unscale,
                                 .planar = true};
  for (std::size_t i = 0; i < interpolations.size(); ++i) {
    if (interpolations[i] == Interpolation::flat) continue;
    const double first{a.varyings[i]}, to_b = double{b.varyings[i]} - first, to_c = double{c.varyings[i]} - first;
    s.value0[i] = static_cast<float>(first + (of_b.at_center * to_b + of_c.at_center * to_c));
    s.delta1[i] = static_cast<float>(of_b.along_x * to_b + of_c.along_x * to_c);
    s.delta2[i] = static_cast<float>(of_b.along_y * to_b + of_c.along_y * to_c);
  }
  return s;
}

namespace {

// Returns the sum of three numbers, and the fractions of the second and the third. Rounding can keep the three fractions from adding up to
// 1; the difference is distributed in proportion to the fractions.
std::array<float, 3> share(const std::array<float, 3>& n) {
  const float sum = n[0] + (n[1] + n[2]);
  const float inverse = 1.0f / sum;
  const float second = n[1] * inverse, third = n[2] * inverse;
  const bool second_is_larger = second > third;
  const float larger = second_is_larger ? second : third, smaller = second_is_larger ? third : second;
  const float missing = std::fma(-n[0], inverse, (1.0f - larger) - smaller);
  return {sum, std::fma(second, missing, second), std::fma(third, missing, third)};
}

}  // namespace

SurfacePoint surface_point(const Surface& s, const WindowTriangle& t, const DepthState& state, const Point& at) {
  const TriangleLanes<float>& l = s.lanes;
  SurfacePoint p{};
  p.dx = static_cast<float>(at.x) - l.x0;
  p.dy = static_cast<float>(at.y) - l.y0;
  // Shaders receive the depth from float determinants, even for triangles whose tested depth uses exact integers.
  const auto [z1, z2] = t.is_point ? std::pair{0.0f, 0.0f} : float_determinants(t, at);
  p.z = depth_sum(t, state, z1, z2);
  if (l.planar) {
    p.weights = {p.dx, p.dy, p.dx, p.dy, l.q0, 256.0f, 0.0f, 0.0f, 256.0f};
    return p;
  }
  const float e0 = determinant(l.e1x - p.dx, l.e2y - p.dy, l.e1y - p.dy, l.e2x - p.dx);
  const float e1 = determinant(p.dx, l.e2y, p.dy, l.e2x);
  const float e2 = determinant(l.e1x, p.dy, l.e1y, p.dx);
  const std::array<float, 3> linear = share({e0, e1, e2});
  const std::array<float, 3> perspective = share({e0 * l.q0, e1 * l.q1, e2 * l.q2});
  // See weight_slopes in shading/pixel.h.
  const float inverse = 1.0f / perspective[0];
  const float per_x = 256.0f * l.area * inverse * inverse, per_y = -256.0f * l.area * inverse * inverse;
  p.weights = {perspective[1],
               perspective[2],
               linear[1],
               linear[2],
               perspective[0],
               l.q1 * per_x * determinant(l.q2, p.dy, l.q0, p.dy - l.e2y),
               l.q2 * per_x * determinant(l.q0, p.dy - l.e1y, l.q1, p.dy),
               l.q1 * per_y * determinant(l.q2, p.dx, l.q0, p.dx - l.e2x),
               l.q2 * per_y * determinant(l.q0, p.dx - l.e1x, l.q1, p.dx)};
  return p;
}

float component_at(const Surface& s, const SurfacePoint& p, Interpolation mode, std::size_t i) {
  if (mode == Interpolation::flat) return s.value0[i];
  const float w1 = mode == Interpolation::linear ? p.weights.b1 : p.weights.p1;
  const float w2 = mode == Interpolation::linear ? p.weights.b2 : p.weights.p2;
  return std::fma(w2, s.delta2[i], std::fma(w1, s.delta1[i], s.value0[i]));
}

// ---- primitives ----------------------------------------------------------------------------------------------------------

std::vector<std::array<uint32_t, 3>> assemble(const std::vector<uint32_t>& indices, bool restart, const DrawState& state) {
  std::vector<std::array<uint32_t, 3>> out;
  std::vector<uint32_t> run;
  const auto finish_run = [&] {
    if (state.topology == Topology::points) {
      for (const uint32_t i : run) out.push_back({i, i, i});
      run.clear();
      return;
    }
    if (is_lines(state.topology)) {
      const std::size_t step = state.topology == Topology::lines ? 2 : 1;
      for (std::size_t i = 0; i + 2 <= run.size(); i += step) out.push_back({run[i], run[i + 1], run[i + 1]});
      if (state.topology == Topology::line_loop && run.size() > 1) out.push_back({run.back(), run[0], run[0]});
      run.clear();
      return;
    }
    const std::size_t step = state.topology == Topology::triangles ? 3 : 1;
    for (std::size_t i = 0; i + 3 <= run.size(); i += step) {
      std::array<uint32_t, 3> t{run[i], run[i + 1], run[i + 2]};  // table 13.2: the first or last vertex is provoking, except in a fan
      if (state.topology == Topology::triangle_fan) t = {run[i + 1], run[i + 2], run[0]};
      const bool turned = state.topology == Topology::triangle_strip && i % 2 == 1;
      if (state.provoking == ProvokingVertex::first) {
        if (turned) std::swap(t[1], t[2]);
      } else {
        if (state.topology == Topology::triangle_fan) t = {run[0], run[i + 1], run[i + 2]};
        if (turned) std::swap(t[0], t[1]);
      }
      out.push_back(t);
    }
    run.clear();
  };
  for (const uint32_t i : indices) {
    if (restart && i == kRestart) {
      finish_run();
    } else {
      run.push_back(i);
    }
  }
  finish_run();
  return out;
}

// ---- the main loops ------------------------------------------------------------------------------------------------------

std::vector<WindowTriangle> Renderer::window_points(const DrawState& state, const ShadedVertex& v) {
  ++counts_.primitives_in;
  const glm::vec4& p = v.pos_clip;
  if (!is_finite(v)) {
    ++counts_.culled_non_finite;
    return {};
  }
  const float inv_w = 1.0f / p.w;
  const bool beyond = std::any_of(v.clip_distances.begin(), v.clip_distances.end(), [](float d) { return !(d >= 0.0f); });
  if (beyond || !(inv_w > 0.0f && inv_w <= 1.0f / kMinW) || (!state.depth.clamp && (beyond_near(state.depth, p) || beyond_far(p)))) {
    ++counts_.culled_outside;
    return {};
  }
  const Transform f = make_transform(state.viewport.value_or(Rect{0, 0, target_.width(), target_.height()}), state.depth);
  const auto place = [](double ndc, float half, float center) {
    return std::llrint(std::fmin(std::fmax((ndc * static_cast<double>(half) + static_cast<double>(center)) * 256.0, -0x1p28), 0x1p28));
  };
  WindowTriangle t;
  t.is_point = t.front = true;
  t.origin = state.point_origin;
  Corner& c = t.corner[0];
  c.varyings = v.varyings;
  c.inv_w = inv_w;
  c.z = clamped(std::fma(p.z * c.inv_w, f.z_scale, f.z_bias), -1e30f, 1e30f);
  t.z0 = t.z_max = c.z;
  if (v.has_bounds) {
    const auto number = [](float x) { return static_cast<double>(x); };
    t.low = {place(number(v.low.x), f.half_width, f.center_x), place(number(v.low.y), f.half_height, f.center_y)};
    t.high = {place(number(v.high.x), f.half_width, f.center_x), place(number(v.high.y), f.half_height, f.center_y)};
  } else {
    const bool near_by = !needs_clip(f, {.clamp = true}, p);
    const auto x = static_cast<double>(p.x) / static_cast<double>(p.w), y = static_cast<double>(p.y) / static_cast<double>(p.w);
    c.x = near_by ? snap(p.x, p.w, f.half_width, f.center_x) : place(x, f.half_width, f.center_x);
    c.y = near_by ? snap(p.y, p.w, f.half_height, f.center_y) : place(y, f.half_height, f.center_y);
    const int64_t side = std::llrint(std::fmin(std::fmax(static_cast<double>(v.point_size) * 256.0, 0.0), 0x1p28));
    t.low = {c.x - side / 2, c.y - side / 2};
    t.high = {t.low.x + side, t.low.y + side};
  }
  if (t.low.x >= t.high.x || t.low.y >= t.high.y) {
    ++counts_.culled_degenerate;
    return {};
  }
  // The rectangle must intersect the sample bounding box of a drawable pixel.
  const Box allowed = allowed_pixels(target_, state);
  WindowTriangle closed = t;
  closed.is_point = false;
  closed.corner[0] = {t.low.x, t.low.y, 0, 0, {}};
  closed.corner[1] = closed.corner[2] = {t.high.x - 1, t.high.y - 1, 0, 0, {}};
  if (intersect(covered_box(closed, target_.samples()), allowed).empty()) {
    ++counts_.culled_no_sample;
    return {};
  }
  ++counts_.triangles;
  return {t};
}

// Returns a line that follows the diamond-exit rule or, with several samples per pixel, the two halves of a rectangle.
std::vector<WindowTriangle> Renderer::window_line(const DrawState& state, const Corner& a, const Corner& b, const std::vector<float>& flat,
                                                  bool front) {
  const int64_t dx = b.x - a.x, dy = b.y - a.y;
  if (dx == 0 && dy == 0) return {};
  if (target_.samples() == 1) {
    WindowTriangle t;
    t.is_line = true;
    t.from = {a.x, a.y};
    t.to = {b.x, b.y};
    t.width = static_cast<int>(std::nearbyint(clamped(state.line_width, 1.0f, 4096.0f)));
    t.front = front;
    t.flat = flat;
    const bool swap = b.z < a.z;
    const Corner &near = swap ? b : a, &far = swap ? a : b;
    t.corner = {near, far, near};
    t.corner[2].x = near.x - (far.y - near.y);
    t.corner[2].y = near.y + (far.x - near.x);
    t.area = dx * dx + dy * dy;
    t.z0 = near.z;
    t.z_max = far.z;
    t.z_step1 = static_cast<float>((static_cast<double>(far.z) - static_cast<double>(near.z)) / static_cast<double>(t.area));
    return {t};
  }
  const auto length = std::sqrt(static_cast<double>(dx) * static_cast<double>(dx) + static_cast<double>(dy) * static_cast<double>(dy));
  const double scale = static_cast<double>(clamped(state.line_width, 0.0f, 4096.0f)) * 128.0 / length;
  const int64_t nx = std::llrint(static_cast<double>(-dy) * scale), ny = std::llrint(static_cast<double>(dx) * scale);
  const auto moved = [&](Corner c, int64_t by) {
    c.x += by * nx;
    c.y += by * ny;
    return c;
  };
  std::vector<WindowTriangle> halves;
  for (const std::array<Corner, 3>& half :
       {std::array{moved(a, -1), moved(b, -1), moved(b, 1)}, {moved(a, -1), moved(b, 1), moved(a, 1)}}) {
    auto [fate, piece] =
        make_window_triangle(state, allowed_pixels(target_, state), target_.depth_format(), target_.samples(), half, 0, front);
    piece.flat = flat;
    if (fate == Fate::drawn) halves.push_back(std::move(piece));
  }
  return halves;
}

// Returns the lines or points that are drawn instead of a polygon.
std::vector<WindowTriangle> Renderer::window_outline(const DrawState& state, const std::vector<Corner>& corners,
                                                     const std::vector<int>& vertex, const std::array<const ShadedVertex*, 3>& v,
                                                     const std::vector<float>& flat) {
  int64_t area = 0;
  for (std::size_t i = 2; i < corners.size(); ++i) area += orient2d(corners[0], corners[i - 1], corners[i]);
  const bool front = (area > 0) == (state.front == Winding::counter_clockwise);
  if (area == 0) ++counts_.culled_degenerate;
  if (area != 0 && culls_face(state.cull, front)) ++counts_.culled_face;
  if (area == 0 || culls_face(state.cull, front)) return {};
  std::vector<WindowTriangle> out;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    if (state.polygon_mode == PolygonMode::line) {
      for (WindowTriangle& t : window_line(state, corners[i], corners[(i + 1) % corners.size()], flat, front)) out.push_back(std::move(t));
    } else if (vertex[i] >= 0) {
      ShadedVertex point = *v[static_cast<std::size_t>(vertex[i])];
      point.clip_distances.clear();
      const Counts before = counts_;
      std::vector<WindowTriangle> one = window_points(state, point);
      counts_ = before;
      for (WindowTriangle& t : one) {
        t.front = front;
        t.corner[0].varyings = corners[i].varyings;
        out.push_back(std::move(t));
      }
    }
  }
  return out;
}

std::vector<WindowTriangle> Renderer::window_triangles(const DrawState& state, const ShaderFacts& facts,
                                                       const std::array<const ShadedVertex*, 3>& v) {
  ++counts_.primitives_in;
  const bool line = is_lines(state.topology);
  counts_.has_lines |= line || state.polygon_mode != PolygonMode::fill;
  if (!std::all_of(v.begin(), v.end(), [](const ShadedVertex* s) { return is_finite(*s); })) {
    ++counts_.culled_non_finite;
    return {};
  }
  bool beyond_all = false, beyond_any = false;  // for a single clip distance
  for (std::size_t k = 0; k < v[0]->clip_distances.size(); ++k) {
    const auto beyond = [k](const ShadedVertex* s) { return !(s->clip_distances[k] >= 0.0f); };
    beyond_all |= std::all_of(v.begin(), v.end(), beyond);
    beyond_any |= std::any_of(v.begin(), v.end(), beyond);
  }
  if (all_outside(state.depth, v) || beyond_all) {
    ++counts_.culled_outside;
    return {};
  }
  const Transform transform = make_transform(state.viewport.value_or(Rect{0, 0, target_.width(), target_.height()}), state.depth);
  const std::size_t provoking = state.provoking == ProvokingVertex::first ? 0 : 2;
  std::vector<Corner> corners;
  std::vector<int> vertices{0, 1, 2};
  bool corners_are_cut = false;
  if (beyond_any ||
      std::any_of(v.begin(), v.end(), [&](const ShadedVertex* s) { return needs_clip(transform, state.depth, s->pos_clip); })) {
    Polygon polygon;
    for (std::size_t i = 0; i < (line ? 2 : 3); ++i) {
      const glm::vec4& p = v[i]->pos_clip;
      polygon.push_back({{static_cast<double>(p.x), static_cast<double>(p.y), static_cast<double>(p.z), static_cast<double>(p.w)},
                         {i == 0 ? 1.0 : 0.0, i == 1 ? 1.0 : 0.0, i == 2 ? 1.0 : 0.0},
                         static_cast<int>(i)});
    }
    std::vector<Plane> planes = clip_planes(transform, state.depth);
    for (std::size_t k = 0; k < v[0]->clip_distances.size(); ++k) {
      const auto of = [&](std::size_t i) { return static_cast<double>(v[i]->clip_distances[k]); };
      planes.push_back({0, 0, 0, 0, 0, std::array{of(0), of(1), of(2)}});
    }
    for (const Plane& plane : planes) {
      polygon = line ? cut_line(plane, &plane == planes.data(), polygon) : cut(plane, &plane == planes.data(), polygon);
    }
    if (polygon.size() < (line ? 2u : 3u)) {
      ++counts_.culled_outside;
      return {};
    }
    ++counts_.clipped;
    corners_are_cut = true;
    vertices.clear();
    for (const ClipPoint& c : polygon) {
      corners.push_back(clip_corner(transform, c, v, facts, provoking));
      vertices.push_back(c.vertex);
    }
  } else {
    for (std::size_t i = 0; i < (line ? 2 : 3); ++i) corners.push_back(project(transform, *v[i]));
  }
  const std::vector<float>& flat = v[provoking]->varyings;
  if (line || state.polygon_mode != PolygonMode::fill || corners_are_cut) {  // all vertices get the flat values of the provoking vertex
    for (Corner& c : corners) {
      for (std::size_t i = 0; i < c.varyings.size(); ++i) {
        if (facts.interpolations[i] == Interpolation::flat) c.varyings[i] = flat[i];
      }
    }
  }
  if (line) return window_line(state, corners[0], corners[1], flat, true);
  if (state.polygon_mode != PolygonMode::fill) return window_outline(state, corners, vertices, v, flat);

  const Box allowed = allowed_pixels(target_, state);
  const bool clipped = corners.size() != 3 || corners_are_cut;
  std::vector<WindowTriangle> pieces;
  Fate last = Fate::drawn;
  for (const std::array<Corner, 3>& c : clipped ? fan(corners) : std::vector<std::array<Corner, 3>>{{corners[0], corners[1], corners[2]}}) {
    auto [fate, piece] = make_window_triangle(state, allowed, target_.depth_format(), target_.samples(), c, clipped ? 0 : provoking);
    if (fate == Fate::drawn) pieces.push_back(std::move(piece));
    last = fate;
  }
  counts_.triangles += pieces.size();
  if (pieces.empty()) {
    if (last == Fate::degenerate) ++counts_.culled_degenerate;
    if (last == Fate::wrong_face) ++counts_.culled_face;
    if (last == Fate::no_sample) ++counts_.culled_no_sample;
  }
  return pieces;
}

void Renderer::rasterize(const DrawState& state, const ShaderFacts& facts, const WindowTriangle& t, const FragmentFunction& shade) {
  const Surface surface = make_surface(t, facts.interpolations);
  const Box box = intersect(covered_box(t, target_.samples()), allowed_pixels(target_, state));
  Surface in_cell;
  for (int64_t y = box.y0; y < box.y1; ++y) {
    for (int64_t x = box.x0; x < box.x1; ++x) {
      if (x == box.x0 || x % kCellSize == 0) in_cell = surface_in_cell(t, surface, facts.interpolations, x / kCellSize, y / kCellSize);
      draw_pixel(state, facts, t, in_cell, static_cast<int>(x), static_cast<int>(y), shade);
    }
  }
}

void Renderer::draw_pixel(const DrawState& state, const ShaderFacts& facts, const WindowTriangle& t, const Surface& surface, int x, int y,
                          const FragmentFunction& shade) {
  std::optional<FragmentResult> of_pixel;
  Point centroid = center_of(x, y);  // if only some samples are covered, replaced by the first of them
  std::vector<Point> covered;
  for (int i = 0; i < target_.samples(); ++i) {
    const Point p = position_of({x, y, i}, target_.samples());
    if (covers(t, p)) covered.push_back(p);
  }
  if (!covered.empty() && covered.size() < static_cast<std::size_t>(target_.samples())) centroid = covered[0];
  for (int i = 0; i < target_.samples(); ++i) {
    const Sample s{x, y, i};
    if (!covers(t, position_of(s, target_.samples()))) continue;
    if (target_.samples() > 1 && (state.sample_mask >> i) % 2 == 0) continue;
    if (state.sample_shading || supersample_) {
      const Point at = position_of(s, target_.samples());
      draw_sample(state, facts, t, s, shade(t, surface, at, at));
    } else {
      if (!of_pixel) of_pixel = shade(t, surface, center_of(x, y), centroid);
      draw_sample(state, facts, t, s, *of_pixel);
    }
  }
}

void Renderer::draw_sample(const DrawState& state, const ShaderFacts& facts, const WindowTriangle& t, const Sample& s,
                           const FragmentResult& result) {
  if (!result.keep) return;
  const auto samples = static_cast<float>(target_.samples());
  if (state.alpha_to_coverage && facts.has_fragment && samples > 1.0f &&
      !(result.colors[0].w * samples >= static_cast<float>(s.number) + 0.5f))
    return;
  double z = target_.depth_value(tested_depth(t, state.depth, position_of(s, target_.samples())));
  if (facts.writes_depth) {
    const float low = std::min(state.depth.range_near, state.depth.range_far),
                high = std::max(state.depth.range_near, state.depth.range_far);
    z = target_.depth_value(clamped(result.depth, low, high));
  }
  if (!tests_pass(state, t.front, s, z)) return;
  ++counts_.samples_passed;
  if (state.query) counts_.queries[*state.query] += 1;
  if (state.depth.test && state.depth.write) target_.set_depth(s, z);
  if (facts.has_fragment) write_colors(state, s, result.colors);
}

bool Renderer::depth_passes(const DrawState& state, const Sample& s, double z) const {
  return !state.depth.test || target_.depth_format() == DepthFormat::none || compares(state.depth.compare, z, target_.depth(s));
}

// Performs the stencil test and then the depth test. The stencil operation depends on the results of both.
bool Renderer::tests_pass(const DrawState& state, bool front, const Sample& s, double z) {
  if (!state.stencil || !has_stencil(target_.depth_format())) return depth_passes(state, s, z);
  const StencilFace& f = front ? state.stencil->front : state.stencil->back;
  const uint8_t stored = target_.stencil(s);
  const bool stencil_passes = compares(f.compare, f.reference & f.read_mask, stored & f.read_mask);
  const bool passes = stencil_passes && depth_passes(state, s, z);
  target_.set_stencil(s, stencil_result(f, !stencil_passes ? f.fail : passes ? f.pass : f.depth_fail, stored));
  return passes;
}

void Renderer::write_colors(const DrawState& state, const Sample& s, const std::vector<glm::vec4>& colors) {
  const glm::vec4 none(0.0f);
  for (std::size_t i = 0; i < std::min(colors.size(), target_.color_formats().size()); ++i) {
    const ColorFormat format = target_.color_formats()[i];
    if (format == ColorFormat::none) continue;
    const bool own = state.attachments[i].has_value();
    const std::optional<BlendState>& blending = own ? state.attachments[i]->blend : state.blend;
    const ColorMask mask = own ? state.attachments[i]->mask : state.color_mask;
    const glm::vec4 before = target_.color(i, s);
    glm::vec4 color = colors[i];
    if (blending) {
      const auto in_range = [&](glm::vec4 c) {
        const bool fixed_point = format == ColorFormat::rgba8 || format == ColorFormat::srgb8a8;
        for (int k = 0; fixed_point && k < 4; ++k) c[k] = clamped(c[k], 0.0f, 1.0f);
        return c;
      };
      const float unit = format == ColorFormat::rgba8 ? 255.0f : 1.0f;
      color = blend(*blending, in_range(color), in_range(colors.size() > 1 ? colors[1] : none), before, in_range(blending->constant), unit);
      // The float nearest to code/255 is encoded as this code.
      for (int k = 0; unit != 1.0f && k < 4; ++k) color[k] = std::nearbyint(clamped(color[k], 0.0f, unit)) / unit;
    }
    const std::array<bool, 4> written{mask.r, mask.g, mask.b, mask.a};
    for (int k = 0; k < 4; ++k) {
      if (!written[static_cast<std::size_t>(k)]) color[k] = before[k];
    }
    target_.set_color(i, s, color);
  }
}

}  // namespace halfspace::oracle
