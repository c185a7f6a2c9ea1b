// SPDX-License-Identifier: Apache-2.0
#include "halfspace/model/stl/read_stl.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "halfspace/core/check.h"
#include "halfspace/core/srgb.h"
#include "halfspace/model/geometry/mesh_vertices.h"
#include "halfspace/model/geometry/normals.h"
#include "halfspace/model/geometry/position_ids.h"
#include "halfspace/model/geometry/single_mesh.h"
#include "halfspace/model/stl/stl_triangles.h"
#include "halfspace/model/text/srgb_color.h"

namespace halfspace::HS_LANES {

namespace {

constexpr std::size_t kMaxTriangles = 0xffffffffu / 3;

// The smallest triangle takes 50 bytes in a binary file and more in a text file.
constexpr std::size_t kStlMemoryPerByte = 1 + (kBytesPerTriangle + 3 * sizeof(glm::dvec3) + 3 * sizeof(glm::vec3)) / 50;

/// Removes triangles with infinite or NaN coordinates. Returns their number.
std::size_t remove_infinite(StlTriangles& triangles) {
  std::size_t kept = 0;
  const std::size_t count = triangles.corners.size() / 3;
  for (std::size_t t = 0; t < count; ++t) {
    if (!std::all_of(&triangles.corners[3 * t], &triangles.corners[3 * t] + 3, is_finite)) continue;
    for (std::size_t k = 0; k < 3; ++k) triangles.corners[3 * kept + k] = triangles.corners[3 * t + k];
    if (!triangles.attributes.empty()) triangles.attributes[kept] = triangles.attributes[t];
    ++kept;
  }
  triangles.corners.resize(3 * kept);
  if (!triangles.attributes.empty()) triangles.attributes.resize(kept);
  return count - kept;
}

/// The colors of the triangles of a file.
class StlColors {
 public:
  explicit StlColors(const StlTriangles& triangles) : attributes_(triangles.attributes) {
    if (!triangles.color) return;
    const glm::u8vec4 c = *triangles.color;
    part_ = glm::vec4(kSrgbToLinear[c.x], kSrgbToLinear[c.y], kSrgbToLinear[c.z], c.w == 0 ? 1.0f : static_cast<float>(c.w) / 255.0f);
    has_own_ = std::ranges::any_of(attributes_, [](uint16_t attribute) { return attribute != 0; });
  }

  bool empty() const { return !part_ && std::ranges::none_of(attributes_, has_bit_15); }

  /// Returns the linear color of a triangle.
  glm::vec4 of(std::size_t triangle) const {
    const uint16_t attribute = attributes_.empty() ? uint16_t{0} : attributes_[triangle];
    if (part_) return has_bit_15(attribute) || !has_own_ ? *part_ : color(attribute, 0, 10);
    constexpr float kGray = 0.8f;
    return has_bit_15(attribute) ? color(attribute, 10, 0) : glm::vec4(kGray, kGray, kGray, 1.0f);
  }

 private:
  static bool has_bit_15(uint16_t attribute) { return (attribute & 0x8000) != 0; }

  // red_bit, blue_bit: the lowest bits of the channels.
  static glm::vec4 color(uint16_t attribute, int red_bit, int blue_bit) {
    const auto channel = [&](int bit) { return linear_from_srgb(static_cast<float>(attribute >> bit & 31) / 31.0f); };
    return {channel(red_bit), channel(5), channel(blue_bit), 1.0f};
  }

  const std::vector<uint16_t>& attributes_;
  std::optional<glm::vec4> part_;  // the color in the header
  bool has_own_ = false;           // with part_: not all attributes are 0, which would be black
};

void join_vertices(ModelMesh& mesh) {
  const std::vector<uint32_t> ids = position_ids(mesh.positions);
  std::vector<uint32_t> sources, numbers(ids.size());
  for (uint32_t i = 0; i < ids.size(); ++i) {
    if (ids[i] == i) {
      numbers[i] = static_cast<uint32_t>(sources.size());
      sources.push_back(i);
    }
  }
  for (uint32_t i = 0; i < ids.size(); ++i) mesh.indices[i] = numbers[ids[i]];
  copy_vertices(mesh, sources);
}

ModelMesh mesh_of(const StlTriangles& triangles, float crease_degrees) {
  ModelMesh mesh;
  set_positions(mesh, triangles.corners);
  mesh.indices.resize(mesh.positions.size());
  for (uint32_t i = 0; i < mesh.indices.size(); ++i) mesh.indices[i] = i;
  if (const StlColors colors(triangles); !colors.empty()) {
    for (std::size_t t = 0; t < triangles.corners.size() / 3; ++t) mesh.colors.insert(mesh.colors.end(), 3, colors.of(t));
  } else {
    join_vertices(mesh);
  }
  add_smooth_normals(mesh, crease_degrees);
  mesh.computed_normals = true;
  return mesh;
}

StlTriangles triangles_of(std::span<const std::byte> bytes, const std::string& file) {
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  if (!is_binary_stl(bytes) && is_text_stl(text)) return text_stl_triangles(text, file);
  return binary_stl_triangles(bytes, file);
}

}  // namespace

bool is_binary_stl(std::span<const std::byte> bytes) {
  if (bytes.size() < 84) return false;
  uint32_t count = 0;
  std::memcpy(&count, bytes.data() + 80, sizeof count);
  return bytes.size() == 84 + std::size_t{count} * 50;
}

Model read_stl(const std::filesystem::path& file, std::span<const std::byte> bytes, const ReadModelOptions& options) {
  try {
    check_memory(bytes.size() * kStlMemoryPerByte, options);
  } catch (const InputError& e) {
    throw InputError(fmt::format("{}: {}", file.string(), e.what()));
  }
  StlTriangles triangles = triangles_of(bytes, file.string());
  try {
    if (triangles.corners.empty()) throw InputError("no triangles; expected at least one");
    if (triangles.corners.size() / 3 > kMaxTriangles) throw InputError(fmt::format("more than {} triangles", kMaxTriangles));
    const std::size_t removed = remove_infinite(triangles);
    Model model = single_mesh_model("STL", file, mesh_of(triangles, options.crease_degrees));
    model.up = UpAxis::z;
    model.warnings = std::move(triangles.warnings);
    if (removed > 0) model.warnings.push_back(fmt::format("{} triangles whose coordinates are not finite; skipped", removed));
    return model;
  } catch (const InputError& e) {
    throw InputError(fmt::format("{}: {}", file.string(), e.what()));
  }
}

}  // namespace halfspace::HS_LANES
