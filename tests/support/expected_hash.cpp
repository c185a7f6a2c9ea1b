// SPDX-License-Identifier: Apache-2.0
#include "support/expected_hash.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/file.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <sstream>
#include <stdexcept>

#include "support/files.h"
#include "support/hash.h"
#include "support/test_output.h"

namespace halfspace {

namespace {

constexpr const char* kHead = "# Hashes of this test program; HALFSPACE_RENEW_HASHES=1 writes them (see CONTRIBUTING.md).\n";

std::string as_text(uint64_t hash) {
  char text[17];
  std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(hash));
  return text;
}

std::map<std::string, uint64_t> read_hashes(const std::filesystem::path& path) {
  std::map<std::string, uint64_t> hashes;
  std::istringstream lines(read_bytes(path));
  for (std::string line; std::getline(lines, line);) {
    const std::size_t space = line.find(' ');
    if (line.starts_with('#') || space == std::string::npos) continue;
    hashes[line.substr(0, space)] = std::strtoull(line.c_str() + space, nullptr, 16);
  }
  return hashes;
}

void write_hashes(const std::filesystem::path& path, const std::map<std::string, uint64_t>& hashes) {
  std::string text = kHead;
  for (const auto& [name, hash] : hashes) text += name + ' ' + as_text(hash) + '\n';
  write_bytes(path, text);
}

// Reads the file, calls `change` to modify the hashes, and writes the file. Holds a lock, so that other processes wait.
template <class F>
void update(const std::filesystem::path& path, const F& change) {
  const int lock = ::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
  if (lock < 0 || ::flock(lock, LOCK_EX) != 0) throw std::runtime_error("cannot write " + path.string());
  std::map<std::string, uint64_t> hashes = read_hashes(path);
  change(hashes);
  write_hashes(path, hashes);
  ::close(lock);
}

// Tests run from the root of the source tree.
HashFile& program_hashes() {
  static HashFile file("tests/" + test_program() + "/hashes.txt", [] {
    const char* renew = std::getenv("HALFSPACE_RENEW_HASHES");
    return renew != nullptr && std::string(renew) == "1" ? HashFile::Mode::renew : HashFile::Mode::compare;
  }());
  return file;
}

// If all tests of the program have run, checks that they used every name in the file.
class UnusedNames : public testing::Environment {
 public:
  void TearDown() override {
    const testing::UnitTest& tests = *testing::UnitTest::GetInstance();
    if (testing::GTEST_FLAG(filter) != "*" || !tests.Passed() || tests.test_to_run_count() != tests.total_test_count()) return;
    expect_no_other_hashes();
  }
};
[[maybe_unused]] testing::Environment* const kUnusedNames = testing::AddGlobalTestEnvironment(new UnusedNames);

}  // namespace

HashFile::HashFile(std::filesystem::path path, Mode mode) : path_(std::move(path)), mode_(mode), hashes_(read_hashes(path_)) {}

std::string HashFile::check(const std::string& name, uint64_t hash) {
  used_.insert(name);
  if (mode_ == Mode::renew) {
    update(path_, [&](auto& hashes) { hashes[name] = hash; });
    return "";
  }
  if (hashes_.empty()) return "cannot read " + path_.string() + "; run the tests from the root of the source tree";
  const auto found = hashes_.find(name);
  if (found == hashes_.end()) return path_.string() + ": no hash named '" + name + "'; set HALFSPACE_RENEW_HASHES=1 to add it";
  if (found->second == hash) return "";
  return "the hash of '" + name + "' is " + as_text(hash) + "; expected " + as_text(found->second) + " (" + path_.string() + ")";
}

std::vector<std::string> HashFile::unused() const {
  std::vector<std::string> names;
  for (const auto& [name, hash] : hashes_) {
    if (!used_.contains(name)) names.push_back(name);
  }
  return names;
}

void HashFile::remove_unused() {
  update(path_, [&](auto& hashes) {
    for (const std::string& name : unused()) hashes.erase(name);
  });
}

bool expect_hash(const std::string& name, uint64_t hash) {
  const std::string problem = program_hashes().check(name, hash);
  EXPECT_EQ(problem, "");
  return problem.empty();
}

void expect_no_other_hashes() {
  HashFile& file = program_hashes();
  if (file.mode() == HashFile::Mode::renew) return file.remove_unused();
  for (const std::string& name : file.unused()) ADD_FAILURE() << file.path() << ": no test uses the name '" << name << "'";
}

bool expect_picture(const std::string& name, const Image<glm::u8vec4>& picture, const std::function<Image<glm::u8vec4>()>& expected) {
  Hash hash;
  hash.add_codes(picture);
  const std::string problem = program_hashes().check(name, hash.value());
  if (problem.empty()) return true;
  ADD_FAILURE() << problem << '\n' << write_failed_picture(name, picture, expected ? expected() : Image<glm::u8vec4>());
  return false;
}

}  // namespace halfspace
