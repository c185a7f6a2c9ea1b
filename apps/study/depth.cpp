// SPDX-License-Identifier: Apache-2.0
//
// Depth precision: compares depth formats and reversed Z for several ratios of far to near plane. Draws pairs of overlapping quads whose
// distances from the eye differ by 1/10,000. The pairs are log-uniformly distributed between the near and far planes, and the quads of a
// pair are drawn in random order. The farther quad is red, so every pair that ends up red is an error.
#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "halfspace/core/random.h"
#include "halfspace/geometry/camera.h"
#include "halfspace/raster/pass.h"
#include "study/pictures.h"

namespace halfspace {

namespace {

constexpr double kGap = 1e-4;
constexpr int kCell = 4;  // side of the square covered by a pair, px

struct Flatly {
  glm::mat4 clip_from_view;
  template <class R>
  struct Attributes {
    vec3<R> position_vs, color;
  };
  template <class R>
  struct Varyings {
    Flat<vec3<R>> color;
  };
  template <class R>
  vec4<R> vertex(const Attributes<R>& in, Varyings<R>& out) const {
    out.color.value = in.color;
    return clip_from_view * vec4<R>(in.position_vs, R(1));
  }
  template <class R>
  Fragment<R> fragment(const Varyings<R>& in, const Pixel<R>&) const {
    return {vec4<R>(in.color.value, R(1))};
  }
};

struct Pairs {
  std::vector<glm::vec3> positions, colors;
};

// The field of view is 90 degrees, so the view volume is 2z wide at distance z.
Pairs make_pairs(int size, double ratio) {
  constexpr double kNear = 0.1;
  Pairs out;
  SplitMix64 random(1);
  for (int cell = 0; cell < (size / kCell) * (size / kCell); ++cell) {
    const double z = kNear * 1.01 * std::pow(ratio / 1.03, random.real(0.0, 1.0));
    const bool far_first = random.real(0.0, 1.0) < 0.5;
    for (int k = 0; k < 2; ++k) {
      const bool is_far = (k == 0) == far_first;
      const double distance = is_far ? z * (1.0 + kGap) : z;
      const double x0 = cell % (size / kCell) * kCell, y0 = cell / (size / kCell) * kCell;
      const auto corner = [&](double x, double y) {
        out.positions.emplace_back(glm::dvec3((2.0 * x / size - 1.0) * distance, (2.0 * y / size - 1.0) * distance, -distance));
        out.colors.push_back(is_far ? glm::vec3(1, 0, 0) : glm::vec3(1, 1, 1));
      };
      for (const int i : {0, 1, 2, 0, 2, 3}) corner(x0 + (i == 1 || i == 2 ? kCell : 0), y0 + (i >= 2 ? kCell : 0));
    }
  }
  return out;
}

// One depth image per format.
struct Depths {
  Image<uint16_t> d16;
  Image<uint32_t> d24;
  Image<float> d32;
  explicit Depths(int size) : d16(size, size), d24(size, size), d32(size, size) {}
  DepthTarget target(DepthFormat format, float clear) {
    DepthTarget t = format == DepthFormat::d16 ? d16_target(d16) : format == DepthFormat::d24 ? d24_target(d24) : d32f_target(d32);
    t.clear_value = clear;
    return t;
  }
};

double wrong_fraction(const Image<glm::vec4>& picture) {
  int wrong = 0, cells = 0;
  for (int y = kCell / 2; y < picture.height(); y += kCell)
    for (int x = kCell / 2; x < picture.width(); x += kCell, ++cells) wrong += picture.at(x, y).y == 0.0f;
  return static_cast<double>(wrong) / cells;
}

}  // namespace

Study study_depth(const StudyOptions& options, const Workers& workers) {
  const int size = options.quick ? 128 : 1024;
  const double cells = static_cast<double>(size / kCell) * (size / kCell);
  Study study{
      .name = "depth",
      .title = "Depth formats: surfaces in the wrong order",
      .setting =
          fmt::format("{:.0f} pairs of quads separated by 1/10,000 of their distance, near plane at 0.1, {}x{}; labels: format, far/near",
                      cells, size, size),
      .error_name = fmt::format("fraction of pairs in the wrong order (zero is plotted at {:.0e})", 0.1 / cells),
      .time_name = "frame",
      .truth = {"by construction (the nearer quad is white)", 0.1 / cells, "a tenth of one pair, as a fraction of all pairs"},
  };
  Depths depths(size);
  Image<glm::vec4> white(size, size);
  std::fill_n(white.data(), white.texels().size(), glm::vec4(1.0f));
  for (const double ratio : {1e2, 1e4, 1e6, 1e9}) {
    const Pairs pairs = make_pairs(size, ratio);
    for (const auto& [name, kind] :
         {std::pair("d16", DepthFormat::d16), std::pair("d24", DepthFormat::d24), std::pair("d32f", DepthFormat::d32f)}) {
      const DepthFormat format = kind;  // a lambda cannot portably capture a structured binding
      for (const bool reversed : {false, true}) {
        if (reversed && format != DepthFormat::d32f) continue;  // reversing does not change the precision of integer formats
        const double angle = std::numbers::pi / 2.0, far = 0.1 * ratio;
        const glm::dmat4 clip = reversed ? perspective_reversed(angle, 1.0, 0.1, far) : perspective_gl(angle, 1.0, 0.1, far);
        DrawState state;
        if (reversed) state.depth = {.compare = CompareOp::greater, .clip = ClipDepth::zero_to_one};
        Image<glm::vec4> picture(size, size);
        Variant v{.name = fmt::format("{}{} 1e{:.0f}", name, reversed ? " reversed" : "", std::log10(ratio)),
                  .group = fmt::format("{}{}", name, reversed ? " reversed" : ""),
                  .parameters = {{"bits", format == DepthFormat::d16   ? 16.0
                                          : format == DepthFormat::d24 ? 24.0
                                                                       : 32.0},
                                 {"reversed", reversed ? 1.0 : 0.0},
                                 {"far_over_near", ratio},
                                 {"gap", kGap},
                                 {"triangles", 4.0 * cells}},
                  .time = time_of(
                      [&] {
                        Pass pass(size, size, rgba32f_target(picture), depths.target(format, reversed ? 0.0f : 1.0f));
                        pass.draw(Flatly{glm::mat4(clip)}, make_vertex_view(stream(pairs.positions), stream(pairs.colors)), state);
                        pass.run(workers);
                      },
                      options)};
        set_picture_error(v, picture, white, PictureError::mean);
        v.measures.clear();
        v.error = wrong_fraction(picture);
        study.variants.push_back(std::move(v));
      }
    }
  }
  return study;
}

}  // namespace halfspace
