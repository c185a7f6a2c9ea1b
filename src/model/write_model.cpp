// SPDX-License-Identifier: Apache-2.0
#include "halfspace/model/write_model.h"

#include <algorithm>
#include <cmath>

#include "halfspace/core/check.h"
#include "halfspace/model/write_formats.h"

namespace halfspace::inline HS_LANES_NAMESPACE {

std::optional<ModelFormat> model_format_of(const std::filesystem::path& file) {
  std::string extension = file.extension().string();
  for (char& c : extension) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  constexpr std::pair<const char*, ModelFormat> kFormats[] = {{".glb", ModelFormat::glb},
                                                              {".gltf", ModelFormat::gltf},
                                                              {".obj", ModelFormat::obj},
                                                              {".ply", ModelFormat::ply},
                                                              {".stl", ModelFormat::stl}};
  for (const auto& [name, format] : kFormats) {
    if (extension == name) return format;
  }
  return std::nullopt;
}

WrittenModel written_model(const Model& model, const std::filesystem::path& file, ModelFormat format) {
  const std::string stem = file.stem().string();
  WrittenModel written;
  switch (format) {
    case ModelFormat::glb: written = write_gltf(model, stem, true); break;
    case ModelFormat::gltf: written = write_gltf(model, stem, false); break;
    case ModelFormat::obj: written = write_obj(model, stem); break;
    case ModelFormat::ply: written = write_ply(model, stem); break;
    case ModelFormat::stl: written = write_stl(model, stem); break;
  }
  written.files[0].name = file.filename().string();
  return written;
}

std::string image_extension(std::span<const std::byte> image) {
  const std::string_view text(reinterpret_cast<const char*>(image.data()), image.size());
  if (text.starts_with("\x89PNG\r\n\x1a\n")) return ".png";
  return text.starts_with("\xff\xd8\xff") ? ".jpg" : "";
}

void append_text(std::vector<std::byte>& bytes, std::string_view text) {
  const auto* first = reinterpret_cast<const std::byte*>(text.data());
  bytes.insert(bytes.end(), first, first + text.size());
}

WorldMesh::WorldMesh(const Model& model, const PosedMesh& posed)
    : mesh_(posed.deformed ? posed.deformed.get() : &model.meshes[static_cast<std::size_t>(posed.mesh)]),
      material_(posed.material),
      world_from_mesh_(posed.world_from_mesh),
      normal_from_mesh_(1.0) {
  const glm::dmat3 linear(posed.world_from_mesh);
  turned_ = linear != glm::dmat3(1.0);
  const double determinant = glm::determinant(linear);
  mirrored_ = determinant < 0.0;
  if (turned_ && determinant != 0.0) normal_from_mesh_ = glm::transpose(glm::inverse(linear));
}

glm::dvec3 WorldMesh::position(std::size_t vertex) const {
  const glm::dvec3 p(mesh_->positions[vertex]);
  return turned_ ? glm::dvec3(world_from_mesh_ * glm::dvec4(p, 1.0)) : p + glm::dvec3(world_from_mesh_[3]);
}

glm::vec3 WorldMesh::normal(std::size_t vertex) const {
  const glm::vec3 n = mesh_->normals[vertex];
  if (!turned_) return n;
  const glm::dvec3 world = normal_from_mesh_ * glm::dvec3(n);
  const double length = std::sqrt(glm::dot(world, world));
  return length > 0.0 ? glm::vec3(world / length) : n;
}

uint32_t WorldMesh::corner(std::size_t triangle, std::size_t corner) const {
  return mesh_->indices[3 * triangle + (mirrored_ && corner > 0 ? 3 - corner : corner)];
}

}  // namespace halfspace::inline HS_LANES_NAMESPACE
