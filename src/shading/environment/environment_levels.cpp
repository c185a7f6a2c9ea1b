// SPDX-License-Identifier: Apache-2.0
//
// Construction of the levels of EnvironmentMap: averaging, low-pass filtering near the poles of a panorama, and borders.
#include <algorithm>

#include "halfspace/core/check.h"
#include "halfspace/core/cube_map.h"
#include "halfspace/core/float_mode.h"
#include "halfspace/core/trig_double.h"
#include "halfspace/shading/environment/environment.h"
#include "halfspace/shading/texture/texels.h"

namespace halfspace::HS_LANES {

namespace {

// ---- texels in linear light --------------------------------------------------------------------------------------------

glm::dvec3 light_of(const glm::u8vec4& t) { return {kSrgbToLinear[t.x], kSrgbToLinear[t.y], kSrgbToLinear[t.z]}; }
glm::dvec3 light_of(const glm::vec4& t) { return glm::dvec3(t); }

void set_light(glm::u8vec4& t, const glm::dvec3& v) { t = glm::u8vec4(linear_to_srgb(v.x), linear_to_srgb(v.y), linear_to_srgb(v.z), 255); }
void set_light(glm::vec4& t, const glm::dvec3& v) { t = glm::vec4(glm::vec3(v), 1.0f); }

// The average of equal texels is exactly that texel: rounding the mean removes the error of double arithmetic.
template <class Texel, class... More>
Texel mean(const Texel& a, const More&... more) {
  Texel t;
  set_light(t, (light_of(a) + ... + light_of(more)) / (1.0 + sizeof...(more)));
  return t;
}

template <class Texel>
std::vector<Image<Texel>> levels_of(const Image<Texel>& base, TexelFormat format) {
  HS_CHECK_OP(std::min(base.width(), base.height()), >=, 1);
  std::vector<Image<Texel>> levels = mip_chain(base, format);
  levels.insert(levels.begin(), base);
  return levels;
}

// Creates a texture with a single level.
Texture2D one_level(const Image<glm::u8vec4>& image, TexelFormat format) { return Texture2D(std::span(&image, 1), format); }
Texture2D one_level(const Image<glm::vec4>& image, TexelFormat format) { return Texture2D(std::span(&image, 1), format); }

// ---- panoramas ---------------------------------------------------------------------------------------------------------

int wrapped(int x, int width) { return (x % width + width) % width; }

// Averages along each row, over an arc of the sphere that is as long as a texel is high.
template <class Texel>
Image<Texel> low_passed(const Image<Texel>& level) {
  const int width = level.width(), height = level.height();
  Image<Texel> out(width, height);
  for (int row = 0; row < height; ++row) {
    const double sine = sincos_turns((row + 0.5) / (2.0 * height)).sin;
    const double span = std::clamp(width / (2.0 * height * sine), 1.0, static_cast<double>(width));
    const int whole = static_cast<int>((span - 1.0) / 2.0);  // full texels on either side
    const double part = (span - 1.0) / 2.0 - whole;          // fraction of the next texel on either side
    for (int x = 0; x < width; ++x) {
      const auto at = [&](int i) { return light_of(level.at(wrapped(x + i, width), row)); };
      glm::dvec3 sum = part * (at(-whole - 1) + at(whole + 1));
      for (int i = -whole; i <= whole; ++i) sum += at(i);
      set_light(out.at(x, row), sum / span);
    }
  }
  return out;
}

// Adds a row beyond each pole.
template <class Texel>
Image<Texel> bordered(const Image<Texel>& level) {
  const int width = level.width(), height = level.height();
  Image<Texel> out(width, height + 2);
  for (int row = 0; row < height; ++row) std::copy(level.row(row).begin(), level.row(row).end(), out.row(row + 1).begin());
  for (int x = 0; x < width; ++x) {  // half a turn around the pole; between two texels if the width is odd
    const int a = (x + width / 2) % width, b = (x + (width + 1) / 2) % width;
    out.at(x, 0) = mean(level.at(a, 0), level.at(b, 0));
    out.at(x, height + 1) = mean(level.at(a, height - 1), level.at(b, height - 1));
  }
  return out;
}

// ---- cubes -------------------------------------------------------------------------------------------------------------

template <class Texel>
using Faces = std::array<Image<Texel>, 6>;

// Calls f(face) for every face, using the workers if there are any.
template <class F>
void for_each_face(const Workers* workers, const F& f) {
  detail::for_each_row(workers, 6, [&](int face) {
    const FloatMode float_mode;
    f(static_cast<std::size_t>(face));
  });
}

// Returns the texel of the adjacent face next to texel (x, y), which is one step beyond an edge of this face.
template <class Texel>
const Texel& beyond_edge(const Faces<Texel>& faces, int face, int x, int y) {
  const int n = faces[0].width();
  const auto clamped = [n](int i) { return std::clamp((2 * i + 1.0) / n - 1.0, -1.0, 1.0); };
  glm::dvec3 d = cube_direction(face, clamped(x), clamped(y));  // on the edge; the next line moves it across by half a texel
  d[face / 2] *= 1.0 - 1.0 / n;
  for (int other = 0; other < 6; ++other) {
    const double sign = other % 2 == 0 ? 1.0 : -1.0;
    if (other / 2 == face / 2 || d[other / 2] != sign) continue;
    const glm::dvec3 s = cube_direction(other, 1, 0) - cube_direction(other, 0, 0),
                     t = cube_direction(other, 0, 1) - cube_direction(other, 0, 0);
    const auto index = [n](double at) { return std::clamp(static_cast<int>((at + 1.0) / 2.0 * n), 0, n - 1); };
    return faces[static_cast<std::size_t>(other)].at(index(glm::dot(d, s)), index(glm::dot(d, t)));
  }
  return faces[static_cast<std::size_t>(face)].at(0, 0);  // unreachable: the point is on another face
}

template <class Texel>
Image<Texel> bordered(const Faces<Texel>& faces, int face) {
  const Image<Texel>& middle = faces[static_cast<std::size_t>(face)];
  const int n = middle.width();
  Image<Texel> out(n + 2, n + 2);
  for (int y = 0; y < n; ++y) std::copy(middle.row(y).begin(), middle.row(y).end(), out.row(y + 1).begin() + 1);
  for (int i = 0; i < n; ++i) {
    out.at(i + 1, 0) = beyond_edge(faces, face, i, -1);
    out.at(i + 1, n + 1) = beyond_edge(faces, face, i, n);
    out.at(0, i + 1) = beyond_edge(faces, face, -1, i);
    out.at(n + 1, i + 1) = beyond_edge(faces, face, n, i);
  }
  for (const int x : {0, n + 1}) {
    for (const int y : {0, n + 1}) {
      const int in_x = std::clamp(x, 1, n), in_y = std::clamp(y, 1, n);
      out.at(x, y) = mean(out.at(in_x, in_y), out.at(x, in_y), out.at(in_x, y));
    }
  }
  return out;
}

}  // namespace

template <class Texel>
EnvironmentMap::EnvironmentMap(const Image<Texel>& panorama, TexelFormat format) : layout_(EnvironmentLayout::panorama) {
  const FloatMode float_mode;
  for (const Image<Texel>& level : levels_of(panorama, format)) {
    images_.push_back(one_level(bordered(levels_ == 0 ? level : low_passed(level)), format));
    ++levels_;
  }
}

template <class Texel>
EnvironmentMap::EnvironmentMap(const std::array<Image<Texel>, 6>& faces, TexelFormat format, const Workers* workers)
    : layout_(EnvironmentLayout::cube) {
  for (const Image<Texel>& face : faces) {
    HS_CHECK_OP(face.width(), ==, faces[0].width());
    HS_CHECK_OP(face.height(), ==, faces[0].width());
  }
  std::array<std::vector<Image<Texel>>, 6> chains;
  for_each_face(workers, [&](std::size_t f) { chains[f] = levels_of(faces[f], format); });
  std::vector<Faces<Texel>> levels(chains[0].size());
  for (std::size_t level = 0; level < levels.size(); ++level) {
    for (std::size_t f = 0; f < 6; ++f) levels[level][f] = std::move(chains[f][level]);
  }
  add_levels<Texel>(levels, format, workers);
}

EnvironmentMap::EnvironmentMap(std::span<const std::array<Image<glm::vec4>, 6>> levels, TexelFormat format, const Workers* workers)
    : layout_(EnvironmentLayout::cube) {
  HS_CHECK_OP(levels.size(), >=, 1u);
  for (std::size_t level = 0; level < levels.size(); ++level) {
    for (const Image<glm::vec4>& face : levels[level]) {
      HS_CHECK_OP(face.width(), ==, std::max(levels[0][0].width() >> level, 1));
      HS_CHECK_OP(face.height(), ==, face.width());
    }
  }
  add_levels(levels, format, workers);
}

bool EnvironmentMap::is_uniform() const {
  const glm::vec3 light(image(0, 0).value(0, 0, 0));
  for (int face = 0; face < faces(); ++face) {
    const Texture2D& texels = image(0, face);
    for (int y = 0; y < texels.height(); ++y) {
      for (int x = 0; x < texels.width(); ++x) {
        if (glm::vec3(texels.value(0, x, y)) != light) return false;
      }
    }
  }
  return true;
}

template <class Texel>
void EnvironmentMap::add_levels(std::span<const std::array<Image<Texel>, 6>> levels, TexelFormat format, const Workers* workers) {
  std::array<std::vector<Texture2D>, 6> by_face;
  for_each_face(workers, [&](std::size_t f) {
    for (const Faces<Texel>& faces : levels) by_face[f].push_back(one_level(bordered(faces, static_cast<int>(f)), format));
  });
  for (std::size_t level = 0; level < levels.size(); ++level) {
    for (std::vector<Texture2D>& textures : by_face) images_.push_back(std::move(textures[level]));
  }
  levels_ = static_cast<int>(levels.size());
}

template EnvironmentMap::EnvironmentMap(const Image<glm::u8vec4>&, TexelFormat);
template EnvironmentMap::EnvironmentMap(const Image<glm::vec4>&, TexelFormat);
template EnvironmentMap::EnvironmentMap(const std::array<Image<glm::u8vec4>, 6>&, TexelFormat, const Workers*);
template EnvironmentMap::EnvironmentMap(const std::array<Image<glm::vec4>, 6>&, TexelFormat, const Workers*);

}  // namespace halfspace::HS_LANES
