// SPDX-License-Identifier: Apache-2.0
//
// The vertices and indices of a draw: which of them its state selects, and checks of both. Private, but installed because pass.h includes
// it.
#pragma once

#include <concepts>
#include <memory>
#include <memory_resource>
#include <span>
#include <type_traits>

#include "halfspace/raster/draw_state.h"
#include "halfspace/raster/vertex_input.h"
#include "halfspace/shading/varyings.h"

namespace halfspace::HS_LANES::detail {

/// Index list that can be drawn: Indices, or a contiguous range of uint32_t, uint16_t or uint8_t.
template <class T>
concept IndexList = std::same_as<std::remove_cvref_t<T>, Indices> || std::convertible_to<T, std::span<const uint32_t>> ||
    std::convertible_to<T, std::span<const uint16_t>> || std::convertible_to<T, std::span<const uint8_t>>;

/// Returns the number of indices that a draw uses of a list of `size`, or of the vertices of a draw without indices.
std::size_t count_of(const DrawState& state, std::size_t size);

template <class T>
std::shared_ptr<const Indices> scan_indices(std::span<const T> list, std::size_t vertex_count, const DrawState& state) {
  const std::size_t count = count_of(state, list.size());
  return std::make_shared<const Indices>(list.subspan(state.first, count), vertex_count);
}

/// Returns a non-owning pointer to an Indices object, or creates one from a raw list or for the part of a list that the state selects.
template <IndexList I>
std::shared_ptr<const Indices> view_indices(I& indices, std::size_t vertex_count, const DrawState& state) {
  if constexpr (std::same_as<std::remove_const_t<I>, Indices>) {
    if (state.first != 0 || state.count)
      return std::make_shared<const Indices>(indices.range(state.first, count_of(state, indices.size())));
    return {std::shared_ptr<void>(), &indices};
  } else if constexpr (std::convertible_to<I&, std::span<const uint32_t>>) {
    return scan_indices(std::span<const uint32_t>(indices), vertex_count, state);
  } else if constexpr (std::convertible_to<I&, std::span<const uint16_t>>) {
    return scan_indices(std::span<const uint16_t>(indices), vertex_count, state);
  } else {
    return scan_indices(std::span<const uint8_t>(indices), vertex_count, state);
  }
}

/// Returns the vertices of a draw without indices.
inline std::shared_ptr<const Indices> sequential_indices(std::size_t vertex_count, const DrawState& state) {
  return std::make_shared<const Indices>(Indices::sequential(vertex_count).range(state.first, count_of(state, vertex_count)));
}

/// Copies the streams of a view. Row 0 of the per-instance streams becomes the row of the first instance.
VertexStreams keep_streams(const VertexView& view, uint32_t base_instance, std::pmr::memory_resource& memory);

/// Checks that the vertices of all indices exist.
void check_vertices(const VertexView& view, const Indices& indices, const DrawState& state);
/// Checks that per-instance streams have rows for all instances (OpenGL 4.6, section 10.3.4).
void check_instances(const VertexView& view, const DrawState& state);

}  // namespace halfspace::HS_LANES::detail
