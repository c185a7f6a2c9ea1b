// SPDX-License-Identifier: Apache-2.0
//
// The oracle is an independent implementation of the whole pipeline with the simplest possible loops. Tests compare it with the tile path
// byte for byte. It supports the full draw state. It shares only type definitions with src/raster (draw_state.h, pass.h, target.h), and
// the shader interface with src/shading. It processes one pixel, one triangle and one fragment at a time, in order, without lanes, tiles,
// bins, incremental evaluation, deferred shading or depth bounds.
//
// This header has the class that draws. Its stages are in the other files of this folder, in the order of the pipeline: shader_call,
// primitives (with transform, clip and triangle_setup), coverage (with smooth_area), interpolation, depth, depth_stencil, blend and
// framebuffer.
//
// If a result depends on the order of float operations, the oracle follows the specifications in shading/pixel.h (weights and components),
// raster/visibility/visibility.h and raster/pipeline/pipeline_data.h (depth), raster/primitives/clip.h (clipping) and
// raster/pipeline/smooth_area.h (smooth primitives).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <vector>

#include "halfspace/raster/draw_state.h"
#include "halfspace/raster/pass.h"
#include "halfspace/raster/target.h"
#include "halfspace/shading/shader_traits.h"
#include "oracle/framebuffer.h"
#include "oracle/interpolation.h"
#include "oracle/shader_call.h"
#include "oracle/shader_data.h"
#include "oracle/window.h"

namespace halfspace::oracle {

/// Statistics. Contains the fields of PassStatistics that do not depend on how a pass organizes its work.
struct Counts {
  uint64_t vertices_shaded = 0;
  uint64_t patches_in = 0;
  uint64_t vertices_evaluated = 0;
  uint64_t geometry_invocations = 0;
  uint64_t primitives_in = 0;
  uint64_t culled_non_finite = 0;
  uint64_t culled_outside = 0;
  uint64_t culled_face = 0;
  uint64_t culled_degenerate = 0;
  uint64_t culled_no_sample = 0;
  uint64_t clipped = 0;
  uint64_t triangles = 0;  ///< triangles that may cover a sample
  uint64_t samples_passed = 0;
  bool has_lines = false;  ///< if set, the oracle counts primitives without samples differently from a pass
  std::map<uint32_t, uint64_t> queries;
};

/// The index that ends a primitive in most tests.
inline constexpr uint32_t kRestart = 0xffffffffu;

/// Input of a draw. Attributes come from the row of the vertex, except for the last instance_components, which come from the row of the
/// instance.
template <class S>
struct Input {
  using Row = typename S::template Attributes<float>;
  std::vector<Row> vertices{};
  std::vector<uint32_t> indices{};
  bool restart = false;  ///< restart_index ends a primitive
  std::size_t instance_components = 0;
  std::vector<Row> instances{};
  uint32_t divisor = 1;
  uint32_t restart_index = kRestart;

  std::optional<uint32_t> restart_at() const { return restart ? std::optional(restart_index) : std::nullopt; }
};

/// Returns the indices that the state selects (DrawState::first and count).
std::vector<uint32_t> selected(const std::vector<uint32_t>& indices, const DrawState& state);

/// Returns the triangles that the indices form. The provoking vertex is first or last, as the state requires. restart: the index that ends
/// a primitive.
std::vector<std::array<uint32_t, 3>> assemble(const std::vector<uint32_t>& indices, std::optional<uint32_t> restart,
                                              const DrawState& state);

/// The same with all vertices of a primitive: those of its neighbors, if the topology has them, are between its own.
std::vector<std::vector<uint32_t>> assemble_with_neighbors(const std::vector<uint32_t>& indices, std::optional<uint32_t> restart,
                                                           const DrawState& state);

/// Returns the patches that the indices form.
std::vector<std::vector<uint32_t>> patches_of(const std::vector<uint32_t>& indices, std::optional<uint32_t> restart, std::size_t size);

class Renderer {
 public:
  /// Draws into the layers of a target, which have the same size and formats, and must outlive the renderer.
  explicit Renderer(std::span<Framebuffer> layers, bool supersample = false)
      : layers_(layers), target_(layers.data()), supersample_(supersample) {}

  template <class S>
  void draw(const S& shader, const Input<S>& input, const DrawState& state);

  /// Sets a part of all layers, as Pass::clear(). The samples count as passed.
  void clear(const ClearValues& values);

  const Counts& counts() const { return counts_; }

 private:
  template <class S>
  void draw_instance(const S& shader, const Input<S>& input, const DrawState& state, uint32_t instance);
  template <class S>
  void emit(const S& shader, const DrawState& state, const std::vector<const ShadedVertex*>& vertices, int32_t primitive, int32_t instance);
  template <class S>
  void draw_primitive(const S& shader, DrawState state, const std::array<const ShadedVertex*, 3>& v);

  void clear_sample(const ClearValues& values, Framebuffer& target, const Sample& s);

  // Returns whether the condition of a draw is true, which depends only on the draws before.
  bool condition_holds(const DrawState& state) const;
  // Selects the layer and the viewport that a primitive is drawn into. Returns false if they do not exist.
  bool select_layer(const ShadedVertex& provoking, DrawState& state);

  using FragmentFunction = std::function<FragmentResult(const WindowTriangle&, const Surface&, const Place&)>;

  // Primitives (primitives.cpp).

  // Returns a submitted point in the window; empty if it is culled.
  std::vector<WindowTriangle> window_points(const DrawState& state, const ShadedVertex& v);
  // Returns the pieces of a submitted triangle in the window: none if it is culled, several if it is clipped. For a line, the third vertex
  // equals the second.
  std::vector<WindowTriangle> window_triangles(const DrawState& state, const ShaderFacts& facts,
                                               const std::array<const ShadedVertex*, 3>& v);
  std::vector<WindowTriangle> window_line(const DrawState& state, const Corner& a, const Corner& b, const std::vector<float>& flat,
                                          bool front);
  std::vector<WindowTriangle> window_outline(const DrawState& state, std::vector<Corner> corners, const std::vector<int>& vertex,
                                             const std::array<const ShadedVertex*, 3>& v, const std::vector<float>& flat);

  // Pixels and samples (oracle.cpp).

  void rasterize(const DrawState& state, const ShaderFacts& facts, const WindowTriangle& t, const FragmentFunction& shade);
  void draw_pixel(const DrawState& state, const ShaderFacts& facts, const WindowTriangle& t, const Surface& surface, int x, int y,
                  const FragmentFunction& shade);
  void draw_sample(const DrawState& state, const ShaderFacts& facts, const WindowTriangle& t, const Sample& s,
                   const FragmentResult& result);
  bool shades_samples(const DrawState& state, const ShaderFacts& facts) const;
  bool allows_sample(const DrawState& state, int number) const;
  bool depth_passes(const DrawState& state, const Sample& s, double z) const;
  bool tests_pass(const DrawState& state, bool front, const Sample& s, double z);
  void write_colors(const DrawState& state, const Sample& s, const std::vector<glm::vec4>& colors);

  std::span<Framebuffer> layers_;
  Framebuffer* target_;  // the layer of the current primitive
  bool supersample_;
  Counts counts_;
};

/// Applies the function to every pixel of `from`, like Pass::post, and writes the results to a new framebuffer without depth.
template <class F>
Framebuffer post(const Framebuffer& from, const F& function, ColorFormat format) {
  Framebuffer to(from.width(), from.height(), {format}, DepthFormat::none);
  for (int y = 0; y < from.height(); ++y) {
    for (int x = 0; x < from.width(); ++x) to.set_color(0, {x, y, 0}, glm::vec4(function(vec4<float>(from.color(0, {x, y, 0})))));
  }
  return to;
}

// ---- code that depends on the shader type ----------------------------------------------------------------------

template <class S>
void Renderer::draw(const S& shader, const Input<S>& input, const DrawState& state) {
  // Stages that emit primitives run in any case. The vertices of a conditional draw without primitives are not shaded.
  constexpr bool kEmits = HasTessellationLayout<S> || HasGeometryLayout<S> || kGivesLayer<S>;
  const auto has_primitives = [&] { return !assemble(selected(input.indices, state), input.restart_at(), state).empty(); };
  if (!kEmits && state.condition && !(condition_holds(state) && has_primitives())) return;
  for (uint32_t instance = 0; instance < state.instances; ++instance) draw_instance(shader, input, state, instance);
}

template <class S>
void Renderer::draw_instance(const S& shader, const Input<S>& input, const DrawState& state, uint32_t instance) {
  using V = VertexVaryingsOf<S, float>;
  std::map<uint32_t, ShadedVertex> shaded;
  const std::vector<uint32_t> indices = selected(input.indices, state);
  for (const uint32_t i : indices) {
    if (input.restart_at() == i || shaded.contains(i)) continue;
    ++counts_.vertices_shaded;
    const auto row = static_cast<uint32_t>(static_cast<int64_t>(i) + state.base_vertex);
    auto attributes = detail::components_of(input.vertices[row]);
    for (std::size_t k = attributes.size() - input.instance_components; k < attributes.size(); ++k) {
      attributes[k] = detail::components_of(input.instances[instance / input.divisor + state.base_instance])[k];
    }
    V out{};
    const VertexId<float> id{static_cast<int32_t>(row), static_cast<int32_t>(instance)};
    const auto vertex = call_vertex<S, float>(shader, detail::struct_of<typename Input<S>::Row>(attributes), id, out);
    shaded[i].point_size = state.point_size;
    detail::take_vertex(vertex, shaded[i]);
    shaded[i].varyings = detail::components_of(out);
  }
  const auto number = [](std::size_t i) { return static_cast<int32_t>(i); };
  if constexpr (HasTessellationLayout<S>) {
    constexpr auto size = static_cast<std::size_t>(S::tessellation_layout.patch_vertices);
    std::size_t patch = 0;
    for (const std::vector<uint32_t>& p : patches_of(indices, input.restart_at(), size)) {
      std::vector<const ShadedVertex*> corners;
      for (const uint32_t i : p) corners.push_back(&shaded[i]);
      const detail::DividedPatch divided = detail::divide_patch(shader, corners, number(patch), number(instance), state.point_size);
      ++counts_.patches_in;
      counts_.vertices_evaluated += divided.vertices.size();
      for (const std::vector<uint32_t>& primitive : divided.primitives) {
        std::vector<const ShadedVertex*> v;
        for (const uint32_t i : primitive) v.push_back(&divided.vertices[i]);
        emit(shader, state, v, number(patch), number(instance));
      }
      ++patch;
    }
  } else {
    const auto primitives = assemble_with_neighbors(indices, input.restart_at(), state);
    for (std::size_t p = 0; p < primitives.size(); ++p) {
      std::vector<const ShadedVertex*> v;
      for (const uint32_t i : primitives[p]) v.push_back(&shaded[i]);
      emit(shader, state, v, number(p), number(instance));
    }
  }
}

// Draws a primitive, or what the geometry function emits for it. vertices: without a geometry function, only those of the primitive count.
template <class S>
void Renderer::emit(const S& shader, const DrawState& state, const std::vector<const ShadedVertex*>& v, int32_t primitive,
                    int32_t instance) {
  if constexpr (HasGeometryLayout<S>) {
    DrawState emitted_state = state;
    emitted_state.topology = detail::topology_of(S::geometry_layout.output);
    for (int32_t invocation = 0; invocation < S::geometry_layout.invocations; ++invocation) {
      ++counts_.geometry_invocations;
      for (const std::vector<ShadedVertex>& strip : detail::call_geometry(shader, v, primitive, instance, invocation, state.point_size)) {
        std::vector<uint32_t> places;
        for (uint32_t i = 0; i < strip.size(); ++i) places.push_back(i);
        for (const auto& [a, b, c] : assemble(places, std::nullopt, emitted_state))
          draw_primitive(shader, emitted_state, {&strip[a], &strip[b], &strip[c]});
      }
    }
  } else {
    DrawState list = state;
    if (state.topology == Topology::patches)
      list.topology = v.size() == 1 ? Topology::points : v.size() == 2 ? Topology::lines : Topology::triangles;
    std::array<std::size_t, 3> corner{0, std::min<std::size_t>(1, v.size() - 1), v.size() - 1};
    if (has_adjacency(state.topology))
      corner = is_lines(state.topology) ? std::array<std::size_t, 3>{1, 2, 2} : std::array<std::size_t, 3>{0, 2, 4};
    draw_primitive(shader, list, {v[corner[0]], v[corner[1]], v[corner[2]]});
  }
}

template <class S>
void Renderer::draw_primitive(const S& shader, DrawState state, const std::array<const ShadedVertex*, 3>& v) {
  using V = typename S::template Varyings<float>;
  using P = PrimitiveOf<S, float>;
  const ShaderFacts facts = detail::facts_of<S>();
  if (!condition_holds(state)) return;
  target_ = layers_.data();
  if (kGivesLayer<S> && !select_layer(*v[state.provoking == ProvokingVertex::first ? 0 : 2], state)) return;
  P face{};
  if constexpr (HasPrimitive<S>) {
    face =
        shader.primitive(detail::struct_of<V>(v[0]->varyings), detail::struct_of<V>(v[1]->varyings), detail::struct_of<V>(v[2]->varyings));
  }
  const bool points = state.topology == Topology::points;
  for (const WindowTriangle& t : points ? window_points(state, *v[0]) : window_triangles(state, facts, v)) {
    rasterize(state, facts, t, [&](const WindowTriangle& triangle, const Surface& surface, const Place& place) {
      return detail::call_shader(shader, face, triangle, surface, state.depth, place);
    });
  }
}

}  // namespace halfspace::oracle
