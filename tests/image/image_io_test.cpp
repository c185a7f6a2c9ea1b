// SPDX-License-Identifier: Apache-2.0
#include "halfspace/image/image_io.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/file.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string>

#include "halfspace/core/check.h"
#include "halfspace/image/atomic_output.h"
#include "halfspace/image/image_tool.h"
#include "halfspace/image/png.h"
#include "image/image_files.h"
#include "image/image_fixture.h"

namespace halfspace {
namespace {

namespace fs = std::filesystem;
using ImageIo = FolderTest;

// Returns the color type in a PNG's header: 2 is RGB, 6 is RGBA.
int color_type(const std::vector<std::byte>& png) { return static_cast<int>(png.at(25)); }

bool contains(const std::vector<std::byte>& bytes, std::string_view word) {
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  return text.find(word) != std::string_view::npos;
}

TEST_F(ImageIo, PngRoundTripKeepsEvery8BitValue) {
  for (const bool opaque : {true, false}) {
    const Image<glm::u8vec4> image = test_picture(opaque);
    write_png(directory / "a.png", image);
    EXPECT_TRUE(read_image(directory / "a.png") == image);
  }
  EXPECT_EQ(file_count(), 1u) << "no other file is left behind";
}

TEST_F(ImageIo, OmitsAlphaOfOpaqueImages) {
  EXPECT_EQ(color_type(encode_png(test_picture(true))), 2);
  EXPECT_EQ(color_type(encode_png(test_picture(false))), 6);
}

TEST_F(ImageIo, PngDeclaresSrgb) { EXPECT_TRUE(contains(encode_png(test_picture(true)), "sRGB")); }

TEST_F(ImageIo, PngStores16Bits) {
  for (const uint16_t alpha : {uint16_t{65535}, uint16_t{300}}) {
    Image<glm::u16vec4> image(40, 30);
    for (int y = 0; y < 30; ++y) {
      for (int x = 0; x < 40; ++x) image.at(x, y) = glm::u16vec4(x * 1601 + y, y * 2003, 65535 - x, alpha);
    }
    EXPECT_EQ(color_type(encode_png(image)), alpha == 65535 ? 2 : 6);
    EXPECT_TRUE(decode_png(encode_png(image), "x") == ColorPicture(image));
  }
}

TEST_F(ImageIo, PngStoresText) {
  const std::vector<std::byte> file = encode_png(test_picture(true), PngCodes::srgb, {.software = "Program 1.0", .comment = "caf\u00e9"});
  EXPECT_TRUE(contains(file, std::string("tEXtSoftware\0Program 1.0", 24)));
  EXPECT_TRUE(contains(file, std::string("iTXtComment\0", 12)));
  EXPECT_TRUE(contains(file, "caf\u00e9"));
  EXPECT_TRUE(decode_png(file, "x") == ColorPicture(test_picture(true)));
  EXPECT_FALSE(contains(encode_png(test_picture(true)), "tEXt"));
}

// A killed process cannot remove its temporary file. A later one does, unless a running process has locked the file.
TEST_F(ImageIo, AbandonedTemporaryFilesAreRemoved) {
  const std::string running = ".halfspace-1-0.part", abandoned = ".halfspace-1-1.part", other = "a.part";
  for (const std::string& file : {running, abandoned, other}) std::ofstream(directory / file) << "x";
  const int descriptor = ::open((directory / running).c_str(), O_WRONLY);
  ASSERT_EQ(::flock(descriptor, LOCK_EX), 0);
  remove_abandoned_output(directory);
  EXPECT_TRUE(std::filesystem::exists(directory / running));
  EXPECT_FALSE(std::filesystem::exists(directory / abandoned));
  EXPECT_TRUE(std::filesystem::exists(directory / other));
  ::close(descriptor);  // as if the process had been killed
  remove_abandoned_output(directory);
  EXPECT_FALSE(std::filesystem::exists(directory / running));
  remove_abandoned_output(directory / "missing");
}

TEST_F(ImageIo, PngKeepsTransparentColors) {
  // Alpha is straight, so a color survives an alpha of 0.
  Image<glm::u8vec4> image(1, 1);
  image.at(0, 0) = glm::u8vec4(10, 20, 30, 0);
  EXPECT_TRUE(decode_png(encode_png(image), "x") == ColorPicture(image));
}

TEST_F(ImageIo, TopRowComesFirst) {
  Image<glm::u8vec4> image(1, 2);
  image.at(0, 0) = glm::u8vec4(255, 0, 0, 255);
  image.at(0, 1) = glm::u8vec4(0, 0, 255, 255);
  write_png(directory / "a.png", image);
  EXPECT_EQ(read_image(directory / "a.png").at(0, 0).x, 255);
}

TEST_F(ImageIo, ReplacesAFileAndKeepsItsPermissions) {
  const fs::path path = put("a.png", "old");
  fs::permissions(path, fs::perms::owner_read | fs::perms::owner_write);
  write_png(path, test_picture(true));
  EXPECT_EQ(fs::status(path).permissions(), fs::perms::owner_read | fs::perms::owner_write);
  EXPECT_TRUE(read_image(path) == test_picture(true));
}

TEST_F(ImageIo, WritesThroughASymbolicLink) {
  const fs::path path = put("real.png", "old");
  fs::create_symlink("real.png", directory / "link.png");
  write_png(directory / "link.png", test_picture(true));
  EXPECT_TRUE(fs::is_symlink(directory / "link.png"));
  EXPECT_TRUE(read_image(path) == test_picture(true));
}

TEST_F(ImageIo, WritesToADeviceInPlace) {
  write_png("/dev/null", test_picture(true));
  EXPECT_TRUE(fs::is_character_file("/dev/null"));
}

TEST_F(ImageIo, ReportsWhyItCannotWrite) {
  EXPECT_EQ(output_error([&] { write_png(directory, test_picture(true)); }), directory.string() + ": is a directory; expected a file name");
  const fs::path slash = directory / "no/";
  EXPECT_EQ(output_error([&] { write_png(slash, test_picture(true)); }), slash.string() + ": is a directory; expected a file name");
  EXPECT_FALSE(fs::exists(slash));
  const fs::path file = put("file", "x");
  for (const fs::path& below_file : {file / "a.png", file / "no" / "a.png"}) {
    EXPECT_EQ(output_error([&] { write_png(below_file, test_picture(true)); }),
              below_file.string() + ": cannot write (" + file.string() + " is not a directory)");
  }
  EXPECT_EQ(output_error([&] { write_png("/dev/full", test_picture(true)); }), "/dev/full: cannot write (No space left on device)");
}

TEST_F(ImageIo, CreatesMissingDirectories) {
  const fs::path path = directory / "new" / "folder" / "a.png";
  check_writable(path);
  EXPECT_FALSE(fs::exists(directory / "new")) << "check_writable creates nothing";
  write_png(path, test_picture(true));
  EXPECT_TRUE(read_image(path) == test_picture(true));
}

TEST_F(ImageIo, ReportsAnUnwritableDirectory) {
  // Runs without root privileges, because root can write anywhere.
  const pid_t child = ::fork();
  if (child == 0) {
    fs::permissions(directory, fs::perms(0555));  // read and execute for everyone
    if (::geteuid() == 0 && ::setuid(65534) != 0) ::_exit(2);
    for (const fs::path& path : {directory / "a.png", directory / "no" / "a.png"}) {
      if (output_error([&] { check_writable(path); }) !=
          path.string() + ": cannot write to directory " + directory.string() + " (Permission denied)")
        ::_exit(1);
    }
    ::_exit(0);
  }
  int status = -1;
  ::waitpid(child, &status, 0);
  fs::permissions(directory, fs::perms::owner_all);
  EXPECT_EQ(status, 0);
}

TEST_F(ImageIo, LeavesNothingBehindWhenTheDiskIsFull) {
  // A file size limit simulates a full disk. SIGXFSZ is ignored so that write() fails instead.
  const fs::path path = put("a.png", "old");
  const pid_t child = ::fork();
  if (child == 0) {
    ::signal(SIGXFSZ, SIG_IGN);
    const rlimit limit = {100, 100};
    ::setrlimit(RLIMIT_FSIZE, &limit);
    const std::string what = output_error([&] { write_png(path, test_picture(true)); });
    ::_exit(what == path.string() + ": cannot write (File too large)" ? 0 : 1);
  }
  int status = -1;
  ::waitpid(child, &status, 0);
  EXPECT_EQ(status, 0);
  EXPECT_EQ(file_count(), 1u);
  EXPECT_EQ(fs::file_size(path), 3u) << "the old file is unchanged";
}

TEST_F(ImageIo, ReportsWhatIsWrongWithAnInput) {
  struct Case {
    const char* name;
    std::string bytes;
    std::vector<std::string> keywords;
  };
  const std::string head = "\x89PNG\r\n\x1a\n";
  const Case cases[] = {
      {"empty.png", "", {"empty", "PNG", "DDS"}},
      {"text.png", "This is not a picture.", {"not a supported image", "begins with \"This is \"", "PNG", "DDS"}},
      {"bytes.png", std::string("\1\2\xfe", 3), {"not a supported image", "begins with the bytes 01 02 fe)"}},
      {"paper.jpg", "%PDF-1.7", {"not a supported image", "found PDF"}},
      {"phone.jpg",
       std::string("\0\0\0\x18"
                   "ftypheic",
                   12),
       {"not a supported image", "found HEIF"}},
      {"cut.png", head, {"damaged PNG", "end of stream"}},
      {"picture.exr", "\x76\x2f\x31\x01 and so on", {"OpenEXR", "linear", "16-bit", "PNG"}},
  };
  for (const Case& c : cases) {
    const fs::path path = put(c.name, c.bytes);
    EXPECT_TRUE(reports(input_error([&] { read_image(path); }), path.string() + ": ", c.keywords));
  }
  EXPECT_TRUE(reports(input_error([&] { read_image(directory / "none.png"); }), (directory / "none.png").string(), {"no such file"}));
  EXPECT_TRUE(reports(input_error([&] { read_image(directory); }), directory.string(), {"is a directory"}));
  EXPECT_TRUE(reports(input_error([&] { read_image("/dev/zero"); }), "/dev/zero", {"regular file"}));
}

// A truncated PNG is rejected, or decodes completely if only trailing chunks are missing. A PNG with one changed byte is either
// rejected or decodes to an image of the right size. Neither crashes.
TEST_F(ImageIo, DamagedPngNeverCrashes) {
  const std::vector<std::byte> whole = encode_png(test_picture(false));
  EXPECT_THROW(decode_png(std::span(whole).first(whole.size() / 2), "cut"), InputError);
  for (std::size_t n = 0; n < whole.size(); n += 7) {
    try {
      EXPECT_TRUE(decode_png(std::span(whole).first(n), "cut") == ColorPicture(test_picture(false))) << n;
    } catch (const InputError&) {
    }
  }
  for (std::size_t i = 0; i < whole.size(); i += 3) {
    std::vector<std::byte> changed = whole;
    changed[i] ^= std::byte{0x41};
    try {
      EXPECT_EQ(std::get<Image<glm::u8vec4>>(decode_png(changed, "changed")).width(), 67) << i;
    } catch (const InputError&) {
    }
  }
}

// A valid header that claims 30000x2000 RGBA pixels, without pixel data.
TEST_F(ImageIo, RejectsAPngThatClaimsMoreThanItHolds) {
  const std::string header = big_endian(30000, 4) + big_endian(2000, 4) + std::string{8, 6, 0, 0, 0};
  const fs::path path = put("bomb.png", "\x89PNG\r\n\x1a\n" + png_chunk("IHDR", header));
  EXPECT_EQ(input_error([&] { read_image(path); }),
            path.string() + ": claims 30000x2000 pixels but has only 33 bytes; expected a complete PNG file");
}

TEST_F(ImageIo, ReadsOtherFormats) {
  if (find_image_tool().empty()) GTEST_SKIP() << kNoImageTool;
  // A binary 2x1 PPM and an uncompressed 1x1 TGA with alpha.
  const Image<glm::u8vec4> ppm = read_image(put("a.ppm", "P6 2 1 255\n\x01\x02\x03\xff\xfe\xfd"));
  ASSERT_EQ(ppm.width(), 2);
  EXPECT_EQ(ppm.at(0, 0), glm::u8vec4(1, 2, 3, 255));
  EXPECT_EQ(ppm.at(1, 0), glm::u8vec4(255, 254, 253, 255));
  const char tga[] = {0, 0, 2, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1, 0, 1, 0, 32, 0x28, 30, 20, 10, 77};
  EXPECT_EQ(read_image(put("a.tga", {tga, sizeof tga})).at(0, 0), glm::u8vec4(10, 20, 30, 77));
  const Image<glm::u8vec4> grey = read_image(put("a.pgm", "P5 1 1 255\n\x80"));
  EXPECT_EQ(grey.at(0, 0), glm::u8vec4(128, 128, 128, 255));
}

TEST_F(ImageIo, RejectsDamagedFilesOfOtherFormatsWithOneLine) {
  if (find_image_tool().empty()) GTEST_SKIP() << kNoImageTool;
  for (const char* name : {"a.jpg", "b.jpg"}) {
    const std::string what = input_error([&] { read_image(put(name, "\xff\xd8\xff\xe0 nothing more")); });
    EXPECT_TRUE(reports(what, (directory / name).string(), {"cannot be read", "jpeg"}));
  }
}

// Compares our decoding of PngSuite with images decoded by stb_image, which are included with the files.
TEST_F(ImageIo, PngSuiteMatchesAnotherDecoder) {
  const fs::path primary = shared_data("pngsuite/primary"), expected = shared_data("pngsuite/primary_check");
  if (!fs::exists(primary)) GTEST_SKIP() << absent(primary);
  int compared = 0;
  for (const auto& entry : fs::directory_iterator(primary)) {
    const fs::path other = expected / entry.path().filename();
    if (entry.path().extension() != ".png" || !fs::exists(other)) continue;
    EXPECT_TRUE(read_image(entry.path()) == read_image(other)) << entry.path();
    ++compared;
  }
  EXPECT_GT(compared, 0);
}

}  // namespace
}  // namespace halfspace
