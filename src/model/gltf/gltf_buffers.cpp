// SPDX-License-Identifier: Apache-2.0
#include "halfspace/model/gltf/gltf_buffers.h"

#include <fmt/format.h>

#include <cstring>
#include <nlohmann/json.hpp>

#include "halfspace/core/check.h"
#include "halfspace/model/gltf/gltf_meshopt.h"
#include "halfspace/model/gltf/gltf_uri.h"
#include "halfspace/model/text/file_bytes.h"

namespace halfspace::HS_LANES {

namespace {

constexpr std::size_t kHeaderSize = 12, kChunkHeaderSize = 8;
constexpr uint32_t kJsonChunk = 0x4e4f534a, kBinaryChunk = 0x004e4942;  // "JSON", "BIN\0"

// Returns a little-endian number.
uint32_t number_at(std::span<const std::byte> bytes, std::size_t at) {
  uint32_t x = 0;
  std::memcpy(&x, bytes.data() + at, sizeof x);
  return x;
}

std::string_view as_text(std::span<const std::byte> bytes) { return {reinterpret_cast<const char*>(bytes.data()), bytes.size()}; }

}  // namespace

bool is_glb(std::span<const std::byte> bytes) { return as_text(bytes).starts_with("glTF"); }

GltfChunks gltf_chunks(const std::filesystem::path& file, std::span<const std::byte> bytes) {
  if (!is_glb(bytes)) return {as_text(bytes), std::nullopt};
  const auto fail = [&](const std::string& problem) { throw InputError(fmt::format("{}: GLB header: {}", file.string(), problem)); };
  if (bytes.size() < kHeaderSize) fail("the file is truncated; expected at least 12 bytes");
  if (number_at(bytes, 4) != 2) fail(fmt::format("version {}; expected 2", number_at(bytes, 4)));
  const std::size_t length = number_at(bytes, 8);
  if (length > bytes.size())
    fail(fmt::format("the length is {}, but the file has {} bytes; expected a complete file", length, bytes.size()));
  GltfChunks chunks;
  for (std::size_t at = kHeaderSize, number = 0; at < length; ++number) {
    if (length - at < kChunkHeaderSize) fail(fmt::format("chunk {} is truncated; expected 8 bytes or more", number));
    const std::size_t size = number_at(bytes, at);
    const uint32_t type = number_at(bytes, at + 4);
    at += kChunkHeaderSize;
    if (size > length - at)
      fail(fmt::format("chunk {} has {} bytes, but {} are left; expected a complete file", number, size, length - at));
    const std::span<const std::byte> chunk = bytes.subspan(at, size);
    if (number == 0 && type != kJsonChunk) fail("the first chunk has a different type; expected a JSON chunk");
    if (number == 0) chunks.json = as_text(chunk);
    if (number == 1 && type == kBinaryChunk) chunks.binary = chunk;
    at += size;
  }
  if (chunks.json.empty()) fail("there is no JSON text; expected a JSON chunk");
  return chunks;
}

GltfBuffers::GltfBuffers(GltfDocument& document, References& references, std::optional<std::span<const std::byte>> binary)
    : document_(document),
      references_(references),
      binary_(binary),
      buffers_(document.list("buffers").size()),
      views_(document.list("bufferViews").size()) {}

std::vector<std::byte> GltfBuffers::load(const GltfValue& json) {
  const std::string uri = document_.string(json, "uri");
  if (is_data_uri(uri)) {
    document_.take_memory(json, uri.size(), 1);
    std::optional<std::vector<std::byte>> data = data_of_uri(uri);
    if (!data) document_.fail(json, "uri", "the data URI is invalid; expected data:...;base64,...");
    return std::move(*data);
  }
  const int outside = references_.outside();
  const auto path = references_.find(percent_decoded(uri), "a buffer");
  if (!path) {
    document_.fail(json, "uri",
                   "the buffer " + gltf_quoted(uri) +
                       (references_.outside() > outside ? " is outside the folder of the model; expected it inside, or --allow-outside"
                                                        : " cannot be opened; expected an existing file"));
  }
  std::vector<std::byte> data = file_bytes(*path, document_.memory_left());
  document_.take_memory(json, data.size(), 1);
  return data;
}

std::span<const std::byte> GltfBuffers::buffer(std::size_t index) {
  if (buffers_[index]) return *buffers_[index];
  const GltfValue& json = document_.list("buffers")[index];
  const uint64_t length = document_.integer(json, "byteLength");
  std::span<const std::byte> bytes;
  if (document_.find(json, "uri") != nullptr) {
    storage_.push_back(load(json));
    bytes = storage_.back();
  } else if (index == 0 && binary_) {
    bytes = *binary_;
  } else {
    document_.fail(json, "uri", "is missing; expected the data of the buffer");
  }
  if (length > bytes.size()) {
    document_.fail(json, "byteLength", fmt::format("{}, but the buffer has {} bytes; expected the whole buffer", length, bytes.size()));
  }
  buffers_[index] = bytes.first(length);
  return *buffers_[index];
}

std::span<const std::byte> GltfBuffers::range(const GltfValue& json) {
  const auto index = static_cast<std::size_t>(document_.required_index(json, "buffer", buffers_.size()));
  const uint64_t offset = document_.integer(json, "byteOffset", 0), length = document_.integer(json, "byteLength");
  const std::span<const std::byte> bytes = buffer(index);
  if (offset > bytes.size() || length > bytes.size() - offset) {
    document_.fail(json, fmt::format("the range from byte {} with length {} is not inside the buffer; expected a range inside its {} bytes",
                                     offset, length, bytes.size()));
  }
  return bytes.subspan(offset, length);
}

GltfView GltfBuffers::compressed_view(const GltfValue& compression) {
  const MeshoptStream stream = meshopt_stream(document_, compression);
  const std::span<const std::byte> source = range(compression);
  document_.take_memory(compression, stream.count, stream.stride);
  std::vector<std::byte> data(stream.count * stream.stride);
  if (!decode_meshopt(stream, source, data)) document_.fail(compression, "the compressed data is damaged; expected meshopt data");
  storage_.push_back(std::move(data));
  return {storage_.back(), stream.stride};
}

const GltfView& GltfBuffers::view(std::size_t index) {
  std::optional<GltfView>& view = views_[index];
  if (view) return *view;
  const GltfValue& json = document_.list("bufferViews")[index];
  if (const GltfValue* compression = document_.extension(json, "EXT_meshopt_compression")) {
    view = compressed_view(*compression);
    const uint64_t length = document_.integer(json, "byteLength");
    if (length > view->bytes.size()) document_.fail(json, "byteLength", "is larger than the decompressed data; expected the same size");
    return *view;
  }
  view = GltfView{range(json), document_.integer(json, "byteStride", 0, 252)};
  if (view->stride % 4 != 0) document_.fail(json, "byteStride", "is not a multiple of 4; expected 4 to 252");
  return *view;
}

}  // namespace halfspace::HS_LANES
