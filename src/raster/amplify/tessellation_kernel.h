// SPDX-License-Identifier: Apache-2.0
//
// Runs the control function of a shader for W patches at a time, and its evaluation function for W vertices at a time.
#pragma once

#include <memory>

#include "halfspace/raster/amplify/load_primitives.h"
#include "halfspace/shading/vertex_traits.h"

namespace halfspace::HS_LANES::detail {

template <class S>
HS_FLATTEN void control_kernel(const void* shader, const PrimitiveRows& patches, PatchRows& out) {
  constexpr auto n = static_cast<std::size_t>(S::tessellation_layout.patch_vertices);
  constexpr std::size_t values = kComponents<PatchOf<S, float>>;
  const S& s = *static_cast<const S*>(shader);
  const auto input = std::make_unique<PatchInputOf<S, Real>>();  // it can be too large for the stack of a thread
  PatchInputOf<S, Real>& in = *input;
  for (int begin = 0; begin < patches.count; begin += kLanes) {
    const auto number = [&](int i) { return std::min(begin + i, patches.count - 1); };  // the last lanes repeat a patch
    load_vertices<n>(patches, number, in);
    in.patch = load_numbers(patches.primitives, number);
    in.instance = load_numbers(patches.instances, number);
    PatchOf<S, Real> patch{};
    const TessellationLevels<Real> levels = call_control<S, Real>(s, in, patch);
    const std::array<Real, values> components = to_components<Real>(patch);
    for (int i = 0; i < std::min(kLanes, patches.count - begin); ++i) {
      TessellationLevels<float>& of = out.levels.emplace_back();
      for (std::size_t k = 0; k < of.outer.size(); ++k) of.outer[k] = lane(levels.outer[k], i);
      for (std::size_t k = 0; k < of.inner.size(); ++k) of.inner[k] = lane(levels.inner[k], i);
      for (const Real& c : components) out.values.push_back(lane(c, i));
    }
  }
}

template <class S>
inline constexpr std::size_t kEvaluatedRow = 4 + kExtraValues<EvaluateResultOf<S>> + kComponents<EvaluatedVaryingsOf<S, float>>;

template <class S>
HS_FLATTEN void evaluation_kernel(const void* shader, const PrimitiveRows& patches, const EvaluatedVertices& vertices) {
  constexpr auto n = static_cast<std::size_t>(S::tessellation_layout.patch_vertices);
  constexpr std::size_t values = kComponents<PatchOf<S, float>>, row_size = kEvaluatedRow<S>;
  using V = EvaluatedVaryingsOf<S, Real>;
  const S& s = *static_cast<const S*>(shader);
  const auto input = std::make_unique<PatchInputOf<S, Real>>();
  PatchInputOf<S, Real>& in = *input;
  for (int begin = 0; begin < vertices.count; begin += kLanes) {
    const auto vertex = [&](int i) { return std::min(begin + i, vertices.count - 1); };  // the last lanes repeat a vertex
    const auto patch_number = [&](int i) { return static_cast<int>(vertices.patches[vertex(i)]); };
    load_vertices<n>(patches, patch_number, in);
    in.patch = load_numbers(patches.primitives, patch_number);
    in.instance = load_numbers(patches.instances, patch_number);
    const auto patch = from_components<PatchOf<S, Real>, Real>(
        load_lanes<values>([&](int i) { return vertices.values + static_cast<std::size_t>(patch_number(i)) * values; }));
    const std::array<Real, 3> at = load_lanes<3>([&](int i) { return &vertices.coordinates[vertex(i)].x; });
    V varyings{};
    std::array<Real, row_size> row;
    put_vertex(call_evaluate<S, Real>(s, in, patch, {at[0], at[1], at[2]}, varyings), row);
    const std::array<Real, kComponents<V>> components = to_components<Real>(varyings);
    std::copy(components.begin(), components.end(), row.end() - static_cast<std::ptrdiff_t>(components.size()));
    for (int i = 0; i < std::min(kLanes, vertices.count - begin); ++i) {
      float* const to = vertices.rows + static_cast<std::size_t>(begin + i) * row_size;
      for (std::size_t c = 0; c < row_size; ++c) to[c] = lane(row[c], i);
    }
  }
}

template <class S>
inline constexpr TessellationStage kTessellationStage{.control = control_kernel<S>,
                                                      .evaluate = evaluation_kernel<S>,
                                                      .options = {S::tessellation_layout.domain, S::tessellation_layout.spacing,
                                                                  S::tessellation_layout.clockwise, S::tessellation_layout.point_mode},
                                                      .patch_vertices = S::tessellation_layout.patch_vertices,
                                                      .row = static_cast<int>(kEvaluatedRow<S>),
                                                      .varying_count = static_cast<int>(kComponents<EvaluatedVaryingsOf<S, float>>)};

}  // namespace halfspace::HS_LANES::detail
