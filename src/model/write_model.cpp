// SPDX-License-Identifier: Apache-2.0
#include "halfspace/model/write_model.h"

#include <string>

#include "halfspace/model/gltf/write_gltf.h"
#include "halfspace/model/obj/write_obj.h"
#include "halfspace/model/ply/write_ply.h"
#include "halfspace/model/stl/write_stl.h"

namespace halfspace::HS_LANES {

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

}  // namespace halfspace::HS_LANES
