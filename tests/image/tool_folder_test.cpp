// SPDX-License-Identifier: Apache-2.0
//
// Tests where the library looks for the decoders.
#include <gtest/gtest.h>

#include "halfspace/core/check.h"
#include "halfspace/image/image_io.h"
#include "halfspace/image/image_tool.h"
#include "image/image_fixture.h"
#include "support/files.h"
#include "support/temporary_folder.h"

namespace halfspace {
namespace {

class ToolFolder : public ImageToolTest {
 protected:
  void TearDown() override { set_tool_folder({}); }
};

TEST_F(ToolFolder, DefaultsToTheFolderOfTheProgram) {
  EXPECT_EQ(find_image_tool().parent_path(), std::filesystem::canonical("/proc/self/exe").parent_path());
}

TEST_F(ToolFolder, CanBeSet) {
  const std::filesystem::path tool = find_image_tool();
  const TemporaryFolder folder;
  const std::filesystem::path link = folder.path() / tool.filename();
  std::filesystem::create_symlink(tool, link);
  set_tool_folder(folder.path());
  EXPECT_EQ(find_image_tool(), link);
  EXPECT_TRUE(find_jpeg_tool().empty()) << "the default folder was searched";
  set_tool_folder({});
  EXPECT_EQ(find_image_tool(), tool);
}

TEST_F(ToolFolder, MissingDecodersAreReportedInOneLine) {
  set_tool_folder("/nowhere");
  const TemporaryFolder folder;
  const std::filesystem::path file = folder.path() / "picture.tif";
  write_bytes(file, std::string("II*\0", 4) + std::string(100, '\0'));
  try {
    read_image(file);
    FAIL() << "the file was read";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("is not installed"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace halfspace
