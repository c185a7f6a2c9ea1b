// SPDX-License-Identifier: Apache-2.0
//
// A scene drawn twice, by Halfspace's Pass and by Mesa, and how far the two agree.
#pragma once

#include <string>

#include "halfspace/raster/pass.h"
#include "mesa/mesa_draw.h"
#include "mesa/truth.h"
#include "mesa/twin_shaders.h"

namespace halfspace::test {

inline constexpr float kDepthTolerance = 1e-6f;

/// The figures of a comparison. A pixel is covered where alpha left its clear value 0.
struct Figures {
  int64_t covered = 0;           ///< pixels covered in either picture
  int64_t coverage_differs = 0;  ///< … in one only
  int64_t color_differs = 0;     ///< a channel differs by more than one code
  int worst = 0;                 ///< the largest difference of a channel, in codes
  int64_t depth_differs = 0;     ///< window depths differ by more than kDepthTolerance

  // Of the pixels that differ, judged in double precision (a sample of them, where they are many):
  int64_t judged = 0;
  int64_t halfspace_right = 0, mesa_right = 0;              ///< within one code of the truth of snapped vertices
  int64_t halfspace_right_exact = 0, mesa_right_exact = 0;  ///< … of unsnapped vertices
  int64_t halfspace_right_beside = 0;                       ///< not the first, but right for a point 1/256 px beside
  // Of the pixels whose depth differs, where colours agree: the largest errors.
  double halfspace_depth_error = 0.0, mesa_depth_error = 0.0;

  /// The share of the judged pixels where Halfspace errs (all, if none was judged).
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

  /// Adds a draw to both. Vertices, indices and textures must outlive run().
  template <Shader S>
  void draw(const S& shader, const VertexView& vertices, const std::vector<uint32_t>& indices, const DrawState& state = {}) {
    const auto list = std::make_shared<const Indices>(indices, vertices.vertex_count);
    our_draws_.push_back([=](Pass& pass) { pass.draw(shader, vertices, *list, state); });
    mesa_draws_.push_back({kSharedGlsl, S::kVertexGlsl, S::kFragmentGlsl, [shader](const UniformSetter& set) { shader.uniforms(set); },
                           vertices, indices, state});
    truths_.push_back(std::make_unique<TruthDrawOf<S>>(shader, vertices, indices, state, target_));
  }

  /// Draws both pictures.
  void run();
  const Picture& halfspace() const { return ours_; }
  const Picture& mesa() const { return mesa_; }

  /// Compares the pictures, and judges up to most_judged differing pixels in double precision. With the environment
  /// variable HALFSPACE_MESA_PIXELS set, the judged pixels are printed.
  Figures figures(int most_judged = 0) const;
  /// For additive draws of 1/255: the number of fragments of every pixel, compared; covered counts fragments.
  Figures fragment_figures(int most_judged = 0) const;
  /// The truth of one pixel, or of a point beside its centre (in pixels).
  TruthPixel truth(int x, int row, Positions positions, const glm::dvec2& beside = glm::dvec2(0.0)) const;

 private:
  void judge_some(const std::vector<std::pair<int, int>>& pixels, int most, int tolerance, Figures& f) const;
  void judge(int x, int row, int tolerance, Figures& f) const;
  bool is_right_beside(int x, int row, int tolerance) const;
  void judge_depths(const std::vector<std::pair<int, int>>& pixels, int most, Figures& f) const;

  TargetSpec target_;
  std::vector<std::function<void(Pass&)>> our_draws_;
  std::vector<MesaDraw> mesa_draws_;
  std::vector<std::unique_ptr<TruthDraw>> truths_;
  Picture ours_, mesa_;
};

/// The default state, changed: state_with([](DrawState& s) { s.cull = CullMode::back; }).
template <class Change>
DrawState state_with(const Change& change) {
  DrawState state;
  change(state);
  return state;
}

/// The name of a parameterized test: its parameter's.
inline const auto case_name = [](const auto& test) { return std::string(test.param.name); };

/// Prints the figures, and records them as properties of the running test.
void report(const Figures& figures);

/// Coverage may differ on at most 0.01% of the covered pixels, and colour must be within 1/255 on at least 99.9%.
inline constexpr double kCoverageBound = 1e-4, kColorBound = 1e-3;
/// Expects the two pictures to agree within the bounds.
void expect_agreement(const Figures& figures);
/// For what Mesa is known to draw less exactly, for the reason given: expects Halfspace's picture to agree with the truth
/// (of vertices on the 1/256 px grid) within the bounds, as far as the judged pixels tell.
void expect_halfspace_right(const Figures& figures, const char* what_mesa_does);
/// The one or the other: what_mesa_does null means that they agree.
inline void expect_verdict(const Figures& figures, const char* what_mesa_does) {
  what_mesa_does == nullptr ? expect_agreement(figures) : expect_halfspace_right(figures, what_mesa_does);
}

}  // namespace halfspace::test
