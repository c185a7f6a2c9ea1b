// SPDX-License-Identifier: Apache-2.0
#include "halfspace/image/tool/picture.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <limits>
#include <type_traits>

namespace halfspace::HS_LANES {

namespace {

// Calls f(samples) with the samples of a picture as a pointer to their type.
template <class F>
void visit_samples(Picture& p, F&& f) {
  switch (p.sample) {
    case Sample::uint8: return f(reinterpret_cast<uint8_t*>(p.pixels.data()));
    case Sample::uint16: return f(reinterpret_cast<uint16_t*>(p.pixels.data()));
    case Sample::float16: return;  // decoders return floats instead
    case Sample::float32: return f(reinterpret_cast<float*>(p.pixels.data()));
  }
}

// Returns color / alpha for an alpha above 0. Codes are rounded and cannot exceed their maximum.
template <class T>
T straight(T color, T alpha) {
  if constexpr (std::is_floating_point_v<T>) {
    return color / alpha;
  } else {
    constexpr uint64_t kMax = std::numeric_limits<T>::max();
    return static_cast<T>(std::min((color * kMax + alpha / 2) / alpha, kMax));
  }
}

// Copies all pixels of a row to `to`, `step` bytes apart.
void scatter_row(const std::byte* from, int count, std::size_t bytes, std::byte* to, std::ptrdiff_t step) {
  for (int i = 0; i < count; ++i, from += bytes) std::memcpy(to + i * step, from, bytes);
}

}  // namespace

Picture empty_picture(int width, int height, const Picture& like) {
  Picture p{width, height, like.channels, like.alpha_channel, like.sample, {}};
  p.pixels.resize(static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * p.pixel_bytes());
  return p;
}

void divide_by_alpha(Picture& p) {
  if (p.alpha_channel < 0) return;
  const std::size_t count = static_cast<std::size_t>(p.width) * static_cast<std::size_t>(p.height);
  visit_samples(p, [&](auto* samples) {
    for (std::size_t i = 0; i < count; ++i, samples += p.channels) {
      const auto alpha = samples[p.alpha_channel];
      if (!(alpha > 0)) continue;
      for (int c = 0; c < p.channels; ++c) {
        if (c != p.alpha_channel) samples[c] = straight(samples[c], alpha);
      }
    }
  });
}

void drop_empty_alpha(Picture& p) {
  if (p.alpha_channel < 0) return;
  const std::size_t count = static_cast<std::size_t>(p.width) * static_cast<std::size_t>(p.height);
  bool is_empty = true;
  visit_samples(p, [&](const auto* samples) {
    const auto channels = static_cast<std::size_t>(p.channels), alpha = static_cast<std::size_t>(p.alpha_channel);
    for (std::size_t i = 0; i < count && is_empty; ++i) is_empty = samples[i * channels + alpha] == 0;
  });
  if (is_empty) p.alpha_channel = -1;
}

Picture upright(Picture p, int orientation) {
  if (orientation < 2 || orientation > 8) return p;
  const bool transposed = orientation >= 5;
  const bool from_right = orientation == 2 || orientation == 3 || orientation == 6 || orientation == 7;
  const bool from_bottom = orientation == 3 || orientation == 4 || orientation == 7 || orientation == 8;
  Picture out = transposed ? empty_picture(p.height, p.width, p) : empty_picture(p.width, p.height, p);
  const std::size_t bytes = p.pixel_bytes();
  const auto at = [&](int x, int y) {
    const int column = from_right ? out.width - 1 - x : x, row = from_bottom ? out.height - 1 - y : y;
    return out.pixels.data() +
           (static_cast<std::size_t>(row) * static_cast<std::size_t>(out.width) + static_cast<std::size_t>(column)) * bytes;
  };
  const std::ptrdiff_t pixel = static_cast<std::ptrdiff_t>(bytes), line = pixel * out.width;
  const std::ptrdiff_t step = transposed ? (from_bottom ? -line : line) : (from_right ? -pixel : pixel);
  for (int y = 0; y < p.height; ++y) {
    const std::byte* from = p.pixels.data() + static_cast<std::size_t>(y) * static_cast<std::size_t>(p.width) * bytes;
    scatter_row(from, p.width, bytes, transposed ? at(y, 0) : at(0, y), step);
  }
  return out;
}

Picture in_window(const Picture& p, const Window& place, const Window& window) {
  Picture out = empty_picture(window.width, window.height, p);
  const int64_t dx = int64_t{place.x} - window.x, dy = int64_t{place.y} - window.y;  // of p in the window
  const int64_t x0 = std::max<int64_t>(dx, 0), x1 = std::min<int64_t>(dx + p.width, window.width);
  const int64_t y0 = std::max<int64_t>(dy, 0), y1 = std::min<int64_t>(dy + p.height, window.height);
  if (x0 >= x1) return out;
  const std::size_t bytes = p.pixel_bytes();
  const auto offset = [&](int64_t x, int64_t y, int width) { return static_cast<std::size_t>(y * width + x) * bytes; };
  for (int64_t y = y0; y < y1; ++y) {
    const std::byte* from = p.pixels.data() + offset(x0 - dx, y - dy, p.width);
    std::memcpy(out.pixels.data() + offset(x0, y, out.width), from, static_cast<std::size_t>(x1 - x0) * bytes);
  }
  return out;
}

}  // namespace halfspace::HS_LANES
