// SPDX-License-Identifier: Apache-2.0
//
// `halfspace explain --text` and `--json`: the history of a pixel, and invalid arguments.
#include <nlohmann/json.hpp>

#include "cli/cli_run.h"

namespace halfspace {

namespace {

using Explain = Cli;

TEST_F(Explain, PrintsTheHistoryOfThePixelThatRenderDraws) {
  const Outcome json = run({"explain", "earth", "--size", "80x45", "--pixel", "40,20", "--json"});
  ASSERT_EQ(json.exit_code, 0) << json.err;
  ASSERT_EQ(run({"render", "earth", "--size", "80x45", "-o", "earth.png"}).exit_code, 0);
  const Image<glm::u8vec4> picture = read_image(directory / "earth.png");
  const glm::u8vec4 code = picture.at(40, 20);
  const nlohmann::json history = nlohmann::json::parse(json.out);
  EXPECT_EQ(history["code"], nlohmann::json({code.x, code.y, code.z, code.w}));
  EXPECT_EQ(history["window"], nlohmann::json({40.5, 24.5}));
  const Outcome text = run({"explain", "earth", "--size", "80x45", "--pixel", "40,20", "--text"});
  EXPECT_NE(text.out.find("pixel 40,20 from the upper left"), std::string::npos);
  EXPECT_NE(text.out.find("shaded"), std::string::npos);
}

TEST_F(Explain, RejectsPixelsOutsideOfThePicture) {
  for (const char* pixel : {"80,0", "0,45", "-1,0", "1,2,3", "a,b", "12", "1.5,2", "5,5 ", ",", "99999999999999999999,0"}) {
    const Outcome o = run({"explain", "earth", "--size", "80x45", "--text", "--pixel", pixel});
    EXPECT_EQ(o.exit_code, 2) << pixel;
    EXPECT_EQ(lines_of(o.err), 1) << o.err;
    EXPECT_NE(o.err.find("--pixel"), std::string::npos) << o.err;
    EXPECT_NE(o.err.find("79,44"), std::string::npos) << o.err;
    EXPECT_TRUE(o.out.empty());
  }
}

TEST_F(Explain, RejectsWrongScenesAndCombinations) {
  EXPECT_EQ(run({"explain", "nothing", "--text"}).exit_code, 3);
  EXPECT_EQ(run({"explain", "earth", "--text", "--json"}).exit_code, 2);
  for (const char* address : {"javascript:alert(1)//", "data:text/html,x", " https://a.example", "java\nscript:x", "less\xffons"}) {
    const Outcome o = run({"explain", "earth", "--lessons", address, "-o", "page.html"});
    EXPECT_EQ(o.exit_code, 2) << address;
    EXPECT_TRUE(o.err.starts_with("halfspace: --lessons is '")) << o.err;
    EXPECT_EQ(lines_of(o.err), 1) << o.err;
  }
  EXPECT_EQ(run({"explain", "earth", "--text", "--shading", "wrong"}).exit_code, 2);
  EXPECT_EQ(run({"explain", "earth", "--text", "--turntable", "3"}).exit_code, 2);
  EXPECT_EQ(run({"explain", "--help-model"}).out.find("--turntable"), std::string::npos);
  EXPECT_EQ(run({"explain", "earth", "--colours"}).err.find("--turntable"), std::string::npos);
  EXPECT_NE(run({"render", "--help-model"}).out.find("--turntable"), std::string::npos);
}

}  // namespace

}  // namespace halfspace
