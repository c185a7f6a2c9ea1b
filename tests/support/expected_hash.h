// SPDX-License-Identifier: Apache-2.0
//
// Committed hashes: tests/PROGRAM/hashes.txt has a line "NAME HASH" for each, in hexadecimal. With HALFSPACE_RENEW_HASHES=1 the
// tests write the hashes to the file instead of comparing them.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <glm/glm.hpp>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "halfspace/core/image.h"

namespace halfspace {

/// A file of hashes. Several processes may renew it at once.
class HashFile {
 public:
  enum class Mode { compare, renew };

  HashFile(std::filesystem::path path, Mode mode);

  /// Compares the hash with that of the file, or writes it there. Returns what is wrong; empty if nothing is.
  std::string check(const std::string& name, uint64_t hash);
  /// The names of the file that check() was not called with.
  std::vector<std::string> unused() const;
  /// Removes them from the file.
  void remove_unused();

  Mode mode() const { return mode_; }
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
  Mode mode_;
  std::map<std::string, uint64_t> hashes_;
  std::set<std::string> used_;
};

/// Fails the test if the hash is not the one of this program's file. Returns whether it is, or was renewed. `name`: no spaces.
bool expect_hash(const std::string& name, uint64_t hash);

/// Fails the test if the program's file has names that no test used: for a test that uses them all.
void expect_no_other_hashes();

/// Compares the hash of a picture's codes. A picture that differs is written to the build folder's test-output; so are its
/// differences from `expected`, if that is given: it draws the right picture, or one close to it, in another way.
bool expect_picture(const std::string& name, const Image<glm::u8vec4>& picture, const std::function<Image<glm::u8vec4>()>& expected = {});

}  // namespace halfspace
