// SPDX-License-Identifier: Apache-2.0
//
// Shapes for the parameter sets, and where in the window they lie, in double precision: what a picture is judged by besides the oracle.
#pragma once

#include <array>
#include <optional>
#include <span>

#include "conformance/picture.h"

namespace halfspace::conformance {

inline constexpr BlendState kAdd{BlendEquation::add, BlendFactor::one, BlendFactor::one,
                                 BlendEquation::add, BlendFactor::one, BlendFactor::one};

/// The clip position of a point of the window (px); exact on the 1/256 px grid.
glm::vec4 clip_at(const Picture& picture, double x, double y, float z_ndc = 0.0f, float w = 1.0f);
/// Where a vertex lies in the window (px); w > 0.
glm::dvec2 window_of(const Picture& picture, const glm::vec4& pos_clip);
/// Two triangles of four corners in their order round the quad, over the vertices that the drawing has.
void add_quad(Drawing& drawing, const std::array<Vertex, 4>& corners);
/// A rectangle in px of one colour.
void add_rectangle(Drawing& drawing, const Picture& picture, const glm::dvec4& x0_y0_x1_y1, const glm::vec4& color, float z_ndc = 0.0f);
/// Eight colours that differ in every channel.
glm::vec4 color_number(int i);
/// n vertices in the window, on the 1/256 px grid, the same for a seed everywhere; colours differ. w is 1, or from 1/2 to 2.
std::vector<Vertex> scattered(const Picture& picture, int n, uint64_t seed, bool projected = false);
/// n vertices that zigzag from left to right, so that strips and lists of triangles lie side by side.
std::vector<Vertex> zigzag(const Picture& picture, int n, bool projected = false);

/// Every triangle or line that the drawing's vertices and indices make (without restart): the numbers of its vertices, OpenGL's order
/// (4.6, table 10.1), and which of them provokes by the convention.
struct Assembled {
  std::array<uint32_t, 3> vertex;  ///< of a line the third is the second
  uint32_t provoking;
};
std::vector<Assembled> assembled(const Drawing& drawing);

/// A convex part of the window.
struct HalfPlane {
  double a, b, c;  ///< inside where a·x + b·y + c >= 0, in px
};
struct Region {
  std::vector<HalfPlane> planes;
};
enum class Where : uint8_t { inside, outside, unsure };
/// Unsure within the margin of an edge (px). The default is twice what snapping moves a vertex, as VK-GL-CTS's box is wider than its grid.
inline constexpr double kMargin = 2.0 / 256.0;
Where where(const Region& region, const glm::dvec2& point, double margin = kMargin);

/// A convex polygon of the window, in either order.
Region polygon(std::span<const glm::dvec2> corners);
/// What is seen of a triangle of clip space, w of any sign, between near and far (unless clamped): the planes of its homogeneous weights.
/// None if it is seen edge-on.
struct Weighed {
  Region region;
  std::array<HalfPlane, 3> weight;  ///< of the vertices, for a point scaled to w = 1

  /// The perspective-correct value at a point.
  glm::dvec4 color(const std::array<glm::vec4, 3>& of, const glm::dvec2& point) const;
};
std::optional<Weighed> weigh(const Picture& picture, const DepthState& depth, const std::array<glm::vec4, 3>& pos_clip);

/// The share of a pixel's samples that lie in regions, each counted as often as a region holds it: at least and at most.
struct Share {
  double low = 0.0, high = 0.0;
};
Share share_of(const std::vector<Region>& regions, int x, int y, int samples);
/// Every pixel's red lies between the shares times the weight of one fragment. Empty, or the first pixel that does not.
std::string expect_red(const Picture& picture, const Seen& seen, const std::vector<Region>& regions, double weight = 1.0);

/// The same of the quads that the first drawing has: four vertices each.
std::string quads_once(const Picture& picture, const Seen& seen);

/// Calls f(x, y) for every pixel until it returns a message.
template <class F>
std::string for_each_pixel(const Seen& seen, const F& f) {
  for (int y = 0; y < seen.height; ++y) {
    for (int x = 0; x < seen.width; ++x) {
      std::string wrong = f(x, y);
      if (!wrong.empty()) return "pixel (" + std::to_string(x) + ", " + std::to_string(y) + "): " + wrong;
    }
  }
  return {};
}
/// "1 0.5 0 1 expected, got 1 0.6 0 1", or nothing where they differ by no more than the tolerance.
std::string expect_near(const glm::dvec4& expected, const glm::vec4& got, double tolerance);
/// Half a code of 8 bits, rounded up by what float arithmetic adds.
inline constexpr double kHalfCode = 0.502 / 255.0;

}  // namespace halfspace::conformance
