// SPDX-License-Identifier: Apache-2.0
//
// `render -o -`: pictures on standard output.
#include <cmath>
#include <cstring>

#include "cli/cli_run.h"

namespace halfspace {
namespace {

class Streams : public Cli {
 protected:
  // Renders two frames to standard output in a format.
  std::string stream(const std::string& format, std::vector<std::string> more = {}) const {
    std::vector<std::string> words{"render", "moon", "--size", "33x20", "--frames", "0..1", "-o", "-", "--format", format};
    words.insert(words.end(), more.begin(), more.end());
    const Outcome o = run(words);
    EXPECT_EQ(o.exit_code, 0) << o.err;
    EXPECT_EQ(o.err, "") << format;
    return o.out;
  }
  void SetUp() override {
    Cli::SetUp();
    ASSERT_EQ(run({"render", "moon", "--size", "33x20", "--frames", "0..1", "-o", "m.png"}).exit_code, 0);
  }
  static constexpr std::size_t kPixels = 33 * 20;
};

TEST_F(Streams, PngFilesFollowEachOther) {
  const std::string both = stream("png"), signature("\x89PNG\r\n\x1a\n");
  const std::size_t second = both.find(signature, 1);
  ASSERT_NE(second, std::string::npos);
  write_bytes(directory / "first.png", both.substr(0, second));
  write_bytes(directory / "second.png", both.substr(second));
  EXPECT_TRUE(picture("first.png") == picture("m_0000.png"));
  EXPECT_TRUE(picture("second.png") == picture("m_0001.png"));
}

TEST_F(Streams, RawPixelsAreThoseOfTheFiles) {
  const std::string rgb = stream("rgb24"), rgba = stream("rgba");
  ASSERT_EQ(rgb.size(), 2 * 3 * kPixels);
  ASSERT_EQ(rgba.size(), 2 * 4 * kPixels);
  const Image<glm::u8vec4> second = picture("m_0001.png");
  for (std::size_t i = 0; i < kPixels; ++i) {
    const glm::u8vec4& t = second.texels()[i];
    ASSERT_EQ(std::memcmp(rgba.data() + 4 * (kPixels + i), &t, 4), 0);
    ASSERT_EQ(std::memcmp(rgb.data() + 3 * (kPixels + i), &t, 3), 0);
  }
}

TEST_F(Streams, FloatsAreTheLightOfExrFiles) {
  const std::string floats = stream("rgbaf32");
  ASSERT_EQ(floats.size(), 2 * 16 * kPixels);
  ASSERT_EQ(run({"render", "moon", "--size", "33x20", "--frames", "0", "-o", "m.exr"}).exit_code, 0);
  const Image<glm::vec4> light = read_linear(directory / "m_0000.exr");
  for (std::size_t i = 0; i < kPixels; ++i) {
    glm::vec4 t;
    std::memcpy(&t, floats.data() + 16 * i, sizeof t);
    // The file stores halfs, which have 11 significant bits.
    for (int c = 0; c < 4; ++c) ASSERT_NEAR(t[c], light.texels()[i][c], std::abs(t[c]) / 2048.0f + 1e-7f);
  }
}

// Converting the video back to R'G'B' gives the picture, up to the rounding of the codes: half a step of 1/219 of luma, and of 1/224 times
// at most 1.8556 of chroma, is less than 2 of 255 steps.
TEST_F(Streams, VideoHasTheColorsOfThePictures) {
  const std::string video = stream("y4m", {"--fps", "29.97"});
  const std::string header = "YUV4MPEG2 W33 H20 F2997:100 Ip A1:1 C444\nFRAME\n";
  ASSERT_EQ(video.substr(0, header.size()), header);
  ASSERT_EQ(video.size(), header.size() + 6 + 2 * 3 * kPixels);
  const Image<glm::u8vec4> first = picture("m_0000.png");
  const auto code = [&](std::size_t plane, std::size_t i) {
    return static_cast<double>(static_cast<unsigned char>(video[header.size() + plane * kPixels + i]));
  };
  for (std::size_t i = 0; i < kPixels; ++i) {
    const double y = (code(0, i) - 16) / 219, b = (code(1, i) - 128) / 224 * 1.8556 + y, r = (code(2, i) - 128) / 224 * 1.5748 + y;
    const double g = (y - 0.2126 * r - 0.0722 * b) / 0.7152;
    ASSERT_NEAR(r * 255, first.texels()[i].x, 2.0);
    ASSERT_NEAR(g * 255, first.texels()[i].y, 2.0);
    ASSERT_NEAR(b * 255, first.texels()[i].z, 2.0);
  }
}

TEST_F(Streams, ASteppedRangeHasFewerPicturesPerSecond) {
  const Outcome o = run({"render", "moon", "--size", "33x20", "--frames", "0..10:5", "--fps", "30", "-o", "-", "--format", "y4m"});
  EXPECT_TRUE(o.out.starts_with("YUV4MPEG2 W33 H20 F6:1 ")) << o.out.substr(0, 40);
}

TEST_F(Streams, OnePictureIsAPng) {
  const Outcome o = run({"render", "moon", "--size", "33x20", "--time", "0", "-o", "-", "--stats"});
  EXPECT_EQ(o.exit_code, 0);
  write_bytes(directory / "one.png", o.out);
  EXPECT_TRUE(picture("one.png") == picture("m_0000.png"));
  EXPECT_NE(o.err.find("samples_passed"), std::string::npos) << "reports go to standard error";
}

// A reader that has seen enough ends the program, without a message, also if the program was started with SIGPIPE ignored.
TEST_F(Streams, AClosedPipeEndsQuietly) {
  for (const char* before : {"", "trap \"\" PIPE; "}) {
    const std::string command = "cd " + directory.string() + " && (" + before +
                                HALFSPACE_PROGRAM
                                " render moon --size 320x180 --frames 0..999 -o - --format rgb24 2> err.txt) | head -c 1000 > out.txt";
    EXPECT_EQ(std::system(command.c_str()), 0);
    EXPECT_EQ(read_bytes(directory / "err.txt"), "") << before;
    EXPECT_EQ(read_bytes(directory / "out.txt").size(), 1000u);
  }
}

// Also single pictures and animations, which have no fingerprint.
TEST_F(Streams, EveryFileRemovesThoseOfKilledProcesses) {
  const fs::path abandoned = directory / ".halfspace-1-1.part";
  for (const std::vector<std::string>& output : {std::vector<std::string>{"-o", "a.png"}, {"-o", "a.gif", "--frames", "0..1"}}) {
    write_bytes(abandoned, "half of a picture");
    std::vector<std::string> words{"render", "moon", "--size", "33x20"};
    words.insert(words.end(), output.begin(), output.end());
    const Outcome o = run(words);
    EXPECT_EQ(o.exit_code, 0) << o.err;
    EXPECT_FALSE(fs::exists(abandoned)) << output[1];
  }
}

TEST_F(Streams, RefuseTransparencyThatTheyCannotStore) {
  for (const char* format : {"rgb24", "y4m"}) {
    const Outcome o = run(
        {"render", "moon", "--size", "33x20", "--frames", "0..1", "-o", "-", "--format", format, "--set", "background.type=transparent"});
    EXPECT_EQ(o.exit_code, 2);
    EXPECT_NE(o.err.find("transparent"), std::string::npos) << o.err;
    EXPECT_EQ(o.out, "");
  }
}

// The command of docs/tutorial/first_picture.md.
TEST_F(Streams, FfmpegMakesAVideo) {
  if (std::system("ffmpeg -version > /dev/null 2>&1") != 0) GTEST_SKIP() << "ffmpeg is not installed";
  const std::string command = "cd " + directory.string() +
                              " && " HALFSPACE_PROGRAM
                              " render moon --size 160x90 --frames 0..11 -o - --format y4m | ffmpeg -loglevel error -i - -pix_fmt yuv420p "
                              "moon.mp4 && ffmpeg -loglevel error -i moon.mp4 f%02d.png";
  ASSERT_EQ(std::system(command.c_str()), 0);
  EXPECT_TRUE(fs::exists(directory / "f12.png") && !fs::exists(directory / "f13.png"));
  EXPECT_EQ(picture("f12.png").width(), 160);
}

uint32_t little_endian(const std::string& bytes, std::size_t at, int count) {
  uint32_t n = 0;
  for (int k = count - 1; k >= 0; --k) n = n << 8 | static_cast<unsigned char>(bytes.at(at + static_cast<std::size_t>(k)));
  return n;
}

// What a player needs to know of an animation.
struct Timing {
  int loop = -1;  // −1: not stored
  std::vector<int> durations;
};

// Source: WebP Container Specification, chunks ANIM and ANMF.
Timing webp_timing(const std::string& file) {
  Timing timing;
  for (std::size_t at = 12; at + 8 <= file.size();) {
    const std::string chunk = file.substr(at, 4);
    const uint32_t size = little_endian(file, at + 4, 4);
    if (chunk == "ANIM") timing.loop = static_cast<int>(little_endian(file, at + 12, 2));
    if (chunk == "ANMF") timing.durations.push_back(static_cast<int>(little_endian(file, at + 20, 3)));
    at += 8 + size + size % 2;
  }
  return timing;
}

// Source: GIF89a specification, and the application extension NETSCAPE2.0.
Timing gif_timing(const std::string& file) {
  Timing timing;
  const auto color_bytes = [&](std::size_t flags_at) {
    const auto flags = static_cast<unsigned char>(file.at(flags_at));
    return (flags & 0x80) != 0 ? std::size_t{3} << ((flags & 7) + 1) : std::size_t{0};
  };
  const auto skip_blocks = [&](std::size_t at) {
    while (file.at(at) != 0) at += 1 + static_cast<unsigned char>(file[at]);
    return at + 1;
  };
  std::size_t at = 13 + color_bytes(10);
  while (file.at(at) != ';') {
    if (file[at] == '!') {
      if (file.at(at + 1) == '\xf9') timing.durations.push_back(static_cast<int>(little_endian(file, at + 4, 2)));
      if (file.at(at + 1) == '\xff') timing.loop = static_cast<int>(little_endian(file, at + 16, 2));
      at = skip_blocks(at + 2);
    } else {
      at = skip_blocks(at + 10 + color_bytes(at + 9) + 1);
    }
  }
  return timing;
}

class Animations : public Cli {
 protected:
  Outcome render(const std::string& out, std::vector<std::string> more = {}) const {
    std::vector<std::string> words{"render", "moon", "--size", "64x36", "--frames", "0..6", "-o", out};
    words.insert(words.end(), more.begin(), more.end());
    return run(words);
  }
  // Renders and returns the timing, or skips the test if this build has no library for the format.
  void expect_timing(const std::string& out, const std::vector<std::string>& more, int loop, const std::vector<int>& durations) {
    const Outcome o = render(out, more);
    if (o.err.find("this build has no") != std::string::npos) GTEST_SKIP() << o.err;
    ASSERT_EQ(o.exit_code, 0) << o.err;
    const std::string file = read_bytes(directory / out);
    const Timing timing = out.ends_with("webp") ? webp_timing(file) : gif_timing(file);
    EXPECT_EQ(timing.loop, loop);
    EXPECT_EQ(timing.durations, durations);
  }
};

TEST_F(Animations, WebpHasTheTimesOfTheFrames) {
  expect_timing("a.webp", {}, 0, {33, 34, 33, 33, 34, 33, 33});
  expect_timing("a.webp", {"--fps", "8", "--loop", "3"}, 3, {125, 125, 125, 125, 125, 125, 125});
}

TEST_F(Animations, GifHasTheTimesOfTheFrames) {
  expect_timing("a.gif", {}, 0, {3, 4, 3, 3, 4, 3, 3});
  expect_timing("a.gif", {"--fps", "1", "--loop", "3"}, 2, {100, 100, 100, 100, 100, 100, 100});
  expect_timing("a.gif", {"--fps", "1000", "--loop", "1"}, -1, {2, 2, 2, 2, 2, 2, 2});
}

// 256 colors per frame, or lossy compression at high quality, must look like the picture: a mean difference of 2 of 255 steps is not
// visible.
TEST_F(Animations, ShowThePictures) {
  ASSERT_EQ(render("m.png").exit_code, 0);
  const Image<glm::u8vec4> first = picture("m_0000.png");
  for (const char* name : {"a.webp", "a.gif"}) {
    const Outcome o = render(name);
    if (o.err.find("this build has no") != std::string::npos) GTEST_SKIP() << o.err;
    const Image<glm::u8vec4> shown = picture(name);
    ASSERT_EQ(shown.width(), 64);
    double sum = 0;
    for (std::size_t i = 0; i < first.texels().size(); ++i)
      for (int c = 0; c < 3; ++c) sum += std::abs(first.texels()[i][c] - shown.texels()[i][c]);
    EXPECT_LT(sum / static_cast<double>(3 * first.texels().size()), 2.0) << name;
  }
}

// A turntable of several models gives one file per model.
TEST_F(Animations, EachSceneHasItsOwn) {
  for (const char* name : {"a.obj", "b.obj"}) write_bytes(directory / name, "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  const Outcome o = run({"render", "a.obj", "b.obj", "--size", "32x18", "--turntable", "3", "-o", "{name}.gif"});
  if (o.err.find("this build has no") != std::string::npos) GTEST_SKIP() << o.err;
  EXPECT_EQ(files(), (std::vector<std::string>{"a.gif", "a.obj", "b.gif", "b.obj"}));
  EXPECT_EQ(gif_timing(read_bytes(directory / "b.gif")).durations.size(), 3u);
}

}  // namespace
}  // namespace halfspace
