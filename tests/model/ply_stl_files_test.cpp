// SPDX-License-Identifier: Apache-2.0
//
// Reads all PLY and STL files in ../shared/data, including damaged ones.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <string>
#include <vector>

#include "halfspace/model/model.h"
#include "support/errors.h"
#include "support/files.h"

namespace halfspace {
namespace {

std::vector<std::filesystem::path> files_in(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    std::string extension = entry.path().extension().string();
    std::ranges::transform(extension, extension.begin(), [](char c) { return static_cast<char>(c | 0x20); });
    if (extension == ".ply" || extension == ".stl") files.push_back(entry.path());
  }
  std::ranges::sort(files);
  return files;
}

TEST(ModelFiles, GoodPlyAndStlFilesAreRead) {
  const std::filesystem::path folder = shared_data("meshes");
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << absent(folder);
  for (const std::filesystem::path& file : files_in(folder)) {
    const Model model = read_model(file);
    EXPECT_FALSE(model.meshes.at(0).indices.empty()) << file;
    EXPECT_TRUE(model.warnings.empty()) << file;
  }
}

TEST(ModelFiles, BrokenPlyAndStlFilesGiveAModelOrAOneLineError) {
  const std::filesystem::path folder = shared_data("broken");
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << absent(folder);
  int rejected = 0, read = 0;
  for (const std::filesystem::path& file : files_in(folder)) {
    const std::string message = input_error([&] { read_model(file); });
    const bool good = message == "(no error)";
    EXPECT_TRUE(good || reports(message, file.string() + ": ", {"expected"})) << message;
    (good ? read : rejected) += 1;
  }
  std::printf("%d models, %d rejected\n", read, rejected);
}

}  // namespace
}  // namespace halfspace
