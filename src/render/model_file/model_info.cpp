// SPDX-License-Identifier: Apache-2.0
#include "halfspace/render/model_file/model_info.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <unordered_map>

#include "halfspace/core/check.h"
#include "halfspace/core/resource_limits.h"
#include "halfspace/core/text.h"
#include "halfspace/image/image_size.h"
#include "halfspace/model/geometry/position_ids.h"
#include "halfspace/model/model.h"
#include "halfspace/model/pose/pose.h"
#include "halfspace/model/up_axis_hint.h"
#include "halfspace/model/used_images.h"
#include "halfspace/scene/scene_file.h"

namespace halfspace::HS_LANES {

namespace {

using OrderedJson = nlohmann::ordered_json;

// Counts of triangles and edges that other programs may handle differently.
struct Problems {
  std::size_t degenerate_triangles = 0;  // without area
  std::size_t open_edges = 0;            // used by one triangle
  std::size_t non_manifold_edges = 0;    // used by more than two triangles
};

void count_problems(const ModelMesh& mesh, Problems& problems) {
  const std::vector<uint32_t> number = position_ids(mesh.positions);
  std::unordered_map<uint64_t, int> edges;
  for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
    const std::array<uint32_t, 3> corner{number[mesh.indices[i]], number[mesh.indices[i + 1]], number[mesh.indices[i + 2]]};
    const glm::dvec3 origin(mesh.positions[corner[0]]);
    const glm::dvec3 side = glm::dvec3(mesh.positions[corner[1]]) - origin, other = glm::dvec3(mesh.positions[corner[2]]) - origin;
    if (glm::cross(side, other) == glm::dvec3(0.0)) {
      ++problems.degenerate_triangles;
      continue;
    }
    for (std::size_t k = 0; k < 3; ++k) {
      const uint64_t a = std::min(corner[k], corner[(k + 1) % 3]), b = std::max(corner[k], corner[(k + 1) % 3]);
      ++edges[a << 32 | b];
    }
  }
  for (const auto& [edge, uses] : edges) {
    if (uses == 1) ++problems.open_edges;
    if (uses > 2) ++problems.non_manifold_edges;
  }
}

std::size_t info_primitive_count(const Model& model, MeshTopology topology, int corners) {
  std::size_t count = 0;
  for (const ModelMesh& mesh : model.meshes) {
    const std::size_t used = mesh.indices.empty() ? mesh.positions.size() : mesh.indices.size();
    if (mesh.topology == topology) count += used / static_cast<std::size_t>(corners);
  }
  return count;
}

template <class T>
std::vector<std::string> item_names(const std::vector<T>& list) {
  std::vector<std::string> names;
  for (const T& item : list) names.push_back(item.name);
  return names;
}

// Returns, for each image, whether a material uses it or an image that it is converted to.
std::vector<bool> needed_images(const Model& model) {
  std::vector<bool> needed = used_images(model);
  for (std::size_t i = 0; i < model.images.size(); ++i) {
    const std::optional<SpecularGlossiness>& converted = model.images[i].converted;
    if (!converted || !needed[i]) continue;
    for (const int texture : {converted->diffuse_texture, converted->specular_texture}) {
      const int source = texture < 0 ? -1 : model.textures[static_cast<std::size_t>(texture)].image;
      if (source >= 0) needed[static_cast<std::size_t>(source)] = true;
    }
  }
  return needed;
}

// Returns the number of textures in the file. The reader adds one for each image that it converts.
std::size_t texture_count(const Model& model) {
  return static_cast<std::size_t>(std::ranges::count_if(model.textures, [&](const ModelTexture& texture) {
    return texture.image < 0 || !model.images[static_cast<std::size_t>(texture.image)].converted;
  }));
}

// Describes the images. The size is null if an image cannot be read, or if its reader did not read it because no material uses it.
OrderedJson image_facts(Model& model) {
  OrderedJson list = OrderedJson::array();
  const std::vector<bool> used = needed_images(model);
  for (std::size_t i = 0; i < model.images.size(); ++i) {
    const ModelImage& image = model.images[i];
    if (image.converted) continue;  // not in the file
    OrderedJson json = {{"name", image.name},
                        {"width", nullptr},
                        {"height", nullptr},
                        {"embedded", image.bytes != nullptr},
                        {"used", used[i] || image.missing}};
    try {
      if (image.bytes != nullptr || !image.file.empty()) {
        const ImageSize size = image.bytes ? image_size(*image.bytes, image.name) : image_size(image.file);
        json["width"] = size.width;
        json["height"] = size.height;
      }
    } catch (const LimitError&) {
      throw;
    } catch (const InputError& e) {
      model.warnings.emplace_back(e.what());
    }
    list.push_back(std::move(json));
  }
  return list;
}

// Returns true if the name is that of a shipped scene, or of a JSON file that begins like a scene file.
bool is_scene(const std::string& name) {
  std::error_code error;
  if (!std::filesystem::exists(name, error))
    return std::ranges::any_of(shipped_scenes(), [&](const ShippedScene& scene) { return scene.name == name; });
  constexpr std::uintmax_t kMaxBytes = std::uintmax_t{4} << 20;  // as for scene files
  if (!std::filesystem::is_regular_file(name, error) || std::filesystem::file_size(name, error) > kMaxBytes) return false;
  std::ifstream file(name, std::ios::binary);
  const nlohmann::json json = nlohmann::json::parse(file, nullptr, false, true);
  return json.is_object() && json.contains("version") && !json.contains("asset");
}

// Reads the model. An error in a scene names the command for scenes.
Model read_described_model(const std::filesystem::path& file, bool allow_outside) {
  try {
    return read_model(file, {.allow_outside = allow_outside});
  } catch (const InputError&) {
    if (!is_scene(file.string())) throw;
    throw InputError(
        fmt::format("{0}: is a scene; expected a model file (use 'halfspace list {0}' to list the keys of the scene)", file.string()));
  }
}

// Returns the text of a list item: its name, and its size if it is an image.
std::string info_item_text(const OrderedJson& item) {
  const std::string name = (item.is_object() ? item.at("name") : item).get<std::string>();
  const std::string shown = name.empty() ? "(no name)" : name;
  if (!item.is_object()) return shown;
  const bool used = item.at("used").get<bool>();
  if (item.at("width").is_null()) return shown + (used ? " (unreadable)" : " (unused)");
  return fmt::format("{} ({}x{}{})", shown, item.at("width").get<int>(), item.at("height").get<int>(), used ? "" : ", unused");
}

std::string info_value_text(const std::string& key, const OrderedJson& value) {
  if (value.is_null()) return "none";
  if (key == "bounds") {
    const auto corner = [&](const char* name) {
      const OrderedJson& c = value.at(name);
      return fmt::format("({:.6g}, {:.6g}, {:.6g})", c[0].get<double>(), c[1].get<double>(), c[2].get<double>());
    };
    return corner("low") + " to " + corner("high");
  }
  if (value.is_string()) return value.get<std::string>();
  if (!value.is_array()) return value.dump();
  std::string names;
  for (const OrderedJson& item : value) names += (names.empty() ? "" : ", ") + info_item_text(item);
  return value.empty() ? "0" : fmt::format("{}: {}", value.size(), names);
}

}  // namespace

nlohmann::ordered_json model_info(const std::filesystem::path& file, bool allow_outside, std::optional<UpAxis> up) {
  Model model = read_described_model(file, allow_outside);
  const std::string hint = up ? std::string() : up_axis_hint(model);
  model.up = up.value_or(model.up);
  const PosedModel posed = pose(model, {});
  std::size_t vertices = 0;
  Problems problems;
  for (const ModelMesh& mesh : model.meshes) {
    vertices += mesh.positions.size();
    if (mesh.topology == MeshTopology::triangles) count_problems(mesh, problems);
  }
  OrderedJson json = {{"file", file.string()},
                      {"format", model.format},
                      {"up_axis", model.up == UpAxis::z ? "z" : "y"},
                      {"meshes", model.meshes.size()},
                      {"vertices", vertices},
                      {"triangles", info_primitive_count(model, MeshTopology::triangles, 3)},
                      {"lines", info_primitive_count(model, MeshTopology::lines, 2)},
                      {"points", info_primitive_count(model, MeshTopology::points, 1)},
                      {"nodes", model.nodes.size()},
                      {"drawn_meshes", posed.meshes.size()}};
  const auto vector = [](const glm::dvec3& v) { return OrderedJson{v.x, v.y, v.z}; };
  json["bounds"] =
      posed.low.x <= posed.high.x ? OrderedJson{{"low", vector(posed.low)}, {"high", vector(posed.high)}} : OrderedJson(nullptr);
  json["materials"] = item_names(model.materials);
  json["textures"] = texture_count(model);
  json["images"] = image_facts(model);
  json["cameras"] = item_names(model.cameras);
  json["lights"] = item_names(model.lights);
  json["scenes"] = item_names(model.scenes);
  json["animations"] = item_names(model.animations);
  json["variants"] = model.variants;
  json["extensions"] = model.extensions;
  json["unsupported_extensions"] = model.unsupported_extensions;
  json["meshes_without_normals"] = std::ranges::count_if(model.meshes, &ModelMesh::computed_normals);
  json["degenerate_triangles"] = problems.degenerate_triangles;
  json["open_edges"] = problems.open_edges;
  json["non_manifold_edges"] = problems.non_manifold_edges;
  if (!hint.empty()) json["hint"] = hint;
  json["warnings"] = model.warnings;
  return json;
}

std::string model_info_text(const nlohmann::ordered_json& info) {
  std::string text;
  for (const auto& [key, value] : info.items()) {
    if (key == "warnings") {
      for (const OrderedJson& warning : value) text += "warning: " + printable(warning.get<std::string>()) + "\n";
      continue;
    }
    if (key == "hint") {
      text += "hint: " + value.get<std::string>() + "\n";
      continue;
    }
    std::string label = key;
    std::ranges::replace(label, '_', ' ');
    text += fmt::format("{:<24}{}\n", label, printable(info_value_text(key, value)));
  }
  return text;
}

}  // namespace halfspace::HS_LANES
