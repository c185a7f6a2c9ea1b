// SPDX-License-Identifier: Apache-2.0
#include "halfspace/model/text/file_bytes.h"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>
#include <string>
#include <string_view>

#include "halfspace/core/resource_limits.h"
#include "support/files.h"

namespace halfspace {
namespace {

class FileBytes : public testing::Test {
 protected:
  void SetUp() override { std::filesystem::create_directories(folder_); }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  std::string error_for(const std::filesystem::path& file, std::size_t max_bytes = 100) const {
    try {
      file_bytes(file, max_bytes);
    } catch (const InputError& e) {
      return e.what();
    }
    return "no error";
  }

  std::filesystem::path folder_ = std::filesystem::path(testing::TempDir()) / ("file_bytes." + std::to_string(::getpid()));
};

TEST_F(FileBytes, ReturnAllBytes) {
  const std::string_view text("a\0b\r\n\xff", 6);
  write_bytes(folder_ / "file", text);
  const std::vector<std::byte> bytes = file_bytes(folder_ / "file", 6);
  EXPECT_EQ(std::string_view(reinterpret_cast<const char*>(bytes.data()), bytes.size()), text);
}

TEST_F(FileBytes, OfAnEmptyFileAreEmpty) {
  write_bytes(folder_ / "empty", "");
  EXPECT_TRUE(file_bytes(folder_ / "empty", 0).empty());
}

TEST_F(FileBytes, AreLimited) {
  write_bytes(folder_ / "file", "123456");
  EXPECT_EQ(error_for(folder_ / "file", 5),
            (folder_ / "file").string() + ": has 6 bytes; expected at most 5, which the memory limit leaves for it (--max-memory)");
  EXPECT_THROW(file_bytes(folder_ / "file", 5), LimitError);
}

TEST_F(FileBytes, RejectNonRegularFiles) {
  EXPECT_EQ(error_for(folder_), folder_.string() + ": is a directory; expected a file");
  ASSERT_EQ(::mkfifo((folder_ / "pipe").c_str(), 0600), 0);
  EXPECT_NE(error_for(folder_ / "pipe").find("regular file"), std::string::npos);
  EXPECT_NE(error_for("/dev/null").find("regular file"), std::string::npos);
}

TEST_F(FileBytes, NameTheReasonWhyAFileCannotBeOpened) {
  EXPECT_EQ(error_for(folder_ / "none"), (folder_ / "none").string() + ": No such file or directory; expected a readable file");
  write_bytes(folder_ / "secret", "x");
  std::filesystem::permissions(folder_ / "secret", std::filesystem::perms::none);
  if (::geteuid() == 0) GTEST_SKIP() << "the superuser may read every file";
  EXPECT_NE(error_for(folder_ / "secret").find("Permission denied"), std::string::npos);
}

}  // namespace
}  // namespace halfspace
