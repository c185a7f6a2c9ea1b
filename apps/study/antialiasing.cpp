// SPDX-License-Identifier: Apache-2.0
//
// Antialiasing: compares multisampling, and downsampling of larger images, with exact area coverage.
#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "halfspace/core/trig_double.h"
#include "halfspace/raster/pass.h"
#include "study/pictures.h"
#include "study/polygon_area.h"

namespace halfspace {

namespace {

// Creates a fan of wedges around the center of the image, whose edges have many different angles. The vertices are on the 1/256 px grid, so
// snapping does not move them.
std::vector<TrianglePx> wedges(int size, int count) {
  std::vector<TrianglePx> out;
  const auto corner = [&](double turns) {
    const SinCosDouble a = sincos_turns(turns);
    const glm::dvec2 p = glm::dvec2(0.5 * size) + 0.48 * size * glm::dvec2(a.cos, a.sin);
    return glm::round(p * 256.0) / 256.0;
  };
  for (int i = 0; i < count; ++i) {
    const double turns = (i + 0.123) / count;
    out.push_back({glm::dvec2(0.5 * size), corner(turns), corner(turns + 0.5 / count)});
  }
  return out;
}

struct White {
  template <class R>
  struct Attributes {
    vec2<R> position_ndc;
  };
  template <class R>
  struct Varyings {};
  template <class R>
  vec4<R> vertex(const Attributes<R>& in, Varyings<R>&) const {
    return {in.position_ndc, R(0), R(1)};
  }
  template <class R>
  Fragment<R> fragment(const Varyings<R>&, const Pixel<R>&) const {
    return {vec4<R>(R(1))};
  }
};

// Downsamples by averaging blocks of factor x factor pixels.
void average(const Image<glm::vec4>& fine, int factor, Image<glm::vec4>& out, const Workers& workers) {
  const float share = 1.0f / static_cast<float>(factor * factor);
  workers.for_each(out.height(), [&](int y) {
    for (int x = 0; x < out.width(); ++x) {
      glm::vec4 sum(0.0f);
      for (int j = 0; j < factor; ++j)
        for (int i = 0; i < factor; ++i) sum += fine.at(x * factor + i, y * factor + j);
      out.at(x, y) = sum * share;
    }
  });
}

class Edges {
 public:
  Edges(const std::vector<TrianglePx>& triangles, int size) {
    for (const TrianglePx& t : triangles)
      for (const glm::dvec2& p : t) corners_.emplace_back(p * (2.0 / size) - 1.0);
  }

  void draw(Image<glm::vec4>& picture, const PassOptions& options, const Workers& workers) const {
    ColorTarget target = rgba32f_target(picture);
    target.clear_value = {0, 0, 0, 1};
    Pass pass(picture.width(), picture.height(), target, {}, options);
    pass.draw(White{}, make_vertex_view(stream(corners_)));
    pass.run(workers);
  }

 private:
  std::vector<glm::vec2> corners_;
};

}  // namespace

Study study_antialiasing(const StudyOptions& options, const Workers& workers) {
  const int size = options.quick ? 128 : 1024;  // powers of two, so that multiples of 1/256 px are exact in NDC
  const std::vector<TrianglePx> triangles = wedges(size, options.quick ? 24 : 90);
  const Image<double> exact = area_coverage<double>(triangles, size, size);
  const Image<long double> finer = area_coverage<long double>(triangles, size, size);
  Image<glm::vec4> truth(size, size);
  double truth_error = 0x1p-25;  // rounding error of the float image
  for (std::size_t i = 0; i < exact.texels().size(); ++i) {
    truth_error = std::max(truth_error, static_cast<double>(std::abs(finer.data()[i] - static_cast<long double>(exact.data()[i]))));
    truth.data()[i] = glm::vec4(glm::vec3(static_cast<float>(exact.data()[i])), 1.0f);
  }
  Study study{
      .name = "antialiasing",
      .title = "Antialiasing: samples per pixel",
      .setting = fmt::format("{} white wedges around the center, {}x{}", triangles.size(), size, size),
      .error_name = "RMS error of coverage over the image",
      .time_name = "frame, including the resolve",
      .truth = {"polygon clipping, in double", truth_error, "difference from long double, and rounding to float", codes_of(truth)},
  };
  const Edges edges(triangles, size);
  const auto add = [&](const std::string& name, const std::string& group, int samples, int shaded, const auto& draw) {
    Image<glm::vec4> picture(size, size);
    Variant v{.name = name,
              .group = group,
              .parameters = {{"samples", static_cast<double>(samples)},
                             {"shaded_per_pixel", static_cast<double>(shaded)},
                             {"pixels", static_cast<double>(size) * size},
                             {"triangles", static_cast<double>(triangles.size())}},
              .time = time_of([&] { draw(picture); }, options)};
    set_picture_error(v, picture, truth, PictureError::rms);
    study.variants.push_back(std::move(v));
  };
  for (const int samples : {1, 2, 4, 8}) {
    add(fmt::format("{} sample{}", samples, samples > 1 ? "s" : ""), "samples, shaded once", samples, 1,
        [&](Image<glm::vec4>& picture) { edges.draw(picture, {.samples = samples}, workers); });
    if (samples == 1) continue;
    add(fmt::format("{} samples, each shaded", samples), "samples, each shaded", samples, samples,
        [&](Image<glm::vec4>& picture) { edges.draw(picture, {.samples = samples, .supersample = true}, workers); });
  }
  for (const int factor : options.quick ? std::vector{2} : std::vector{2, 4, 8}) {
    Image<glm::vec4> fine(size * factor, size * factor);
    add(fmt::format("{0}x{0} larger", factor), "larger image, downsampled", factor * factor, factor * factor,
        [&](Image<glm::vec4>& picture) {
          edges.draw(fine, {}, workers);
          average(fine, factor, picture, workers);
        });
  }
  return study;
}

}  // namespace halfspace
