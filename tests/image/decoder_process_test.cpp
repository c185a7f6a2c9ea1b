// SPDX-License-Identifier: Apache-2.0
//
// Tests the lifetime of the decoder programs: they serve many images, are replaced if they exit, and exit with the program that started
// them.
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <span>
#include <string>
#include <thread>
#include <vector>

#include "halfspace/core/check.h"
#include "halfspace/image/image_io.h"
#include "halfspace/image/image_tool.h"
#include "image/image_fixture.h"

namespace halfspace {
namespace {

namespace fs = std::filesystem;

struct Process {
  pid_t id = 0, parent = 0;
  std::string name;  // the first 15 characters
  char state = 0;    // Z for a zombie
};

// Reads /proc/ID/stat. Returns an id of 0 if there is no such process.
Process process(pid_t id) {
  std::ifstream file("/proc/" + std::to_string(id) + "/stat");
  std::string text;
  std::getline(file, text);
  const std::size_t open = text.find('('), close = text.rfind(')');
  if (close == std::string::npos) return {};
  return {id, std::stoi(text.substr(close + 4)), text.substr(open + 1, close - open - 1), text[close + 2]};
}

std::vector<Process> children() {
  std::vector<Process> found;
  for (const auto& entry : fs::directory_iterator("/proc")) {
    const std::string name = entry.path().filename();
    if (!std::ranges::all_of(name, [](char c) { return c >= '0' && c <= '9'; })) continue;
    const Process p = process(std::stoi(name));
    if (p.id != 0 && p.parent == ::getpid()) found.push_back(p);
  }
  return found;
}

// The running tools of this process.
std::vector<pid_t> tools(const char* name = kImageToolName) {
  std::vector<pid_t> ids;
  for (const Process& p : children()) {
    if (p.name == std::string(name).substr(0, 15) && p.state != 'Z') ids.push_back(p.id);
  }
  return ids;
}

// Kills the running tools and waits until they have exited.
void kill_tools(const char* name = kImageToolName) {
  for (const pid_t id : tools(name)) ::kill(id, SIGKILL);
  while (!tools(name).empty()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
}

std::size_t zombies() {
  return static_cast<std::size_t>(std::ranges::count_if(children(), [](const Process& p) { return p.state == 'Z'; }));
}

std::size_t open_files() {
  return static_cast<std::size_t>(std::distance(fs::directory_iterator("/proc/self/fd"), fs::directory_iterator()));
}

class DecoderProcess : public ImageToolTest {
 protected:
  void SetUp() override {
    ImageToolTest::SetUp();
    if (IsSkipped()) return;
    write_image(jpeg, test_picture(true));
    read_image(ppm);
    read_image(jpeg);
  }
  // Stops all tools, so that the next test starts its own.
  void TearDown() override {
    for (const char* name : {kImageToolName, kJpegToolName}) kill_tools(name);
  }

  // Sends the signal to the tool while it is reading an image, and returns the error of the read.
  std::string error_if_signaled(int signal) const {
    const std::vector<pid_t> ids = tools();
    for (const pid_t id : ids) ::kill(id, SIGSTOP);
    std::string error;
    std::thread reader([&] {
      try {
        EXPECT_EQ(read_image(ppm).at(0, 0), first);
      } catch (const InputError& e) {
        error = e.what();
      }
    });
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    for (const pid_t id : ids) {
      ::kill(id, signal);
      ::kill(id, SIGCONT);
    }
    reader.join();
    return error;
  }

  const fs::path ppm = put("a.ppm", "P6 2 1 255\n\x01\x02\x03\xff\xfe\xfd"), jpeg = directory / "a.jpg";
  const glm::u8vec4 first = {1, 2, 3, 255};
};

TEST_F(DecoderProcess, ServesManyImages) {
  const std::vector<pid_t> before = tools();
  ASSERT_EQ(before.size(), 1u);
  for (int i = 0; i < 10; ++i) EXPECT_EQ(read_image(ppm).at(0, 0), first);
  write_image(directory / "a.tif", test_picture(true));
  EXPECT_TRUE(read_image(directory / "a.tif") == test_picture(true));
  EXPECT_EQ(tools(), before);
}

TEST_F(DecoderProcess, JpegNeedsNoImageTool) {
  if (find_jpeg_tool().empty()) GTEST_SKIP() << "halfspace-jpeg-tool is not built here (libjpeg is absent)";
  kill_tools();
  EXPECT_EQ(read_image(jpeg).width(), test_picture(true).width());
  EXPECT_EQ(tools(kJpegToolName).size(), 1u);
  EXPECT_EQ(tools().size(), 0u);
}

TEST_F(DecoderProcess, IsReplacedIfItIsKilled) {
  for (int i = 0; i < 3; ++i) {
    const std::vector<pid_t> before = tools();
    ASSERT_EQ(before.size(), 1u);
    for (const char* name : {kImageToolName, kJpegToolName}) kill_tools(name);
    EXPECT_EQ(read_image(ppm).at(0, 0), first);
    EXPECT_EQ(read_gray(jpeg).width(), test_picture(true).width());
    ASSERT_EQ(tools().size(), 1u);
    EXPECT_NE(tools(), before);
  }
  kill_tools();
  write_image(directory / "a.tif", test_picture(false));
  EXPECT_TRUE(read_image(directory / "a.tif") == test_picture(false)) << "a writer is replaced, too";
  EXPECT_EQ(zombies(), 0u);
}

TEST_F(DecoderProcess, CrashFailsOnlyOneImage) {
  const fs::path hostile = shared_data("broken/oiio_images/palette32bit-corrupt.bmp");
  if (!fs::exists(hostile)) GTEST_SKIP() << absent(hostile);
  for (int i = 0; i < 3; ++i) {
    // OpenImageIO 2.4 crashes. Later versions may report an error.
    const std::string error = input_error([&] { read_image(hostile); });
    EXPECT_TRUE(reports(error, hostile.string() + ": cannot be read as bmp", {"expected a complete image file"}));
    EXPECT_EQ(read_image(ppm).at(0, 0), first);
  }
  EXPECT_EQ(zombies(), 0u);
}

TEST_F(DecoderProcess, IsReplacedAfterAFailedWrite) {
  PictureHeader header;
  header.width = header.height = 1;
  header.channels = 3;
  const auto black = [](int, std::span<std::byte> row) { std::ranges::fill(row, std::byte{0}); };
  EXPECT_THROW(encode_by_tool("a.xyz", "xyz", header, {}, black), OutputError);
  EXPECT_EQ(zombies(), 0u);
  EXPECT_EQ(read_image(ppm).at(0, 0), first);
}

// An earlier image may have corrupted a process, which then crashes on a valid image.
TEST_F(DecoderProcess, RetriesWhenAReusedProcessCrashes) {
  EXPECT_EQ(error_if_signaled(SIGSEGV), "");
  EXPECT_EQ(zombies(), 0u);
}

TEST_F(DecoderProcess, TimeLimitFailsOnlyOneImage) {
  for (const int signal : {SIGXCPU, SIGALRM}) {
    EXPECT_EQ(error_if_signaled(signal),
              ppm.string() + ": cannot be read as pnm (the decoder died: " + ::strsignal(signal) + "); expected a complete image file");
    EXPECT_EQ(read_image(ppm).at(0, 0), first);
  }
  EXPECT_EQ(zombies(), 0u);
}

TEST_F(DecoderProcess, LeaksNoDescriptors) {
  const std::string bytes = read_bytes(ppm);
  const fs::path damaged = put("damaged.ppm", "P6 2 1 255\n");
  const auto read_all = [&] {
    read_image(ppm);
    read_linear(jpeg);
    read_gray(std::as_bytes(std::span(bytes)), "memory");
    EXPECT_THROW(read_image(damaged), InputError);
    EXPECT_THROW(read_image(std::as_bytes(std::span("text")), "memory"), InputError);
  };
  read_all();
  const std::size_t before = open_files();
  for (int i = 0; i < 100; ++i) read_all();
  EXPECT_EQ(open_files(), before);
  for (int i = 0; i < 5; ++i) {
    kill_tools();
    read_all();
  }
  EXPECT_EQ(open_files(), before);
  EXPECT_EQ(zombies(), 0u);
}

TEST_F(DecoderProcess, ForkedChildUsesItsOwnDecoders) {
  const std::vector<pid_t> before = tools();
  const pid_t child = ::fork();
  if (child == 0) {
    ::alarm(60);
    if (!tools().empty()) ::_exit(1);
    if (read_image(ppm).at(0, 0) != first || read_image(jpeg).empty()) ::_exit(2);
    ::_exit(tools().size() == 1 ? 0 : 3);
  }
  EXPECT_EQ(read_image(ppm).at(0, 0), first);
  int status = -1;
  ::waitpid(child, &status, 0);
  EXPECT_EQ(status, 0);
  EXPECT_EQ(read_image(ppm).at(0, 0), first);
  EXPECT_EQ(tools(), before);
}

TEST_F(DecoderProcess, ForkWhileThreadsRead) {
  std::atomic<bool> done = false;
  std::vector<std::thread> threads;
  for (int i = 0; i < 2; ++i) {
    threads.emplace_back([&] {
      while (!done) EXPECT_EQ(read_image(ppm).at(0, 0), first);
    });
  }
  for (int i = 0; i < 5; ++i) {
    const pid_t child = ::fork();
    if (child == 0) {
      ::alarm(60);
      ::_exit(read_image(ppm).at(0, 0) == first ? 0 : 1);
    }
    int status = -1;
    ::waitpid(child, &status, 0);
    EXPECT_EQ(status, 0);
  }
  done = true;
  for (std::thread& t : threads) t.join();
}

TEST_F(DecoderProcess, ThreadsReadInParallel) {
  const auto reads = [&](int kind) {
    for (int i = 0; i < 20; ++i) {
      const fs::path path = kind == 0 ? put("b.ppm", "P6 1 1 255\n\x07\x08\x09") : ppm;
      EXPECT_EQ(read_image(path).at(0, 0), kind == 0 ? glm::u8vec4(7, 8, 9, 255) : first);
      EXPECT_TRUE(read_image(jpeg).width() == test_picture(true).width());
    }
  };
  put("b.ppm", "");
  std::thread other(reads, 1);
  reads(0);
  other.join();
  EXPECT_LE(tools().size(), 2u);
  EXPECT_EQ(zombies(), 0u);
}

TEST_F(DecoderProcess, OutlivesTheThreadThatStartedIt) {
  TearDown();
  std::thread([&] { read_image(ppm); }).join();
  const std::vector<pid_t> before = tools();
  ASSERT_EQ(before.size(), 1u);
  std::this_thread::sleep_for(std::chrono::milliseconds(50));
  EXPECT_EQ(read_image(ppm).at(0, 0), first);
  EXPECT_EQ(tools(), before);
}

TEST_F(DecoderProcess, ExitsWhenItsParentExits) {
  int ends[2] = {};
  ASSERT_EQ(::pipe(ends), 0);
  const pid_t child = ::fork();
  if (child == 0) {
    read_image(ppm);
    const std::vector<pid_t> ids = tools();
    if (ids.size() == 1 && ::write(ends[1], &ids[0], sizeof ids[0]) > 0) ::raise(SIGKILL);
    ::_exit(1);
  }
  ::close(ends[1]);
  pid_t tool = 0;
  ASSERT_EQ(::read(ends[0], &tool, sizeof tool), static_cast<ssize_t>(sizeof tool));
  ::waitpid(child, nullptr, 0);
  ::close(ends[0]);
  const auto lives = [&] {
    const Process p = process(tool);
    return p.id != 0 && p.state != 'Z';
  };
  for (int i = 0; i < 500 && lives(); ++i) std::this_thread::sleep_for(std::chrono::milliseconds(10));
  EXPECT_FALSE(lives());
}

}  // namespace
}  // namespace halfspace
