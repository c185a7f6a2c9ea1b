// SPDX-License-Identifier: Apache-2.0
//
// Runs all programs in apps/lessons and compares their pictures with those in the lessons' pages.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "halfspace/core/image.h"
#include "halfspace/image/image_io.h"
#include "support/program.h"
#include "support/temporary_folder.h"

namespace halfspace {
namespace {

constexpr int kLessons = 24;

// Returns whether a lesson does not use the library. Such lessons write PPM.
bool is_plain(int number) { return number <= 5 || number == 24; }

struct Lesson {
  std::string name;    // "01_triangle"
  std::string output;  // what the program prints
  Image<glm::u8vec4> picture;
  Image<glm::u8vec4> in_docs;
};

// Reads a PPM file, the format of the first lessons. This function does not need the image tool, which is optional.
Image<glm::u8vec4> read_ppm(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::string magic;
  int width = 0, height = 0, maximum = 0;
  file >> magic >> width >> height >> maximum;
  file.get();
  EXPECT_EQ(magic, "P6");
  EXPECT_EQ(maximum, 255);
  Image<glm::u8vec4> image(width, height);
  for (std::size_t i = 0; i < image.texels().size(); ++i) {
    char rgb[3]{};
    file.read(rgb, 3);
    image.data()[i] = {static_cast<uint8_t>(rgb[0]), static_cast<uint8_t>(rgb[1]), static_cast<uint8_t>(rgb[2]), 255};
  }
  EXPECT_TRUE(file.good());
  return image;
}

std::string digits_of(int number) { return (number < 10 ? "0" : "") + std::to_string(number); }

// Returns the name of a lesson, counted from 1.
std::string lesson_name(int number) {
  for (const auto& entry : std::filesystem::directory_iterator(HALFSPACE_LESSONS_SOURCE_DIR)) {
    const std::string stem = entry.path().stem().string();
    if (entry.path().extension() == ".cpp" && stem.starts_with(digits_of(number))) return stem;
  }
  return "";
}

// Runs the program of a lesson, counted from 1.
Lesson run_lesson(int number) {
  const std::string digits = digits_of(number);
  Lesson lesson;
  lesson.name = lesson_name(number);
  const TemporaryFolder folder;
  const std::filesystem::path out = folder.path() / ("lesson" + digits + (is_plain(number) ? ".ppm" : ".png")),
                              printed = folder.path() / ("lesson" + digits + ".txt");
  const std::string command =
      std::string(HALFSPACE_EXAMPLES_DIR) + "/lesson-" + lesson.name + " '" + out.string() + "' > '" + printed.string() + "'";
  EXPECT_EQ(std::system(command.c_str()), 0) << command;
  std::ifstream text(printed);
  lesson.output.assign(std::istreambuf_iterator<char>(text), {});
  lesson.picture = is_plain(number) ? read_ppm(out) : read_image(out);
  lesson.in_docs = read_image(std::filesystem::path(HALFSPACE_LESSONS_DOCS_DIR) / "images" / (digits + ".png"));
  return lesson;
}

class Lessons : public testing::TestWithParam<int> {};

TEST_P(Lessons, DrawThePictureOfTheirPage) {
  const Lesson lesson = run_lesson(GetParam());
  EXPECT_EQ(lesson.picture, lesson.in_docs) << lesson.name << ": scripts/docs/lesson_pictures.py draws the pictures again";
}

TEST_P(Lessons, ReportAnOutputFileThatCannotBeWritten) {
  const std::string program = std::string(HALFSPACE_EXAMPLES_DIR) + "/lesson-" + lesson_name(GetParam());
  const ProgramOutput output = run_command(program + " /proc/x.png 2>&1 > /dev/null");
  EXPECT_EQ(output.exit_code, 1);
  EXPECT_TRUE(output.text.starts_with("/proc/x.png: ")) << output.text;
  EXPECT_EQ(std::ranges::count(output.text, '\n'), 1) << output.text;
}

INSTANTIATE_TEST_SUITE_P(All, Lessons, testing::Range(1, kLessons + 1));

int differing_pixels(const Image<glm::u8vec4>& a, const Image<glm::u8vec4>& b) {
  int count = 0;
  for (std::size_t i = 0; i < a.texels().size(); ++i) count += a.texels()[i] != b.texels()[i];
  return count;
}

TEST(Lesson, SixDrawsThePictureOfThree) {
  const Image<glm::u8vec4> own = run_lesson(3).picture, library = run_lesson(6).picture;
  ASSERT_EQ(own.width(), library.width());
  ASSERT_EQ(own.height(), library.height());
  // The page states this number. Vertices are snapped to 1/256 px, which moves edges by less than a pixel.
  EXPECT_EQ(differing_pixels(own, library), 129);
}

int occurrences(const std::string& text, const std::string& part) {
  int count = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
  return count;
}

TEST(Lesson, ThirteenAndFourteenDrawTheSamePictureInEveryWay) {
  const Lesson lanes = run_lesson(13), threads = run_lesson(14);
  EXPECT_NE(lanes.output.find("the same picture"), std::string::npos) << lanes.output;
  EXPECT_EQ(lanes.picture, threads.picture);
  // The scalar loop, the lanes and the bands on one and on all threads draw the same picture. The page states how many pixels of the
  // library's picture differ.
  EXPECT_EQ(occurrences(threads.output, "differing pixels: 0\n"), 4) << threads.output;
  EXPECT_EQ(occurrences(threads.output, "differing pixels: 7\n"), 2) << threads.output;
}

TEST(Lesson, ProgramsHaveAtMostAHundredLines) {
  int programs = 0;
  for (const auto& entry : std::filesystem::directory_iterator(HALFSPACE_LESSONS_SOURCE_DIR)) {
    if (entry.path().extension() != ".cpp") continue;
    std::ifstream file(entry.path());
    EXPECT_LE(std::count(std::istreambuf_iterator<char>(file), {}, '\n'), 100) << entry.path();
    ++programs;
  }
  EXPECT_EQ(programs, kLessons);
}

}  // namespace
}  // namespace halfspace
