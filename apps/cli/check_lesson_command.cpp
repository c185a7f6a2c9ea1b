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

// Returns the folder of the solutions, NN.png for lesson NN. The build creates a link to it at this path, and packages contain it.
fs::path solutions_folder() {
  std::error_code error;
  const fs::path program = fs::read_symlink("/proc/self/exe", error);
  return (program.parent_path() / "../share/halfspace/lessons").lexically_normal();
}

fs::path solution_path(const fs::path& folder, int lesson) { return folder / fmt::format("{:02}.png", lesson); }

// Returns the picture of the solution.
fs::path solution_of(const std::string& text) {
  const fs::path folder = solutions_folder();
  int lessons = 0;
  while (fs::exists(solution_path(folder, lessons + 1))) ++lessons;
  if (lessons == 0) throw InputError(folder.string() + ": no solutions of lessons; expected 01.png and the others of docs/teachers/images");
  const int lesson = parse_number(text);
  if (lesson < 1 || lesson > lessons) throw UsageError(fmt::format("N: '{}'; expected the number of a lesson, 1 to {}", text, lessons));
  return solution_path(folder, lesson);
}

// What is known about a picture that was handed in.
struct Verdict {
  int64_t differing = 0;
  std::string problem{};  // why it cannot be compared, or empty
  bool passed() const { return problem.empty() && differing == 0; }
};

// Compares a picture. The difference is written to `difference` if the picture differs and the path is not empty.
Verdict verdict_on(const fs::path& file, const fs::path& solution, const fs::path& difference) {
  const ComparedImage expected{"the solution", read_image(solution)}, picture = read_compared_image(file.string());
  Image<glm::u8vec4> colors;
  const Comparison c = compare(expected, picture, &colors);
  if (c.difference.differing != 0 && !difference.empty()) write_png(difference, colors);
  return {c.difference.differing};
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
void check_folder(const fs::path& folder, const fs::path& solution, const fs::path& out) {
  const std::vector<fs::path> pictures = pictures_in(folder);
  std::size_t width = 0, passed = 0;
  for (const fs::path& p : pictures) width = std::max(width, printable(p.string()).size());
  for (const fs::path& p : pictures) {
    Verdict verdict;
    try {
      verdict = verdict_on(folder / p, solution, out.empty() ? out : out / fs::path(p).replace_extension("").concat(kDifferenceEnd));
    } catch (const InputError& error) {
      verdict.problem = error.what();
      if (const std::string place = (folder / p).string() + ": "; verdict.problem.starts_with(place))
        verdict.problem.erase(0, place.size());
    }
    const std::string reason = verdict.problem.empty() ? fmt::format("{} pixels differ", verdict.differing) : verdict.problem;
    std::cout << fmt::format("{:<{}}  {}\n", printable(p.string()), width, verdict.passed() ? "pass" : "fail  " + printable(reason));
    passed += verdict.passed();
  }
  std::cout << fmt::format("{} of {} passed\n", passed, pictures.size());
  if (passed < pictures.size())
    throw DifferenceError(fmt::format("{}: {} of {} failed", folder.string(), pictures.size() - passed, pictures.size()));
}

}  // namespace

void check_lesson_command(const CheckLessonArguments& args) {
  const fs::path solution = solution_of(args.lesson), file = args.file;
  std::error_code error;
  if (fs::is_directory(file, error)) {
    check_folder(file, solution, args.out);
    return;
  }
  const fs::path difference = args.out.empty() ? file.stem().concat(kDifferenceEnd) : fs::path(args.out);
  reject_overwriting(difference, {file, solution});
  const Verdict verdict = verdict_on(file, solution, difference);
  if (!verdict.passed())
    throw DifferenceError(fmt::format("{}: {} pixels differ from the solution of lesson {}; {} shows them", args.file, verdict.differing,
                                      args.lesson, difference.string()));
  std::cout << fmt::format("{}: pass, this is the picture of the solution of lesson {}\n", printable(args.file), args.lesson);
}

}  // namespace halfspace
