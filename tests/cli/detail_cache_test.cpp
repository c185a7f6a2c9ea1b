// SPDX-License-Identifier: Apache-2.0
//
// The simplified meshes in the user's cache folder: they do not change the picture, damaged files are replaced, and processes can share
// them.
#include <gtest/gtest.h>

#include <chrono>
#include <cstdlib>
#include <fstream>
#include <set>
#include <vector>

#include "cli/cli_run.h"
#include "model/test_meshes.h"

namespace halfspace {
namespace {

class DetailCacheTest : public Cli {
 protected:
  void SetUp() override {
    Cli::SetUp();
    put(directory / "s.json", R"({"version": 1, "ambient": 1, "cameras": {"c": {"position": [0, 0, 6]}},
                                  "objects": {"a": {"shape": "file", "file": "a.obj"}}})");
    const ModelMesh mesh = sphere(72, 35);
    std::ofstream file(directory / "a.obj");
    for (const glm::vec3& p : mesh.positions) file << "v " << p.x << ' ' << p.y << ' ' << p.z << '\n';
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3)
      file << "f " << mesh.indices[i] + 1 << ' ' << mesh.indices[i + 1] + 1 << ' ' << mesh.indices[i + 2] + 1 << '\n';
  }

  // Returns the standard error of a run that writes a picture.
  std::string render(const std::string& name, const std::string& options = "") const {
    const Outcome o = run_in("XDG_CACHE_HOME=" + cache.string(), "render s.json --size 32x32 --max-error 0.5 -o " + name + options);
    EXPECT_EQ(o.exit_code, 0);
    return o.err;
  }
  std::set<fs::path> cached() const {
    std::set<fs::path> found;
    if (!fs::exists(cache_folder)) return found;
    for (const fs::directory_entry& entry : fs::directory_iterator(cache_folder)) found.insert(entry.path());
    return found;
  }

  static void put(const fs::path& file, const std::string& bytes) { std::ofstream(file, std::ios::binary) << bytes; }

  const fs::path cache = directory / "cache", cache_folder = cache / "halfspace" / "detail";
};

TEST_F(DetailCacheTest, KeepsThePicture) {
  EXPECT_EQ(render("off.png", " --no-cache"), "");
  EXPECT_TRUE(cached().empty());
  EXPECT_EQ(render("first.png"), "");
  const std::set<fs::path> written = cached();
  EXPECT_FALSE(written.empty());
  fs::create_hard_link(*written.begin(), directory / "link");
  EXPECT_EQ(render("second.png"), "");
  EXPECT_EQ(cached(), written);
  EXPECT_EQ(fs::hard_link_count(*written.begin()), 2u) << "the file was made again instead of being used";
  EXPECT_TRUE(picture("first.png") == picture("off.png"));
  EXPECT_TRUE(picture("second.png") == picture("off.png"));
}

TEST_F(DetailCacheTest, DamagedFilesAreReplacedWithOneWarning) {
  render("first.png");
  const std::set<fs::path> written = cached();
  ASSERT_FALSE(written.empty());
  const std::string intact = read_bytes(*written.begin());
  std::string flipped = intact;
  flipped[20] = static_cast<char>(flipped[20] ^ 1);
  for (const std::string& damaged : {flipped, intact.substr(0, intact.size() / 2), intact + intact}) {
    for (const fs::path& file : written) put(file, damaged);
    const std::string err = render("again.png");
    EXPECT_EQ(lines_of(err), 1) << err;
    EXPECT_NE(err.find("is damaged"), std::string::npos) << err;
    EXPECT_TRUE(picture("again.png") == picture("first.png"));
    EXPECT_EQ(read_bytes(*written.begin()), intact);
    EXPECT_EQ(render("again.png"), "");
  }
}

TEST_F(DetailCacheTest, OldFilesAreRemovedAboveTheLimit) {
  fs::create_directories(cache_folder);
  const fs::path old = cache_folder / "old.detail", other = cache_folder / "other.txt";
  for (const fs::path& file : {old, other}) {
    put(file, "");
    fs::resize_file(file, uint64_t{1} << 30);  // takes no space on the disk
    fs::last_write_time(file, fs::file_time_type::clock::now() - std::chrono::hours(1));
  }
  EXPECT_EQ(render("a.png"), "");
  EXPECT_FALSE(fs::exists(old));
  EXPECT_TRUE(fs::exists(other)) << "not a file of the cache";
  EXPECT_GE(cached().size(), 2u);
}

TEST_F(DetailCacheTest, ProcessesCanShareIt) {
  const std::string run = "(cd " + directory.string() + " && XDG_CACHE_HOME=" + cache.string() +
                          " " HALFSPACE_PROGRAM " render s.json --size 32x32 --max-error 0.5 --threads 1 -o ";
  std::string command, wait;
  for (const char* name : {"1.png", "2.png", "3.png", "4.png"}) {
    command += run + name + ") & p" + name[0] + "=$!; ";
    wait += std::string("wait $p") + name[0] + " && ";
  }
  EXPECT_EQ(std::system((command + wait + "true").c_str()), 0);
  render("5.png");
  for (const char* name : {"1.png", "2.png", "3.png", "4.png"}) EXPECT_TRUE(picture(name) == picture("5.png"));
  for (const fs::path& file : cached()) EXPECT_EQ(file.extension(), ".detail") << "a temporary file is left";
}

TEST_F(DetailCacheTest, AFolderThatCannotBeWrittenIsIgnored) {
  put(cache, "a file");
  EXPECT_EQ(render("a.png"), "");
  EXPECT_EQ(run_in("XDG_CACHE_HOME=relative HOME=", "render s.json --size 32x32 --max-error 0.5 -o b.png").err, "");
  EXPECT_FALSE(fs::exists(directory / "relative"));
}

}  // namespace
}  // namespace halfspace
