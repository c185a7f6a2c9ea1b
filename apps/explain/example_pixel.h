// SPDX-License-Identifier: Apache-2.0
//
// Chooses the pixel that a page follows through the pipeline, unless the user chooses one.
#pragma once

#include "explain/pixel_history.h"
#include "explain/stage_pictures.h"
#include "halfspace/render/prepared_scene.h"

namespace halfspace {

/// Returns the fragment that is visible at a pixel: the last one that replaced the color or, if there is none, the last one that was
/// shaded. If a pixel has several samples, it is visible at one of them. Returns null if no fragment was shaded.
const TracedFragment* visible_fragment(const FrameTrace& trace, glm::ivec2 pixel);

/// Returns the largest distance by which affine interpolation displaces a value along an edge of a triangle, in pixels. x and y are in
/// 1/256 pixel.
double affine_error(const std::array<int32_t, 3>& x, const std::array<int32_t, 3>& y, const std::array<float, 3>& inv_w);

/// Returns the height of a triangle above its longest edge, in pixels. x and y are in 1/256 pixel.
double height_above_longest_edge(const std::array<int32_t, 3>& x, const std::array<int32_t, 3>& y);

/// The parts of a frame that the choice depends on.
struct ExampleSource {
  const PreparedScene& scene;
  const PassContext& context;  ///< of the first round
  const FrameTrace& trace;
  const ValuePictures& values;
  const Workers& workers;
};

/// What a pixel and its visible primitive can show.
struct ExampleFacts {
  bool is_triangle = false;            ///< a triangle of a mesh, not a point, a line or the background
  uint32_t visible_pixels = 0;         ///< pixels at which the primitive is the visible one
  uint32_t covered_pixels = 0;         ///< pixels with a fragment of the primitive, visible or not
  uint32_t primitives = 0;             ///< different primitives with a fragment in the pixel
  bool is_clipped = false;             ///< the triangle was clipped, and is drawn as several pieces
  double height = 0.0;                 ///< of the triangle above its longest edge, in pixels; 0 for other primitives
  double affine_error = 0.0;           ///< see affine_error(); 0 in an orthographic view
  float cosine = 0.0f;                 ///< largest n·l of the lights that reach the surface, at most 1; 0 or less: faces away from all
  float shadow = 0.0f;                 ///< fraction of the first light with a shadow that reaches the visible fragment; 0 if it faces away
  bool has_different_samples = false;  ///< different primitives are visible at the samples of the pixel
};

/// The ideas that a frame can show at all. Facts about others do not count.
struct ExampleIdeas {
  bool perspective = false, light = false, shadow = false, samples = false;
};

/// Returns how well a pixel explains the pipeline; higher is better. example_pixel.cpp gives the reasons for each part.
int example_score(const ExampleFacts& facts, const ExampleIdeas& ideas);

/// Finds the facts about pixels. The results do not depend on the number of threads or lanes.
class ExampleSearch {
 public:
  explicit ExampleSearch(const ExampleSource& source);

  const ExampleIdeas& ideas() const { return ideas_; }
  ExampleFacts facts(glm::ivec2 pixel) const;
  /// Returns the pixel with the highest score; among equals, the one nearest to the center of the picture, and the first in reading order.
  glm::ivec2 best() const;

 private:
  struct Seen {
    uint32_t visible = 0, covered = 0;
    double height = 0.0, affine_error = 0.0;
    bool is_clipped = false;
  };

  void count_primitives();
  void measure_triangles();
  void render_shadow();
  void correct_shadow(int light);

  ExampleSource source_;
  ExampleIdeas ideas_;
  std::vector<uint32_t> primitive_of_;  // for each pixel, the index of its visible primitive in seen_, or kUnseen
  std::vector<Seen> seen_;
  std::vector<const TracedFragment*> visible_;  // for each pixel
  Image<float> shadow_;                         // empty if no light has a shadow
};

}  // namespace halfspace
