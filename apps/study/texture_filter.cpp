// SPDX-License-Identifier: Apache-2.0
//
// Compares texture filters on a checkered plane that reaches the horizon. The reference is the mean of the texture over each pixel.
#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "halfspace/geometry/camera.h"
#include "halfspace/procedural/patterns.h"
#include "halfspace/raster/pass.h"
#include "study/pictures.h"

namespace halfspace {

namespace {

constexpr double kHalf = 40.0;   // kTiles repeats of the texture cover a length of 2·kHalf units on the plane
constexpr double kEye = 1.0;     // height of the eye above the plane; it looks along −z
constexpr double kTan = 0.5;     // tangent of half the vertical field of view
constexpr double kTiles = 20.0;  // see kHalf

struct Textured {
  glm::mat4 clip_from_world;
  const Texture2D* texture;
  Sampler sampler;
  template <class R>
  struct Attributes {
    vec3<R> position_ws;
    vec2<R> uv;
  };
  template <class R>
  struct Varyings {
    vec2<R> uv;
  };
  template <class R>
  vec4<R> vertex(const Attributes<R>& in, Varyings<R>& out) const {
    out.uv = in.uv;
    return clip_from_world * vec4<R>(in.position_ws, R(1));
  }
  template <class R>
  Fragment<R> fragment(const Varyings<R>& in, const Pixel<R>& px) const {
    return {texture->sample<R>(sampler, in.uv, px.ddx(&Varyings<R>::uv), px.ddy(&Varyings<R>::uv))};
  }
};

// Returns the texture coordinates seen at (x, y), in pixels with y down. The plane is kEye below the eye. The horizon is 0.02 of the
// image height above the upper edge of the image, so the plane fills the image.
glm::dvec2 uv_seen(double x, double y, int width, int height) {
  const double right = kTan * width / height * (2.0 * x / width - 1.0), down = 2.0 * kTan * (y + 0.02 * height) / height;
  const double z = kEye / down;  // distance along the view axis
  return glm::dvec2(right * z, z) * (kTiles / (2.0 * kHalf));
}

// The mean of the texture over each pixel, from 32 x 32 samples. The samples are split into two halves in a checkerboard pattern. The error
// is estimated from the difference between the halves.
struct Integrated {
  Image<glm::vec4> mean;
  double error;  // RMS of half the difference between the two halves
};
Integrated integrate(const Texture2D& texture, int width, int height, const Workers& workers) {
  constexpr int kSide = 32;
  Integrated out{Image<glm::vec4>(width, height), 0.0};
  std::vector<double> squares(static_cast<std::size_t>(height));
  workers.for_each(height, [&](int y) {
    for (int x = 0; x < width; ++x) {
      glm::dvec3 sums[2]{};
      for (int i = 0; i < kSide * kSide; ++i) {
        const glm::dvec2 uv = uv_seen(x + (i % kSide + 0.5) / kSide, y + (i / kSide + 0.5) / kSide, width, height);
        sums[(i + i / kSide) & 1] += glm::dvec3(vec3<double>(texture.sample_level<double>({}, vec2<double>(uv), 0.0)));
      }
      const glm::dvec3 a = sums[0] / (0.5 * kSide * kSide), b = sums[1] / (0.5 * kSide * kSide);
      out.mean.at(x, y) = glm::vec4(glm::vec3(0.5 * (a + b)), 1.0f);
      squares[static_cast<std::size_t>(y)] += 0.25 * (a.x - b.x) * (a.x - b.x);
    }
  });
  double sum = 0.0;
  for (const double s : squares) sum += s;
  out.error = std::sqrt(sum / (static_cast<double>(width) * height));
  return out;
}

}  // namespace

Study study_texture_filter(const StudyOptions& options, const Workers& workers) {
  const int width = options.quick ? 160 : 960, height = options.quick ? 90 : 540;
  const Texture2D texture(procedural_pattern(Pattern::checkerboard, 512, workers).color, TexelFormat::srgb8a8);
  const Integrated truth = integrate(texture, width, height, workers);
  Study study{
      .name = "texture_filter",
      .title = "Texture filters on a plane that reaches the horizon",
      .setting = fmt::format("A checkered plane seen from a height of 1 unit, {}x{}; 512x512 texels per tile, sRGB", width, height),
      .error_name = "RMS error of linear light over the image",
      .time_name = "frame",
      .truth = {"1,024 bilinear lookups per pixel, in double", truth.error, "half the RMS difference between two halves",
                codes_of(truth.mean)},
  };
  // A quad in eye space (y up, −z forward) from below the lower edge of the image almost to the horizon; u = x and v = −z in tiles.
  const double scale = kTiles / (2.0 * kHalf), near = 0.3, far = 2000.0, wide = 2.0 * far;
  const auto corner = [&](double x, double z) {
    return glm::vec3(static_cast<float>(x), static_cast<float>(-kEye), static_cast<float>(-z));
  };
  const auto uv = [&](double x, double z) { return glm::vec2(static_cast<float>(x * scale), static_cast<float>(z * scale)); };
  const std::vector<glm::vec3> positions{corner(-wide, near), corner(wide, near), corner(wide, far), corner(-wide, far)};
  const std::vector<glm::vec2> uvs{uv(-wide, near), uv(wide, near), uv(wide, far), uv(-wide, far)};
  const std::vector<uint32_t> list{0, 1, 2, 0, 2, 3};
  const Indices indices(list, positions.size());
  // The horizon is 0.02 of the image height above the upper edge: move the image up accordingly.
  const double aspect = static_cast<double>(width) / height;
  glm::dmat4 moved(1.0);
  moved[3][1] = 1.0 + 2.0 * 0.02;
  const glm::dmat4 clip = moved * perspective_reversed(2.0 * std::atan(kTan), aspect, 0.1, std::numeric_limits<double>::infinity());
  DrawState state;
  state.depth = {.test = false, .clip = ClipDepth::zero_to_one};
  for (const auto& [name, group, filter, anisotropy] :
       {std::tuple("nearest", "isotropic", Filter::nearest, 1), std::tuple("bilinear", "isotropic", Filter::bilinear, 1),
        std::tuple("trilinear", "isotropic", Filter::trilinear, 1), std::tuple("2x", "anisotropic", Filter::trilinear, 2),
        std::tuple("4x", "anisotropic", Filter::trilinear, 4), std::tuple("8x", "anisotropic", Filter::trilinear, 8),
        std::tuple("16x", "anisotropic", Filter::trilinear, 16)}) {
    const Textured shader{
        glm::mat4(clip), &texture, {.mag = filter == Filter::nearest ? filter : Filter::bilinear, .min = filter, .anisotropy = anisotropy}};
    Image<glm::vec4> picture(width, height);
    Variant v{.name = name,
              .group = group,
              .parameters = {{"filter", static_cast<double>(filter)},
                             {"anisotropy", static_cast<double>(anisotropy)},
                             {"pixels", static_cast<double>(width) * height}},
              .time = time_of(
                  [&] {
                    Pass pass(width, height, rgba32f_target(picture), {});
                    pass.draw(shader, make_vertex_view(stream(positions), stream(uvs)), indices, state);
                    pass.run(workers);
                  },
                  options)};
    set_picture_error(v, picture, truth.mean, PictureError::rms);
    study.variants.push_back(std::move(v));
  }
  return study;
}

}  // namespace halfspace
