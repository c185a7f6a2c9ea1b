// SPDX-License-Identifier: Apache-2.0
//
// Runs the program as a process and checks its exit code, streams and files. CMake defines HALFSPACE_PROGRAM as the path of the program.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <sched.h>
#include <signal.h>
#include <sys/inotify.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include "cli/cli_run.h"
#include "support/errors.h"
#include "support/files.h"
#include "support/program.h"
#include "support/sanitized.h"
#include "support/temporary_folder.h"

namespace halfspace {
namespace {

// ---- invalid input: exit code and one-line message --------------------------------------------------------------

struct Mistake {
  const char* name;
  std::vector<std::string> arguments;
  int exit_code;
  std::string place;  // text after "halfspace: "; {here} stands for the directory of the test, because paths in --set become absolute
  std::vector<std::string> keywords;
};

// Returns the list of shipped scenes as printed in error messages. (Tests run from the root of the source tree.)
std::string shipped_scenes() {
  std::vector<std::string> names;
  std::error_code absent;
  for (const auto& entry : fs::directory_iterator("scenes", absent)) names.push_back(entry.path().stem().string());
  std::ranges::sort(names);
  std::string list;
  for (const std::string& name : names) list += (list.empty() ? "" : ", ") + name;
  return list;
}

void PrintTo(const Mistake& m, std::ostream* os) { *os << m.name; }

const Mistake kMistakes[] = {
    {"NoCommand", {}, 2, "no command", {"render", "completion", "--help"}},
    {"WrongCommand", {"rendr", "earth"}, 2, "unknown command", {"'rendr'", "'render'"}},
    {"FarCommand", {"paint"}, 2, "unknown command", {"'paint'", "render", "completion"}},
    {"WrongOption", {"render", "earth", "--siez", "3x3"}, 2, "unknown option", {"'--siez'", "'--size'"}},
    {"OptionOfNoCommand", {"--jsn"}, 2, "unknown option", {"'--jsn'", "--help", "--version"}},
    {"NoScene", {"render"}, 2, "SCENE", {"required", "render --help"}},
    {"SizeWithoutX", {"render", "earth", "--size", "640"}, 2, "--size", {"'640'", "WxH"}},
    {"SizeZero", {"render", "earth", "--size", "0x480"}, 2, "--size", {"'0x480'", "WxH"}},
    {"SizeTooLarge", {"render", "earth", "--size", "640x16385"}, 2, "--size", {"'640x16385'", "16384"}},
    {"SizeNegative", {"render", "earth", "--size=-640x480"}, 2, "--size", {"'-640x480'", "WxH"}},
    {"SizeOverflow", {"render", "earth", "--size", "99999999999x1"}, 2, "--size", {"'99999999999x1'", "WxH"}},
    {"SizeTail", {"render", "earth", "--size", "640x480px"}, 2, "--size", {"'640x480px'", "WxH"}},
    {"SizeMissing", {"render", "earth", "--size"}, 2, "--size", {"WxH", "missing", "render --help"}},
    {"ThreadsZero", {"render", "earth", "--threads", "0"}, 2, "--threads", {"'0'", "1 to 1024"}},
    {"ThreadsNegative", {"render", "earth", "--threads=-2"}, 2, "--threads", {"'-2'", "1 to 1024"}},
    {"ThreadsWord", {"render", "earth", "--threads", "two"}, 2, "--threads", {"'two'", "1 to 1024"}},
    {"StatsFormat", {"render", "earth", "--stats=xml"}, 2, "--stats", {"'xml'", "--stats=json"}},
    {"SetWithoutValue", {"render", "earth", "--set", "earth.color"}, 2, "--set", {"'earth.color'", "KEY=VALUE"}},
    {"OutputFormat", {"render", "earth", "-o", "earth.bmp"}, 2, "-o", {"'earth.bmp'", ".png", ".exr"}},
    {"NearScene", {"render", "eart"}, 3, "unknown scene", {"'eart'", "'earth'"}},
    {"FarScene", {"render", "teapot"}, 3, "unknown scene", {"'teapot'", shipped_scenes()}},
    {"NoModelFile", {"render", "a.fbx"}, 3, "a.fbx", {"does not exist", ".glb", ".obj", "JSON"}},
    {"SizeTwice", {"render", "earth", "--size", "64x36", "--size", "32x18"}, 2, "--size", {"more than once", "render --help"}},
    {"EmptyOutput", {"render", "earth", "-o", ""}, 2, "--output", {"empty"}},
    {"EmptyCamera", {"render", "earth", "--camera", ""}, 2, "--camera", {"empty"}},
    {"PitchTooHigh", {"render", "a.glb", "--pitch", "90"}, 2, "--pitch", {"'90'", "-89 to 89"}},
    {"BackgroundWord", {"render", "a.glb", "--background", "red"}, 2, "--background", {"'red'", "#rrggbb", "transparent"}},
    {"YawInside", {"render", "a.glb", "--inside", "--yaw", "90"}, 2, "--yaw", {"--inside", "--eye"}},
    {"ZoomOfEye", {"render", "a.glb", "--eye", "1,2,3", "--zoom", "2"}, 2, "--zoom", {"--eye"}},
    {"FovOfCamera", {"render", "a.glb", "--camera", "shot", "--fov", "20"}, 2, "--fov", {"fitted camera", "--camera shot"}},
    {"YawOfCamera", {"render", "a.glb", "--camera", "shot", "--yaw", "20"}, 2, "--yaw", {"fitted camera", "--camera shot"}},
    {"NoSceneFile", {"render", "my.json"}, 3, "my.json", {"no such"}},
    {"NearKey", {"render", "earth", "--set", "earth.colour=a.png"}, 3, "--set: earth.colour", {"'colour'", "'color'"}},
    {"NearThing", {"render", "earth", "--set", "erath.color=a.png"}, 3, "--set: erath.color", {"'erath'", "'earth'"}},
    {"WrongType", {"render", "earth", "--set", "earth.radius=big"}, 3, "--set: earth.radius", {"number", "1e-06", "1e+06", "'big'"}},
    {"WrongRange", {"render", "earth", "--set", "earth.latitudes=1"}, 3, "--set: earth.latitudes", {"2 to 8192", "got 1"}},
    {"WrongChoice", {"render", "earth", "--set", "earth.shape=ball"}, 3, "--set: earth.shape", {"\"ball\"", "uv_sphere", "torus_knot"}},
    {"EmptyValue", {"render", "earth", "--set", "earth.color="}, 3, "--set: earth.color", {"color", "#rrggbb", "texture", "image file"}},
    {"NoShading", {"render", "earth", "--shading", "gourod"}, 2, "--shading", {"'gourod'", "'gouraud'"}},
    {"NoMapOfNormals",
     {"render", "earth", "--set", "earth.normal_map=1"},
     3,
     "scene earth: objects.earth.normal",
     {"normal_map", "image file"}},
    {"MaxErrorZero", {"render", "earth", "--max-error", "1e-9"}, 2, "--max-error", {"'1e-9'", "0.01 to 100 pixels"}},
    {"MaxErrorColorWord", {"render", "earth", "--max-error-color", "low"}, 2, "--max-error-color", {"'low'", "0.1 to 255 8-bit"}},
    {"ThreeSamples", {"render", "earth", "--set", "samples=3"}, 3, "scene earth: samples", {"1, 2, 4 or 8", "got 3"}},
    {"NoCamera", {"render", "earth", "--camera", "nroth"}, 3, "--camera", {"'nroth'", "'north'"}},
    {"TimeWord", {"render", "earth", "--time", "noon"}, 2, "--time", {"'noon'", "seconds"}},
    {"FramesBackwards", {"render", "earth", "--frames", "5..2"}, 2, "--frames", {"'5..2'", "FIRST..LAST"}},
    {"FramesTooMany", {"render", "earth", "--frames", "0..99999999"}, 2, "--frames", {"'0..99999999'", "below 10000000"}},
    {"FramesWord", {"render", "earth", "--frames", "all"}, 2, "--frames", {"'all'", "FIRST..LAST"}},
    {"FpsZero", {"render", "earth", "--frames", "0..1", "--fps", "0"}, 2, "--fps", {"'0'", "0.001 to 1000000 frames per second"}},
    {"FpsAlone", {"render", "earth", "--fps", "24"}, 2, "--fps", {"--frames FIRST..LAST"}},
    {"ResumeAlone", {"render", "earth", "--resume"}, 2, "--resume", {"--frames FIRST..LAST", "--list FILE"}},
    {"ResumeAStream", {"render", "earth", "--frames", "0..1", "-o", "-", "--resume"}, 2, "--resume", {"single pictures"}},
    {"UnknownFormat", {"render", "earth", "-o", "-", "--format", "mp4"}, 2, "--format", {"'mp4'", "y4m", "rgbaf32"}},
    {"FormatOfAFile", {"render", "earth", "-o", "a.png", "--format", "rgba"}, 2, "--format", {"-o -"}},
    {"AnimationOfOnePicture", {"render", "earth", "-o", "a.gif"}, 2, "-o", {"'a.gif'", "--frames"}},
    {"ShardOfAnAnimation", {"render", "earth", "--frames", "0..1", "-o", "a.gif", "--shard", "0/2"}, 2, "--shard", {"file per frame"}},
    {"AnimationWithANumber", {"render", "earth", "--frames", "0..1", "-o", "a_%04d.gif"}, 2, "-o", {"'a_%04d.gif'", "animation"}},
    {"ReportIsAScene", {"render", "earth", "moon", "--report", "/"}, 4, "/", {"directory"}},
    {"LoopOfPictures", {"render", "earth", "--frames", "0..1", "-o", "a.png", "--loop", "2"}, 2, "--loop", {".webp or .gif"}},
    {"LoopWord", {"render", "earth", "--frames", "0..1", "-o", "a.gif", "--loop", "x"}, 2, "--loop", {"'x'", "0 to 65535"}},
    {"ValuesOfAnAnimation", {"render", "earth", "--frames", "0..1", "-o", "a.gif", "--aov", "depth"}, 2, "-o", {"--aov"}},
    {"TwoScenesOneFile", {"render", "earth", "moon", "-o", "a.png"}, 2, "'earth' and 'moon'", {"a.png", "{name}"}},
    {"TheSameSceneTwice", {"render", "earth", "earth", "-o", "{name}.png"}, 2, "'earth' and 'earth'", {"earth.png", "different names"}},
    {"MissingList", {"render", "--list", "none.txt", "-o", "{name}.png"}, 3, "--list", {"none.txt", "No such file"}},
    {"FolderAsList", {"render", "--list", "/", "-o", "{name}.png"}, 3, "--list", {"cannot be read"}},
    {"ReportOfOne", {"render", "earth", "--report", "a.json"}, 2, "--report", {"--list FILE"}},
    {"PrintOfAList", {"render", "earth", "moon", "--print"}, 2, "--print", {"--list"}},
    {"ProgressWord", {"render", "earth", "--progress", "dots"}, 2, "--progress", {"'dots'", "json"}},
    {"QuietAndVerbose", {"render", "earth", "--quiet", "--verbose"}, 2, "--quiet", {"only one"}},
    {"FramesIntoADevice", {"render", "earth", "--frames", "0..1", "-o", "/dev/null"}, 2, "-o", {"'/dev/null'", "--frames", ".png", ".exr"}},
    {"ControlCharacters", {"render", "a\nb\x1b"}, 3, "unknown scene", {"'a\\x0ab\\x1b'", shipped_scenes()}},
    {"PrintChecksToo", {"render", "earth", "--print", "--size", "bogus"}, 2, "--size", {"'bogus'", "WxH"}},
    {"ListModel", {"list", "a/Box.glb"}, 3, "a/Box.glb: is a model file", {"a scene file", "render a/Box.glb --print"}},
    {"InfoScene", {"info", "shapes"}, 3, "shapes: is a scene", {"model file", "list shapes"}},
    {"ListUnknown", {"list", "eart"}, 3, "unknown scene", {"'eart'", "'earth'"}},
    {"ValidateNothing", {"validate"}, 2, "SCENE", {"required", "--table", "validate --help"}},
    {"ValidateBoth", {"validate", "earth", "--table"}, 2, "--table", {"SCENE"}},
    {"ValidateFull", {"validate", "earth", "--full"}, 2, "--full", {"--table"}},
    {"ValidateNowhere", {"validate", "shadow-plane", "--size", "16x9", "-o", "/proc/none"}, 4, "/proc/none", {"directory"}},
    {"CompareOne", {"compare", "a.png"}, 2, "B", {"required", "compare --help"}},
    {"CompareNothing", {"compare", "a.png", "b.png"}, 3, "a.png", {"no such file"}},
    {"CompareTolerance", {"compare", "a.png", "b.png", "--tolerance", "-1"}, 2, "--tolerance", {"'-1'", "0 or more"}},
    {"CompareNowhere",
     {"compare", "a.png", "b.png", "-o", "/dev/null/d.png"},
     4,
     "/dev/null/d.png",
     {"cannot write", "/dev/null is not a directory"}},
    {"ChartNothing", {"chart"}, 2, "STUDY", {"required", "chart --help"}},
    {"ChartNear", {"chart", "shading_rat"}, 2, "unknown study", {"'shading_rat'", "'shading_rate'"}},
    {"ChartThreads", {"chart", "tone", "--threads", "0"}, 2, "--threads", {"'0'", "1 to 1024"}},
    {"ChartNowhere", {"chart", "tone", "-o", "/proc/none"}, 4, "/proc/none", {"directory"}},
    {"NormalWithoutOutput", {"convert-normal", "a.png"}, 2, "--output", {"required", "convert-normal --help"}},
    {"NormalFormat", {"convert-normal", "a.png", "-o", "n.jpg"}, 2, "-o", {"'n.jpg'", ".png"}},
    {"NormalStrength", {"convert-normal", "a.png", "-o", "n.png", "--strength", "strong"}, 2, "--strength", {"'strong'", "black to white"}},
    {"NormalEdges", {"convert-normal", "a.png", "-o", "n.png", "--edges", "round"}, 2, "--edges", {"'round'", "repeat", "clamp", "sphere"}},
    {"NormalOfNothing", {"convert-normal", "a.png", "-o", "n.png"}, 3, "a.png", {"no such file"}},
    {"NormalNowhere",
     {"convert-normal", "a.png", "-o", "/dev/null/n.png"},
     4,
     "/dev/null/n.png",
     {"cannot write", "/dev/null is not a directory"}},
    {"Shell", {"completion", "tcsh"}, 2, "completion", {"'tcsh'", "bash", "zsh", "fish"}},
    {"NoMap",
     {"render", "earth", "--set", "earth.color=none.jpg"},
     3,
     "scene earth: objects.earth.color: {here}/none.jpg",
     {"no such file"}},
    {"MapIsADirectory", {"render", "earth", "--set", "earth.color=."}, 3, "scene earth: objects.earth.color: {here}/", {"is a directory"}},
    {"MapIsADevice",
     {"render", "earth", "--set", "earth.color=/dev/zero"},
     3,
     "scene earth: objects.earth.color: /dev/zero",
     {"regular file"}},
    {"NormalOfNothingIntoNewFolder", {"convert-normal", "a.png", "-o", "new/n.png"}, 3, "a.png", {"no such file"}},
    {"ParentIsAFile",
     {"render", "earth", "-o", "/dev/null/new/earth.png"},
     4,
     "/dev/null/new/earth.png",
     {"cannot write", "/dev/null is not a directory"}},
    {"ParentCannotBeMade",
     {"render", "earth", "--size", "8x8", "-o", "/proc/none/earth.png"},
     4,
     "/proc/none",
     {"cannot create the directory"}},
    {"OutputIsADirectory", {"render", "earth", "-o", ".."}, 4, "..", {"is a directory"}},
    {"FullDisk", {"render", "earth", "--size", "8x8", "-o", "/dev/full"}, 4, "/dev/full", {"cannot write", "No space left on device"}},
};

// Checks that the text is one complete line that contains the place and the keywords.
testing::AssertionResult is_line_with(const std::string& text, const std::string& place, const std::vector<std::string>& keywords) {
  if (!text.ends_with('\n')) return testing::AssertionFailure() << "not a complete line: " << text;
  return reports(text.substr(0, text.size() - 1), place, keywords);
}

class CliMistake : public Cli, public testing::WithParamInterface<Mistake> {};

TEST_P(CliMistake, IsReportedInOneLine) {
  const Outcome o = run(GetParam().arguments);
  EXPECT_EQ(o.exit_code, GetParam().exit_code);
  std::string place = "halfspace: " + GetParam().place;
  if (const std::size_t at = place.find("{here}"); at != std::string::npos) place.replace(at, 6, directory.string());
  EXPECT_TRUE(is_line_with(o.err, place, GetParam().keywords));
  EXPECT_EQ(o.out, "");
  EXPECT_TRUE(files().empty()) << files().front() << " was left behind";
}

INSTANTIATE_TEST_SUITE_P(Table, CliMistake, testing::ValuesIn(kMistakes), [](const auto& mistake) { return mistake.param.name; });

// Checks the complete text of some messages.
TEST_F(Cli, ErrorMessagesAreExact) {
  const auto error = [&](const std::vector<std::string>& arguments) { return run(arguments).err; };
  EXPECT_EQ(error({"rendr", "earth"}), "halfspace: unknown command 'rendr'; did you mean 'render'?\n");
  EXPECT_EQ(error({"render", "earth", "--size", "640"}),
            "halfspace: --size is '640'; expected WxH with 1 to 16384 each, for example 1920x1080\n");
  EXPECT_EQ(error({"render", "eart"}), "halfspace: unknown scene 'eart'; did you mean 'earth'?\n");
  EXPECT_EQ(error({"render", "earth", "--set", "earth.latitudes=1"}),
            "halfspace: --set: earth.latitudes: expected an integer from 2 to 8192, got 1\n");
  EXPECT_EQ(error({"render", "earth", "--set", "earth.color=none.jpg"}),
            "halfspace: scene earth: objects.earth.color: " + (directory / "none.jpg").string() + ": no such file; expected an image\n");
  EXPECT_EQ(error({"render", "earth", "--size", "8x8", "-o", "/dev/full"}),
            "halfspace: /dev/full: cannot write (No space left on device)\n");
}

TEST_F(Cli, RejectsFilesThatAreNotImages) {
  std::ofstream(directory / "map.png") << "no picture";
  const Outcome o = run({"render", "earth", "--set", "earth.color=map.png"});
  EXPECT_EQ(o.exit_code, 3);
  EXPECT_TRUE(is_line_with(o.err, "halfspace: scene earth: objects.earth.color: " + (directory / "map.png").string(), {"PNG"}));
}

// On a processor without the required features, the program prints one line instead of crashing with an illegal instruction. An emulator
// provides such a processor (qemu64 supports nothing beyond SSE3).
TEST_F(Cli, ReportsAnUnsupportedProcessorInOneLine) {
  if (!command_works("qemu-x86_64 --version")) GTEST_SKIP() << "qemu-x86_64 (package qemu-user) is absent";
  if (kSanitized) GTEST_SKIP() << "sanitizers do not run in the emulator";
  const std::string command = std::string("qemu-x86_64 -cpu qemu64 ") + HALFSPACE_PROGRAM + " info 2> " + (root / "err").string();
  EXPECT_EQ(WEXITSTATUS(std::system(command.c_str())), 1);
  const std::string line = read_bytes(root / "err");
  EXPECT_TRUE(is_line_with(line, "halfspace: ", {"this build needs", "SSSE3", "processor"}));
}

// ---- valid input -----------------------------------------------------------------------------------------------

TEST_F(Cli, RenderNamesTheFileAfterTheScene) {
  const Outcome o = run({"render", "earth", "--size", "64x36"});
  EXPECT_EQ(o.exit_code, 0) << o.err;
  EXPECT_EQ(o.out + o.err, "") << "the program is silent unless output is requested";
  EXPECT_EQ(files(), std::vector<std::string>{"earth.png"});
}

TEST_F(Cli, CreatesMissingFolders) {
  const auto succeeds = [&](const std::vector<std::string>& arguments) {
    const Outcome o = run(arguments);
    EXPECT_EQ(o.exit_code, 0) << o.err;
    EXPECT_EQ(o.err, "");
  };
  succeeds({"render", "earth", "--size", "8x8", "-o", "new/folder/earth.png"});
  succeeds({"render", "earth", "--size", "8x8", "--frames", "0..1", "-o", "frames/earth.png"});
  succeeds({"convert-normal", "new/folder/earth.png", "-o", "normals/earth.png"});
  succeeds({"compare", "frames/earth_0000.png", "frames/earth_0001.png", "-o", "differences/earth.png"});
  for (const char* name :
       {"new/folder/earth.png", "frames/earth_0000.png", "frames/earth_0001.png", "normals/earth.png", "differences/earth.png"})
    EXPECT_TRUE(fs::exists(directory / name)) << name;
}

TEST_F(Cli, OutputIsIdenticalForAnyThreadCount) {
  for (const char* n : {"1", "2", "7"})
    EXPECT_EQ(run({"render", "earth", "--size", "200x120", "--threads", n, "-o", std::string(n) + ".png"}).exit_code, 0);
  EXPECT_EQ(read_bytes(directory / "1.png"), read_bytes(directory / "2.png"));
  EXPECT_EQ(read_bytes(directory / "1.png"), read_bytes(directory / "7.png"));
}

TEST_F(Cli, ShadingOverridesEveryObject) {
  // Two objects, one of which specifies a shading rate.
  std::ofstream(directory / "s.json") << R"({"version": 1, "lights": {"l": {"direction": [1, 1, 1]}},
    "objects": {"a": {"latitudes": 8, "longitudes": 16, "position": [-1.1, 0, 0]},
                "b": {"latitudes": 8, "longitudes": 16, "position": [1.1, 0, 0], "shading": "gouraud"}}})";
  std::vector<Image<glm::u8vec4>> pictures;
  for (const char* rate : {"none", "flat", "provoking", "gouraud", "phong"}) {
    const std::string out = std::string(rate) + ".png", again = std::string(rate) + "-set.png";
    EXPECT_EQ(run({"render", "s.json", "--size", "64x36", "--shading", rate, "-o", out}).exit_code, 0);
    const std::string set = std::string("shading=") + rate;
    EXPECT_EQ(run({"render", "s.json", "--size", "64x36", "--set", "a." + set, "--set", "b." + set, "-o", again}).exit_code, 0);
    EXPECT_TRUE(picture(out) == picture(again)) << rate;
    EXPECT_EQ(std::ranges::find(pictures, picture(out)), pictures.end()) << "all five images differ";
    pictures.push_back(picture(out));
  }
}

// The choices of --max-error are reported, and can be printed as a scene that renders the same image.
TEST_F(Cli, MaxErrorReportsItsChoices) {
  const std::vector<std::string> asked{"render", "shadow-plane", "--size", "160x90", "--max-error", "0.3"};
  std::vector<std::string> render = asked, print = asked;
  render.insert(render.end(), {"--stats=json", "-o", "asked.png"});
  print.emplace_back("--print");
  const Outcome o = run(render);
  EXPECT_EQ(o.exit_code, 0) << o.err;
  std::map<std::string, std::string> choices;
  const auto report = nlohmann::json::parse(o.out);
  for (const auto& choice : report.at("choices")) {
    choices[choice.at("key")] = choice.at("value");
    EXPECT_FALSE(choice.at("why").get<std::string>().empty());
  }
  EXPECT_EQ(choices.at("samples"), "4") << "4 is the smallest sample count with 0.5/sqrt(samples) px within 0.3";
  EXPECT_LT(std::stoi(choices.at("objects.earth.latitudes")), 128)
      << "a globe of about 20 px needs fewer latitudes than the scene specifies";
  EXPECT_EQ(choices.at("shadow.method"), "bilinear");
  const Outcome printed = run(print);
  EXPECT_EQ(printed.exit_code, 0) << printed.err;
  std::ofstream(directory / "chosen.json") << printed.out;
  EXPECT_EQ(run({"render", "chosen.json", "--size", "160x90", "-o", "chosen.png"}).exit_code, 0);
  EXPECT_TRUE(picture("asked.png") == picture("chosen.png"));
}

TEST_F(Cli, RenderUsesAColorMap) {
  EXPECT_EQ(run({"render", "earth", "--size", "64x36", "-o", "map.png"}).exit_code, 0);
  EXPECT_EQ(run({"render", "earth", "--size", "64x36", "-o", "again.png", "--set", "earth.color=map.png"}).exit_code, 0);
  EXPECT_EQ(files(), (std::vector<std::string>{"again.png", "map.png"}));
}

TEST_F(Cli, PrintsStatisticsAsTextAndJson) {
  const Outcome text = run({"render", "--stats", "earth", "--size", "64x36"});
  EXPECT_EQ(text.exit_code, 0) << text.err;
  EXPECT_TRUE(text.out.starts_with("earth, 64x36, ")) << text.out;
  const std::regex line("\\w+ +[0-9.]+( \\([0-9.]+ %\\))?");
  std::istringstream lines(text.out.substr(text.out.find('\n') + 1));
  for (std::string l; std::getline(lines, l);) EXPECT_TRUE(std::regex_match(l, line)) << l;
  const Outcome json = run({"render", "earth", "--stats=json", "--size", "64x36"});
  const auto parsed = nlohmann::json::parse(json.out);
  EXPECT_EQ(parsed.at("width"), 64);
  EXPECT_TRUE(parsed.at("counts").contains("fragments_shaded"));
}

TEST_F(Cli, InfoPrintsVersionAndJsonKeys) {
  EXPECT_TRUE(run({"info"}).out.starts_with("halfspace "));
  const auto parsed = nlohmann::json::parse(run({"info", "--json"}).out);
  for (const char* key : {"version", "arch", "lanes", "compiler", "cores", "cores_limit", "image_tool", "jpeg_tool", "draco_tool"})
    EXPECT_TRUE(parsed.contains(key)) << key;
  for (const char* line : {"\ndraco tool ", "\nimage tool ", "\njpeg tool "})
    EXPECT_NE(run({"info"}).out.find(line), std::string::npos) << line;
}

TEST_F(Cli, ThreadsFollowTheAffinityMask) {
  cpu_set_t all;
  ASSERT_EQ(::sched_getaffinity(0, sizeof all, &all), 0);
  cpu_set_t one;
  CPU_ZERO(&one);
  for (int i = 0; CPU_COUNT(&one) == 0; ++i) {
    if (CPU_ISSET(i, &all)) CPU_SET(i, &one);
  }
  ASSERT_EQ(::sched_setaffinity(0, sizeof one, &one), 0);  // inherited by the program
  const Outcome info = run({"info"}), render = run({"render", "earth", "--size", "8x8", "-o", "e.png", "--stats=json"});
  ASSERT_EQ(::sched_setaffinity(0, sizeof all, &all), 0);
  EXPECT_TRUE(CPU_COUNT(&all) == 1 || info.out.find("\ncores         1 (affinity mask)\n") != std::string::npos) << info.out;
  EXPECT_EQ(nlohmann::json::parse(render.out).at("threads"), 1);
}

TEST_F(Cli, HelpFitsOnAScreenAndEndsWithTwoExamples) {
  for (const char* command :
       {"render", "export", "convert-normal", "validate", "compare", "check-lesson", "chart", "list", "info", "completion"}) {
    const Outcome o = run({command, "--help"});
    EXPECT_EQ(o.exit_code, 0);
    EXPECT_LE(lines_of(o.out), 24);
    std::istringstream lines(o.out);
    std::vector<std::string> tail;
    for (std::string line; std::getline(lines, line);) {
      EXPECT_LE(line.size(), 80u) << line;
      if (!line.empty()) tail.push_back(line);
    }
    ASSERT_GE(tail.size(), 3u);
    EXPECT_EQ(tail[tail.size() - 3], "Examples:");
    for (std::size_t i = tail.size() - 2; i < tail.size(); ++i)
      EXPECT_TRUE(tail[i].starts_with("  halfspace " + std::string(command))) << tail[i];
  }
}

// ---- scenes, frames, formats -----------------------------------------------------------------------------------

TEST_F(Cli, PrintedSceneRendersTheSameImage) {
  const Outcome printed = run({"render", "moon", "--set", "moon.latitudes=40", "--camera", "terminator", "--print"});
  EXPECT_EQ(printed.exit_code, 0) << printed.err;
  EXPECT_TRUE(files().empty()) << "--print does not render";
  std::ofstream(directory / "my.json") << printed.out;
  const std::vector<std::string> size{"--size", "96x54"};
  EXPECT_EQ(run({"render", "my.json", "--size", "96x54"}).exit_code, 0);
  EXPECT_EQ(run({"render", "moon", "--set", "moon.latitudes=40", "--camera", "terminator", "--size", "96x54"}).exit_code, 0);
  EXPECT_TRUE(picture("my.png") == picture("moon.png"));
}

TEST_F(Cli, WorksInADeletedWorkingDirectory) {
  fs::create_directory(directory / "gone");
  const std::string command = "cd " + (directory / "gone").string() + " && rmdir ../gone && " HALFSPACE_PROGRAM " list > " +
                              (root / "out").string() + " 2>&1; " HALFSPACE_PROGRAM " render earth --size 8x8 -o " +
                              (directory / "e.png").string();
  EXPECT_EQ(WEXITSTATUS(std::system(command.c_str())), 0);
  EXPECT_GE(lines_of(read_bytes(root / "out")), 5);
}

TEST_F(Cli, ReportsErrorsInSceneFiles) {
  std::ofstream(directory / "my.json") << "{\"version\": 1, \"objects\": {\"a\": {\"raduis\": 2}}}";
  const Outcome o = run({"render", "my.json"});
  EXPECT_EQ(o.exit_code, 3);
  EXPECT_TRUE(is_line_with(o.err, "halfspace: my.json: objects.a.raduis", {"unknown key", "'radius'"}));
}

TEST_F(Cli, ListPrintsScenesAndKeys) {
  const Outcome scenes = run({"list"});
  EXPECT_EQ(lines_of(scenes.out), lines_of(run({"list", "--names"}).out));
  EXPECT_GE(lines_of(scenes.out), 5);
  EXPECT_NE(scenes.out.find("\nmoon "), std::string::npos);
  const Outcome keys = run({"list", "moon"});
  EXPECT_NE(keys.out.find("height_scale"), std::string::npos);
  const Outcome names = run({"list", "moon", "--names"});
  EXPECT_NE(names.out.find("\nmoon.height_scale\n"), std::string::npos);
  EXPECT_TRUE(nlohmann::json::accept(run({"list", "--schema"}).out));
}

TEST_F(Cli, CompletionScriptsWork) {
  for (const char* shell : {"bash", "zsh", "fish"}) EXPECT_EQ(run({"completion", shell}).exit_code, 0);
  EXPECT_EQ(run({"completion", "words"}).out,
            "render\nexplain\nexport\nconvert-normal\nvalidate\ncompare\ncheck-lesson\nchart\nlist\ninfo\ncompletion\n");
  std::ofstream(directory / "try.sh") << run({"completion", "bash"}).out << R"(
halfspace() { ")" HALFSPACE_PROGRAM R"(" "$@"; }
compopt() { :; }
try() { COMP_WORDS=("$@"); COMP_CWORD=$(($# - 1)); _halfspace; echo "${COMPREPLY[*]}"; }
try halfspace re
try halfspace render ear
try halfspace render moon --set moon.lat
try halfspace render moon --res
try halfspace chart sh
try halfspace compare --js
)";
  const std::string command = "bash " + (directory / "try.sh").string() + " > " + (root / "out").string() + " 2>&1";
  EXPECT_EQ(std::system(command.c_str()), 0);
  EXPECT_EQ(read_bytes(root / "out"), "render\nearth\nmoon.latitudes=\n--resume\nshading_rate shadows\n--json\n");
}

TEST_F(Cli, NumbersAndResumesFrames) {
  const std::vector<std::string> command{"render", "moon", "--size", "48x27", "--frames", "8..11", "--fps", "12", "-o", "m.png"};
  EXPECT_EQ(run(command).exit_code, 0);
  EXPECT_EQ(files(), (std::vector<std::string>{"m_0008.png", "m_0009.png", "m_0010.png", "m_0011.png"}));
  // A frame equals the image rendered at its time.
  EXPECT_EQ(run({"render", "moon", "--size", "48x27", "--time", "0.75", "-o", "one.png"}).exit_code, 0);
  EXPECT_TRUE(picture("one.png") == picture("m_0009.png"));
  const std::string whole = read_bytes(directory / "m_0010.png");
  fs::remove(directory / "m_0009.png");
  std::ofstream(directory / "m_0010.png") << whole.substr(0, whole.size() / 2);
  const auto before = fs::last_write_time(directory / "m_0008.png");
  std::vector<std::string> resume = command;
  resume.push_back("--resume");
  const Outcome o = run(resume);
  EXPECT_EQ(o.exit_code, 0) << o.err;
  EXPECT_EQ(o.err, "halfspace: kept 2 pictures, rendered 2: 1 missing, 1 incomplete\n") << "no progress in a pipe";
  EXPECT_TRUE(picture("m_0009.png") == picture("one.png"));
  EXPECT_EQ(read_bytes(directory / "m_0010.png"), whole) << "a truncated file is rendered again";
  EXPECT_EQ(fs::last_write_time(directory / "m_0008.png"), before) << "a complete file is kept";
}

TEST_F(Cli, AnimationIsIdenticalForAnyThreadCount) {
  for (const char* threads : {"1", "2"}) {
    const std::string out = std::string("t") + threads + ".png";
    EXPECT_EQ(run({"render", "moon", "--size", "64x36", "--frames", "0..47", "--threads", threads, "-o", out}).exit_code, 0);
  }
  std::string first;
  for (int i = 0; i < 48; ++i) {
    const std::string number = std::string(i < 10 ? "000" : "00") + std::to_string(i) + ".png";
    const std::string one = read_bytes(directory / ("t1_" + number));
    EXPECT_NE(one, "");
    EXPECT_EQ(one, read_bytes(directory / ("t2_" + number))) << i;
    if (i == 0) first = one;
    EXPECT_EQ(one == first, i == 0) << "Moon and light rotate";
  }
}

TEST_F(Cli, WritesEveryFormat) {
  for (const char* name : {"a.png", "a.jpg", "a.tif", "a.exr", "a.hdr"}) {
    const Outcome o = run({"render", "earth", "--size", "64x36", "-o", name});
    EXPECT_EQ(o.exit_code, 0) << o.err;
    // Read the file back as a map of a scene.
    const Outcome again = run({"render", "moon", "--size", "32x18", "-o", "again.png", "--set", std::string("moon.height=") + name});
    EXPECT_EQ(again.exit_code, 0) << name << ": " << again.err;
  }
}

TEST_F(Cli, ReportsAFullStandardOutput) {
  const std::string command = std::string(HALFSPACE_PROGRAM) + " info > /dev/full 2> " + (root / "err").string();
  EXPECT_EQ(WEXITSTATUS(std::system(command.c_str())), 4);
  EXPECT_EQ(read_bytes(root / "err"), "halfspace: standard output: cannot write: No space left on device\n");
}

// ---- streams ---------------------------------------------------------------------------------------------------

TEST_F(Cli, ReportsAPipeWithoutReader) {
  ASSERT_EQ(::mkfifo((directory / "pipe").c_str(), 0666), 0);
  const Outcome o = run({"render", "earth", "--size", "8x8", "-o", "pipe"});
  EXPECT_EQ(o.exit_code, 4);
  EXPECT_TRUE(is_line_with(o.err, "halfspace: pipe", {"reading"}));
}

// The image is larger than a pipe buffer, so the program has to wait for the reader.
TEST_F(Cli, WritesToAPipeWithAReader) {
  EXPECT_EQ(run({"render", "earth", "--size", "640x360", "-o", "file.png"}).exit_code, 0);
  ASSERT_EQ(::mkfifo((directory / "pipe").c_str(), 0666), 0);
  const std::string reader = "(sleep 0.3; cat) < " + (directory / "pipe").string() + " > " + (directory / "copy.png").string() + " &";
  ASSERT_EQ(std::system(reader.c_str()), 0);
  EXPECT_EQ(run({"render", "earth", "--size", "640x360", "-o", "pipe"}).exit_code, 0);
  for (int i = 0; i < 100 && read_bytes(directory / "copy.png").size() < read_bytes(directory / "file.png").size(); ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  EXPECT_GT(read_bytes(directory / "file.png").size(), 65536u);
  EXPECT_EQ(read_bytes(directory / "copy.png"), read_bytes(directory / "file.png"));
}

// An image written to standard output, as a file or a pipe, must not be mixed with other output; reports go to standard error.
TEST_F(Cli, ReportsDoNotMixWithTheImage) {
  EXPECT_EQ(run({"render", "earth", "--size", "64x36", "-o", "file.png"}).exit_code, 0);
  const Outcome o = run({"render", "earth", "--size", "64x36", "-o", "/dev/stdout", "--stats=json"});
  EXPECT_EQ(o.exit_code, 0) << o.err;
  EXPECT_EQ(o.out, read_bytes(directory / "file.png"));
  EXPECT_EQ(nlohmann::json::parse(o.err).at("width"), 64);
  const std::string piped =
      HALFSPACE_PROGRAM " render earth --size 64x36 -o /dev/stdout --stats 2> /dev/null | cat > " + (directory / "piped.png").string();
  EXPECT_EQ(std::system(piped.c_str()), 0);
  EXPECT_EQ(read_bytes(directory / "piped.png"), o.out);
}

// ---- compare ---------------------------------------------------------------------------------------------------

TEST_F(Cli, CompareReportsNumbersAndChecksTheTolerance) {
  for (const char* size : {"64x36", "32x18"})
    EXPECT_EQ(run({"render", "earth", "--size", size, "-o", std::string(size) + ".png"}).exit_code, 0);
  EXPECT_EQ(run({"render", "earth", "--size", "64x36", "--shading", "flat", "-o", "flat.png"}).exit_code, 0);
  const Outcome same = run({"compare", "64x36.png", "64x36.png", "--tolerance", "0"});
  EXPECT_EQ(same.exit_code, 0) << same.err;
  EXPECT_TRUE(same.out.starts_with("64x36.png vs. 64x36.png, 64x36, 8-bit values / 255\ndiffering    0 of 2304 pixels\nrmse         0\n"))
      << same.out;
  EXPECT_NE(same.out.find("\npsnr         infinite\n"), std::string::npos) << same.out;
  const Outcome json = run({"compare", "64x36.png", "flat.png", "--json", "-o", "d.png"});
  EXPECT_EQ(json.exit_code, 0) << "without --tolerance, differences are not an error";
  const auto parsed = nlohmann::json::parse(json.out);
  for (const char* key : {"differing_pixels", "rmse", "psnr_db", "max", "p999", "share_above_1_255", "ssim"})
    EXPECT_TRUE(parsed.at(key).is_number()) << key;
  EXPECT_TRUE(fs::exists(directory / "d.png"));
  const double max_value = parsed.at("max");
  EXPECT_GT(max_value, 0.01);
  const Outcome above = run({"compare", "64x36.png", "flat.png", "--tolerance", "0.01"});
  EXPECT_EQ(above.exit_code, 1);
  EXPECT_TRUE(is_line_with(above.err, "halfspace: flat.png", {"64x36.png", " 0.", "0.01"}));
  EXPECT_EQ(run({"compare", "64x36.png", "flat.png", "--tolerance", "1"}).exit_code, 0);
  const Outcome sizes = run({"compare", "64x36.png", "32x18.png"});
  EXPECT_EQ(sizes.exit_code, 3);
  EXPECT_TRUE(is_line_with(sizes.err, "halfspace: 32x18.png", {"32x18", "64x36", "64x36.png"}));
  std::ofstream(directory / "bad.png") << "no picture";
  const Outcome bad = run({"compare", "64x36.png", "bad.png"});
  EXPECT_EQ(bad.exit_code, 3);
  EXPECT_EQ(lines_of(bad.err), 1) << bad.err;
}

TEST_F(Cli, CompareUsesLinearValuesForLinearFiles) {
  for (const char* name : {"a.exr", "a.png"}) EXPECT_EQ(run({"render", "earth", "--size", "64x36", "-o", name}).exit_code, 0);
  EXPECT_EQ(nlohmann::json::parse(run({"compare", "a.exr", "a.exr", "--json"}).out).at("values"), "linear");
  // A linear file is encoded to 8 bits for the comparison with an 8-bit file. Both show the same scene, so they differ only where rounding
  // to half (2^-11 of the value) changes the nearest 8-bit value.
  const auto mixed = nlohmann::json::parse(run({"compare", "a.exr", "a.png", "--json"}).out);
  EXPECT_EQ(mixed.at("values"), "codes");
  EXPECT_LE(mixed.at("max").get<double>(), 1.0 / 255.0);
}

// ---- chart -----------------------------------------------------------------------------------------------------

TEST_F(Cli, ChartWritesDataChartAndPage) {
  const Outcome o = run({"chart", "antialiasing", "--quick", "-o", "out"});
  ASSERT_EQ(o.exit_code, 0) << o.err;
  const auto data = nlohmann::json::parse(read_bytes(directory / "out" / "antialiasing.json"));
  const std::string csv = read_bytes(directory / "out" / "antialiasing.csv"), page = read_bytes(directory / "out" / "index.html");
  EXPECT_EQ(lines_of(csv), 1 + static_cast<int>(data.at("variants").size()));
  EXPECT_TRUE(csv.starts_with("study,variant,group,samples,")) << csv;
  for (const auto& row : data.at("variants"))
    for (const char* key : {"picture", "difference"}) EXPECT_TRUE(fs::exists(directory / "out" / row.at(key).get<std::string>())) << row;
  EXPECT_NE(page.find("prefers-color-scheme: dark"), std::string::npos);
  EXPECT_NE(page.find("antialiasing-8-samples.png"), std::string::npos);
  if (!fs::exists(directory / "out" / "antialiasing.svg")) {
    EXPECT_NE(o.out.find("no charts were drawn: matplotlib is missing (Debian and Ubuntu: python3-matplotlib)"), std::string::npos);
    GTEST_SKIP() << "matplotlib is not installed, so charts cannot be tested";
  }
  for (const char* file : {"antialiasing.svg", "antialiasing-dark.svg"}) {
    EXPECT_GT(fs::file_size(directory / "out" / file), 5000u);
    EXPECT_NE(page.find(file), std::string::npos) << "the page shows the chart";
  }
  const std::string svg = read_bytes(directory / "out" / "antialiasing.svg");
  for (const auto& row : data.at("variants")) EXPECT_NE(svg.find(row.at("name").get<std::string>()), std::string::npos) << row;
  // A second study is added to the page of the first one.
  EXPECT_EQ(run({"chart", "tone", "--quick", "-o", "out"}).exit_code, 0);
  const std::string both = read_bytes(directory / "out" / "index.html");
  EXPECT_NE(both.find("id=\"antialiasing\""), std::string::npos);
  EXPECT_NE(both.find("id=\"tone\""), std::string::npos);
}

// Without Python or matplotlib, only the data is written. A module named matplotlib that cannot be imported simulates a missing matplotlib.
TEST_F(Cli, ChartWritesDataWithoutPythonOrMatplotlib) {
  std::ofstream(root / "matplotlib.py") << "raise ImportError('hidden')\n";
  const std::pair<std::string, std::string> cases[] = {
      {"PATH=/nowhere", "python3 is missing (Debian and Ubuntu: python3)"},
      {"PYTHONPATH=" + root.string(), "matplotlib is missing (Debian and Ubuntu: python3-matplotlib)"}};
  for (const auto& [environment, missing] : cases) {
    const Outcome o = run_in(environment, "chart tone --quick -o out");
    EXPECT_EQ(o.exit_code, 0) << o.err;
    EXPECT_NE(o.out.find("no charts were drawn: " + missing + "; the data files were written\n"), std::string::npos) << o.out;
    EXPECT_TRUE(fs::exists(directory / "out" / "tone.csv"));
    EXPECT_FALSE(fs::exists(directory / "out" / "tone.svg"));
    EXPECT_EQ(read_bytes(directory / "out" / "index.html").find("tone.svg"), std::string::npos);
  }
}

TEST_F(Cli, ChartReportsAFailureOfTheScriptInOneLine) {
  std::ofstream(root / "matplotlib.py") << "raise RuntimeError('broken for this test')\n";
  const Outcome o = run_in("PYTHONPATH=" + root.string(), "chart tone --quick -o out");
  EXPECT_EQ(o.exit_code, 4);
  EXPECT_TRUE(is_line_with(o.err, "halfspace: no charts were drawn", {"RuntimeError: broken for this test"})) << o.err;
  EXPECT_TRUE(fs::exists(directory / "out" / "tone.csv"));
}

// ---- convert-normal --------------------------------------------------------------------------------------------

TEST_F(Cli, ConvertNormalWritesAMap) {
  EXPECT_EQ(run({"render", "earth", "--size", "64x32", "-o", "heights.png"}).exit_code, 0);
  for (const char* edges : {"repeat", "clamp", "sphere"}) {
    const Outcome o = run({"convert-normal", "heights.png", "-o", "normal.png", "--strength", "4", "--edges", edges});
    EXPECT_EQ(o.exit_code, 0) << o.err;
    EXPECT_EQ(o.out + o.err, "");
  }
  const std::string map = read_bytes(directory / "normal.png");
  EXPECT_EQ(map.find("sRGB"), std::string::npos) << "normals are not colors";
  EXPECT_EQ(run({"convert-normal", "normal.png", "-o", "again.png"}).exit_code, 0) << "the written file can be read";
}

// On a terminal, the progress bar advances, fits into one line, and is cleared at the end and after an interrupt. (`script` from util-linux
// provides the terminal.)
TEST_F(Cli, ProgressIsABarOnATerminal) {
  if (!command_works("script --version")) GTEST_SKIP() << "script (util-linux) is absent";
  const auto shown = [&](const std::string& command) {
    const std::string line =
        "cd " + directory.string() + " && script -qc '" + command + "' /dev/null < /dev/null > " + (root / "out").string();
    (void)!std::system(line.c_str());
    return read_bytes(root / "out");
  };
  const std::string frames = HALFSPACE_PROGRAM " render earth --size 16x9 -o e.png --frames 0..";
  const std::string wide = shown("stty cols 80; " + frames + "3");
  EXPECT_NE(wide.find("\r\033[K[..............................] 0/4"), std::string::npos) << wide;
  EXPECT_NE(wide.find("\r\033[K[###############...............] 2/4  "), std::string::npos) << wide;
  EXPECT_TRUE(wide.ends_with("\r\033[K")) << wide;
  std::istringstream narrow(shown("stty cols 24; " + frames + "3"));
  int lines = 0;
  for (std::string line; std::getline(narrow, line, '\r'); ++lines)
    EXPECT_LT(line.size(), 24u + 3u) << "including three characters that clear the line";
  EXPECT_GT(lines, 4);
  const std::string stopped = shown("stty cols 80; timeout --foreground -s INT 2 " + frames + "999999");
  EXPECT_NE(stopped.find("/1000000  "), std::string::npos);
  EXPECT_TRUE(stopped.ends_with("\r\033[K")) << stopped;
}

// Tracks the files of a folder that are being written: created, but not closed yet.
class OpenFiles {
 public:
  explicit OpenFiles(const fs::path& folder) : events_(::inotify_init1(IN_CLOEXEC | IN_NONBLOCK)) {
    EXPECT_GE(::inotify_add_watch(events_, folder.c_str(), IN_CREATE | IN_CLOSE_WRITE), 0);
  }
  ~OpenFiles() { ::close(events_); }
  OpenFiles(const OpenFiles&) = delete;
  OpenFiles& operator=(const OpenFiles&) = delete;

  // Waits until a file is created or closed. Returns false on timeout.
  bool wait(std::chrono::milliseconds at_most) const {
    pollfd events{events_, POLLIN, 0};
    return ::poll(&events, 1, static_cast<int>(at_most.count())) == 1;
  }
  bool any() {
    alignas(inotify_event) std::array<char, 16384> buffer;
    for (ssize_t n = 0; (n = ::read(events_, buffer.data(), buffer.size())) > 0;) {
      for (const char* at = buffer.data(); at < buffer.data() + n;) {
        const auto* event = reinterpret_cast<const inotify_event*>(at);
        if ((event->mask & IN_CREATE) != 0) {
          open_.insert(event->name);
        } else {
          open_.erase(event->name);
        }
        at += sizeof(inotify_event) + event->len;
      }
    }
    return !open_.empty();
  }

 private:
  int events_;
  std::set<std::string> open_;
};

// Stops a program while it is writing a file. If the file is already closed when this test wakes up, lets the program continue to the next
// file. Returns false if this takes more than a minute.
bool stop_while_writing(pid_t child, OpenFiles& files) {
  using std::chrono::milliseconds;
  using Clock = std::chrono::steady_clock;
  const auto end = Clock::now() + std::chrono::minutes(1);
  while (files.wait(std::max(milliseconds(0), std::chrono::duration_cast<milliseconds>(end - Clock::now())))) {
    int status = 0;
    if (::kill(child, SIGSTOP) != 0 || ::waitpid(child, &status, WUNTRACED) != child || !WIFSTOPPED(status)) return false;
    if (files.any()) return true;
    ::kill(child, SIGCONT);
  }
  return false;
}

// Interrupts a long animation at many different times, including while a file is being written. The signal must terminate the program, and
// the remaining files must be complete images. Each file is larger than a megabyte and is written in chunks; signals are handled between
// chunks.
TEST_F(Cli, InterruptsLeaveNoPartialFiles) {
  const auto render = [&](const std::string& frames) {
    return start({"render", "particles", "--size", "1920x1080", "--frames", frames, "-o", "particles.exr"});
  };
  std::map<std::string, std::string> whole;
  const auto check_whole = [&](const std::string& name, const std::string& bytes) {
    if (!whole.contains(name)) {
      const std::string frame = name.substr(10, 4);
      EXPECT_EQ(finish(render(frame + ".." + frame)).exit_code, 0) << name;
      whole[name] = read_bytes(directory / name);
    }
    EXPECT_TRUE(bytes == whole[name]) << name << ": " << bytes.size() << " bytes of " << whole[name].size();
  };
  const auto interrupt = [&](pid_t child, int signal) {
    ::kill(child, signal);
    ::kill(child, SIGCONT);
    EXPECT_EQ(finish(child).signal, signal);
    for (const std::string& name : files()) {
      EXPECT_TRUE(name.starts_with("particles_")) << name;
      if (name.starts_with("particles_")) check_whole(name, read_bytes(directory / name));
      fs::remove(directory / name);
    }
  };
  for (const int signal : {SIGINT, SIGTERM}) {
    for (int delay_ms = 5; delay_ms < 200; delay_ms += 30) {
      const pid_t child = render("0..999");
      std::this_thread::sleep_for(std::chrono::milliseconds(delay_ms));
      interrupt(child, signal);
    }
    for (int i = 0; i < 3; ++i) {
      OpenFiles open_files(directory);
      const pid_t child = render("0..999");
      EXPECT_TRUE(stop_while_writing(child, open_files)) << "no image was written within a minute";
      interrupt(child, signal);
    }
  }
}

}  // namespace
}  // namespace halfspace
