// SPDX-License-Identifier: Apache-2.0
//
// A scene of the property tests: a target, its initial contents, and draws. It can be drawn by the tile path with any options and by the
// oracle.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "halfspace/raster/pass.h"
#include "oracle/oracle.h"
#include "property/test_shaders.h"
#include "property/vertex_formats.h"

namespace halfspace {

/// A type-erased draw with any shader.
struct SceneDraw {
  std::function<void(Pass&)> submit;
  std::function<void(oracle::Renderer&)> reference;
  DrawState state;
  std::shared_ptr<const ViewportArray> viewports;  ///< those of the state
  std::string shader;
  std::size_t triangles = 0;
};

struct Scene {
  int width = 1, height = 1;
  int samples = 1;
  bool supersample = false;
  int layers = 1;     ///< of the pass and its images; if there are several, images do not store samples, and there is no post step
  ColorTarget color;  ///< run_pass sets the data pointers and the sizes; `samples` may be those of the scene
  DepthTarget depth;
  std::vector<ColorTarget> more_colors;               ///< attachments 1, 2 and 3, which have images
  std::vector<std::byte> color_before, depth_before;  ///< contents of the images before the pass, of all samples or layers that they store
  std::vector<std::vector<std::byte>> more_before;
  bool in_views = false;  ///< the pass draws into rectangles of larger images, which store the bottom row first
  std::vector<SceneDraw> draws;
  bool has_color_image = true;  ///< if false, the color is only visible through the post step
  bool has_depth_image = true;
  ColorFormat post_format = ColorFormat::none;  ///< if not none, a post step applies Curve and writes an image of this format
};

/// The visible results of a scene. If a pass writes next to its views, they are empty.
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

/// Returns the viewport of the state; defaults to the whole target.
Rect viewport_of(const Scene& scene, const DrawState& state);

PassResult run_pass(const Scene& scene, const PassOptions& options, int threads);
OracleResult run_oracle(const Scene& scene);

/// Returns an empty string if the pictures are equal. Otherwise, describes the largest difference: "color: 12 of 7000 pixels differ; worst,
/// window (x, y): … expected, got …".
std::string difference(const Scene& scene, const Pictures& expected, const Pictures& actual);

/// Converts the color, the post step's output or the depth (as gray) to 8 bits, for visual inspection.
Image<glm::u8vec4> codes_of(const Scene& scene, const Pictures& pictures);

std::string describe(const PassOptions& options, int threads);
std::string describe(const Scene& scene);

/// How the vertices of a draw are stored in memory.
enum class VertexLayout { tight, padded, separate };
enum class IndexLayout { none, narrow, wide, bytes };

/// Creates a draw of a shader. With IndexLayout::none, the indices must be 0, 1, 2, …. With a format other than StreamFormat::in_place, the
/// rows of the input must be representable in it (vertex_formats.h), and the layout does not matter.
template <class S>
SceneDraw make_draw(const S& shader, const std::string& name, const oracle::Input<S>& input, const DrawState& state,
                    VertexLayout vertex_layout, IndexLayout index_layout, StreamFormat format = StreamFormat::in_place);
template <class S>
SceneDraw make_draw(const S& shader, const std::string& name, std::vector<typename S::template Attributes<float>> vertex_rows,
                    std::vector<uint32_t> index_list, const DrawState& state, VertexLayout vertex_layout, IndexLayout index_layout) {
  return make_draw(shader, name, oracle::Input<S>{.vertices = std::move(vertex_rows), .indices = std::move(index_list)}, state,
                   vertex_layout, index_layout);
}

// ---- code that depends on the shader type ------------------------------------------------------------------------

namespace draw_memory {

/// Owns the memory of a draw.
struct DrawMemory {
  std::vector<std::vector<float>> buffers;
  std::vector<std::vector<std::byte>> formatted;
  std::vector<VertexStream> streams;
  VertexView view;
  std::vector<uint8_t> bytes;
  std::vector<uint16_t> narrow;
  std::vector<uint32_t> wide;
  std::optional<Indices> indices;  ///< none: sequential
};

/// Stores rows of `components` floats as streams.
void lay_out_vertices(const float* rows, std::size_t count, int components, VertexLayout layout, DrawMemory& memory);
/// restart: the index that ends a primitive. The largest 32-bit value becomes the largest value of the index type.
void lay_out_indices(const std::vector<uint32_t>& list, std::size_t vertex_count, std::optional<uint32_t> restart, IndexLayout layout,
                     DrawMemory& memory);
/// Replaces the last `instance_components` components of each vertex with per-instance values. Each row of `components` floats applies to
/// `divisor` consecutive instances.
void lay_out_instances(const float* rows, std::size_t count, int components, std::size_t instance_components, uint32_t divisor,
                       DrawMemory& memory);

}  // namespace draw_memory

/// Creates a draw of memory with the same vertices and indices as the input.
template <class S>
SceneDraw make_draw(const S& shader, const std::string& name, const oracle::Input<S>& input, const DrawState& state,
                    const std::shared_ptr<const draw_memory::DrawMemory>& memory) {
  SceneDraw d;
  d.state = state;
  d.shader = name;
  d.triangles = oracle::assemble(oracle::selected(input.indices, state), input.restart_at(), state).size() * state.instances;
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

template <class S>
SceneDraw make_draw(const S& shader, const std::string& name, const oracle::Input<S>& input, const DrawState& state,
                    VertexLayout vertex_layout, IndexLayout index_layout, StreamFormat format) {
  using A = typename S::template Attributes<float>;
  constexpr auto components = static_cast<int>(kComponents<A>);
  const auto memory = std::make_shared<draw_memory::DrawMemory>();
  const auto* vertices = reinterpret_cast<const float*>(input.vertices.data());
  const auto* instances = reinterpret_cast<const float*>(input.instances.data());
  if (format == StreamFormat::in_place) {
    draw_memory::lay_out_vertices(vertices, input.vertices.size(), components, vertex_layout, *memory);
    draw_memory::lay_out_instances(instances, input.instances.size(), components, input.instance_components, input.divisor, *memory);
  } else {
    const FormattedRows per_vertex{vertices, input.vertices.size(), components, kIntegerComponents<A>};
    const FormattedRows per_instance_rows{instances, input.instances.size(), components, kIntegerComponents<A>};
    const int end = components - static_cast<int>(input.instance_components);
    add_formatted(per_vertex, 0, end, format, 0, memory->formatted, memory->streams);
    add_formatted(per_instance_rows, end, components, format, input.divisor, memory->formatted, memory->streams);
  }
  memory->view = detail::bind_streams(memory->streams, input.vertices.size());
  const std::size_t indexable = input.vertices.size() + static_cast<std::size_t>(-std::min(state.base_vertex, 0));
  draw_memory::lay_out_indices(input.indices, indexable, input.restart_at(), index_layout, *memory);
  return make_draw(shader, name, input, state, std::shared_ptr<const draw_memory::DrawMemory>(memory));
}

}  // namespace halfspace
