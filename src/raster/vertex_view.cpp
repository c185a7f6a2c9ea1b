// SPDX-License-Identifier: Apache-2.0
#include "raster/vertex_view.h"

#include <algorithm>

namespace halfspace {

Indices Indices::sequential(std::size_t vertex_count) {
  HS_CHECK_OP(vertex_count, <, std::size_t{1} << 32);
  Indices i;
  i.size_ = vertex_count;
  i.end_ = static_cast<uint32_t>(vertex_count);
  return i;
}

Indices::Indices(std::span<const uint32_t> list, std::size_t vertex_count) : wide_(list.data()), size_(list.size()) {
  scan(list, vertex_count);
}

Indices::Indices(std::span<const uint16_t> list, std::size_t vertex_count) : narrow_(list.data()), size_(list.size()) {
  scan(list, vertex_count);
}

template <class T>
void Indices::scan(std::span<const T> list, std::size_t vertex_count) {
  if (list.empty()) return;
  const auto [low, high] = std::minmax_element(list.begin(), list.end());
  HS_CHECK_OP(*high, <, vertex_count);
  first_ = *low;
  end_ = static_cast<uint32_t>(*high) + 1;
  std::vector<bool> seen(end_ - first_);
  std::size_t distinct = 0;
  for (const T i : list) {
    if (!seen[i - first_]) ++distinct;
    seen[i - first_] = true;
  }
  if (distinct == seen.size()) return;
  used_.reserve(distinct);
  for (uint32_t i = 0; i < seen.size(); ++i) {
    if (seen[i]) used_.push_back(first_ + i);
  }
}

}  // namespace halfspace
