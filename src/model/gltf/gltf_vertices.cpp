// SPDX-License-Identifier: Apache-2.0
#include "halfspace/model/gltf/gltf_vertices.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "halfspace/model/geometry/normals.h"
#include "halfspace/model/geometry/single_mesh.h"
#include "halfspace/model/text/text_lines.h"

namespace halfspace::HS_LANES {

namespace {

constexpr float kMaxPosition = static_cast<float>(kMaxModelNumber);
constexpr float kMaxTextureCoordinate = 1e9f;

template <class V>
bool is_bounded(const V& v, float limit) {
  for (glm::length_t i = 0; i < V::length(); ++i) {
    if (!(std::abs(v[i]) <= limit)) return false;
  }
  return true;
}

/// Reads attributes of one primitive or morph target.
class VertexReader {
 public:
  VertexReader(GltfAccessors& accessors, const GltfValue& attributes, std::size_t count, GltfSubset subset)
      : accessors_(accessors), document_(accessors.document()), attributes_(attributes), count_(count), subset_(subset) {}

  bool has(const char* key) const { return document_.find(attributes_, key) != nullptr; }

  GltfAccessor accessor(const char* key) {
    GltfAccessor accessor = accessors_.find(attributes_, key);
    if (accessor.count != count_) {
      document_.fail(*accessor.json, "count", fmt::format("{} is not the number of vertices; expected {}", accessor.count, count_));
    }
    return accessor;
  }

  // Positions may be infinite or NaN.
  std::vector<glm::vec3> positions(const char* key) {
    const GltfAccessor source = accessor(key);
    std::vector<glm::vec3> values = accessors_.read<glm::vec3>(source, subset_);
    const auto bad =
        std::ranges::find_if(values, [](const glm::vec3& p) { return is_finite(glm::dvec3(p)) && !is_bounded(p, kMaxPosition); });
    if (bad != values.end())
      document_.fail(*source.json, fmt::format("position {} exceeds 1e18; expected smaller positions", bad - values.begin()));
    return values;
  }

  // Vectors that are too large or not finite are replaced.
  template <class V>
  std::vector<V> bounded(const char* key, float limit, const V& replacement = V(0.0f)) {
    const GltfAccessor source = accessor(key);
    std::vector<V> values = accessors_.read<V>(source, subset_);
    std::size_t replaced = 0;
    for (V& v : values) {
      if (is_bounded(v, limit)) continue;
      v = replacement;
      ++replaced;
    }
    if (replaced > 0) {
      document_.warn_at(*source.json, "",
                        fmt::format("{} values that are not finite or too large are replaced by {}", replaced, replacement[0]));
    }
    return values;
  }

  // Normals that have no direction become 0.
  std::vector<glm::vec3> normals() {
    const GltfAccessor source = accessor("NORMAL");
    std::vector<glm::vec3> values = accessors_.read<glm::vec3>(source, subset_);
    for (glm::vec3& n : values) n = is_bounded(n, kMaxPosition) && n != glm::vec3(0.0f) ? unit_vector(glm::dvec3(n)) : glm::vec3(0.0f);
    return values;
  }

  // Returns an empty list if a tangent has no direction.
  std::vector<glm::vec4> tangents() {
    std::vector<glm::vec4> values = bounded<glm::vec4>("TANGENT", kMaxPosition);
    for (glm::vec4& t : values) {
      const glm::dvec3 direction(t);
      const double length = glm::length(direction);
      if (length == 0.0) {
        document_.warn_at(attributes_, "TANGENT", "has tangents of length 0; all tangents are computed");
        return {};
      }
      t = glm::vec4(unit_vector(direction), t.w < 0.0f ? -1.0f : 1.0f);
    }
    return values;
  }

  std::vector<glm::vec4> colors() {
    std::vector<glm::vec4> values;
    const GltfAccessor source = accessor("COLOR_0");
    if (source.width == 3) {
      for (const glm::vec3& c : bounded<glm::vec3>("COLOR_0", kMaxPosition, glm::vec3(1.0f))) values.emplace_back(c, 1.0f);
    } else {
      values = bounded<glm::vec4>("COLOR_0", kMaxPosition, glm::vec4(1.0f));
    }
    for (glm::vec4& c : values) c = glm::clamp(c, 0.0f, 1.0f);
    return values;
  }

  std::vector<std::array<uint16_t, 4>> joints(const char* key) {
    const GltfAccessor source = accessor(key);
    const std::vector<uint32_t> numbers = accessors_.read_integers(source, 4, subset_);
    document_.take_memory(*source.json, numbers.size(), sizeof(uint16_t));
    std::vector<std::array<uint16_t, 4>> values(numbers.size() / 4);
    for (std::size_t i = 0; i < numbers.size(); ++i) {
      if (numbers[i] > 0xffff) document_.fail(*source.json, fmt::format("joint {} is out of range; expected at most 65535", numbers[i]));
      values[i / 4][i % 4] = static_cast<uint16_t>(numbers[i]);
    }
    return values;
  }

 private:
  GltfAccessors& accessors_;
  GltfDocument& document_;
  const GltfValue& attributes_;
  std::size_t count_;
  GltfSubset subset_;
};

// Normalizes the weights of every vertex to a sum of 1. Joints with zero weight become joint 0. A vertex without weights follows its first
// joint.
void normalize_weights(ModelMesh& mesh) {
  const auto sum_of = [](glm::vec4& w) {
    w = glm::max(w, glm::vec4(0.0f));
    return w.x + w.y + w.z + w.w;
  };
  const auto release = [](const glm::vec4& w, std::array<uint16_t, 4>& joints) {
    for (int k = 0; k < 4; ++k) {
      if (w[k] == 0.0f) joints[static_cast<std::size_t>(k)] = 0;
    }
  };
  const bool more = !mesh.more_weights.empty();
  for (std::size_t i = 0; i < mesh.weights.size(); ++i) {
    glm::vec4& w = mesh.weights[i];
    const float sum = sum_of(w) + (more ? sum_of(mesh.more_weights[i]) : 0.0f);
    w = sum > 0.0f ? w / sum : glm::vec4(1.0f, 0.0f, 0.0f, 0.0f);
    release(w, mesh.joints[i]);
    if (!more) continue;
    if (sum > 0.0f) mesh.more_weights[i] /= sum;
    release(mesh.more_weights[i], mesh.more_joints[i]);
  }
}

void read_skin_attributes(GltfDocument& document, VertexReader& reader, ModelMesh& mesh) {
  if (!reader.has("JOINTS_0") || !reader.has("WEIGHTS_0")) return;
  if (reader.has("JOINTS_2")) document.warn("more than eight joints per vertex are not supported; using the first eight");
  mesh.joints = reader.joints("JOINTS_0");
  mesh.weights = reader.bounded<glm::vec4>("WEIGHTS_0", 1e9f);
  if (reader.has("JOINTS_1") && reader.has("WEIGHTS_1")) {
    mesh.more_joints = reader.joints("JOINTS_1");
    mesh.more_weights = reader.bounded<glm::vec4>("WEIGHTS_1", 1e9f);
  }
  normalize_weights(mesh);
}

MorphTarget read_target(VertexReader reader, const ModelMesh& mesh) {
  MorphTarget target;
  if (reader.has("POSITION")) target.positions = reader.bounded<glm::vec3>("POSITION", kMaxPosition);
  if (reader.has("NORMAL") && !mesh.normals.empty()) target.normals = reader.bounded<glm::vec3>("NORMAL", kMaxPosition);
  if (reader.has("TANGENT") && !mesh.tangents.empty()) target.tangents = reader.bounded<glm::vec3>("TANGENT", kMaxPosition);
  return target;
}

}  // namespace

void read_vertices(GltfAccessors& accessors, const GltfValue& primitive, std::size_t count, GltfSubset subset,
                   const std::array<int, 2>& uv_sets, ModelMesh& mesh) {
  GltfDocument& document = accessors.document();
  VertexReader reader(accessors, document.object(primitive, "attributes"), count, subset);
  mesh.positions = reader.positions("POSITION");
  if (reader.has("NORMAL")) mesh.normals = reader.normals();
  if (reader.has("TANGENT") && !mesh.normals.empty()) mesh.tangents = reader.tangents();
  for (std::size_t i = 0; i < uv_sets.size(); ++i) {
    const std::string name = fmt::format("TEXCOORD_{}", uv_sets[i]);
    if (uv_sets[i] >= 0 && reader.has(name.c_str())) mesh.uvs[i] = reader.bounded<glm::vec2>(name.c_str(), kMaxTextureCoordinate);
  }
  if (reader.has("COLOR_0")) mesh.colors = reader.colors();
  read_skin_attributes(document, reader, mesh);
  const GltfValue& targets = document.objects(primitive, "targets");
  document.take_memory(targets, targets.size(), sizeof(MorphTarget));
  for (const GltfValue& target : targets) {
    for (auto attribute = target.begin(); attribute != target.end(); ++attribute) {
      if (attribute.key().starts_with("TEXCOORD_") || attribute.key().starts_with("COLOR_"))
        document.warn("morph targets of texture coordinates and vertex colors are not supported; they are ignored");
    }
    mesh.targets.push_back(read_target({accessors, target, count, subset}, mesh));
  }
}

}  // namespace halfspace::HS_LANES
