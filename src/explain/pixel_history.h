// SPDX-License-Identifier: Apache-2.0
//
// What the renderer did with every fragment of a frame, and all values of the fragments of chosen pixels.
//
//   FrameTrace trace = trace_frame(prepared, workers);
//   PixelHistory history = pixel_histories(description, prepared, trace, {{trace.busiest_pixel()}}, workers)[0];
//
// trace_frame() runs the pipeline of render() with a tracer in it. The picture is the same, bit for bit. A fragment is one sample of one
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
#include "halfspace/raster/trace/fragment_trace.h"
#include "halfspace/render/prepared_scene.h"
#include "halfspace/scene/description.h"

namespace halfspace {

struct PassContext;

/// Returns the name of an enumerator, for example "block_rejected".
const char* outcome_name(FragmentOutcome outcome);
/// Returns an outcome for readers, for example "rejected with its block".
const char* outcome_text(FragmentOutcome outcome);

/// The trace of a frame. Depths are window depths: 1 is near and 0 is far in all scenes. TracedFragment::draw is an index in
/// PreparedScene::draws.
struct FrameTrace {
  static constexpr uint32_t kMaxFragments = 64;  ///< per pixel

  int width = 0, height = 0, samples = 1;
  ColorFormat format = ColorFormat::none;  ///< in which tiles store colors
  std::vector<uint32_t> first;             ///< width · height + 1 offsets into `fragments`, by row from the upper left
  std::vector<TracedFragment> fragments;   ///< of each pixel in submission order, and for each primitive by sample
  /// Of each pixel: fragments that are left out because there are more than kMaxFragments. Those that were shaded are kept first.
  std::vector<uint32_t> others;
  Image<glm::u8vec4> picture;     ///< as rendered without tracing
  std::vector<glm::vec4> values;  ///< of each sample of each pixel: linear color at the end of the pass, before resolving
  Image<glm::vec4> light;         ///< linear color of each pixel after resolving, before exposure and tone curve
  double exposure = 1.0;          ///< of the whole frame
  PassStatistics statistics;

  /// x and y of a pixel from the upper left.
  std::span<const TracedFragment> at(glm::ivec2 pixel) const;
  /// Number of fragments of a pixel, including those that are left out.
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
  std::string object;    ///< as object_name() returns it
  bool is_front = true;  ///< the winding of the triangle as seen from the eye
  Topology topology = Topology::triangles;
  int copy = 0;            ///< copy of the object; for models with several parts, copy · parts + part
  std::string shader;      ///< for example "phong surface"
  glm::vec3 barycentrics;  ///< weights of the vertices of the submitted primitive, perspective-correct; (1, 0, 0) for points
  float inv_w = 0.0f;      ///< 1/w of clip space
  std::vector<NamedValue> varyings;
  std::vector<NamedValue> terms;    ///< linear colors whose sum is `color`, such as "ambient" or "diffuse, light sun"
  std::vector<NamedValue> factors;  ///< numbers that the terms contain, such as "shadow, light sun"
  /// Output of the fragment function, linear with straight alpha. If !fragment.is_shaded, the renderer did not compute it in this frame,
  /// and neither the varyings and terms; they were then computed by the same shader code.
  glm::vec4 color;
  std::string blend;  ///< formula that combines `color` with the color of the sample; empty if it replaces it
};

/// How the light of a pixel became the code in the picture.
struct DisplayDetail {
  glm::vec4 light{0.0f};  ///< linear: the mean of the samples
  float exposure = 1.0f;
  glm::vec3 tone_mapped{0.0f};  ///< linear display light, after the tone curve
  glm::u8vec4 code{0};          ///< in the picture
};

/// The history of a pixel.
struct PixelHistory {
  glm::ivec2 pixel;                       ///< from the upper left
  glm::vec2 window;                       ///< center in GL window coordinates, from the lower left
  glm::vec4 clear_color;                  ///< of all samples before the first fragment
  std::vector<FragmentDetail> fragments;  ///< in submission order
  uint32_t others = 0;                    ///< as in FrameTrace
  std::vector<glm::vec4> samples;         ///< color of each sample at the end of the pass
  DisplayDetail display;                  ///< the last value equals the picture
};

/// Returns the histories of pixels, in the same order. scene must be the description that `prepared` was made from.
std::vector<PixelHistory> pixel_histories(const SceneDescription& scene, const PreparedScene& prepared, const FrameTrace& trace,
                                          std::span<const glm::ivec2> pixels, const Workers& workers);

/// Runs the stages of the scene's pass that come before the tiles: vertices, clipping, setup and binning. Calls visit(context, round) with
/// the result. There is more than one round only if the triangles exceed PassOptions::bin_budget.
void visit_set_up_scene(const PreparedScene& scene, const Workers& workers,
                        const std::function<void(const PassContext& context, int round)>& visit);

}  // namespace halfspace
