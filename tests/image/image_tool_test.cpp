// SPDX-License-Identifier: Apache-2.0
//
// Behavior when a decoder program is missing, crashes or sends invalid data. The programs are looked up in the directory of the running
// program, so these tests run a copy of the test program in a temporary directory, next to a script that replaces the tool.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <glm/glm.hpp>
#include <iterator>
#include <span>
#include <sstream>
#include <string>
#include <utility>

#include "halfspace/core/resource_limits.h"
#include "halfspace/image/image_io.h"
#include "halfspace/image/image_tool.h"
#include "image/image_fixture.h"

namespace halfspace {
namespace {

namespace fs = std::filesystem;

// Returns the message of the error with which a file cannot be read, and whether it is one of a limit.
std::string reading_error(const char* file) {
  try {
    read_image(file);
  } catch (const LimitError& e) {
    return std::string(e.what()) + " (limit)";
  } catch (const InputError& e) {
    return e.what();
  }
  return {};
}

// The copy runs only this test. It writes the error messages to the file "lines" in the working directory.
TEST(ImageToolCopy, DISABLED_WritesAndReads) {
  const Image<glm::u8vec4> codes(400, 300);
  const Image<glm::vec4> light(400, 300);
  std::ofstream("a.ppm") << "P6 1 1 255\nabc";
  std::ofstream("b.jpg") << "\xff\xd8\xff\xe0 and so on";
  std::ofstream lines("lines");
  lines << output_error([&] { write_image("a.tif", codes); }) << '\n'
        << output_error([&] { write_image("a.hdr", light); }) << '\n'
        << reading_error("a.ppm") << '\n'
        << reading_error("b.jpg") << '\n'
        << (fs::exists("a.tif") || fs::exists("a.hdr") ? "something was written" : "nothing was written") << '\n';
}

class ImageTool : public FolderTest {
 protected:
  // Runs a copy of this program in a folder in which the script takes the place of both tools, and returns the lines that it writes. If
  // the script is empty, there are no tools.
  std::string lines_beside(const std::string& script) const {
    const fs::path copy = directory / "test";
    fs::copy_file("/proc/self/exe", copy);
    for (const char* name : {kImageToolName, kJpegToolName}) {
      if (!script.empty()) fs::permissions(put(name, "#!/bin/sh\n" + script + "\n"), fs::perms::owner_all);
    }
    const pid_t child = ::fork();
    if (child == 0) {
      const int nothing = ::open("/dev/null", O_WRONLY);
      if (::chdir(directory.c_str()) != 0 || ::dup2(nothing, STDOUT_FILENO) < 0) ::_exit(99);
      // ctest runs this program in parts, but the copy has only one test to run.
      for (const char* variable : {"GTEST_TOTAL_SHARDS", "GTEST_SHARD_INDEX"}) ::unsetenv(variable);
      ::execl(copy.c_str(), copy.c_str(), "--gtest_filter=ImageToolCopy.*", "--gtest_also_run_disabled_tests", nullptr);
      ::_exit(99);
    }
    int status = -1;
    ::waitpid(child, &status, 0);
    EXPECT_EQ(status, 0);
    return read_bytes(directory / "lines");
  }
};

// Expects that both writes failed for the first reason, both reads failed for the second, and no file was left behind.
void expect_failures(const std::string& message, const std::string& of_writing, const std::string& of_reading) {
  std::istringstream lines(message);
  std::string line;
  const std::pair<const char*, std::string> expected[] = {
      {"a.tif: cannot write", of_writing}, {"a.hdr: cannot write", of_writing}, {"a.ppm: ", of_reading}, {"b.jpg: ", of_reading}};
  for (const auto& [place, reason] : expected) {
    ASSERT_TRUE(std::getline(lines, line)) << message;
    EXPECT_TRUE(reports(line, place, {reason}));
  }
  std::getline(lines, line);
  EXPECT_EQ(line, "nothing was written");
  EXPECT_FALSE(std::getline(lines, line)) << message;
}

TEST_F(ImageTool, ReportsAMissingTool) { expect_failures(lines_beside(""), "not installed", "not installed"); }

TEST_F(ImageTool, ReportsACrash) { expect_failures(lines_beside("kill -SEGV $$"), "died: Segmentation fault", "died: Segmentation fault"); }

// The system may kill a decoder when memory runs out. That is not the fault of the file, which must not be left out of a picture.
TEST_F(ImageTool, AKilledDecoderIsAnErrorOfALimit) {
  expect_failures(lines_beside("kill -KILL $$"), "died: Killed", "the decoder was killed; expected enough free memory for it (limit)");
}

TEST_F(ImageTool, ReportsATruncatedAnswer) {
  // The script reads a request and sends the beginning of a valid 100-byte answer.
  const std::string script = "head -c 40 >/dev/null; printf 'HIT4\\0\\0\\0\\0\\144\\0\\0\\0\\0\\0\\0\\0 and so on'";
  expect_failures(lines_beside(script), "ended early", "ended early");
}

TEST_F(ImageTool, ReportsAnotherProtocolVersion) {
  const std::string script = "head -c 40 >/dev/null; printf 'HIT0 some other protocol, of which nothing is known'";
  expect_failures(lines_beside(script), "different version", "different version");
}

TEST_F(ImageTool, RejectsAnswersWithHugeSizes) {
  // A file of 2^63 bytes; an image with a width of 2^31 − 1 pixels. Byte 4 of a request is the task; 2 is writing.
  const std::string script =
      "case $(head -c 40 | od -An -tu1 -j4 -N1 | tr -d ' ') in 2) printf 'HIT4\\0\\0\\0\\0\\0\\0\\0\\0\\0\\0\\0\\200';; "
      "*) printf 'HIT4\\377\\377\\377\\177\\1\\0\\0\\0\\4\\0\\0\\0\\0\\0\\0\\0\\0\\0\\0\\0';; esac";
  expect_failures(lines_beside(script), "different version", "2147483647x1");
}

TEST_F(ImageTool, ReportsUnsupportedFormatsAndHeaders) {
  if (find_image_tool().empty()) GTEST_SKIP() << kNoImageTool;
  PictureHeader header;
  header.width = 4000;
  header.height = 3000;
  header.channels = 3;
  const auto black = [](int, std::span<std::byte> row) { std::ranges::fill(row, std::byte{0}); };
  EXPECT_TRUE(
      reports(output_error([&] { encode_by_tool("a.xyz", "xyz", header, {}, black); }), "a.xyz: cannot write", {"OpenImageIO", "xyz"}));
  header.channels = 2;
  EXPECT_TRUE(reports(output_error([&] { encode_by_tool("a.jpg", "jpeg", header, {}, black); }), "a.jpg: cannot write", {"header"}));
}

TEST_F(ImageTool, ReportsAFullDisk) {
  if (find_image_tool().empty()) GTEST_SKIP() << kNoImageTool;
  for (const char* name : {"a.jpg", "a.tif", "a.exr"}) {
    const fs::path path = directory / name;
    fs::create_symlink("/dev/full", path);
    const auto write = [&] {
      is_linear(*image_file_of(path)) ? write_image(path, Image<glm::vec4>(9, 9)) : write_image(path, test_picture(true));
    };
    EXPECT_EQ(output_error(write), path.string() + ": cannot write (No space left on device)");
  }
}

TEST_F(ImageTool, ReportsAnUnwritableDirectory) {
  fs::permissions(directory, static_cast<fs::perms>(0555));
  const pid_t child = ::fork();
  if (child == 0) {
    if (::geteuid() == 0 && ::setuid(65534) != 0) ::_exit(2);  // root can write anywhere, so continue as nobody
    const fs::path path = directory / "a.exr";
    const std::string what = output_error([&] { write_image(path, Image<glm::vec4>(2, 2)); });
    ::_exit(reports(what, path.string(), {"cannot write", "Permission denied"}) ? 0 : 1);
  }
  int status = -1;
  ::waitpid(child, &status, 0);
  EXPECT_EQ(status, 0);
  fs::permissions(directory, fs::perms::owner_all);
}

}  // namespace
}  // namespace halfspace
