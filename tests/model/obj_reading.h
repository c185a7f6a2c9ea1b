// SPDX-License-Identifier: Apache-2.0
//
// Reads OBJ text that is given in a test.
#pragma once

#include <string>
#include <string_view>

#include "halfspace/model/obj/read_obj.h"
#include "support/files.h"
#include "support/temporary_folder.h"

namespace halfspace {

inline Model read_obj_text(std::string_view text, const ReadModelOptions& options = {}, const std::filesystem::path& file = "/none/a.obj") {
  return read_obj(file, std::as_bytes(std::span(text)), options);
}

/// Reads a triangle with the material `m` from a library with this text. Files that the library names must be in the folder.
inline Model read_mtl_text(const TemporaryFolder& folder, std::string_view mtl) {
  write_bytes(folder.path() / "a.mtl", mtl);
  return read_obj_text("mtllib a.mtl\nv 0 0 0\nv 3 0 0\nv 0 4 0\nusemtl m\nf 1 2 3\n", {}, folder.path() / "a.obj");
}

}  // namespace halfspace
