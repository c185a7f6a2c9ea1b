// SPDX-License-Identifier: Apache-2.0
#include "conformance/texture_lookups.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <random>
#include <sstream>

namespace halfspace::conformance::lookups {

namespace {

template <class F>
auto with_kind(TextureKind kind, const F& f) {
  switch (kind) {
    case TextureKind::one_d: return f.template operator()<TextureKind::one_d>();
    case TextureKind::two_d: return f.template operator()<TextureKind::two_d>();
    case TextureKind::rectangle: return f.template operator()<TextureKind::rectangle>();
    case TextureKind::three_d: return f.template operator()<TextureKind::three_d>();
    case TextureKind::one_d_array: return f.template operator()<TextureKind::one_d_array>();
    case TextureKind::two_d_array: return f.template operator()<TextureKind::two_d_array>();
    case TextureKind::cube: return f.template operator()<TextureKind::cube>();
    case TextureKind::cube_array: return f.template operator()<TextureKind::cube_array>();
    default: return f.template operator()<TextureKind::multisample>();
  }
}

using R = FragmentReal;
constexpr std::size_t kWidth = kWidthOf<R>;

/// A group of points, one for each lane.
class Group {
 public:
  explicit Group(const Point* points) : points_(points) {}

  template <class F>
  R real(const F& of) const {
    R r(0.0f);
    for (std::size_t k = 0; k < kWidth; ++k) set_lane(r, static_cast<int>(k), of(points_[k]));
    return r;
  }
  template <class F>
  IntOf<R> integer(const F& of) const {
    IntOf<R> r(0);
    for (std::size_t k = 0; k < kWidth; ++k) set_lane(r, static_cast<int>(k), of(points_[k]));
    return r;
  }
  template <TextureKind kind>
  TextureDerivatives<kind, R> vector(glm::vec3 Point::*of) const {
    constexpr int count = detail::texture_axes(kind);
    const auto axis = [&](int k) { return real([&](const Point& p) { return (p.*of)[k]; }); };
    if constexpr (count == 1) {
      return axis(0);
    } else {
      TextureDerivatives<kind, R> v;
      for (int k = 0; k < count; ++k) v[k] = axis(k);
      return v;
    }
  }
  template <TextureKind kind>
  TextureCoordinates<kind, R> coordinates() const {
    const TextureDerivatives<kind, R> p = vector<kind>(&Point::p);
    if constexpr (!is_array(kind)) {
      return p;
    } else {
      const R layer = real([](const Point& q) { return q.layer; });
      if constexpr (detail::texture_axes(kind) == 1) return {p, layer};
      if constexpr (detail::texture_axes(kind) == 2) return {p.x, p.y, layer};
      if constexpr (detail::texture_axes(kind) == 3) return {p.x, p.y, p.z, layer};
    }
  }

 private:
  const Point* points_;
};

template <TextureKind kind>
TextureView<kind> view_of(const LookupCase& c, const TextureMemory& memory) {
  return memory.view<kind>().part_of_levels(c.base_level, used_levels(c)).swizzled(c.swizzle[0], c.swizzle[1], c.swizzle[2], c.swizzle[3]);
}

/// The lookups of kinds that are filtered.
template <TextureKind kind>
vec4<R> real_answers(const LookupCase& c, const TextureView<kind>& view, const Group& group) {
  const auto scalar = [&](float Point::*of) { return group.real([&](const Point& p) { return p.*of; }); };
  const R zero(0.0f);
  const TextureCoordinates<kind, R> p = group.coordinates<kind>();
  const TextureDerivatives<kind, R> dx = group.vector<kind>(&Point::dx), dy = group.vector<kind>(&Point::dy);
  const glm::ivec3& offset = c.options.offset;
  switch (c.function) {
    case Function::sample: return view.sample(c.sampler, p, dx, dy, c.options);
    case Function::sample_level: return view.sample_level(c.sampler, p, scalar(&Point::lod), offset);
    case Function::sample_projected:
      if constexpr (!is_array(kind) && !is_cube(kind))
        return view.sample_projected(c.sampler, p, dx, dy, scalar(&Point::divisor), scalar(&Point::divisor_dx), scalar(&Point::divisor_dy),
                                     c.options);
      break;
    case Function::sample_compare:
      return {view.sample_compare(c.sampler, p, scalar(&Point::reference), dx, dy, c.options), zero, zero, zero};
    case Function::sample_compare_level:
      return {view.sample_compare_level(c.sampler, p, scalar(&Point::reference), scalar(&Point::lod), offset), zero, zero, zero};
    case Function::gather: return view.gather(c.sampler, p, c.component, offset);
    case Function::gather_compare: return view.gather_compare(c.sampler, p, scalar(&Point::reference), offset);
    case Function::query_lod: {
      const vec2<R> lod = view.query_lod(c.sampler, p, dx, dy);
      return {lod.x, lod.y, zero, zero};
    }
    default: break;
  }
  return vec4<R>(zero);
}

bool returns_integers(Function f) { return f == Function::sample_integers || f == Function::fetch_integers || f == Function::size; }

template <TextureKind kind>
std::vector<glm::dvec4> answers(const LookupCase& c, const TextureMemory& memory, const std::vector<Point>& points) {
  const TextureView<kind> view = view_of<kind>(c, memory);
  std::vector<glm::dvec4> all;
  for (std::size_t first = 0; first < points.size(); first += kWidth) {
    const Group group(&points[first]);
    ivec3<R> texel;
    for (int k = 0; k < 3; ++k) texel[k] = group.integer([&](const Point& p) { return p.texel[k]; });
    const IntOf<R> level = group.integer([](const Point& p) { return p.level; });
    vec4<R> color(R(0.0f));
    ivec4<R> integers{IntOf<R>(0), IntOf<R>(0), IntOf<R>(0), IntOf<R>(0)};
    if (c.function == Function::fetch) {
      color = view.template fetch<R>(texel, level);
    } else if (c.function == Function::fetch_integers) {
      integers = view.template fetch_integers<R>(texel, level);
    } else if (c.function == Function::size) {
      integers = {group.integer([&](const Point& p) { return view.width(p.level); }),
                  group.integer([&](const Point& p) { return view.height(p.level); }),
                  group.integer([&](const Point& p) { return view.depth(p.level); }), IntOf<R>(0)};
    } else if constexpr (kind != TextureKind::multisample) {
      if (c.function == Function::sample_integers) {
        const R lod = group.real([](const Point& p) { return p.lod; });
        integers = view.sample_integers(c.sampler, group.coordinates<kind>(), lod, c.options.offset);
      } else {
        color = real_answers(c, view, group);
      }
    }
    const bool is_unsigned = texel_info(c.format).kind == TexelKind::uints;
    for (int k = 0; k < static_cast<int>(kWidth); ++k) {
      glm::dvec4 answer;
      for (int i = 0; i < 4; ++i) {
        const int32_t code = lane(integers[i], k);
        answer[i] = !returns_integers(c.function) ? static_cast<double>(lane(color[i], k))
                    : is_unsigned                 ? static_cast<double>(static_cast<uint32_t>(code))
                                                  : static_cast<double>(code);
      }
      all.push_back(answer);
    }
  }
  return all;
}

}  // namespace

int used_levels(const LookupCase& c) { return std::min(c.max_level + 1, c.levels) - c.base_level; }

std::vector<glm::dvec4> answers_of_view(const LookupCase& c, const TextureMemory& memory, const std::vector<Point>& points) {
  return with_kind(c.kind, [&]<TextureKind kind>() { return answers<kind>(c, memory, points); });
}

void fill_with_noise(TextureMemory& memory) {
  std::mt19937 random(static_cast<unsigned>(memory.level().format) * 16 + static_cast<unsigned>(memory.kind()));
  const auto bits = [&](int count) { return static_cast<uint32_t>(random()) >> (32 - count); };
  // A float with the given numbers of bits of the exponent and mantissa, and 0 to 3 added to the exponent of 1/4.
  const auto number = [&](int exponent_bits, int mantissa_bits) {
    return ((1u << (exponent_bits - 1)) - 3 + bits(2)) << mantissa_bits | bits(mantissa_bits);
  };
  const auto fill = [&](TexelFormat format, std::byte* texel) {
    const TexelInfo& info = texel_info(format);
    std::array<uint32_t, 4> words{bits(32), bits(32), bits(32), bits(32)};
    if (format == TexelFormat::r11f_g11f_b10f) words[0] = number(5, 6) | number(5, 6) << 11 | number(5, 5) << 22;
    if (format == TexelFormat::rgb9_e5) words[0] = bits(27) | (12 + bits(2)) << 27;
    if (format == TexelFormat::d32f || format == TexelFormat::d32fs8)
      words[0] = std::bit_cast<uint32_t>(static_cast<float>(bits(24)) * 0x1p-24f);
    if (info.kind == TexelKind::floats && info.bits == 32) {
      for (uint32_t& w : words) w = bits(1) << 31 | number(8, 23);
    }
    if (info.kind == TexelKind::floats && info.bits == 16) {
      for (uint32_t& w : words) w = bits(1) << 15 | number(5, 10) | bits(1) << 31 | number(5, 10) << 16;
    }
    std::memcpy(texel, words.data(), info.bytes);
  };
  for (int k = 0; k < memory.levels(); ++k) {
    const TexelView level = memory.level(k);
    for (int z = 0; z < level.layers; ++z) {
      for (int y = 0; y < level.height; ++y) {
        for (int x = 0; x < level.width; ++x) fill(level.format, level.at(x, y, z));
      }
    }
  }
}

namespace {

// Returns the allowed difference of a channel whose texels are from `low` to `high`.
double tolerance(const LookupCase& c, double low, double high) {
  if (returns_integers(c.function)) return 0.0;
  // The fourth texel at a corner of a cube is the mean of three, of magnitudes up to 4.
  if (c.function == Function::gather || c.function == Function::gather_compare) return 0x1p-20;
  // Fractions of texels are rounded to 2^-15 along each of up to three axes, and levels of detail from derivatives have an error of 2^-12.
  // Values are computed in float, where a filter of up to 16 texels adds some roundings.
  return 0x1p-11 * (high - low) + 0x1p-21 * std::max(std::fabs(high), std::fabs(low));
}

}  // namespace

std::string check(const LookupCase& c) {
  TextureMemory memory(c.kind, c.format, c.size, c.levels);
  fill_with_noise(memory);
  const std::vector<Point> points = points_of(c, memory);
  const std::vector<Answer> expected = answers_in_double(c, memory, points);
  const std::vector<glm::dvec4> seen = answers_of_view(c, memory, points);
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (int k = 0; k < 4; ++k) {
      const Answer& e = expected[i];
      if (std::fabs(seen[i][k] - e.value[k]) <= tolerance(c, e.low[k], e.high[k])) continue;
      std::ostringstream wrong;
      wrong.precision(9);
      const Point& p = points[i];
      wrong << "channel " << k << " is " << seen[i][k] << ", expected " << e.value[k] << " from " << e.low[k] << " to " << e.high[k]
            << "; at " << p.p.x << ' ' << p.p.y << ' ' << p.p.z << ", layer " << p.layer << ", level of detail " << p.lod << ", reference "
            << p.reference << ", texel " << p.texel.x << ' ' << p.texel.y << ' ' << p.texel.z << ", level " << p.level;
      return wrong.str();
    }
  }
  return "";
}

}  // namespace halfspace::conformance::lookups
