// SPDX-License-Identifier: Apache-2.0
#include "command_line/arguments.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <string>

#include "command_line/errors.h"
#include "halfspace/core/parallel.h"
#include "halfspace/image/atomic_output.h"

namespace halfspace {

namespace {
constexpr int kMaxEdge = 16384;
constexpr int kMaxThreads = 1024;
}  // namespace

int parse_number(std::string_view text) {
  int n = -1;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), n);
  return error == std::errc() && end == text.data() + text.size() ? n : -1;
}

PictureSize parse_size(std::string_view text) {
  const std::size_t x = text.find('x');
  if (x != std::string_view::npos && x > 0 && x + 1 < text.size()) {
    const PictureSize size{parse_number(text.substr(0, x)), parse_number(text.substr(x + 1))};
    if (std::min(size.width, size.height) >= 1 && std::max(size.width, size.height) <= kMaxEdge) return size;
  }
  throw UsageError("--size is '" + std::string(text) + "'; expected WxH with 1 to 16384 each, for example 1920x1080");
}

int parse_threads(std::string_view text) {
  if (text.empty()) return Workers::cores();
  const int threads = parse_number(text);
  if (threads >= 1 && threads <= kMaxThreads) return threads;
  throw UsageError(fmt::format("--threads is '{}'; expected 1 to {}", text, kMaxThreads));
}

double parse_real(std::string_view option, std::string_view text, double low, double high, std::string_view example) {
  double x = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), x);
  if (error == std::errc() && end == text.data() + text.size() && x >= low && x <= high) return x;
  throw UsageError(std::string(option) + " is '" + std::string(text) + "'; expected " + std::string(example));
}

bool is_stream(const std::filesystem::path& path) {
  std::error_code error;
  return is_standard_output(path) || (std::filesystem::exists(path, error) && !std::filesystem::is_regular_file(path, error));
}

}  // namespace halfspace
