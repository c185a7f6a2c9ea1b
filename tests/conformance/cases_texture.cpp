// SPDX-License-Identifier: Apache-2.0
#include <bit>
#include <cmath>

#include "conformance/geometry.h"
#include "conformance/groups.h"
#include "shading/texture_reference.h"

namespace halfspace::conformance {

namespace {

// ---- derivatives ---------------------------------------------------------------------------------------------------

constexpr const char* kFunctions[] = {"ddx", "ddy", "fwidth", "quad_ddx", "quad_ddy", "quad_fwidth"};

// A rectangle that covers the window, with u and v varying in x and y. If projected, w varies from left to right.
Picture derivative_picture(int mode, float scale, bool projected, int samples) {
  Picture p;
  p.samples = samples;
  p.colors = {ColorFormat::rgba32f};
  Drawing d;
  d.kind = Kind::derivative;
  d.mode = mode;
  d.value = 1.0f / scale;  // gives the same colors for every scale
  const std::array<glm::dvec2, 4> corners{glm::dvec2(0, 0), glm::dvec2(32, 0), glm::dvec2(32, 32), glm::dvec2(0, 32)};
  std::array<Vertex, 4> quad;
  for (std::size_t i = 0; i < 4; ++i) {
    const glm::dvec2 c = corners[i];
    const float w = projected ? static_cast<float>(1.0 / (0.25 + 0.75 * c.x / 32.0)) : 1.0f;
    // With perspective, u/w is linear in the window, so u is the ratio of two linear functions.
    const glm::vec2 uv = glm::vec2(glm::dvec2(0.5 * c.x - 0.25 * c.y + 1.0, 0.125 * c.x + 0.75 * c.y - 3.0)) * (projected ? w : 1.0f);
    quad[i] = {clip_at(p, c.x, c.y, 0.0f, w), glm::vec4(1.0f), glm::vec4(uv * scale, 0, 0)};
  }
  add_quad(d, quad);
  p.draws.push_back(std::move(d));
  return p;
}

// u and v are linear in x and y, divided by 0.25 + 0.75·x/32 if projected. Quad differences are evaluated from the same functions.
std::string derivative_formula(const Picture& p, const Seen& seen) {
  const Drawing& d = p.draws[0];
  const bool projected = d.vertices[0].pos_clip.w != 1.0f, by_quad = d.mode >= kQuadDdx;
  const auto uv = [&](double x, double y) {
    return glm::dvec2(0.5 * x - 0.25 * y + 1.0, 0.125 * x + 0.75 * y - 3.0) / (projected ? 0.25 + 0.75 * x / 32.0 : 1.0);
  };
  return for_each_pixel(seen, [&](int x, int y) -> std::string {
    const double px = x + 0.5, py = y + 0.5;
    glm::dvec2 dx, dy;
    if (by_quad) {
      const double qx = x / 2 * 2 + 0.5, qy = y / 2 * 2 + 0.5;
      dx = uv(qx + 1, qy) - uv(qx, qy);
      dy = uv(qx, qy + 1) - uv(qx, qy);
    } else {
      const double q = projected ? 0.25 + 0.75 * px / 32.0 : 1.0, dq = projected ? 0.75 / 32.0 : 0.0;
      dx = (glm::dvec2(0.5, 0.125) - uv(px, py) * dq) / q;
      dy = glm::dvec2(-0.25, 0.75) / q;
    }
    const glm::dvec2 of = d.mode % 3 == kDdx ? dx : d.mode % 3 == kDdy ? dy : glm::abs(dx) + glm::abs(dy);
    // u, v and w are rounded to float at the vertices. The tolerance allows a relative error of 2^-22 for values of magnitude 70. A quad
    // difference subtracts two such values, so its tolerance is twice as large.
    const double tolerance = by_quad ? 70.0 * 4 * 0x1p-23 : 70.0 * 0x1p-22;
    return expect_near(glm::dvec4(of, 0.0, 1.0), seen.color(x, y), tolerance);
  });
}

// ---- textures ------------------------------------------------------------------------------------------------------

constexpr std::pair<TexelFormat, const char*> kTextureFormats[] = {{TexelFormat::rgba8, "rgba8"},     {TexelFormat::srgb8a8, "srgb8"},
                                                                   {TexelFormat::r8, "r8"},           {TexelFormat::r16, "r16"},
                                                                   {TexelFormat::rgba16f, "rgba16f"}, {TexelFormat::rgba32f, "rgba32f"}};
constexpr const char* kFilterNames[] = {"nearest", "linear", "mipmap"};
constexpr const char* kWrapNames[] = {"repeat", "mirror", "clamp", "border"};

// A rectangle that covers the window, with u from u0 to u1 and v from v0 to v1; `turn` swaps the axes.
Picture textured(std::shared_ptr<const Texture2D> texture, const Sampler& sampler, const glm::vec4& u0_v0_u1_v1, bool turn, int size = 32) {
  Picture p;
  p.width = p.height = size;
  p.colors = {ColorFormat::rgba32f};
  Drawing d;
  d.kind = Kind::texture;
  d.texture = std::move(texture);
  d.sampler = sampler;
  add_rectangle(d, p, {0, 0, static_cast<double>(size), static_cast<double>(size)}, glm::vec4(1.0f));
  const glm::vec4& r = u0_v0_u1_v1;
  const std::array<glm::vec2, 4> uv{glm::vec2(r.x, r.y), {r.z, r.y}, {r.z, r.w}, {r.x, r.w}};
  for (std::size_t i = 0; i < 4; ++i) d.vertices[i].extra = glm::vec4(uv[turn ? (4 - i) % 4 : i], 0, 0);
  p.draws.push_back(std::move(d));
  return p;
}

// The coordinates and the mip level of every pixel are known. If rounding could select a different texel or level, either result is
// accepted.
std::string lookup_by_rule(const Picture& p, const Seen& seen) {
  const Drawing& d = p.draws[0];
  const Texture2D& t = *d.texture;
  const auto corner = [&](std::size_t i) { return glm::dvec2(d.vertices[i].extra.x, d.vertices[i].extra.y); };
  const glm::dvec2 along_x = (corner(1) - corner(0)) / static_cast<double>(p.width),
                   along_y = (corner(3) - corner(0)) / static_cast<double>(p.height);
  const glm::dvec2 size(t.width(), t.height());
  const double lod =
      d.mode == kByLevel ? static_cast<double>(d.value) : std::log2(std::max(glm::length(along_x * size), glm::length(along_y * size)));
  return for_each_pixel(seen, [&](int x, int y) -> std::string {
    const glm::dvec2 at = corner(0) + (x + 0.5) * along_x + (y + 0.5) * along_y;
    std::string wrong;
    for (int i = 0; i < 27; ++i) {  // by 2^-12 texel (the Vulkan Roadmap requires 2^-8 from hardware) and 2^-10 of a level
      const glm::dvec3 beside(i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1);
      const glm::dvec2 uv = at + glm::dvec2(beside.x, beside.y) * 0x1p-12 / size;
      const test::Mixed m = test::reference(t, d.sampler, uv.x, uv.y, lod + beside.z * 0x1p-10);
      const glm::dvec4 range = m.high - m.low;
      // Texel fractions have 15 bits; coordinates are varied by 2^-12 texel and levels by 2^-10, as above. The tolerance is this fraction
      // of the range of the texels.
      const double tolerance = 0x1p-9 * std::max({range.x, range.y, range.z, range.w}) + 1e-6 * (1.0 + std::fabs(m.high.x));
      wrong = expect_near(m.value, seen.color(x, y), tolerance);
      if (wrong.empty()) return wrong;
    }
    return wrong;
  });
}

std::shared_ptr<const Texture2D> noise(int width, int height, TexelFormat format) {
  return std::make_shared<const Texture2D>(test::make_noise(width, height, format, 7));
}

void add_filter(Cases& cases, const std::string& name, int width, int height, TexelFormat format, const Sampler& sampler,
                const glm::vec4& uv, bool turn) {
  cases.push_back({name, [=] { return textured(noise(width, height, format), sampler, uv, turn); }, lookup_by_rule, width * height == 1});
}

void add_filters(Cases& cases) {
  for (int f = 0; f < 6; ++f) {  // formats by filters, magnified and minified
    for (int mag = 0; mag < 2; ++mag) {
      for (int min = 0; min < 3; ++min) {
        const Sampler s{.mag = static_cast<Filter>(mag), .min = static_cast<Filter>(min)};
        const bool magnified = (f + min) % 2 == 0;
        const glm::vec4 uv = magnified ? glm::vec4(-0.31f, 0.13f, 0.57f, 0.91f) : glm::vec4(-3.1f, 1.2f, 4.7f, 6.3f);
        add_filter(cases,
                   std::string(kTextureFormats[f].second) + "_" + kFilterNames[mag] + "_" + kFilterNames[min] +
                       (magnified ? "_magnified" : "_minified"),
                   16, 16, kTextureFormats[f].first, s, uv, f % 2 == 1);
      }
    }
  }
  for (int ws = 0; ws < 4; ++ws) {  // wrap modes of both axes by filters
    for (int wt = 0; wt < 4; ++wt) {
      for (int filter = 0; filter < 2; ++filter) {
        const Sampler s{.mag = static_cast<Filter>(filter),
                        .min = static_cast<Filter>(filter),
                        .wrap_s = static_cast<Wrap>(ws),
                        .wrap_t = static_cast<Wrap>(wt),
                        .border_color = {0.9f, 0.1f, 0.6f, 0.3f}};
        add_filter(cases, std::string("wrap_") + kWrapNames[ws] + "_" + kWrapNames[wt] + "_" + kFilterNames[filter], 9, 7,
                   ws == 3 || wt == 3 ? TexelFormat::rgba32f : TexelFormat::rgba8, s, {-1.43f, -1.17f, 2.21f, 2.39f}, (ws + wt) % 2 == 1);
      }
    }
  }
  constexpr glm::ivec2 kSizes[] = {{1, 1},   {1, 16},  {3, 7},   {4, 8},    {31, 55},  {32, 64},
                                   {57, 35}, {64, 32}, {63, 63}, {127, 99}, {128, 128}};
  for (const glm::ivec2& size : kSizes) {
    for (int min = 0; min < 3; ++min) {
      for (const bool minified : {false, true}) {
        const Sampler s{.mag = min == 0 ? Filter::nearest : Filter::bilinear, .min = static_cast<Filter>(min), .wrap_t = Wrap::clamp};
        // Minified: three texels per pixel horizontally and about two vertically. Magnified: about two texels across the whole image.
        const glm::vec2 texels = minified ? glm::vec2(96.0f, 70.0f) : glm::vec2(2.3f, 1.7f);
        const glm::vec2 reach = texels / glm::vec2(size);
        add_filter(cases,
                   std::string("size_") + std::to_string(size.x) + "x" + std::to_string(size.y) + "_" + kFilterNames[min] +
                       (minified ? "_minified" : "_magnified"),
                   size.x, size.y, min == 2 ? TexelFormat::rgba8 : TexelFormat::srgb8a8, s,
                   {0.4113f, 0.3217f, 0.4113f + reach.x, 0.3217f + reach.y}, minified && size.x % 2 == 1);
      }
    }
  }
}

// Level n has a constant color that identifies it.
std::shared_ptr<const Texture2D> level_numbers(int width, int height) {
  std::vector<Image<glm::u8vec4>> levels;
  for (int i = 0;; ++i) {
    Image<glm::u8vec4> level(std::max(width >> i, 1), std::max(height >> i, 1));
    std::fill_n(level.data(), level.width() * level.height(), glm::u8vec4(i * 32, 255 - i * 16, 0, 255));
    levels.push_back(level);
    if (level.width() == 1 && level.height() == 1) break;
  }
  return std::make_shared<const Texture2D>(std::span<const Image<glm::u8vec4>>(levels), TexelFormat::rgba8);
}

void add_levels(Cases& cases) {
  constexpr glm::ivec2 kSizes[] = {{64, 64}, {32, 128}, {57, 35}};
  for (const glm::ivec2& size : kSizes) {
    for (int i = 0; i < 10; ++i) {  // levels −1 to 7
      const float lod = -1.0f + static_cast<float>(i) * 0.83f;
      const std::string suffix = std::string("_") + std::to_string(size.x) + "x" + std::to_string(size.y) + "_" + std::to_string(i);
      const Sampler s{.mag = Filter::bilinear, .min = Filter::trilinear};
      cases.push_back({"level" + suffix,
                       [=] {
                         Picture p = textured(level_numbers(size.x, size.y), s, {0.1f, 0.2f, 0.9f, 0.7f}, false, 16);
                         p.draws[0].mode = kByLevel;
                         p.draws[0].value = lod;
                         return p;
                       },
                       lookup_by_rule, true});
      cases.push_back({"derivatives" + suffix,
                       [=] {
                         const float texels = std::exp2(lod) * 16.0f;
                         const glm::vec2 reach(texels / static_cast<float>(size.x), 0.4f * texels / static_cast<float>(size.y));
                         return textured(level_numbers(size.x, size.y), s, {0.1f, 0.2f, 0.1f + reach.x, 0.2f + reach.y}, i % 2 == 1, 16);
                       },
                       lookup_by_rule, true});
    }
  }
}

}  // namespace

Cases derivate_cases() {
  Cases cases;
  for (int mode = 0; mode < 6; ++mode) {  // even with supersampling, a derivative is the change per pixel of the picture
    cases.push_back({std::string(kFunctions[mode]) + "_supersampled",
                     [=] {
                       Picture p = derivative_picture(mode, 1.0f, false, 4);
                       p.supersample = true;
                       return p;
                     },
                     derivative_formula, true});
  }
  for (int mode = 0; mode < 6; ++mode) {
    for (int power = -8; power <= 12; power += 4) {
      for (const bool projected : {false, true}) {
        for (const int samples : {1, 4}) {
          const float scale = std::ldexp(1.0f, power);
          const std::string name = std::string(kFunctions[mode]) + (projected ? "_projected" : "_affine") + "_scale_" +
                                   (power < 0 ? "minus_" : "") + std::to_string(std::abs(power)) + (samples > 1 ? "_samples_4" : "");
          cases.push_back({name, [=] { return derivative_picture(mode, scale, projected, samples); }, derivative_formula, !projected});
        }
      }
    }
  }
  return cases;
}

Cases texture_filtering_cases() {
  Cases cases;
  add_filters(cases);
  return cases;
}

Cases texture_mipmap_cases() {
  Cases cases;
  add_levels(cases);
  return cases;
}

}  // namespace halfspace::conformance
