// SPDX-License-Identifier: Apache-2.0
//
// Draws a scene with Halfspace's Pass and with Mesa, and measures how far the results agree.
#pragma once

#include <string>

#include "halfspace/raster/pass.h"
#include "mesa/mesa_draw.h"
#include "mesa/truth.h"
#include "mesa/twin_shaders.h"

namespace halfspace::test {

inline constexpr float kDepthTolerance = 1e-6f;

/// Results of a comparison. A pixel counts as covered if its alpha differs from the clear value 0.
struct Figures {
  int64_t covered = 0;           ///< pixels covered in either image
  int64_t coverage_differs = 0;  ///< pixels covered in only one image
  int64_t color_differs = 0;     ///< a channel differs by more than 1/255
  int worst = 0;                 ///< maximum difference of a channel, in 1/255
  int64_t depth_differs = 0;     ///< window depths differ by more than kDepthTolerance

  // Differing pixels, or a sample of them if there are many, checked against double precision:
  int64_t judged = 0;
  int64_t halfspace_right = 0, mesa_right = 0;              ///< within 1/255 of the reference for snapped vertices
  int64_t halfspace_right_exact = 0, mesa_right_exact = 0;  ///< within 1/255 of the reference for unsnapped vertices
  int64_t halfspace_right_beside = 0;                       ///< wrong at the pixel center, but correct for a point within 1/256 px of it
  // Maximum errors over pixels whose depths differ although their colors agree.
  double halfspace_depth_error = 0.0, mesa_depth_error = 0.0;

  /// Returns the fraction of the checked pixels for which Halfspace is wrong, or 1 if none was checked.
  double halfspace_wrong() const {
    return judged == 0 ? 1.0 : 1.0 - static_cast<double>(halfspace_right + halfspace_right_beside) / static_cast<double>(judged);
  }
  double coverage_share() const { return share(coverage_differs); }
  double color_share() const { return share(color_differs); }

 private:
  double share(int64_t n) const { return covered == 0 ? 0.0 : static_cast<double>(n) / static_cast<double>(covered); }
};

class TwinPass {
 public:
  explicit TwinPass(const TargetSpec& target = {}) : target_(target) {}

  /// Adds a draw call to both. Vertices, indices and textures must outlive run().
  template <Shader S>
  void draw(const S& shader, const VertexView& vertices, const std::vector<uint32_t>& indices, const DrawState& state = {}) {
    const auto list = std::make_shared<const Indices>(indices, vertices.vertex_count);
    our_draws_.push_back([=](Pass& pass) { pass.draw(shader, vertices, *list, state); });
    mesa_draws_.push_back({kSharedGlsl, S::kVertexGlsl, S::kFragmentGlsl, [shader](const UniformSetter& set) { shader.uniforms(set); },
                           vertices, indices, state});
    truths_.push_back(std::make_unique<TruthDrawOf<S>>(shader, vertices, indices, state, target_));
  }

  /// Draws both images.
  void run();
  const Picture& halfspace() const { return ours_; }
  const Picture& mesa() const { return mesa_; }

  /// Compares the images and checks up to max_checked differing pixels in double precision. If the environment variable
  /// HALFSPACE_MESA_PIXELS is set, these pixels are printed.
  Figures figures(int max_checked = 0) const;
  /// Compares the number of fragments per pixel in additive draws of 1/255; `covered` then counts fragments.
  Figures fragment_figures(int max_checked = 0) const;
  /// Returns the reference value of a pixel, or of a point at `offset` (in pixels) from its center.
  TruthPixel truth(int x, int row, Positions positions, const glm::dvec2& offset = glm::dvec2(0.0)) const;

 private:
  void judge(int x, int row, int tolerance, Figures& f) const;
  bool is_right_beside(int x, int row, int tolerance) const;
  void compare_depths_with_double(const std::vector<std::pair<int, int>>& pixels, int max_count, Figures& f) const;

  TargetSpec target_;
  std::vector<std::function<void(Pass&)>> our_draws_;
  std::vector<MesaDraw> mesa_draws_;
  std::vector<std::unique_ptr<TruthDraw>> truths_;
  Picture ours_, mesa_;
};

/// Returns the default state with a change: state_with([](DrawState& s) { s.cull = CullMode::back; }).
template <class Change>
DrawState state_with(const Change& change) {
  DrawState state;
  change(state);
  return state;
}

/// Returns the name of a parameterized test: the name of its parameter.
inline const auto case_name = [](const auto& test) { return std::string(test.param.name); };

/// Prints the results and records them as properties of the running test.
void report(const Figures& figures);

/// Bounds: coverage may differ on at most 0.01% of the covered pixels, and color must be within 1/255 on at least 99.9%.
inline constexpr double kCoverageBound = 1e-4, kColorBound = 1e-3;
/// Expects that the two images agree within the bounds.
void expect_agreement(const Figures& figures);
/// Expects that Halfspace agrees with the reference within the bounds, for vertices on the 1/256 px grid. The number of differing pixels is
/// extrapolated from the checked ones. Used for features that Mesa is known to draw less accurately; what_mesa_does is the reason.
void expect_halfspace_right(const Figures& figures, const char* what_mesa_does);
/// Calls expect_agreement if what_mesa_does is null, and expect_halfspace_right otherwise.
inline void expect_verdict(const Figures& figures, const char* what_mesa_does) {
  what_mesa_does == nullptr ? expect_agreement(figures) : expect_halfspace_right(figures, what_mesa_does);
}

}  // namespace halfspace::test
