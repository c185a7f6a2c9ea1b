// SPDX-License-Identifier: Apache-2.0
//
// The reference of texture lookups: OpenGL 4.6 in double precision, without the code of TextureView and of the texel codec.
#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>
#include <random>

#include "conformance/texture_lookups.h"
#include "shading/texture_reference.h"

namespace halfspace::conformance::lookups {

namespace {

// ---- formats (sections 2.3.4, 2.3.5 and 8.25) ----------------------------------------------------------------------

// Returns `count` of the bits of a texel, of which bit 0 is the lowest of the first byte.
uint32_t field(const std::byte* texel, int first, int count) {
  uint64_t bits = 0;
  for (int byte = first / 8; 8 * byte < first + count; ++byte)
    bits |= uint64_t{std::to_integer<uint8_t>(texel[byte])} << 8 * (byte - first / 8);
  return static_cast<uint32_t>(bits >> first % 8 & ((uint64_t{1} << count) - 1));
}

// A float with an exponent of 5 bits and without a sign.
double small_float(uint32_t code, int mantissa_bits) {
  const int exponent = static_cast<int>(code >> mantissa_bits);
  const double mantissa = std::ldexp(static_cast<double>(code & ((1u << mantissa_bits) - 1)), -mantissa_bits);
  return exponent == 0 ? std::ldexp(mantissa, -14) : std::ldexp(1.0 + mantissa, exponent - 15);
}

double depth_of(TexelFormat format, const std::byte* texel) {
  switch (format) {
    case TexelFormat::d16: return field(texel, 0, 16) / 65535.0;
    case TexelFormat::d24: return field(texel, 0, 24) / 16777215.0;
    case TexelFormat::d24s8: return field(texel, 8, 24) / 16777215.0;
    default: return static_cast<double>(std::bit_cast<float>(field(texel, 0, 32)));
  }
}

double channel(const TexelInfo& info, uint32_t code, int bits, int k) {
  const double most = std::ldexp(1.0, bits) - 1;
  const double signed_code = code >> (bits - 1) != 0 ? code - std::ldexp(1.0, bits) : code;
  switch (info.kind) {
    case TexelKind::unorm: return code / most;
    case TexelKind::srgb: {
      const double c = code / most;
      return k == 3 ? c : c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
    }
    case TexelKind::snorm: return std::max(signed_code / (std::ldexp(1.0, bits - 1) - 1), -1.0);
    case TexelKind::sints: return signed_code;
    case TexelKind::uints: return code;
    default: break;
  }
  if (bits == 32) return static_cast<double>(std::bit_cast<float>(code));
  if (bits == 16) return small_float(code & 0x7fff, 10) * (code >> 15 != 0 ? -1.0 : 1.0);
  return small_float(code, bits - 5);
}

}  // namespace

glm::dvec4 decoded(TexelFormat format, const std::byte* texel) {
  const TexelInfo& info = texel_info(format);
  glm::dvec4 v(0.0, 0.0, 0.0, 1.0);
  if (info.kind == TexelKind::depth) return {depth_of(format, texel), 0.0, 0.0, 1.0};
  std::array<int, 4> bits{info.bits, info.bits, info.bits, info.bits};
  if (format == TexelFormat::rgb10_a2 || format == TexelFormat::rgb10_a2ui) bits = {10, 10, 10, 2};
  if (format == TexelFormat::rgb565) bits = {5, 6, 5, 0};
  if (format == TexelFormat::rgb5_a1) bits = {5, 5, 5, 1};
  if (format == TexelFormat::rgba4) bits = {4, 4, 4, 4};
  const bool is_highest_first = info.bits == 0 && info.bytes == 2;
  if (format == TexelFormat::r11f_g11f_b10f) bits = {11, 11, 10, 0};
  if (format == TexelFormat::rgb9_e5) bits = {9, 9, 9, 5};
  int first = 0;
  for (int k = 0; k < info.channels; ++k) {
    const int count = bits[static_cast<std::size_t>(k)];
    const uint32_t code = field(texel, is_highest_first ? 16 - first - count : first, count);
    v[k] = format == TexelFormat::rgb9_e5 ? std::ldexp(static_cast<double>(code), static_cast<int>(field(texel, 27, 5)) - 15 - 9)
                                          : channel(info, code, count, k);
    first += count;
  }
  return v;
}

double stencil_of(TexelFormat format, const std::byte* texel) {
  return format == TexelFormat::d24s8 ? field(texel, 0, 8) : format == TexelFormat::d32fs8 ? field(texel, 32, 8) : 0;
}

namespace {

// ---- cubes (section 8.13, table 8.19) ------------------------------------------------------------------------------

// Returns the direction whose sc, tc and |ma| are given.
glm::dvec3 direction(int face, double sc, double tc, double ma) {
  switch (face) {
    case 0: return {ma, -tc, -sc};
    case 1: return {-ma, -tc, sc};
    case 2: return {sc, ma, tc};
    case 3: return {sc, -ma, -tc};
    case 4: return {sc, -tc, ma};
    default: return {-sc, -tc, -ma};
  }
}
// Returns sc, tc and |ma|.
glm::dvec3 on_face(int face, const glm::dvec3& r) {
  switch (face) {
    case 0: return {-r.z, -r.y, r.x};
    case 1: return {r.z, -r.y, -r.x};
    case 2: return {r.x, r.z, r.y};
    case 3: return {r.x, -r.z, -r.y};
    case 4: return {r.x, -r.y, r.z};
    default: return {-r.x, -r.y, -r.z};
  }
}
int face_of(const glm::dvec3& r) {
  int best = 0;
  for (int face = 1; face < 6; ++face) {
    if (on_face(face, r).z > on_face(best, r).z) best = face;
  }
  return best;
}

// ---- lookups -------------------------------------------------------------------------------------------------------

struct Level {
  glm::ivec3 size;
  std::vector<glm::dvec4> texels, integers;
};

class Reference {
 public:
  Reference(const LookupCase& c, TextureMemory& memory) : c_(c) {
    for (int k = c.base_level; k < c.base_level + used_levels(c); ++k) {
      const TexelView view = memory.level(k);
      Level level{{view.width, view.height, view.layers}, {}, {}};
      for (int z = 0; z < view.layers; ++z) {
        for (int y = 0; y < view.height; ++y) {
          for (int x = 0; x < view.width; ++x) {
            const std::byte* texel = view.at(x, y, z);
            level.texels.push_back(decoded(view.format, texel));
            level.integers.push_back(is_depth(view.format) ? glm::dvec4(stencil_of(view.format, texel), 0.0, 0.0, 1.0)
                                                           : level.texels.back());
          }
        }
      }
      levels_.push_back(std::move(level));
    }
    border_ = border();
  }

  const Level& level(int k) const { return levels_[static_cast<std::size_t>(k)]; }
  const glm::dvec4& texel(int k, int x, int y, int z) const {
    const Level& l = level(k);
    return l.texels[static_cast<std::size_t>((z * l.size.y + y) * l.size.x + x)];
  }

  /// Returns the level of detail from derivatives after the bias, before the limits.
  double lod_of(const Point& point) const {
    const glm::dvec3 p = place(point, 0.0, 0.0);
    const int face = face_of(p);
    const auto texels = [&](double x, double y) { return coordinates(place(point, x, y), face) * texels_per_unit(0); };
    constexpr double h = 1e-5;
    const double x = glm::length(texels(h, 0.0) - texels(-h, 0.0)), y = glm::length(texels(0.0, h) - texels(0.0, -h));
    return std::log2(std::max(x, y) / (2 * h)) + static_cast<double>(c_.options.bias) + static_cast<double>(c_.sampler.lod.bias);
  }

  Answer answer(const Point& p) const {
    switch (c_.function) {
      case Function::fetch: return exactly(swizzled(texel(p.level, p.texel.x, p.texel.y, p.texel.z)));
      case Function::fetch_integers: {
        const Level& l = level(p.level);
        return exactly(swizzled(l.integers[static_cast<std::size_t>((p.texel.z * l.size.y + p.texel.y) * l.size.x + p.texel.x)]));
      }
      case Function::size: return exactly(glm::dvec4(glm::dvec3(level(p.level).size), 0.0));
      case Function::query_lod: return queried(lod_of(p));
      case Function::gather:
      case Function::gather_compare: return gathered(p);
      case Function::sample_compare:
      case Function::sample_compare_level: {
        const test::Mixed m = sampled(p);
        const auto red = [&](const glm::dvec4& v) { return glm::dvec4(swizzled(glm::dvec4(v.x, 0.0, 0.0, 1.0)).x, 0.0, 0.0, 0.0); };
        return {red(m.value), red(m.low), red(m.high)};
      }
      default: {
        const test::Mixed m = sampled(p);
        return {swizzled(m.value), swizzled(m.low), swizzled(m.high)};
      }
    }
  }

 private:
  static Answer exactly(const glm::dvec4& v) { return {v, v, v}; }
  bool from_derivatives() const {
    return c_.function == Function::sample || c_.function == Function::sample_projected || c_.function == Function::sample_compare;
  }
  bool compares() const {
    return c_.function == Function::sample_compare || c_.function == Function::sample_compare_level ||
           c_.function == Function::gather_compare;
  }

  double swizzled_channel(Swizzle s, const glm::dvec4& v) const {
    return s == Swizzle::zero ? 0.0 : s == Swizzle::one ? 1.0 : v[static_cast<int>(s)];
  }
  glm::dvec4 swizzled(const glm::dvec4& v) const {
    const auto channel = [&](std::size_t k) { return swizzled_channel(c_.swizzle[k], v); };
    return {channel(0), channel(1), channel(2), channel(3)};
  }

  glm::dvec4 border() const {
    const TexelInfo& info = texel_info(c_.format);
    glm::dvec4 color(0.0, 0.0, 0.0, 1.0);
    const bool float_depth = c_.format == TexelFormat::d32f || c_.format == TexelFormat::d32fs8;
    const bool is_float = info.kind == TexelKind::floats || info.kind == TexelKind::shared_exponent || float_depth;
    const bool is_signed = info.kind == TexelKind::snorm || float_depth || (is_float && info.bits != 0);
    for (int k = 0; k < info.channels; ++k) {
      const double v = static_cast<double>(c_.sampler.border_color[k]);
      if (is_integer(c_.format))
        color[k] = std::nearbyint(v);
      else if (is_float)
        color[k] = is_signed ? v : std::max(v, 0.0);
      else
        color[k] = std::clamp(v, is_signed ? -1.0 : 0.0, 1.0);
    }
    return color;
  }

  // Coordinates or the direction at (x, y) px from the point.
  glm::dvec3 place(const Point& point, double x, double y) const {
    const glm::dvec3 p = glm::dvec3(point.p) + x * glm::dvec3(point.dx) + y * glm::dvec3(point.dy);
    if (c_.function != Function::sample_projected) return p;
    const auto real = [](float v) { return static_cast<double>(v); };
    return p / (real(point.divisor) + x * real(point.divisor_dx) + y * real(point.divisor_dy));
  }
  // Coordinates in a layer, face or volume, without the axes that the kind does not have.
  glm::dvec3 coordinates(const glm::dvec3& p, int face) const {
    if (is_cube(c_.kind)) {
      const glm::dvec3 on = on_face(face, p);
      return {0.5 * (on.x / on.z + 1.0), 0.5 * (on.y / on.z + 1.0), 0.0};
    }
    const int axes = detail::texture_axes(c_.kind);
    return {p.x, axes > 1 ? p.y : 0.0, axes > 2 ? p.z : 0.0};
  }
  glm::dvec3 texels_per_unit(int k) const { return c_.kind == TextureKind::rectangle ? glm::dvec3(1.0) : glm::dvec3(level(k).size); }

  int layer_of(const Point& p, int face) const {
    if (c_.kind == TextureKind::cube) return face;
    if (!is_array(c_.kind)) return 0;
    const int layers = level(0).size.z / (c_.kind == TextureKind::cube_array ? 6 : 1);
    const int layer = static_cast<int>(std::clamp(std::floor(static_cast<double>(p.layer) + 0.5), 0.0, layers - 1.0));
    return c_.kind == TextureKind::cube_array ? 6 * layer + face : layer;
  }

  // The value of a texel or of the border, or 1 if its comparison passes.
  glm::dvec4 value(const glm::dvec4& color, const Point& p) const {
    if (!compares()) return color;
    const bool is_float =
        texel_info(c_.format).kind == TexelKind::floats || c_.format == TexelFormat::d32f || c_.format == TexelFormat::d32fs8;
    const float reference = is_float ? p.reference : std::clamp(p.reference, 0.0f, 1.0f), texel = static_cast<float>(color.x);
    const bool less = reference < texel, equal = reference == texel;
    const std::array<bool, 8> passes{false, less, equal, less || equal, !less && !equal, !equal, !less, true};
    return {passes[static_cast<std::size_t>(c_.sampler.compare)] ? 1.0 : 0.0, 0.0, 0.0, 1.0};
  }
  glm::dvec4 wrapped_texel(int k, const glm::i64vec3& at, int layer, const Point& p) const {
    const glm::ivec3 size = level(k).size;
    const bool volume = c_.kind == TextureKind::three_d;
    const int x = test::wrapped_index(at.x, size.x, c_.sampler.wrap_s);
    const int y = detail::texture_axes(c_.kind) > 1 ? test::wrapped_index(at.y, size.y, c_.sampler.wrap_t) : 0;
    const int z = volume ? test::wrapped_index(at.z, size.z, c_.sampler.wrap_r) : layer;
    return value(x < 0 || y < 0 || z < 0 ? border_ : texel(k, x, y, z), p);
  }
  // A texel at most one beyond an edge of a face. Beyond an edge, it is the one of the adjacent face that touches the edge at the same
  // place.
  glm::dvec4 cube_texel(int k, int face, int x, int y, int cube, const Point& p) const {
    const int n = level(k).size.x;
    const auto beyond = [&](int i) { return i < 0 || i >= n; };
    if (beyond(x) && beyond(y)) {  // at a corner, three texels meet
      const int i = std::clamp(x, 0, n - 1), j = std::clamp(y, 0, n - 1);
      return (cube_texel(k, face, i, j, cube, p) + cube_texel(k, face, x, j, cube, p) + cube_texel(k, face, i, y, cube, p)) / 3.0;
    }
    if (!beyond(x) && !beyond(y)) return value(texel(k, x, y, cube + face), p);
    const auto center = [&](int i) { return beyond(i) ? (i < 0 ? -1.0 : 1.0) : (2.0 * i + 1.0) / n - 1.0; };
    const glm::dvec3 r = direction(face, center(x), center(y), 1.0 - 1.0 / n);
    const int other = face_of(r);
    const glm::dvec3 on = on_face(other, r);
    const auto index = [&](double s) { return std::clamp(static_cast<int>(std::floor((s + 1.0) * 0.5 * n)), 0, n - 1); };
    return value(texel(k, index(on.x), index(on.y), cube + other), p);
  }

  // Texel (dx, dy, dz) from texel `at`, the first of those that a linear filter blends.
  glm::dvec4 neighbor(int k, const glm::dvec3& at, const glm::ivec3& d, int face, int layer, const Point& p) const {
    const glm::i64vec3 i = glm::i64vec3(at) + glm::i64vec3(d);
    if (is_cube(c_.kind)) return cube_texel(k, face, static_cast<int>(i.x), static_cast<int>(i.y), layer - face, p);
    return wrapped_texel(k, i + glm::i64vec3(c_.options.offset), layer, p);
  }

  void mix_level(int k, const glm::dvec3& st, int face, int layer, bool nearest, double weight, const Point& p, test::Mixed& to) const {
    const glm::dvec3 u = st * texels_per_unit(k);
    if (nearest) {
      glm::dvec3 i = glm::floor(u);
      if (is_cube(c_.kind)) i = glm::clamp(i, glm::dvec3(0.0), glm::dvec3(level(k).size.x - 1));
      return to.add(weight, neighbor(k, i, glm::ivec3(0), face, layer, p));
    }
    const glm::dvec3 first = glm::floor(u - 0.5), fraction = u - 0.5 - first;
    const int axes = is_cube(c_.kind) ? 2 : detail::texture_axes(c_.kind);
    for (int n = 0; n < 1 << axes; ++n) {
      const glm::ivec3 d(n & 1, n >> 1 & 1, n >> 2);
      double w = weight;
      for (int axis = 0; axis < axes; ++axis) w *= d[axis] != 0 ? fraction[axis] : 1.0 - fraction[axis];
      to.add(w, neighbor(k, first, d, face, layer, p));
    }
  }

  // Section 8.14.3 and 8.15.
  test::Mixed sampled(const Point& p) const {
    const glm::dvec3 at = place(p, 0.0, 0.0);
    const int face = is_cube(c_.kind) ? face_of(at) : 0, layer = layer_of(p, face), last = used_levels(c_) - 1;
    const glm::dvec3 st = coordinates(at, face);
    const Sampler& s = c_.sampler;
    const double before = from_derivatives() ? lod_of(p) : static_cast<double>(p.lod) + static_cast<double>(s.lod.bias);
    const double lod = std::clamp(before, static_cast<double>(s.lod.min), static_cast<double>(s.lod.max));
    const bool nearest_min = s.min == Filter::nearest || s.min == Filter::nearest_mipmap_nearest || s.min == Filter::nearest_mipmap_linear;
    const bool linear_mag = s.mag != Filter::nearest, mipmaps = s.min != Filter::nearest && s.min != Filter::bilinear;
    const double c = linear_mag && nearest_min && mipmaps ? 0.5 : 0.0;
    test::Mixed mixed;
    const auto mix = [&](double k, bool nearest, double weight) {
      mix_level(static_cast<int>(std::clamp(k, 0.0, static_cast<double>(last))), st, face, layer, nearest, weight, p, mixed);
    };
    if (lod <= c) {
      mix(0.0, !linear_mag, 1.0);
    } else if (!mipmaps) {
      mix(0.0, nearest_min, 1.0);
    } else if (s.min == Filter::nearest_mipmap_nearest || s.min == Filter::bilinear_mipmap_nearest) {
      mix(std::ceil(lod + 0.5) - 1.0, nearest_min, 1.0);
    } else {
      mix(std::floor(lod), nearest_min, 1.0 - (lod - std::floor(lod)));
      mix(std::floor(lod) + 1.0, nearest_min, lod - std::floor(lod));
    }
    return mixed;
  }

  Answer gathered(const Point& p) const {
    const glm::dvec3 at = place(p, 0.0, 0.0);
    const int face = is_cube(c_.kind) ? face_of(at) : 0, layer = layer_of(p, face);
    const glm::dvec3 first = glm::floor(coordinates(at, face) * texels_per_unit(0) - 0.5);
    const auto one = [&](int x, int y) {
      const auto component = compares() ? std::size_t{0} : static_cast<std::size_t>(c_.component);
      return swizzled_channel(c_.swizzle[component], neighbor(0, first, {x, y, 0}, face, layer, p));
    };
    return exactly({one(0, 1), one(1, 1), one(1, 0), one(0, 0)});
  }

  // The function of ARB_texture_query_lod for the accessed level.
  Answer queried(double before) const {
    const Sampler& s = c_.sampler;
    const double limited = std::clamp(before, static_cast<double>(s.lod.min), static_cast<double>(s.lod.max));
    double accessed = std::clamp(limited, 0.0, used_levels(c_) - 1.0);
    if (s.min == Filter::nearest || s.min == Filter::bilinear) accessed = 0.0;
    if (s.min == Filter::nearest_mipmap_nearest || s.min == Filter::bilinear_mipmap_nearest) accessed = std::ceil(accessed + 0.5) - 1.0;
    const glm::dvec4 v(accessed, before, 0.0, 0.0), range(0.5, 0.5, 0.0, 0.0);
    return {v, v - range, v + range};
  }

  const LookupCase& c_;
  std::vector<Level> levels_;
  glm::dvec4 border_;
};

uint32_t hash_of(const std::string& text) {
  uint32_t h = 2166136261u;
  for (const char c : text) h = (h ^ static_cast<uint8_t>(c)) * 16777619u;
  return h;
}

}  // namespace

std::vector<Answer> answers_in_double(const LookupCase& c, TextureMemory& memory, const std::vector<Point>& points) {
  const Reference reference(c, memory);
  std::vector<Answer> answers;
  for (const Point& p : points) answers.push_back(reference.answer(p));
  return answers;
}

std::vector<Point> points_of(const LookupCase& c, TextureMemory& memory) {
  const Reference reference(c, memory);
  const glm::ivec3 size = reference.level(0).size;
  std::mt19937 random(hash_of(c.name));
  const auto below = [&](int count) { return static_cast<int>(random() % static_cast<unsigned>(count)); };
  const auto number = [&](double low, double high) { return low + (high - low) * static_cast<double>(random()) * 0x1p-32; };
  const bool projects = c.function == Function::sample_projected;
  const bool derives =
      projects || c.function == Function::sample || c.function == Function::sample_compare || c.function == Function::query_lod;
  const auto vector = [](const glm::dvec3& v) { return glm::vec3(v); };

  // An odd multiple of a power of two is at a distance from the edges and centers of texels. It is changed by up to 2^-17, so that
  // fractions of texels have more bits than the filter.
  const auto place = [&](int odd, double scale) { return odd * scale + (below(17) - 8) * 0x1p-20; };
  const auto candidate = [&] {
    Point p;
    constexpr std::array<double, 4> divisors{0.5, 1.0, 2.0, -4.0};
    const double scale = divisors[static_cast<std::size_t>(below(projects ? 4 : 3))];
    const double step = std::exp2(number(-1.5, used_levels(c) + 0.5));  // texels
    const double angle = number(0.0, 6.28), other = number(0.0, 6.28), tilt = number(0.2, 0.9);
    const glm::dvec3 right = step * glm::dvec3(std::cos(angle), std::sin(angle), tilt),
                     up = tilt * step * glm::dvec3(std::cos(other), std::sin(other), tilt);
    if (is_cube(c.kind)) {
      const auto coordinate = [&] { return place(2 * below(1024) - 1023, 0x1p-10); };
      const int face = below(6);
      const auto slope = [&](const glm::dvec3& d) {
        return vector(scale * direction(face, 2 * d.x / size.x, 2 * d.y / size.x, 0.1 * d.z / size.x));
      };
      p.p = vector(scale * direction(face, coordinate(), coordinate(), 1.0));
      p.dx = slope(right);
      p.dy = slope(up);
    } else {
      const glm::dvec3 unit = c.kind == TextureKind::rectangle ? glm::dvec3(size) : glm::dvec3(1.0);
      const auto coordinate = [&] { return place(2 * below(8192) - 6143, 0x1p-12); };
      const double divisor = projects ? scale : 1.0;
      p.p = vector(unit * glm::dvec3(coordinate(), coordinate(), coordinate()) * divisor);
      p.dx = vector(unit * right / glm::dvec3(size) * divisor);
      p.dy = vector(unit * up / glm::dvec3(size) * divisor);
      p.divisor = static_cast<float>(divisor);
      p.divisor_dx = static_cast<float>(divisor * number(-0.1, 0.1));
      p.divisor_dy = static_cast<float>(divisor * number(-0.1, 0.1));
    }
    p.layer = static_cast<float>(below(8 * 3 + 4) - 4) / 8.0f + 1.0f / 32;
    p.lod = static_cast<float>(2 * below(32 * (used_levels(c) + 2)) + 1 - 96) / 64.0f;
    p.level = below(used_levels(c));
    const glm::ivec3 there = reference.level(p.level).size;
    p.texel = {below(there.x), below(there.y), below(there.z)};
    p.reference = below(3) == 0 ? static_cast<float>(reference.texel(p.level, p.texel.x, p.texel.y, p.texel.z).x)
                                : static_cast<float>(number(-0.25, 1.25));
    return p;
  };
  std::vector<Point> points;
  while (points.size() < 64) {
    const Point p = candidate();
    if (derives) {
      const double halves = 2.0 * reference.lod_of(p);
      if (std::fabs(halves - std::round(halves)) < 0.125) continue;
    }
    points.push_back(p);
  }
  return points;
}

}  // namespace halfspace::conformance::lookups
