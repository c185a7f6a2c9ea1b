// SPDX-License-Identifier: Apache-2.0
//
// Records what the renderer did with every fragment of a frame, and computes all values of the fragments of selected pixels.
//
//   FrameTrace trace = trace_frame(prepared, workers);
//   PixelHistory history = pixel_histories(description, prepared, trace, {{trace.busiest_pixel()}}, workers)[0];
//
// trace_frame() runs the pipeline of render() with a tracer. The picture is bit-identical. A fragment is one sample of one
// triangle, point or line; with one sample per pixel, a pixel has one fragment for each primitive that covers its center. Pixels are
// counted from 0 at the upper left, as in image files.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "halfspace/core/image.h"
#include "halfspace/core/parallel.h"
#include "halfspace/raster/pipeline/pass_context.h"
#include "halfspace/raster/trace/fragment_trace.h"
#include "halfspace/render/prepared_scene.h"
#include "halfspace/scene/description.h"

namespace halfspace {

/// Returns the name of an enumerator, for example "block_rejected".
const char* outcome_name(FragmentOutcome outcome);
/// Returns a description of an outcome, for example "rejected with its block".
const char* outcome_text(FragmentOutcome outcome);

/// The trace of a frame. Depths are window depths; in all scenes, 1 is near and 0 is far. TracedFragment::draw is an index into
/// PreparedScene::draws.
struct FrameTrace {
  static constexpr uint32_t kMaxFragments = 64;  ///< per pixel

  int width = 0, height = 0, samples = 1;
  ColorFormat format = ColorFormat::none;  ///< color format of the tiles
  std::vector<uint32_t> first;             ///< width · height + 1 offsets into `fragments`, by row from the upper left
  std::vector<TracedFragment> fragments;   ///< of each pixel in submission order, and for each primitive by sample
  /// For each pixel, the number of fragments that are not in `fragments` because the pixel has more than kMaxFragments. Fragments that
  /// were not shaded are dropped first.
  std::vector<uint32_t> others;
  Image<glm::u8vec4> picture;     ///< the picture of render()
  std::vector<glm::vec4> values;  ///< linear color of each sample of each pixel at the end of the pass, before resolving
  Image<glm::vec4> light;         ///< linear color of each pixel after resolving, before exposure and tone curve
  double exposure = 1.0;          ///< exposure of the frame
  PassStatistics statistics;

  /// Returns the fragments of a pixel. x and y are counted from the upper left.
  std::span<const TracedFragment> at(glm::ivec2 pixel) const;
  /// Returns the number of fragments of a pixel, including those that are not in `fragments`.
  uint32_t count(glm::ivec2 pixel) const;
  /// Returns the pixel with the most fragments, the first in reading order.
  glm::ivec2 busiest_pixel() const;
};

/// Renders the scene and traces it. The result does not depend on the number of workers.
FrameTrace trace_frame(const PreparedScene& scene, const Workers& workers);

/// A value with one to four components.
struct NamedValue {
  std::string name;
  std::vector<float> values;
};

/// All values of a fragment.
struct FragmentDetail {
  TracedFragment fragment;
  std::string object;    ///< see object_name()
  bool is_front = true;  ///< the triangle is front-facing
  Topology topology = Topology::triangles;
  int copy = 0;            ///< copy of the object; for models with several parts, copy · parts + part
  std::string shader;      ///< for example "surface lit per pixel (phong)"
  glm::vec3 barycentrics;  ///< weights of the vertices of the submitted primitive, perspective-correct; (1, 0, 0) for points
  float inv_w = 0.0f;      ///< 1/w of clip space
  std::vector<NamedValue> varyings;
  std::vector<NamedValue> terms;    ///< linear colors whose sum is `color`, such as "ambient" or "diffuse, light sun"
  std::vector<NamedValue> factors;  ///< factors of the terms, such as "shadow, light sun"
  /// Output of the fragment function, linear with straight alpha. If fragment.is_shaded is false, the renderer did not shade the fragment
  /// in this frame, and color, varyings and terms were computed afterwards by the same shader code.
  glm::vec4 color;
  std::string blend;  ///< blend equation; empty if `color` replaces the color of the sample
};

/// How the linear light of a pixel was converted to its value in the picture.
struct DisplayDetail {
  glm::vec4 light{0.0f};  ///< linear light: the mean of the samples
  float exposure = 1.0f;
  glm::vec3 tone_mapped{0.0f};  ///< linear display light, after the tone curve
  glm::u8vec4 code{0};          ///< 8-bit value in the picture
};

/// The history of a pixel.
struct PixelHistory {
  glm::ivec2 pixel;                       ///< counted from the upper left
  glm::vec2 window;                       ///< pixel center in OpenGL window coordinates, from the lower left
  glm::vec4 clear_color;                  ///< color of all samples before the first fragment
  std::vector<FragmentDetail> fragments;  ///< in submission order
  uint32_t others = 0;                    ///< see FrameTrace::others
  std::vector<glm::vec4> samples;         ///< color of each sample at the end of the pass
  DisplayDetail display;                  ///< display.code equals the pixel of FrameTrace::picture
};

/// Returns the histories of `pixels`, in the same order. `prepared` must have been created from `scene`.
std::vector<PixelHistory> pixel_histories(const SceneDescription& scene, const PreparedScene& prepared, const FrameTrace& trace,
                                          std::span<const glm::ivec2> pixels, const Workers& workers);

/// Runs the stages of the scene's pass before the tiles (vertices, clipping, setup and binning) and calls visit(context, round) with the
/// result. There is more than one round only if the triangles or vertices exceed PassTuning::bin_budget.
void visit_set_up_scene(const PreparedScene& scene, const Workers& workers,
                        const std::function<void(const PassContext& context, int round)>& visit);

}  // namespace halfspace
