// SPDX-License-Identifier: Apache-2.0
#include "halfspace/image/exr_header.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <string>
#include <string_view>
#include <vector>

namespace halfspace::HS_LANES {

namespace {

// The text is at the start, because attributes are sorted by name and the others are small.
constexpr std::size_t kHeaderBytes = 1 << 16;
constexpr std::string_view kMagic("\x76\x2f\x31\x01", 4);
constexpr std::size_t kVersionBytes = 4;

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
  std::size_t rest() const { return rest_.size(); }

 private:
  std::string_view rest_;
  bool ok_ = true;
};

// The attributes of a file, and the offset of what follows them.
struct Header {
  struct Attribute {
    std::string_view name, type, value;
  };
  std::string start;  // of the file
  std::vector<Attribute> attributes;
  std::size_t end = 0;  // 0: the header is not valid

  // Returns the value of the attribute with the name and type, or an empty text.
  std::string_view value(std::string_view name, std::string_view type) const {
    const auto found = std::ranges::find_if(attributes, [&](const Attribute& a) { return a.name == name && a.type == type; });
    return found == attributes.end() ? std::string_view() : found->value;
  }
};

Header read_header(std::istream& stream) {
  Header header;
  header.start.resize(kHeaderBytes);
  stream.read(header.start.data(), static_cast<std::streamsize>(header.start.size()));
  header.start.resize(static_cast<std::size_t>(stream.gcount()));
  HeaderBytes bytes(header.start);
  if (bytes.take(kMagic.size()) != kMagic) return header;
  bytes.take(kVersionBytes);
  for (std::string_view name = bytes.word(); !name.empty(); name = bytes.word()) {
    const std::string_view type = bytes.word();
    header.attributes.push_back({name, type, bytes.take(bytes.size())});
  }
  header.end = bytes.ok() ? header.start.size() - bytes.rest() : 0;
  return header;
}

Header header_of(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return read_header(stream);
}

}  // namespace

ImageText exr_text(const std::filesystem::path& file) {
  const Header header = header_of(file);
  const auto text = [&header](std::string_view name) { return std::string(header.value(name, "string")); };
  return {text("software"), text("comments"), text("fingerprint")};
}

bool is_whole_exr(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  const Header header = read_header(stream);
  const std::string_view window = header.value("dataWindow", "box2i"), compression = header.value("compression", "compression");
  constexpr char kZip = 3;  // blocks of 16 rows
  if (header.end == 0 || window.size() != 4 * sizeof(int32_t) || compression.size() != 1 || compression[0] != kZip) return false;
  int32_t edges[4];
  std::memcpy(edges, window.data(), sizeof edges);
  const int64_t rows = int64_t{edges[3]} - edges[1] + 1;
  if (rows < 1) return false;
  const auto read_at = [&stream](uint64_t offset, auto& value) {
    stream.clear();
    stream.seekg(static_cast<std::streamoff>(offset));
    return static_cast<bool>(stream.read(reinterpret_cast<char*>(&value), sizeof value));
  };
  uint64_t last_block = 0;
  struct {
    int32_t y;
    uint32_t bytes;
  } block = {};
  const auto blocks = static_cast<uint64_t>((rows + 15) / 16);
  if (!read_at(header.end + (blocks - 1) * sizeof last_block, last_block) || !read_at(last_block, block)) return false;
  std::error_code error;
  return last_block > header.end && last_block + sizeof block + block.bytes <= std::filesystem::file_size(file, error) && !error;
}

}  // namespace halfspace::HS_LANES
