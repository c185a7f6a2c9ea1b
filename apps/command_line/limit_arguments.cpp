// SPDX-License-Identifier: Apache-2.0
#include "command_line/limit_arguments.h"

#include <fmt/format.h>

#include <charconv>
#include <climits>
#include <optional>
#include <string_view>

#include "command_line/errors.h"
#include "halfspace/core/resource_limits.h"

namespace halfspace {

namespace {

constexpr uint64_t kMinMemory = uint64_t{1} << 20, kMaxMemory = uint64_t{1} << 50;
// Two cores draw a model with this many primitives in a few seconds.
constexpr uint64_t kMaxPrimitives = 50'000'000;

// Returns the exponent of the power of two that a suffix denotes.
std::optional<int> shift_of(std::string_view suffix) {
  if (suffix.empty()) return 0;
  if (suffix.size() != 1) return std::nullopt;
  const std::size_t place = std::string_view("KMGT").find(suffix[0]);
  return place == std::string_view::npos ? std::nullopt : std::optional(10 * static_cast<int>(place + 1));
}

// Parses an integer with an optional suffix K, M, G or T.
std::optional<uint64_t> parse_bytes(std::string_view text) {
  uint64_t n = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), n);
  const std::optional<int> shift = shift_of(text.substr(static_cast<std::size_t>(end - text.data())));
  if (error != std::errc() || !shift || n > kMaxMemory >> *shift) return std::nullopt;
  return n << *shift;
}

}  // namespace

void set_limits(const LimitArguments& args) {
  ResourceLimits limits{.max_primitives = kMaxPrimitives, .counts_resident = true};
  if (!args.memory.empty()) {
    const std::optional<uint64_t> bytes = parse_bytes(args.memory);
    if (!bytes || *bytes < kMinMemory)
      throw UsageError("--max-memory is '" + args.memory + "'; expected a size of at least 1M, for example 512M or 4G");
    limits.max_memory = *bytes;
  }
  if (!args.pixels.empty()) {
    const int pixels = parse_number(args.pixels);
    if (pixels < 1 || static_cast<uint64_t>(pixels) > ResourceLimits::kMaxPixels)
      throw UsageError(fmt::format("--max-pixels is '{}'; expected 1 to {}", args.pixels, ResourceLimits::kMaxPixels));
    limits.max_pixels = static_cast<uint64_t>(pixels);
  }
  if (!args.primitives.empty()) {
    const int primitives = parse_number(args.primitives);
    if (primitives < 1) throw UsageError(fmt::format("--max-primitives is '{}'; expected 1 to {}", args.primitives, INT_MAX));
    limits.max_primitives = static_cast<uint64_t>(primitives);
  }
  set_resource_limits(limits);
}

void check_picture(const PictureSize& size, int bytes_per_pixel) {
  const auto width = static_cast<uint64_t>(size.width), height = static_cast<uint64_t>(size.height);
  check_pixel_limit(width, height, "--size");
  const MemoryClaim claim(width * height * static_cast<uint64_t>(bytes_per_pixel), fmt::format("--size {}x{}", size.width, size.height));
}

}  // namespace halfspace
