// SPDX-License-Identifier: Apache-2.0
//
// Reads all files in tests/fuzz/crashes: inputs that crashed a reader when they were found by a fuzz target, and small hostile files of
// each format that were written by hand. Each file must give a model that can be shown, or an InputError with a one-line message.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "fuzz/model_checks.h"
#include "fuzz/mtl_model.h"
#include "halfspace/model/text/file_bytes.h"
#include "support/files.h"
#include "support/sanitized.h"

namespace halfspace {
namespace {

std::vector<std::filesystem::path> crash_files() {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator("tests/fuzz/crashes")) files.push_back(entry.path());
  std::ranges::sort(files);
  return files;
}

Model read_any(const std::filesystem::path& file) {
  ReadModelOptions options;
  options.max_memory = std::size_t{256} << 20;  // as in the fuzz targets
  if (file.extension() != ".mtl") return read_model(file, options);
  return read_mtl_model(file, file_bytes(file, options.max_memory), options);
}

TEST(FuzzCrashes, GiveAModelOrAOneLineError) {
  std::map<std::string, int> files;
  for (const std::filesystem::path& file : crash_files()) {
    SCOPED_TRACE(file);
    const auto start = std::chrono::steady_clock::now();
    accept_input_error([&] {
      const Model model = read_any(file);
      check_model(model);
      check_poses(model);
    });
    // The limit of the fuzz targets for one input. Usually it takes milliseconds. Sanitizers slow the program down.
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
    EXPECT_LT(seconds.count(), kSanitized ? 100.0 : 10.0);
    ++files[file.extension().string()];
  }
  for (const char* format : {".obj", ".mtl", ".gltf", ".glb", ".ply", ".stl"}) EXPECT_GT(files[format], 0) << format;
}

}  // namespace
}  // namespace halfspace
