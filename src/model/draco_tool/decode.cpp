// SPDX-License-Identifier: Apache-2.0
#include "halfspace/model/draco_tool/decode.h"

#include <draco/compression/decode.h>

#include <cstring>
#include <limits>
#include <memory>

namespace halfspace::HS_LANES {

namespace {

// Converts a decoder message to a single line.
std::string one_line(std::string text) {
  for (char& c : text) {
    if (static_cast<unsigned char>(c) < 0x20) c = ' ';
  }
  if (text.size() > 200) text.resize(200);
  return text.empty() ? "no reason given" : text;
}

std::unique_ptr<draco::Mesh> decode_mesh(std::span<const char> stream) {
  draco::DecoderBuffer buffer;
  buffer.Init(stream.data(), stream.size());
  draco::Decoder decoder;
  auto result = decoder.DecodeMeshFromBuffer(&buffer);
  if (!result.ok()) {
    throw DracoFailure{"cannot be decoded (Draco: " + one_line(result.status().error_msg_string()) +
                       "); expected a compressed triangle mesh"};
  }
  return std::move(result).value();
}

// Returns the glTF component type, or 0 if there is none.
uint32_t component_of(draco::DataType type) {
  switch (type) {
    case draco::DT_INT8: return 5120;
    case draco::DT_UINT8: return 5121;
    case draco::DT_INT16: return 5122;
    case draco::DT_UINT16: return 5123;
    case draco::DT_UINT32: return 5125;
    case draco::DT_FLOAT32: return 5126;
    default: return 0;
  }
}

std::size_t bytes_per_point(const draco::PointAttribute& attribute) {
  return static_cast<std::size_t>(draco::DataTypeLength(attribute.data_type())) * static_cast<std::size_t>(attribute.num_components());
}

// Returns an attribute. Throws DracoFailure if it is missing or if glTF cannot store its type.
const draco::PointAttribute& attribute_of(const draco::Mesh& mesh, uint32_t id) {
  const std::string name = "the attribute with id " + std::to_string(id);
  const draco::PointAttribute* attribute = mesh.GetAttributeByUniqueId(id);
  if (attribute == nullptr) throw DracoFailure{"does not contain " + name + "; expected it to be in the compressed mesh"};
  const int width = attribute->num_components();
  if (component_of(attribute->data_type()) == 0 || width < 1 || width > 4)
    throw DracoFailure{name + " has an unsupported type; expected up to 4 components of a glTF component type"};
  return *attribute;
}

void append_indices(const draco::Mesh& mesh, std::byte*& to) {
  for (draco::FaceIndex f(0); f < mesh.num_faces(); ++f) {
    for (std::size_t k = 0; k < 3; ++k, to += sizeof(uint32_t)) {
      const uint32_t index = mesh.face(f)[k].value();
      std::memcpy(to, &index, sizeof index);
    }
  }
}

void append_values(const draco::Mesh& mesh, const draco::PointAttribute& attribute, std::byte*& to) {
  const std::size_t size = bytes_per_point(attribute);
  const auto stride = static_cast<uint64_t>(attribute.byte_stride());
  const uint64_t available = attribute.buffer()->data_size();
  for (draco::PointIndex p(0); p < mesh.num_points(); ++p, to += size) {
    const draco::AttributeValueIndex value = attribute.mapped_index(p);
    const uint64_t offset = static_cast<uint64_t>(attribute.byte_offset()) + uint64_t{value.value()} * stride;
    if (value.value() >= attribute.size() || offset + size > available)
      throw DracoFailure{"a point has no value; expected one for each point"};
    std::memcpy(to, attribute.buffer()->data() + offset, size);
  }
}

}  // namespace

DecodedDraco decode_draco(std::span<const char> stream, std::span<const uint32_t> ids, uint64_t max_bytes) {
  const std::unique_ptr<draco::Mesh> mesh = decode_mesh(stream);
  DecodedDraco decoded;
  decoded.header.points = mesh->num_points();
  decoded.header.triangles = mesh->num_faces();
  uint64_t bytes = decoded.header.triangles * 3 * sizeof(uint32_t);
  for (const uint32_t id : ids) {
    const draco::PointAttribute& attribute = attribute_of(*mesh, id);
    decoded.attributes.push_back({component_of(attribute.data_type()), static_cast<uint32_t>(attribute.num_components())});
    bytes += uint64_t{decoded.header.points} * bytes_per_point(attribute);
  }
  if (bytes > max_bytes) {
    throw DracoFailure{
        "needs " + std::to_string(bytes >> 20) + " MiB; expected at most " + std::to_string(max_bytes >> 20) + " MiB (--max-memory)", true};
  }
  decoded.data.resize(bytes);
  std::byte* to = decoded.data.data();
  append_indices(*mesh, to);
  for (const uint32_t id : ids) append_values(*mesh, attribute_of(*mesh, id), to);
  return decoded;
}

}  // namespace halfspace::HS_LANES
