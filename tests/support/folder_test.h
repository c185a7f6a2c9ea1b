// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <iterator>
#include <string>
#include <string_view>

#include "support/errors.h"
#include "support/files.h"
#include "support/temporary_folder.h"

namespace halfspace {

/// Base class of tests that need a temporary folder.
class FolderTest : public testing::Test {
 protected:
  std::size_t file_count() const {
    return static_cast<std::size_t>(std::distance(std::filesystem::directory_iterator(directory), std::filesystem::directory_iterator()));
  }
  std::filesystem::path put(const std::string& name, std::string_view bytes) const {
    write_bytes(directory / name, bytes);
    return directory / name;
  }

 private:
  const TemporaryFolder folder_;

 protected:
  const std::filesystem::path& directory = folder_.path();
};

}  // namespace halfspace
