// SPDX-License-Identifier: Apache-2.0
//
// The output file and the error messages of `halfspace explain`. tests/explain tests the contents of the page.
#include "cli/cli_run.h"
#include "support/errors.h"

namespace halfspace {
namespace {

class ExplainPage : public Cli {
 protected:
  Outcome explain(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), "explain");
    arguments.insert(arguments.end(), {"--size", "64x36"});
    return run(arguments);
  }
};

TEST_F(ExplainPage, IsWrittenUnderTheNameOfTheScene) {
  EXPECT_EQ(explain({"earth"}).exit_code, 0);
  EXPECT_EQ(files(), std::vector<std::string>{"earth.html"});
  const std::string page = read_bytes(directory / "earth.html");
  EXPECT_EQ(page.substr(0, 15), "<!DOCTYPE html>");
  EXPECT_NE(page.find("</html>"), std::string::npos);
}

TEST_F(ExplainPage, IsWrittenToTheOutput) {
  EXPECT_EQ(explain({"earth", "-o", "out/page.html"}).exit_code, 0);
  EXPECT_TRUE(fs::exists(directory / "out/page.html"));
}

TEST_F(ExplainPage, PrintsNothing) {
  const Outcome o = explain({"earth"});
  EXPECT_EQ(o.out, "");
  EXPECT_EQ(o.err, "");
}

TEST_F(ExplainPage, ContainsTheCommandThatGeneratedIt) {
  EXPECT_EQ(run({"explain", "earth", "--size", "64x36", "--set", "earth.normal=none", "-o", "page.html"}).exit_code, 0);
  EXPECT_NE(read_bytes(directory / "page.html").find(R"("halfspace explain earth --size 64x36 --set earth.normal=none")"),
            std::string::npos);
}

struct Rejected {
  std::vector<std::string> arguments;
  int exit_code;
  std::string place, expected;
};

TEST_F(ExplainPage, RejectsWrongArgumentsInOneLine) {
  write_bytes(directory / "file", "");
  const Rejected cases[] = {
      {{"explain"}, 2, "SCENE", "required"},
      {{"explain", "erth"}, 3, "erth", "earth"},
      {{"explain", "earth", "--size", "64"}, 2, "--size", "expected"},
      {{"explain", "earth", "--pixel", "640,1"}, 2, "--pixel", "639,359"},
      {{"explain", "earth", "-o", "page.png"}, 2, "-o", ".html"},
      {{"explain", "earth", "--text", "-o", "page.html"}, 2, "-o", "--text"},
      {{"explain", "earth", "-o", "file/page.html"}, 4, "file/page.html", "directory"},
  };
  for (const Rejected& c : cases) {
    const Outcome o = run(c.arguments);
    const std::string shown = c.arguments.back();
    EXPECT_NE(o.exit_code, 0) << shown;
    EXPECT_EQ(o.out, "") << shown;
    EXPECT_NE(o.err.find(c.place), std::string::npos) << shown << ": " << o.err;
    EXPECT_NE(o.err.find(c.expected), std::string::npos) << shown << ": " << o.err;
    EXPECT_EQ(lines_of(o.err), 1) << shown << ": " << o.err;
    EXPECT_EQ(o.exit_code, c.exit_code) << shown << ": " << o.err;
  }
  EXPECT_EQ(files(), std::vector<std::string>{"file"}) << "nothing is left behind";
}

TEST_F(ExplainPage, DoesNotReplaceTheSceneThatItReads) {
  write_bytes(directory / "scene.html", R"({"version": 1, "cameras": {"c": {}}})");
  const Outcome o = explain({"scene.html", "-o", "scene.html"});
  EXPECT_EQ(o.exit_code, 4);
  EXPECT_NE(o.err.find("is read by"), std::string::npos) << o.err;
  EXPECT_EQ(read_bytes(directory / "scene.html").front(), '{');
}

}  // namespace
}  // namespace halfspace
