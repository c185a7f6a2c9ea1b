// SPDX-License-Identifier: Apache-2.0
//
// Shapes for the cases and their geometry in the window, in double precision. Pictures are checked against this geometry in addition to the
// oracle.
#pragma once

#include <array>
#include <optional>
#include <span>

#include "conformance/picture.h"

namespace halfspace::conformance {

inline constexpr BlendState kAdd{BlendEquation::add, BlendFactor::one, BlendFactor::one,
                                 BlendEquation::add, BlendFactor::one, BlendFactor::one};

/// Returns the clip position of a point in the window (px); exact on the 1/256 px grid.
glm::vec4 clip_at(const Picture& picture, double x, double y, float z_ndc = 0.0f, float w = 1.0f);
/// Returns the window position of a vertex (px). w must be positive.
glm::dvec2 window_of(const Picture& picture, const glm::vec4& pos_clip);
/// Adds two triangles for a quad whose corners are in order around it.
void add_quad(Drawing& drawing, const std::array<Vertex, 4>& corners);
/// Adds a single-color rectangle (px).
void add_rectangle(Drawing& drawing, const Picture& picture, const glm::dvec4& x0_y0_x1_y1, const glm::vec4& color, float z_ndc = 0.0f);
/// Returns one of eight colors that differ in every channel.
glm::vec4 color_number(int i);
/// Returns n vertices of different colors on the 1/256 px grid of the window. They depend only on the seed and are the same on every
/// machine. w is 1, or between 1/2 and 2 if projected.
std::vector<Vertex> scattered(const Picture& picture, int n, uint64_t seed, bool projected = false);
/// Returns n vertices that zigzag from left to right, so that strips and lists form adjacent triangles.
std::vector<Vertex> zigzag(const Picture& picture, int n, bool projected = false);

/// A triangle or line formed by the vertices and indices of a drawing (without restart): its vertex numbers in OpenGL's order (OpenGL 4.6,
/// table 10.1) and its provoking vertex.
struct Assembled {
  std::array<uint32_t, 3> vertex;  ///< for a line, the third vertex equals the second
  uint32_t provoking;
};
std::vector<Assembled> assembled(const Drawing& drawing);

/// A half plane. A convex region of the window is an intersection of half planes.
struct HalfPlane {
  double a, b, c;  ///< inside where a·x + b·y + c >= 0, in px
};
struct Region {
  std::vector<HalfPlane> planes;
};
enum class Where : uint8_t { inside, outside, unsure };
/// `unsure` means closer than the margin (px) to an edge. The default margin is twice the distance by which snapping can move a vertex;
/// VK-GL-CTS also uses a margin larger than its grid.
inline constexpr double kMargin = 2.0 / 256.0;
Where where(const Region& region, const glm::dvec2& point, double margin = kMargin);

/// Returns a convex polygon in the window. The vertices can be in either winding order.
Region polygon(std::span<const glm::dvec2> corners);
/// Computes the visible part of a clip-space triangle from the planes of its homogeneous weights. w may have any sign. The part is limited
/// by the near and far planes unless depth is clamped. Returns nothing if the triangle is seen edge-on.
struct Weighed {
  Region region;
  std::array<HalfPlane, 3> weight;  ///< weights of the vertices, for a point scaled to w = 1

  /// Returns the perspective-correct value at a point.
  glm::dvec4 color(const std::array<glm::vec4, 3>& of, const glm::dvec2& point) const;
};
std::optional<Weighed> weigh(const Picture& picture, const DepthState& depth, const std::array<glm::vec4, 3>& pos_clip);

/// Bounds on the fraction of a pixel's samples that are inside the regions. A sample counts once for each region that contains it.
struct Share {
  double low = 0.0, high = 0.0;
};
Share share_of(const std::vector<Region>& regions, int x, int y, int samples);
/// Checks that the red channel of every pixel is within the bounds of share_of times `weight`, the red value that one fragment adds.
/// Returns a message about the first wrong pixel, or an empty string.
std::string expect_red(const Picture& picture, const Seen& seen, const std::vector<Region>& regions, double weight = 1.0);

/// Like expect_red, for the quads of the first drawing, with four vertices each.
std::string quads_once(const Picture& picture, const Seen& seen);

/// Calls f(x, y) for every pixel until it returns a message, and returns that message.
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
/// Returns a message such as "1 0.5 0 1 expected, got 1 0.6 0 1", or an empty string if the difference is within the tolerance.
std::string expect_near(const glm::dvec4& expected, const glm::vec4& got, double tolerance);
/// Half an 8-bit LSB, plus a margin for float arithmetic.
inline constexpr double kHalfCode = 0.502 / 255.0;

}  // namespace halfspace::conformance
