// SPDX-License-Identifier: Apache-2.0
//
// A scene of the property tests: a target, its images before the pass, and draws, that can be sent through the tile path
// with any options, and through the oracle.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "halfspace/raster/pass.h"
#include "oracle/oracle.h"
#include "property/test_shaders.h"

namespace halfspace {

/// A draw of some shader, its type forgotten.
struct SceneDraw {
  std::function<void(Pass&)> submit;
  std::function<void(oracle::Renderer&)> reference;
  DrawState state;
  std::string shader;
  std::size_t triangles = 0;
};

struct Scene {
  int width = 1, height = 1;
  int samples = 1;
  bool supersample = false;
  ColorTarget color;  ///< data is filled in by run_pass
  DepthTarget depth;
  std::vector<ColorTarget> more_colors;               ///< attachments 1, 2 and 3; they have images
  std::vector<std::byte> color_before, depth_before;  ///< what the images hold before the pass
  std::vector<std::vector<std::byte>> more_before;
  std::vector<SceneDraw> draws;
  bool has_color_image = true;  ///< else the colour is seen through the post step alone
  bool has_depth_image = true;
  ColorFormat post_format = ColorFormat::none;  ///< none: no post step; else Curve into an image of this format
};

/// What is seen of a scene afterwards.
struct Pictures {
  std::vector<std::byte> color, depth, post;
  std::vector<std::vector<std::byte>> more;
  friend bool operator==(const Pictures&, const Pictures&) = default;
};

struct PassResult {
  Pictures pictures;
  PassStatistics statistics;
};
struct OracleResult {
  Pictures pictures;
  oracle::Counts counts;
};

/// The state's viewport, or the whole target.
Rect viewport_of(const Scene& scene, const DrawState& state);

PassResult run_pass(const Scene& scene, const PassOptions& options, int threads);
OracleResult run_oracle(const Scene& scene);

/// Empty if a and b are the same, else where they differ most: "colour: 12 of 7000 pixels differ; worst (x, y): … against …".
std::string difference(const Scene& scene, const Pictures& expected, const Pictures& actual);

/// The colours as codes, or the post step's, or depth as greys: for a look at what is wrong.
Image<glm::u8vec4> codes_of(const Scene& scene, const Pictures& pictures);

std::string describe(const PassOptions& options, int threads);
std::string describe(const Scene& scene);

/// How a draw's vertices lie in memory.
enum class VertexLayout { tight, padded, separate };
enum class IndexLayout { none, narrow, wide };

/// The draw of a shader; `none` needs indices 0, 1, 2, ….
template <class S>
SceneDraw make_draw(const S& shader, const std::string& name, const oracle::Input<S>& input, const DrawState& state,
                    VertexLayout vertex_layout, IndexLayout index_layout);
template <class S>
SceneDraw make_draw(const S& shader, const std::string& name, std::vector<typename S::template Attributes<float>> vertex_rows,
                    std::vector<uint32_t> index_list, const DrawState& state, VertexLayout vertex_layout, IndexLayout index_layout) {
  return make_draw(shader, name, oracle::Input<S>{std::move(vertex_rows), std::move(index_list), false, 0, {}, 1}, state, vertex_layout,
                   index_layout);
}

// ---- the part that knows the shader ------------------------------------------------------------------------------

namespace detail {

/// Keeps a draw's memory.
struct DrawMemory {
  std::vector<std::vector<float>> buffers;
  VertexView view;
  std::vector<uint16_t> narrow;
  std::vector<uint32_t> wide;
  std::optional<Indices> indices;  ///< none: sequential
};

/// Lays rows of `components` floats out as streams.
void lay_out_vertices(const float* rows, std::size_t count, int components, VertexLayout layout, DrawMemory& memory);
void lay_out_indices(const std::vector<uint32_t>& list, std::size_t vertex_count, bool restart, IndexLayout layout, DrawMemory& memory);
/// The last `instance_components` of each vertex come from rows of `components` floats instead, one for `divisor` instances.
void lay_out_instances(const float* rows, std::size_t count, int components, std::size_t instance_components, uint32_t divisor,
                       DrawMemory& memory);

}  // namespace detail

template <class S>
SceneDraw make_draw(const S& shader, const std::string& name, const oracle::Input<S>& input, const DrawState& state,
                    VertexLayout vertex_layout, IndexLayout index_layout) {
  constexpr auto components = static_cast<int>(kComponents<typename S::template Attributes<float>>);
  const auto memory = std::make_shared<detail::DrawMemory>();
  detail::lay_out_vertices(reinterpret_cast<const float*>(input.vertices.data()), input.vertices.size(), components, vertex_layout,
                           *memory);
  detail::lay_out_instances(reinterpret_cast<const float*>(input.instances.data()), input.instances.size(), components,
                            input.instance_components, input.divisor, *memory);
  const std::size_t indexable = input.vertices.size() + static_cast<std::size_t>(-std::min(state.base_vertex, 0));
  detail::lay_out_indices(input.indices, indexable, input.restart, index_layout, *memory);
  SceneDraw d;
  d.state = state;
  d.shader = name;
  d.triangles = oracle::assemble(input.indices, input.restart, state).size() * state.instances;
  d.submit = [memory, shader, state](Pass& pass) {
    if constexpr (HasFragmentFunction<S>) {
      if (memory->indices) {
        pass.draw(shader, memory->view, *memory->indices, state);
      } else {
        pass.draw(shader, memory->view, state);
      }
    } else {
      pass.draw_depth(shader, memory->view, *memory->indices, state);
    }
  };
  d.reference = [input, shader, state](oracle::Renderer& r) { r.draw(shader, input, state); };
  return d;
}

}  // namespace halfspace
