// SPDX-License-Identifier: Apache-2.0
//
// `halfspace check-lesson`: right and wrong solutions, folders of submissions, and bad input.
#include <fstream>

#include "cli/cli_run.h"

namespace halfspace {
namespace {

const fs::path kSolutions = "docs/teachers/images";  // tests run from the root of the source tree

class CheckLesson : public Cli {
 protected:
  void SetUp() override {
    Cli::SetUp();
    solution = read_image(kSolutions / "01.png");
    write_png(directory / "right.png", solution);
    Image<glm::u8vec4> wrong = solution;
    for (const int x : {3, 4, 5}) wrong.at(x, 7).x ^= 1;  // the smallest difference of three pixels
    write_png(directory / "wrong.png", wrong);
  }
  Image<glm::u8vec4> solution;
};

TEST_F(CheckLesson, PassesTheSolutionOfEachLesson) {
  int lessons = 0;
  for (const auto& entry : fs::directory_iterator(kSolutions)) {
    const std::string number = std::to_string(std::stoi(entry.path().stem().string()));
    const Outcome o = run({"check-lesson", number, fs::absolute(entry.path()).string()});
    EXPECT_EQ(o.exit_code, 0) << number << ": " << o.err;
    EXPECT_NE(o.out.find("pass"), std::string::npos) << o.out;
    ++lessons;
  }
  EXPECT_EQ(lessons, 24);
  EXPECT_EQ(files(), (std::vector<std::string>{"right.png", "wrong.png"})) << "no difference is written";
}

TEST_F(CheckLesson, CountsThePixelsOfAWrongSolutionAndShowsThem) {
  const Outcome o = run({"check-lesson", "1", "wrong.png"});
  EXPECT_EQ(o.exit_code, 1);
  EXPECT_EQ(o.err, "halfspace: wrong.png: 3 pixels differ from the solution of lesson 1; wrong-difference.png shows them\n");
  const Image<glm::u8vec4> difference = picture("wrong-difference.png");
  int shown = 0;
  for (const glm::u8vec4& pixel : difference.texels()) shown += pixel != glm::u8vec4(0, 0, 0, 255);
  EXPECT_EQ(shown, 3);
  EXPECT_NE(difference.at(4, 7), glm::u8vec4(0, 0, 0, 255));
  EXPECT_EQ(run({"check-lesson", "1", "wrong.png", "-o", "d/other.png"}).exit_code, 1);
  EXPECT_TRUE(fs::exists(directory / "d" / "other.png"));
  EXPECT_EQ(run({"check-lesson", "2", "right.png"}).exit_code, 1) << "the solution of another lesson";
}

TEST_F(CheckLesson, RecognizesThePictureOfTheUnchangedProgram) {
  fs::create_directory(directory / "class");
  for (const int lesson : {1, 13, 24}) {
    const std::string number = std::to_string(lesson);
    fs::copy_file("docs/tutorial/lessons/images" / fs::path(lesson < 10 ? "0" + number : number).concat(".png"),
                  directory / "class" / "start.png", fs::copy_options::overwrite_existing);
    const Outcome o = run({"check-lesson", number, "class/start.png"});
    EXPECT_EQ(o.exit_code, 1) << number;
    EXPECT_EQ(o.err,
              "halfspace: class/start.png: this is the picture of the unchanged program; expected that of your solution of the exercise "
              "of lesson " +
                  number + "\n");
  }
  EXPECT_EQ(files(), (std::vector<std::string>{"class", "right.png", "wrong.png"})) << "no difference is written";
  EXPECT_EQ(run({"check-lesson", "24", "class"}).out, "start.png  fail  the picture of the unchanged program\n0 of 1 passed\n");
}

TEST_F(CheckLesson, PrintsATableForAFolder) {
  fs::create_directories(directory / "class" / "bea");
  fs::rename(directory / "right.png", directory / "class" / "ann.png");
  fs::rename(directory / "wrong.png", directory / "class" / "bea" / "lesson01.png");
  std::ofstream(directory / "class" / "cem.png") << "no picture";
  write_png(directory / "class" / "dan.png", Image<glm::u8vec4>(2, 2));
  std::ofstream(directory / "class" / "notes.txt") << "not a picture, ignored";
  const Outcome o = run({"check-lesson", "1", "class", "-o", "differences"});
  EXPECT_EQ(o.exit_code, 1);
  EXPECT_EQ(o.err, "halfspace: class: 3 of 4 failed\n");
  EXPECT_TRUE(
      o.out.starts_with("ann.png           pass\n"
                        "bea/lesson01.png  fail  3 pixels differ\n"
                        "cem.png           fail  "))
      << o.out;
  EXPECT_TRUE(o.out.ends_with("dan.png           fail  size is 2x2; expected 320x240, the size of the solution\n1 of 4 passed\n")) << o.out;
  EXPECT_TRUE(fs::exists(directory / "differences" / "bea" / "lesson01-difference.png"));
  EXPECT_FALSE(fs::exists(directory / "differences" / "ann-difference.png"));
  fs::remove_all(directory / "class" / "bea");
  fs::remove(directory / "class" / "cem.png");
  fs::remove(directory / "class" / "dan.png");
  EXPECT_EQ(run({"check-lesson", "1", "class"}).exit_code, 0);
}

TEST_F(CheckLesson, RejectsBadInputWithOneLine) {
  fs::create_directory(directory / "empty");
  std::ofstream(directory / "cut.png") << read_bytes(directory / "right.png").substr(0, 200);
  write_png(directory / "small.png", Image<glm::u8vec4>(4, 4));
  const std::string start = fs::absolute("docs/tutorial/lessons/images/01.png").string();
  const struct {
    std::vector<std::string> arguments;
    int exit_code;
    std::string start;
  } mistakes[]{
      {{"0", "right.png"}, 2, "N: '0'; expected the number of a lesson, 1 to "},
      {{"99", "right.png"}, 2, "N: '99'; expected the number of a lesson, 1 to "},
      {{"one", "right.png"}, 2, "N: 'one'; expected the number of a lesson, 1 to "},
      {{"1", "none.png"}, 3, "none.png: no such file"},
      {{"1", "cut.png"}, 3, "cut.png: "},
      {{"1", "small.png"}, 3, "small.png: size is 4x4; expected 320x240"},
      {{"1", "empty"}, 3, "empty: contains no pictures"},
      {{"1", "wrong.png", "-o", "wrong.png"}, 4, "wrong.png: "},
      {{"1", "wrong.png", "-o", start}, 4, start},
      {{"1", "wrong.png", "-o", "/proc/d.png"}, 4, "/proc/d.png: "},
  };
  for (const auto& mistake : mistakes) {
    std::vector<std::string> words{"check-lesson"};
    words.insert(words.end(), mistake.arguments.begin(), mistake.arguments.end());
    const Outcome o = run(words);
    EXPECT_EQ(o.exit_code, mistake.exit_code) << o.err;
    EXPECT_TRUE(o.err.starts_with("halfspace: " + mistake.start)) << o.err;
    EXPECT_EQ(lines_of(o.err), 1) << o.err;
    EXPECT_EQ(o.out, "");
  }
}

}  // namespace
}  // namespace halfspace
