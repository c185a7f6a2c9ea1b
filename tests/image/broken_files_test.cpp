// SPDX-License-Identifier: Apache-2.0
//
// Reads damaged and hostile image files. Whatever a file contains, each reader must return an image or throw an InputError with a one-line
// message. Each folder is read in a child process with limited memory and time, so that a crash or a hang fails only one test, which
// reports the file.
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <iterator>
#include <span>
#include <string>
#include <vector>

#include "halfspace/core/check.h"
#include "halfspace/core/text.h"
#include "halfspace/image/image_io.h"
#include "image/image_fixture.h"
#include "support/errors.h"
#include "support/files.h"
#include "support/sanitized.h"

namespace halfspace {
namespace {

// Wall-clock limit. A hanging decoder is killed after 60 s of CPU time, which takes longer on a busy machine.
constexpr unsigned kSecondsPerFile = 300;
constexpr rlim_t kAddressSpace = rlim_t{2} << 30;

std::vector<std::filesystem::path> files_in(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    if (entry.is_regular_file()) files.push_back(entry.path());
  }
  std::ranges::sort(files);
  return files;
}

// Sanitizers reserve terabytes of address space.
void limit_memory() {
  if (kSanitized) return;
  const rlimit limit = {kAddressSpace, kAddressSpace};
  ::setrlimit(RLIMIT_AS, &limit);
}

struct Reader {
  const char* name;
  bool (*gives_pixels)(const std::filesystem::path&);
};
constexpr Reader kReaders[] = {
    {"read_image", [](const std::filesystem::path& path) { return !read_image(path).empty(); }},
    {"read_gray", [](const std::filesystem::path& path) { return !read_gray(path).empty(); }},
    {"read_linear", [](const std::filesystem::path& path) { return !read_linear(path).empty(); }},
};

std::string outcome_of(const std::filesystem::path& path, const Reader& reader) {
  try {
    return reader.gives_pixels(path) ? "ok" : "returned an empty image";
  } catch (const InputError& e) {
    return (std::string(e.what()).starts_with(path.string() + ": ") ? "error " : "does not begin with the path: ") + std::string(e.what());
  } catch (const std::exception& e) {
    return std::string("another exception: ") + e.what();
  }
}

// Runs in the child. Writes two lines per file and reader: the names before reading, then "ok" or the error.
[[noreturn]] void read_all(const std::vector<std::filesystem::path>& files, int to_parent) {
  std::FILE* out = ::fdopen(to_parent, "w");
  limit_memory();
  for (const std::filesystem::path& file : files) {
    for (const Reader& reader : kReaders) {
      std::fprintf(out, "%s by %s\n", file.c_str(), reader.name);
      std::fflush(out);
      ::alarm(kSecondsPerFile);
      std::fprintf(out, "%s\n", outcome_of(file, reader).c_str());
    }
  }
  std::fflush(out);
  ::_exit(0);
}

struct Outcome {
  int status = 0;
  std::vector<std::string> lines;
};

Outcome read_in_child(const std::vector<std::filesystem::path>& files) {
  int ends[2] = {};
  if (::pipe(ends) != 0) return {-1, {}};
  const pid_t child = ::fork();
  if (child == 0) {
    ::close(ends[0]);
    read_all(files, ends[1]);
  }
  ::close(ends[1]);
  std::string text;
  char buffer[4096];
  for (ssize_t n = 0; (n = ::read(ends[0], buffer, sizeof buffer)) > 0;) text.append(buffer, static_cast<std::size_t>(n));
  ::close(ends[0]);
  Outcome outcome;
  ::waitpid(child, &outcome.status, 0);
  for (std::size_t start = 0; start < text.size();) {
    const std::size_t end = std::min(text.find('\n', start), text.size());
    outcome.lines.push_back(text.substr(start, end - start));
    start = end + 1;
  }
  return outcome;
}

class BrokenFiles : public testing::TestWithParam<const char*> {};

TEST_P(BrokenFiles, ReturnsAnImageOrOneLineError) {
  const std::filesystem::path folder = shared_data(GetParam());
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << absent(folder);
  const std::vector<std::filesystem::path> files = files_in(folder);
  const Outcome outcome = read_in_child(files);
  const std::string last = outcome.lines.empty() ? "(none)" : outcome.lines.back();
  ASSERT_TRUE(WIFEXITED(outcome.status) && WEXITSTATUS(outcome.status) == 0)
      << "the reader was killed by signal " << WTERMSIG(outcome.status) << " (14: timeout of " << kSecondsPerFile << " s) at " << last;
  const std::size_t count = files.size() * std::size(kReaders);
  ASSERT_EQ(outcome.lines.size(), 2 * count) << "an error message spans several lines";
  std::size_t images = 0;
  for (std::size_t i = 0; i < 2 * count; i += 2) {
    const std::string& verdict = outcome.lines[i + 1];
    EXPECT_TRUE(verdict == "ok" || verdict.starts_with("error ")) << outcome.lines[i] << ": " << verdict;
    images += verdict == "ok" ? 1 : 0;
  }
  std::printf("%zu files, %zu readers: %zu images, %zu rejected\n", files.size(), std::size(kReaders), images, count - images);
}

INSTANTIATE_TEST_SUITE_P(Folders, BrokenFiles,
                         testing::Values("broken/oiio_images", "broken/openexr_damaged", "broken/imagetestsuite_gif",
                                         "broken/imagetestsuite_jpg", "broken/imagetestsuite_png", "broken/imagetestsuite_tif",
                                         "broken/pngsuite_corrupt", "broken/assimp_obj_odd", "broken/gltf_validator", "pngsuite"),
                         [](const testing::TestParamInfo<const char*>& folder) {
                           std::string name = folder.param;
                           std::ranges::replace(name, '/', '_');
                           return name;
                         });

// Returns an OpenEXR file of 64x64 pixels, which are missing, whose only channel has this name and a sampling rate that is not supported.
std::string exr_with_channel(const std::string& name) {
  const auto word = [](uint32_t x) { return std::string(reinterpret_cast<const char*>(&x), 4); };
  const auto attribute = [&](const std::string& key, const std::string& type, const std::string& value) {
    return key + '\0' + type + '\0' + word(static_cast<uint32_t>(value.size())) + value;
  };
  constexpr uint32_t kHalf = 1, kOne = 0x3f800000;
  const std::string window = word(0) + word(0) + word(63) + word(63);
  return word(20000630) + word(2) +
         attribute("channels", "chlist", name + '\0' + word(kHalf) + std::string(4, '\0') + word(32) + word(1) + '\0') +
         attribute("compression", "compression", std::string(1, '\0')) + attribute("dataWindow", "box2i", window) +
         attribute("displayWindow", "box2i", window) + attribute("lineOrder", "lineOrder", std::string(1, '\0')) +
         attribute("pixelAspectRatio", "float", word(kOne)) + attribute("screenWindowCenter", "v2f", word(0) + word(0)) +
         attribute("screenWindowWidth", "float", word(kOne)) + '\0' + std::string(std::size_t{64} * 8, '\1');  // offsets of the rows
}

// Decoders quote names from the file.
TEST(BrokenFile, MessagesArePrintable) {
  if (find_image_tool().empty()) GTEST_SKIP() << kNoImageTool;
  const std::string file = exr_with_channel("a\xff\x1b");
  const std::string message = input_error([&] { read_linear(std::as_bytes(std::span(file)), "a.exr"); });
  EXPECT_TRUE(message.starts_with("a.exr: ")) << message;
  EXPECT_EQ(printable(message), message);
  EXPECT_NE(message.find("a\\xff"), std::string::npos) << message;
}

}  // namespace
}  // namespace halfspace
