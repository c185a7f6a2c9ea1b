// SPDX-License-Identifier: Apache-2.0
//
// The lights of a surface. If many lights have a limited reach, the window is divided into square cells, each with a list of the lights
// that can reach a surface seen in it (tiled shading: Olsson and Assarsson, "Tiled Shading", JGT 15(4), 2011). A fragment then computes
// only the lights of its cell. All other lights have a strength of zero there, so the lists do not change the result.
#pragma once

#include <algorithm>
#include <concepts>
#include <cstdint>
#include <span>
#include <vector>

#include "halfspace/core/lanes.h"
#include "halfspace/shading/light/light.h"

namespace halfspace::HS_LANES {

/// Width of a cell in pixels. It is a multiple of every tile size of a pass, so that all fragments of a packet are in the same cell.
inline constexpr int kLightCellPixels = 64;

/// For each cell of the window, the lights that reach it. Cells are numbered from the lower left, row by row.
struct LightCells {
  int columns = 0, rows = 0;
  std::vector<uint32_t> first;    ///< of cell i: index of its first number in `numbers`; columns · rows + 1 entries
  std::vector<uint32_t> numbers;  ///< indices of lights, in increasing order within a cell
};

/// A range of lights: all elements of an array, or those with the given numbers.
class LightRange {
 public:
  class Iterator {
   public:
    Iterator(const Light* lights, const uint32_t* numbers, std::size_t i) : lights_(lights), numbers_(numbers), i_(i) {}
    const Light& operator*() const { return lights_[numbers_ == nullptr ? i_ : numbers_[i_]]; }
    Iterator& operator++() { return ++i_, *this; }
    bool operator!=(const Iterator& other) const { return i_ != other.i_; }

   private:
    const Light* lights_;
    const uint32_t* numbers_;  // null: all lights
    std::size_t i_;
  };

  /// No lights.
  LightRange() = default;
  /// All elements. Implicit, as for a span.
  LightRange(std::span<const Light> lights) : lights_(lights.data()), count_(lights.size()) {}
  template <class Array>
  requires std::convertible_to<const Array&, std::span<const Light>> LightRange(const Array& lights)
      : LightRange(std::span<const Light>(lights)) {}
  LightRange(const Light* lights, std::span<const uint32_t> numbers) : lights_(lights), numbers_(numbers.data()), count_(numbers.size()) {}

  Iterator begin() const { return {lights_, numbers_, 0}; }
  Iterator end() const { return {lights_, numbers_, count_}; }

 private:
  const Light* lights_ = nullptr;
  const uint32_t* numbers_ = nullptr;
  std::size_t count_ = 0;
};

/// Lights, and optionally the cells of the window that they reach. Refers to both and owns neither.
class LightSet : public std::span<const Light> {
 public:
  LightSet() = default;
  /// Lights without cells. Implicit, as for a span.
  LightSet(std::span<const Light> lights) : span(lights) {}
  template <class Array>
  requires std::convertible_to<const Array&, std::span<const Light>> LightSet(const Array& lights) : span(std::span<const Light>(lights)) {}
  LightSet(std::span<const Light> lights, const LightCells* cells) : span(lights), cells_(cells) {}

  /// Returns the lights that can reach a surface at a pixel. All lanes must be in the same tile of a pass. x_px, y_px: window coordinates.
  template <class R>
  HS_INLINE LightRange at_pixel(const R& x_px, const R& y_px) const {
    if (cells_ == nullptr) return *this;
    return cell_at(static_cast<int>(static_cast<double>(lane(x_px, 0))), static_cast<int>(static_cast<double>(lane(y_px, 0))));
  }

 private:
  LightRange cell_at(int x_px, int y_px) const {
    const int column = std::clamp(x_px / kLightCellPixels, 0, cells_->columns - 1);
    const int row = std::clamp(y_px / kLightCellPixels, 0, cells_->rows - 1);
    const auto cell = static_cast<std::size_t>(row * cells_->columns + column);
    const uint32_t begin = cells_->first[cell], end = cells_->first[cell + 1];
    return {data(), std::span(cells_->numbers).subspan(begin, end - begin)};
  }

  const LightCells* cells_ = nullptr;
};

}  // namespace halfspace::HS_LANES
