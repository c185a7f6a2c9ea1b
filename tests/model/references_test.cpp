// SPDX-License-Identifier: Apache-2.0
#include "halfspace/model/text/references.h"

#include <gtest/gtest.h>

#include "support/files.h"
#include "support/temporary_folder.h"

namespace halfspace {
namespace {

namespace fs = std::filesystem;

// A folder `model` with files, and a file outside it.
class ModelReferences : public testing::Test {
 protected:
  void SetUp() override {
    fs::create_directories(model_ / "maps");
    write_bytes(model_ / "wood.png", "wood");
    write_bytes(model_ / "maps/Brick.png", "brick");
    write_bytes(folder_.path() / "secret.png", "secret");
  }

  // Returns the path relative to the model's folder, or "".
  std::string find(std::string_view name, bool allow_outside = false) {
    warnings_.clear();
    References references(model_ / "a.obj", allow_outside, warnings_);
    const std::optional<fs::path> path = references.find(name, "map of 'm'");
    if (!path) return "";
    EXPECT_TRUE(path->is_absolute());
    return path->lexically_relative(fs::canonical(model_)).string();
  }

  // Returns the only warning; "" if there is none.
  std::string warning() const {
    EXPECT_LE(warnings_.size(), 1u);
    return warnings_.empty() ? "" : warnings_[0];
  }
  bool warns(std::string_view word) const { return warning().find(word) != std::string::npos; }

  TemporaryFolder folder_;
  fs::path model_ = folder_.path() / "model";
  std::vector<std::string> warnings_;
};

TEST_F(ModelReferences, FindsRelativePaths) {
  EXPECT_EQ(find("wood.png"), "wood.png");
  EXPECT_EQ(find("./maps/../wood.png"), "wood.png");
  EXPECT_EQ(find("maps/Brick.png"), "maps/Brick.png");
  EXPECT_EQ(find("maps\\Brick.png"), "maps/Brick.png");
  EXPECT_EQ(warning(), "");
}

TEST_F(ModelReferences, FindsAbsolutePathsInTheFolder) {
  EXPECT_EQ(find((fs::canonical(model_) / "wood.png").string()), "wood.png");
  EXPECT_EQ(warning(), "");
}

TEST_F(ModelReferences, IgnoresCaseWithAWarning) {
  EXPECT_EQ(find("WOOD.PNG"), "wood.png");
  EXPECT_TRUE(warns("'wood.png'"));
  EXPECT_EQ(find("Maps/brick.png"), "maps/Brick.png");
  EXPECT_TRUE(warns("'maps/Brick.png'"));
}

TEST_F(ModelReferences, PrefersTheExactCase) {
  write_bytes(model_ / "WOOD.png", "");
  EXPECT_EQ(find("wood.png"), "wood.png");
  EXPECT_EQ(find("WOOD.png"), "WOOD.png");
  EXPECT_EQ(warning(), "");
}

TEST_F(ModelReferences, NamesMissingFilesOnce) {
  EXPECT_EQ(find("metal.png"), "");
  EXPECT_TRUE(warning().starts_with("map of 'm': 'metal.png'")) << warning();
  EXPECT_EQ(find("maps"), "") << "a folder is not a file";
  EXPECT_EQ(find(""), "");
  EXPECT_EQ(find(std::string_view("wood.png\0", 9)), "");
  EXPECT_EQ(find(std::string(100000, 'x')), "");
  EXPECT_LT(warning().size(), 300u);
}

TEST_F(ModelReferences, DoesNotLeaveTheFolder) {
  for (const std::string& name : {std::string("../secret.png"), std::string("maps/../../secret.png"), std::string("..\\secret.png"),
                                  (fs::canonical(folder_.path()) / "secret.png").string(), std::string("/etc/hostname")}) {
    EXPECT_EQ(find(name), "") << name;
    EXPECT_TRUE(warns("--allow-outside")) << name;
  }
}

TEST_F(ModelReferences, AllowsOutsideFilesOnRequest) {
  EXPECT_EQ(find("../secret.png", true), "../secret.png");
  EXPECT_EQ(find((fs::canonical(folder_.path()) / "secret.png").string(), true), "../secret.png");
  EXPECT_EQ(warning(), "");
}

TEST_F(ModelReferences, LooksForBareNamesInTheFolder) {
  for (const char* name : {"../wood.png", "/home/artist/wood.png", "C:\\Users\\artist\\wood.png", "c:wood.png",
                           "\\\\server\\share\\wood.png", "textures/Wood.png"}) {
    for (const bool allow : {false, true}) {
      EXPECT_EQ(find(name, allow), "wood.png") << name;
      EXPECT_TRUE(warns("'wood.png'")) << name;
    }
  }
}

TEST_F(ModelReferences, DoesNotFollowSymbolicLinksOutOfTheFolder) {
  fs::create_symlink("../secret.png", model_ / "link.png");
  fs::create_directory_symlink("..", model_ / "up");
  for (const char* name : {"link.png", "up/secret.png", "LINK.png", "UP/secret.png", "../link.png"}) {
    EXPECT_EQ(find(name), "") << name;
    EXPECT_NE(warning(), "") << name;
  }
  EXPECT_EQ(find("link.png", true), "link.png");
  fs::create_symlink("wood.png", model_ / "inner.png");
  EXPECT_EQ(find("inner.png"), "inner.png");
  fs::create_symlink("loop.png", model_ / "loop.png");
  EXPECT_EQ(find("loop.png"), "");
}

// The folder of the model itself may be reached through a link.
TEST_F(ModelReferences, AcceptsALinkToTheFolder) {
  fs::create_directory_symlink("model", folder_.path() / "alias");
  References references(folder_.path() / "alias/a.obj", false, warnings_);
  EXPECT_TRUE(references.find("wood.png", "map"));
  EXPECT_EQ(warning(), "");
}

}  // namespace
}  // namespace halfspace
