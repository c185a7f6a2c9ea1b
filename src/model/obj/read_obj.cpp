// SPDX-License-Identifier: Apache-2.0
#include "halfspace/model/obj/read_obj.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <numeric>
#include <set>

#include "halfspace/core/resource_limits.h"
#include "halfspace/model/geometry/single_mesh.h"
#include "halfspace/model/obj/mtl_materials.h"
#include "halfspace/model/obj/obj_meshes.h"
#include "halfspace/model/obj/obj_text.h"
#include "halfspace/model/obj/read_mtl.h"
#include "halfspace/model/text/file_bytes.h"
#include "halfspace/model/text/references.h"
#include "halfspace/model/text/text_lines.h"

namespace halfspace::HS_LANES {

namespace {

// Parsing a typical file needs up to 8 times its size.
constexpr std::size_t kMemoryPerByte = 8;
constexpr std::size_t kMaxBytes = 0xffffffffu;

std::string_view text_of(std::span<const std::byte> bytes) { return {reinterpret_cast<const char*>(bytes.data()), bytes.size()}; }

// If the file has no elements, its vertices are a point cloud.
void add_points(ObjText& obj, std::vector<std::string>& warnings) {
  obj.states.push_back({MeshTopology::points, -1, 0, "points"});
  obj.elements.push_back({0, static_cast<uint32_t>(obj.states.size() - 1)});
  for (uint32_t i = 0; i < obj.positions.size(); ++i) {
    if (is_finite(obj.positions[i])) obj.corners.push_back({i, kNoIndex, kNoIndex});
  }
  if (obj.corners.empty()) throw InputError("no vertex has finite coordinates; expected at least one");
  if (const std::size_t skipped = obj.positions.size() - obj.corners.size(); skipped > 0)
    warnings.push_back(fmt::format("{} points with coordinates that are not finite; skipped", skipped));
}

// The material libraries of an OBJ file.
class Libraries {
 public:
  Libraries(const std::filesystem::path& file, const ReadModelOptions& options, std::vector<std::string>& warnings)
      : file_(file), options_(options), warnings_(warnings) {}

  // names: one file name that may contain spaces, or several names.
  void add(std::string_view names) {
    if (read_quietly(names)) return;
    std::vector<std::string_view> missing;
    std::string_view rest = names;
    std::size_t count = 0;
    for (std::string_view name = take_word(rest); !name.empty() && count < kMaxNames; name = take_word(rest), ++count) {
      if (!read_quietly(name)) missing.push_back(name);
    }
    if (missing.empty()) return;
    if (missing.size() == count) missing = {names};
    missing_ = true;
    References references(file_, options_.allow_outside, warnings_);
    for (const std::string_view name : missing) references.find(without_quotes(name), kWhat);  // only for the warning
  }

  /// Returns the first definition of a material, or null.
  const MtlMaterial* find(const std::string& name) const {
    const auto known = numbers_.find(name);
    return known == numbers_.end() ? nullptr : &materials_[known->second];
  }

  bool missing() const { return missing_; }
  const std::vector<std::filesystem::path>& files() const { return files_; }

 private:
  static constexpr std::string_view kWhat = "material library";
  static constexpr std::size_t kMaxNames = 64;

  // Returns false without a warning if the file is not found.
  bool read_quietly(std::string_view name) {
    std::vector<std::string> notes;
    const auto path = References(file_, options_.allow_outside, notes).find(without_quotes(name), kWhat);
    if (!path) return false;
    warnings_.insert(warnings_.end(), notes.begin(), notes.end());
    read(*path);
    return true;
  }

  void read(const std::filesystem::path& path) {
    std::vector<std::byte> bytes;
    try {
      bytes = file_bytes(path, options_.memory_left() / kMemoryPerByte);
    } catch (const LimitError&) {
      throw;
    } catch (const InputError& e) {
      warnings_.emplace_back(e.what());
      missing_ = true;
      return;
    }
    files_.push_back(path);
    std::error_code ignored;
    const std::filesystem::path model_folder = std::filesystem::absolute(file_, ignored).parent_path();
    const std::filesystem::path folder = path.parent_path().lexically_relative(model_folder.lexically_normal());
    for (MtlMaterial& material : parse_mtl(path.filename().string(), text_of(without_byte_order_mark(bytes)), warnings_)) {
      if (!numbers_.try_emplace(material.name, materials_.size()).second) continue;
      material.folder = folder == "." ? std::string() : folder.generic_string();
      materials_.push_back(std::move(material));
    }
  }

  const std::filesystem::path& file_;
  const ReadModelOptions& options_;
  std::vector<std::string>& warnings_;
  std::vector<MtlMaterial> materials_;
  std::map<std::string, std::size_t> numbers_;
  std::vector<std::filesystem::path> files_;
  bool missing_ = false;
};

// Looks up the materials of all states and replaces their numbers with indices into the returned list. All undefined materials and all
// elements without a material share one entry, which is null.
std::vector<const MtlMaterial*> resolve_materials(ObjText& obj, const Libraries& libraries, std::vector<std::string>& warnings) {
  std::vector<const MtlMaterial*> used;
  std::map<const MtlMaterial*, int> numbers;
  std::set<int> undefined;
  std::string first;
  for (ObjState& state : obj.states) {
    const MtlMaterial* mtl = nullptr;
    if (state.material >= 0) {
      const std::string& name = obj.materials[static_cast<std::size_t>(state.material)];
      mtl = libraries.find(name);
      if (undefined.empty()) first = name;
      if (mtl == nullptr) undefined.insert(state.material);
    }
    const auto [known, added] = numbers.try_emplace(mtl, static_cast<int>(used.size()));
    if (added) used.push_back(mtl);
    state.material = known->second;
  }
  if (!undefined.empty() && !libraries.missing()) {
    warnings.push_back(fmt::format("no material library defines {}{}; drawn in gray", in_quotes(first),
                                   undefined.size() > 1 ? fmt::format(" and {} other materials", undefined.size() - 1) : ""));
  }
  return used;
}

}  // namespace

Model read_obj(const std::filesystem::path& file, std::span<const std::byte> bytes, const ReadModelOptions& options) {
  if (bytes.size() > kMaxBytes)
    throw InputError(fmt::format("{}: has {} bytes; expected at most {}", file.string(), bytes.size(), kMaxBytes));
  if (bytes.size() > options.memory_left() / kMemoryPerByte) {
    throw InputError(
        fmt::format("{}: {}", file.string(), memory_problem(bytes.size() * kMemoryPerByte, options.memory_in_use, options.max_memory)));
  }
  Model model;
  model.format = "OBJ";
  ObjText obj = parse_obj(file, text_of(bytes), model.warnings);
  if (obj.positions.empty())
    throw InputError(fmt::format("{}: no vertices; expected an OBJ file with `v` and `f` statements", file.string()));
  if (obj.elements.empty()) {
    model.warnings.emplace_back("no faces, lines or points; the vertices are drawn as points");
    try {
      add_points(obj, model.warnings);
    } catch (const InputError& e) {
      throw InputError(fmt::format("{}: {}", file.string(), e.what()));
    }
  }
  Libraries libraries(file, options, model.warnings);
  for (const std::string& names : obj.libraries) libraries.add(names);
  model.files = libraries.files();
  const std::vector<const MtlMaterial*> materials = resolve_materials(obj, libraries, model.warnings);
  ObjMeshes built = obj_meshes(obj, options.crease_degrees);
  model.meshes = std::move(built.meshes);
  MtlConverter converter(model, file, options, built.diagonal);
  const ModelMaterial gray = default_model_material(!obj.colors.empty());
  for (const MtlMaterial* const mtl : materials) model.materials.push_back(mtl == nullptr ? gray : converter.convert(*mtl));
  ModelNode& node = model.nodes.emplace_back();
  node.name = file.stem().string();
  node.meshes.resize(model.meshes.size());
  std::iota(node.meshes.begin(), node.meshes.end(), 0);
  model.scenes.push_back({"", {0}});
  return model;
}

}  // namespace halfspace::HS_LANES
