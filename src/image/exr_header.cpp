// SPDX-License-Identifier: Apache-2.0
#include "halfspace/image/exr_header.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <string_view>

namespace halfspace::HS_LANES {

namespace {

// Attributes are sorted by name, so the comments and the list of channels are among the first.
constexpr std::size_t kHeaderBytes = 1 << 16;
constexpr std::string_view kMagic("\x76\x2f\x31\x01", 4);
// Version, and per channel: type, linearity with padding, and two subsampling rates.
constexpr std::size_t kVersionBytes = 4, kChannelBytes = 16;

// Reads from the front of a text. After an error, all results are empty.
class HeaderBytes {
 public:
  explicit HeaderBytes(std::string_view rest) : rest_(rest) {}

  std::string_view take(std::size_t count) {
    ok_ = ok_ && count <= rest_.size();
    const std::string_view taken = ok_ ? rest_.substr(0, count) : std::string_view();
    rest_.remove_prefix(taken.size());
    return taken;
  }
  std::string_view word() {
    const std::string_view text = take(std::min(rest_.find('\0'), rest_.size()));
    take(1);
    return ok_ ? text : std::string_view();
  }
  std::size_t size() {
    const std::string_view bytes = take(sizeof(uint32_t));
    uint32_t n = 0;
    if (!bytes.empty()) std::memcpy(&n, bytes.data(), sizeof n);
    return n;
  }
  bool ok() const { return ok_; }

 private:
  std::string_view rest_;
  bool ok_ = true;
};

std::vector<std::string> names_in(std::string_view list) {
  HeaderBytes bytes(list);
  std::vector<std::string> names;
  for (std::string_view name = bytes.word(); !name.empty(); name = bytes.word()) {
    names.emplace_back(name);
    bytes.take(kChannelBytes);
  }
  return bytes.ok() ? names : std::vector<std::string>();
}

}  // namespace

namespace {

// Returns the value of the first attribute with the name and type, or an empty string.
std::string attribute(const std::filesystem::path& file, std::string_view name, std::string_view type) {
  std::ifstream stream(file, std::ios::binary);
  std::string start(kHeaderBytes, '\0');
  stream.read(start.data(), static_cast<std::streamsize>(start.size()));
  start.resize(static_cast<std::size_t>(stream.gcount()));
  HeaderBytes bytes(start);
  if (bytes.take(kMagic.size()) != kMagic) return {};
  bytes.take(kVersionBytes);
  for (std::string_view found = bytes.word(); !found.empty(); found = bytes.word()) {
    const bool is_wanted = bytes.word() == type && found == name;
    const std::string_view value = bytes.take(bytes.size());
    if (is_wanted) return std::string(value);
  }
  return {};
}

}  // namespace

std::vector<std::string> exr_channel_names(const std::filesystem::path& file) { return names_in(attribute(file, "channels", "chlist")); }

std::string exr_comment(const std::filesystem::path& file) { return attribute(file, "comments", "string"); }

}  // namespace halfspace::HS_LANES
