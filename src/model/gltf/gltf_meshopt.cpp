// SPDX-License-Identifier: Apache-2.0
#include "halfspace/model/gltf/gltf_meshopt.h"

#include <meshoptimizer.h>

namespace halfspace::HS_LANES {

namespace {

// First bytes of the streams that the decoder accepts: version 0 for attributes, versions 0 and 1 for indices.
constexpr unsigned kAttributeHeader = 0xa0, kTriangleHeader = 0xe0, kSequenceHeader = 0xd0;

bool is_filter_valid(const MeshoptStream& stream) {
  switch (stream.filter) {
    case MeshoptFilter::none: return true;
    case MeshoptFilter::octahedral: return stream.stride == 4 || stream.stride == 8;
    case MeshoptFilter::quaternion: return stream.stride == 8;
    case MeshoptFilter::exponential: return stream.stride % 4 == 0;
  }
  return false;
}

void apply_filter(const MeshoptStream& stream, void* data) {
  switch (stream.filter) {
    case MeshoptFilter::none: return;
    case MeshoptFilter::octahedral: return meshopt_decodeFilterOct(data, stream.count, stream.stride);
    case MeshoptFilter::quaternion: return meshopt_decodeFilterQuat(data, stream.count, stream.stride);
    case MeshoptFilter::exponential: return meshopt_decodeFilterExp(data, stream.count, stream.stride);
  }
}

}  // namespace

MeshoptStream meshopt_stream(const GltfDocument& document, const GltfValue& json) {
  MeshoptStream stream;
  const std::string mode = document.string(json, "mode"), filter = document.string(json, "filter");
  if (mode == "ATTRIBUTES") {
    stream.mode = MeshoptMode::attributes;
  } else if (mode == "TRIANGLES") {
    stream.mode = MeshoptMode::triangles;
  } else if (mode == "INDICES") {
    stream.mode = MeshoptMode::indices;
  } else {
    document.fail(json, "mode", gltf_quoted(mode) + " is unknown; expected ATTRIBUTES, TRIANGLES or INDICES");
  }
  if (filter == "OCTAHEDRAL") {
    stream.filter = MeshoptFilter::octahedral;
  } else if (filter == "QUATERNION") {
    stream.filter = MeshoptFilter::quaternion;
  } else if (filter == "EXPONENTIAL") {
    stream.filter = MeshoptFilter::exponential;
  } else if (!filter.empty() && filter != "NONE") {
    document.fail(json, "filter", gltf_quoted(filter) + " is unknown; expected NONE, OCTAHEDRAL, QUATERNION or EXPONENTIAL");
  }
  stream.stride = document.integer(json, "byteStride");
  stream.count = document.integer(json, "count");
  const bool attributes = stream.mode == MeshoptMode::attributes;
  const bool stride_valid =
      attributes ? stream.stride > 0 && stream.stride <= 256 && stream.stride % 4 == 0 : stream.stride == 2 || stream.stride == 4;
  if (!stride_valid)
    document.fail(json, "byteStride", "is not valid for this mode; expected a multiple of 4 up to 256, or 2 or 4 for indices");
  if (stream.mode == MeshoptMode::triangles && stream.count % 3 != 0) {
    document.fail(json, "count", "is not a multiple of 3; expected three indices per triangle");
  }
  if (!attributes && stream.filter != MeshoptFilter::none) document.fail(json, "filter", "indices have no filter; expected NONE");
  if (!is_filter_valid(stream))
    document.fail(json, "byteStride", "is not valid for this filter; expected 4 or 8 (octahedral), 8 (quaternion)");
  return stream;
}

bool decode_meshopt(const MeshoptStream& stream, std::span<const std::byte> source, std::span<std::byte> result) {
  if (source.empty() || stream.count == 0) return stream.count == 0;
  const auto* data = reinterpret_cast<const unsigned char*>(source.data());
  const unsigned header = data[0];
  switch (stream.mode) {
    case MeshoptMode::attributes:
      if (header != kAttributeHeader) return false;
      if (meshopt_decodeVertexBuffer(result.data(), stream.count, stream.stride, data, source.size()) != 0) return false;
      apply_filter(stream, result.data());
      return true;
    case MeshoptMode::triangles:
      if ((header & 0xf0u) != kTriangleHeader || (header & 0x0fu) > 1) return false;
      return meshopt_decodeIndexBuffer(result.data(), stream.count, stream.stride, data, source.size()) == 0;
    case MeshoptMode::indices:
      if ((header & 0xf0u) != kSequenceHeader || (header & 0x0fu) > 1) return false;
      return meshopt_decodeIndexSequence(result.data(), stream.count, stream.stride, data, source.size()) == 0;
  }
  return false;
}

}  // namespace halfspace::HS_LANES
