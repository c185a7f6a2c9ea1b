// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <string_view>

#include "halfspace/core/check.h"
#include "halfspace/core/float_mode.h"
#include "halfspace/model/gltf/read_gltf.h"
#include "halfspace/model/model.h"
#include "halfspace/model/obj/read_obj.h"
#include "halfspace/model/ply/read_ply.h"
#include "halfspace/model/stl/read_stl.h"
#include "halfspace/model/stl/stl_triangles.h"
#include "halfspace/model/text/file_bytes.h"
#include "halfspace/model/text/text_lines.h"

namespace halfspace::HS_LANES {

namespace {

using Reader = Model (*)(const std::filesystem::path&, std::span<const std::byte>, const ReadModelOptions&);

std::string lower_extension(const std::filesystem::path& file) {
  std::string extension = file.extension().string();
  std::ranges::transform(extension, extension.begin(), [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c | 0x20) : c; });
  return extension;
}

/// Returns true if a line near the beginning is a vertex or a face.
bool looks_like_obj(std::string_view text) {
  TextLines lines(text.substr(0, 65536));
  while (lines.next()) {
    std::string_view rest = lines.line();
    const std::string_view keyword = take_word(rest);
    if ((keyword == "v" || keyword == "f") && number_in(take_word(rest).substr(0, 1))) return true;
  }
  return false;
}

Reader reader_by_contents(std::span<const std::byte> bytes, std::string_view text) {
  if (text.starts_with("glTF")) return read_gltf;
  if (text.starts_with("ply\n") || text.starts_with("ply\r")) return read_ply;
  if (is_binary_stl(bytes)) return read_stl;
  const std::size_t begin = text.find_first_not_of(" \t\r\n");
  if (begin != std::string_view::npos && text[begin] == '{') return read_gltf;
  return is_text_stl(text) ? read_stl : nullptr;
}

Reader reader_by_extension(const std::string& extension) {
  if (extension == ".obj") return read_obj;
  if (extension == ".gltf" || extension == ".glb") return read_gltf;
  if (extension == ".ply") return read_ply;
  if (extension == ".stl") return read_stl;
  return nullptr;
}

/// Returns true if the bytes begin with a byte order mark of UTF-16.
bool is_utf16(std::string_view text) { return text.starts_with("\xff\xfe") || text.starts_with("\xfe\xff"); }

Reader reader_of(const std::filesystem::path& file, std::span<const std::byte> bytes) {
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  const std::string extension = lower_extension(file);
  if (const Reader reader = reader_by_contents(bytes, text)) return reader;
  if (is_utf16(text)) throw InputError(fmt::format("{}: the text is UTF-16; expected UTF-8 or ASCII", file.string()));
  if (const Reader reader = reader_by_extension(extension)) return reader;
  if (looks_like_obj(text)) return read_obj;
  throw InputError(fmt::format("{}: unknown model format; expected glTF (.gltf, .glb), OBJ, PLY or STL", file.string()));
}

/// Replaces the memory limit by that of the process if the latter leaves less, because other models and images are in memory.
ReadModelOptions within_limits(const ReadModelOptions& options) {
  ReadModelOptions process = options;
  process.max_memory = static_cast<std::size_t>(resource_limits().max_memory);
  process.memory_in_use = static_cast<std::size_t>(memory_in_use());
  return process.memory_left() < options.memory_left() ? process : options;
}

}  // namespace

std::vector<std::filesystem::path> files_of(const Model& model) {
  std::vector<std::filesystem::path> files = model.files;
  for (const ModelImage& image : model.images) {
    if (!image.file.empty()) files.push_back(image.file);
  }
  return files;
}

Model read_model(const std::filesystem::path& file, const ReadModelOptions& options) {
  const FloatMode float_mode;
  const ReadModelOptions limited = within_limits(options);
  const std::vector<std::byte> bytes = file_bytes(file, limited.memory_left());
  if (bytes.empty()) throw InputError(fmt::format("{}: the file is empty; expected a glTF, OBJ, PLY or STL file", file.string()));
  const std::span<const std::byte> contents = without_byte_order_mark(bytes);
  return reader_of(file, contents)(file, contents, limited);
}

}  // namespace halfspace::HS_LANES
