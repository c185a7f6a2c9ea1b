// SPDX-License-Identifier: Apache-2.0
#include "halfspace/model/gltf/gltf_output.h"

#include <algorithm>

namespace halfspace::HS_LANES {

namespace {

// OpenGL constants.
constexpr int kArrayBuffer = 34962, kElementArrayBuffer = 34963;
constexpr int kUint8 = 5121, kUint16 = 5123, kUint32 = 5125, kFloat = 5126;

}  // namespace

int GltfOutput::add(const char* list, OutputJson item) {
  json[list].push_back(std::move(item));
  return static_cast<int>(json[list].size()) - 1;
}

void GltfOutput::extend(OutputJson& object, const char* extension, OutputJson value) {
  object["extensions"][extension] = std::move(value);
  if (extensions_.insert(extension).second) json["extensionsUsed"].push_back(extension);
}

void GltfOutput::warn(const std::string& text) {
  if (std::ranges::find(warnings, text) == warnings.end()) warnings.push_back(text);
}

int GltfOutput::view(std::span<const std::byte> bytes, Use use) {
  buffer.resize((buffer.size() + 3) / 4 * 4);
  OutputJson item = {{"buffer", 0}, {"byteOffset", buffer.size()}, {"byteLength", bytes.size()}};
  if (use != Use::other) item["target"] = use == Use::vertices ? kArrayBuffer : kElementArrayBuffer;
  buffer.insert(buffer.end(), bytes.begin(), bytes.end());
  return add("bufferViews", std::move(item));
}

int GltfOutput::accessor_of(int view, int component, std::size_t count, const char* type) {
  return add("accessors", {{"bufferView", view}, {"componentType", component}, {"count", count}, {"type", type}});
}

int GltfOutput::float_accessor(std::span<const std::byte> bytes, std::size_t count, const char* type, Use use) {
  return accessor_of(view(bytes, use), kFloat, count, type);
}

int GltfOutput::index_accessor(const std::vector<uint32_t>& values, std::size_t vertices) {
  constexpr std::size_t kRestart = 0xffff;  // not a valid index
  if (vertices > kRestart) return accessor_of(view(std::as_bytes(std::span(values)), Use::indices), kUint32, values.size(), "SCALAR");
  const std::vector<uint16_t> narrow(values.begin(), values.end());
  return accessor_of(view(std::as_bytes(std::span(narrow)), Use::indices), kUint16, values.size(), "SCALAR");
}

int GltfOutput::flag_accessor(const std::vector<float>& values) {
  std::vector<uint8_t> flags(values.size());
  std::ranges::transform(values, flags.begin(), [](float x) { return static_cast<uint8_t>(x != 0.0f ? 1 : 0); });
  return accessor_of(view(std::as_bytes(std::span(flags))), kUint8, flags.size(), "SCALAR");
}

int GltfOutput::joint_accessor(const std::vector<std::array<uint16_t, 4>>& values) {
  return accessor_of(view(std::as_bytes(std::span(values)), Use::vertices), kUint16, values.size(), "VEC4");
}

void GltfOutput::set_bounds(int accessor, std::span<const float> values, int width) {
  if (values.empty()) return;
  const auto components = static_cast<std::size_t>(width);
  std::vector<float> low(values.begin(), values.begin() + width), high = low;
  for (std::size_t i = 0; i < values.size(); ++i) {
    low[i % components] = std::min(low[i % components], values[i]);
    high[i % components] = std::max(high[i % components], values[i]);
  }
  OutputJson& item = json["accessors"][static_cast<std::size_t>(accessor)];
  item["min"] = std::vector<double>(low.begin(), low.end());
  item["max"] = std::vector<double>(high.begin(), high.end());
}

std::string percent_encoded(const std::string& name) {
  constexpr const char* kDigits = "0123456789ABCDEF";
  std::string encoded;
  for (const char c : name) {
    const bool plain = (c >= '0' && c <= '9') || (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || c == '-' || c == '_' || c == '.';
    const auto code = static_cast<unsigned char>(c);
    encoded += plain ? std::string(1, c) : std::string{'%', kDigits[code >> 4], kDigits[code & 15]};
  }
  return encoded;
}

}  // namespace halfspace::HS_LANES
