// SPDX-License-Identifier: Apache-2.0
//
// Shared by the fuzz targets for model files (libFuzzer). A target passes its input to one reader, which must return a model or throw an
// InputError with a one-line message. The model is then posed at several times and shown by a fitted camera, as `halfspace render` does.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>

#include "fuzz/model_checks.h"
#include "support/files.h"
#include "support/temporary_folder.h"

namespace halfspace {

inline constexpr std::size_t kMaxFuzzBytes = std::size_t{64} << 10;

/// Returns the folder of the model. It contains files that inputs can refer to: the image `a.png` (not decoded), the material library
/// `a.mtl` and the buffer `a.bin`, 4096 zeros.
inline const std::filesystem::path& fuzz_folder() {
  static const TemporaryFolder folder;
  static const bool written = [] {
    write_bytes(folder.path() / "a.png", "no image");
    write_bytes(folder.path() / "a.mtl", "newmtl a\nKd 1 0 0\nmap_Kd -s 2 2 a.png\nmap_bump -bm 2 a.png\nnewmtl b\nd 0.5\nPr 0.1\nPm 1\n");
    write_bytes(folder.path() / "a.bin", std::string(4096, '\0'));
    return true;
  }();
  (void)written;
  return folder.path();
}

/// Reads one input and uses the model. Only an InputError is accepted; other exceptions end the process.
template <class Reader>
int fuzz_model(Reader&& reader, const char* name, const uint8_t* data, std::size_t size) {
  if (size > kMaxFuzzBytes) return -1;
  ReadModelOptions options;
  options.max_memory = std::size_t{256} << 20;
  accept_input_error([&] {
    const Model model = reader(fuzz_folder() / name, std::as_bytes(std::span(data, size)), options);
    check_model(model);
    check_poses(model);
  });
  return 0;
}

}  // namespace halfspace
