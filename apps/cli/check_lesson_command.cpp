// SPDX-License-Identifier: Apache-2.0
//
// `halfspace check-lesson N FILE`: compares the picture of an exercise, or all pictures of a folder, with the solution of a lesson.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <iostream>

#include "cli/commands.h"
#include "command_line/arguments.h"
#include "command_line/errors.h"
#include "halfspace/core/text.h"
#include "halfspace/image/atomic_output.h"
#include "halfspace/image/image_errors.h"
#include "halfspace/image/image_io.h"
#include "halfspace/render/frame/image_comparison.h"
#include "halfspace/render/model_file/input_files.h"

namespace halfspace {

namespace {

namespace fs = std::filesystem;

constexpr const char* kDifferenceEnd = "-difference.png";

// Returns a folder with the picture NN.png of lesson NN. The build creates links to the folders at these paths, and packages contain them.
fs::path pictures_folder(const char* name) {
  std::error_code error;
  const fs::path program = fs::read_symlink("/proc/self/exe", error);
  return (program.parent_path() / "../share/halfspace" / name).lexically_normal();
}

fs::path picture_path(const fs::path& folder, int lesson) { return folder / fmt::format("{:02}.png", lesson); }

// The pictures of a lesson. They have the same size.
struct LessonPictures {
  fs::path solution;
  fs::path start;  // of the program before the exercise; teachers can leave it out
};

LessonPictures pictures_of(const std::string& text) {
  const fs::path folder = pictures_folder("lessons");
  int lessons = 0;
  while (fs::exists(picture_path(folder, lessons + 1))) ++lessons;
  if (lessons == 0) throw InputError(folder.string() + ": no solutions of lessons; expected 01.png and the others of docs/teachers/images");
  const int lesson = parse_number(text);
  if (lesson < 1 || lesson > lessons) throw UsageError(fmt::format("N: '{}'; expected the number of a lesson, 1 to {}", text, lessons));
  return {picture_path(folder, lesson), picture_path(pictures_folder("lesson_starts"), lesson)};
}

// What is known about a picture that was handed in.
struct Verdict {
  int64_t differing = 0;
  bool is_start = false;  // it is the picture of the unchanged program
  std::string problem{};  // why it cannot be compared, or empty
  bool passed() const { return problem.empty() && differing == 0; }
  std::string reason() const {
    if (!problem.empty()) return problem;
    return is_start ? "the picture of the unchanged program" : fmt::format("{} pixels differ", differing);
  }
};

// Compares a picture. If it is neither the solution nor the start, and the path is not empty, the difference is written to `difference`.
Verdict verdict_on(const fs::path& file, const LessonPictures& lesson, const fs::path& difference) {
  const ComparedImage expected{"the solution", read_image(lesson.solution)}, picture = read_compared_image(file.string());
  Image<glm::u8vec4> colors;
  Verdict verdict{compare(expected, picture, &colors).difference.differing};
  if (verdict.passed()) return verdict;
  verdict.is_start = fs::exists(lesson.start) && compare({"the start", read_image(lesson.start)}, picture).difference.differing == 0;
  if (!verdict.is_start && !difference.empty()) write_png(difference, colors);
  return verdict;
}

bool is_picture(const fs::path& path) {
  std::string end = path.extension().string();
  std::ranges::transform(end, end.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return (end == ".ppm" || end == ".png" || end == ".tif" || end == ".tiff" || end == ".jpg" || end == ".jpeg") &&
         !path.string().ends_with(kDifferenceEnd);
}

// Returns the pictures in a folder and its subfolders, relative to the folder and in alphabetical order.
std::vector<fs::path> pictures_in(const fs::path& folder) {
  std::vector<fs::path> pictures;
  try {
    for (const auto& entry : fs::recursive_directory_iterator(folder)) {
      if (entry.is_regular_file() && is_picture(entry.path())) pictures.push_back(fs::relative(entry.path(), folder));
    }
  } catch (const fs::filesystem_error& error) {
    throw InputError(folder.string() + ": " + error.code().message());
  }
  std::ranges::sort(pictures);
  if (pictures.empty()) throw InputError(folder.string() + ": contains no pictures; expected .ppm, .png or .tif files");
  return pictures;
}

// Prints one line for each picture in the folder. The differences are written to files with the same names in `out`, unless it is empty.
void check_folder(const fs::path& folder, const LessonPictures& lesson, const fs::path& out) {
  const std::vector<fs::path> pictures = pictures_in(folder);
  std::size_t width = 0, passed = 0;
  for (const fs::path& p : pictures) width = std::max(width, printable(p.string()).size());
  for (const fs::path& p : pictures) {
    Verdict verdict;
    try {
      verdict = verdict_on(folder / p, lesson, out.empty() ? out : out / fs::path(p).replace_extension("").concat(kDifferenceEnd));
    } catch (const InputError& error) {
      verdict.problem = error.what();
      if (const std::string place = (folder / p).string() + ": "; verdict.problem.starts_with(place))
        verdict.problem.erase(0, place.size());
    }
    std::cout << fmt::format("{:<{}}  {}\n", printable(p.string()), width,
                             verdict.passed() ? "pass" : "fail  " + printable(verdict.reason()));
    passed += verdict.passed();
  }
  std::cout << fmt::format("{} of {} passed\n", passed, pictures.size());
  if (passed < pictures.size())
    throw DifferenceError(fmt::format("{}: {} of {} failed", folder.string(), pictures.size() - passed, pictures.size()));
}

}  // namespace

void check_lesson_command(const CheckLessonArguments& args) {
  const LessonPictures lesson = pictures_of(args.lesson);
  const fs::path file = args.file;
  std::error_code error;
  if (fs::is_directory(file, error)) {
    check_folder(file, lesson, args.out);
    return;
  }
  const fs::path difference = args.out.empty() ? file.stem().concat(kDifferenceEnd) : fs::path(args.out);
  reject_overwriting(difference, {file, lesson.solution, lesson.start});
  const Verdict verdict = verdict_on(file, lesson, difference);
  if (verdict.is_start)
    throw DifferenceError(
        fmt::format("{}: this is the picture of the unchanged program; expected that of your solution of the exercise of lesson {}",
                    args.file, args.lesson));
  if (!verdict.passed())
    throw DifferenceError(fmt::format("{}: {} pixels differ from the solution of lesson {}; {} shows them", args.file, verdict.differing,
                                      args.lesson, difference.string()));
  std::cout << fmt::format("{}: pass, this is the picture of the solution of lesson {}\n", printable(args.file), args.lesson);
}

}  // namespace halfspace
