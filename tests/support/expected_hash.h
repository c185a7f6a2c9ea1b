// SPDX-License-Identifier: Apache-2.0
//
// Committed hashes. tests/PROGRAM/hashes.txt contains one line "NAME HASH" (in hexadecimal) per hash. With HALFSPACE_RENEW_HASHES=1, tests
// update the file instead of comparing hashes.
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

/// A file of hashes. Several processes may update it concurrently.
class HashFile {
 public:
  enum class Mode { compare, renew };

  HashFile(std::filesystem::path path, Mode mode);

  /// Compares the hash with the one in the file, or writes it to the file. Returns an error message; empty on success.
  std::string check(const std::string& name, uint64_t hash);
  /// Returns the names in the file that were not passed to check().
  std::vector<std::string> unused() const;
  /// Removes the unused names from the file.
  void remove_unused();

  Mode mode() const { return mode_; }
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
  Mode mode_;
  std::map<std::string, uint64_t> hashes_;
  std::set<std::string> used_;
};

/// Fails the test if the hash differs from the one in this program's file. Returns true if they are equal or the file was updated. The name
/// must not contain spaces.
bool expect_hash(const std::string& name, uint64_t hash);

/// Fails the test if the program's file contains names that no test has used. Call it only from a test that uses all of them.
void expect_no_other_hashes();

/// Compares the hash of a picture's pixel values with the stored one. If it differs, writes the picture to the folder test-output of the
/// build. If `expected` is given, it must return a reference picture; the difference from that picture is then also written.
bool expect_picture(const std::string& name, const Image<glm::u8vec4>& picture, const std::function<Image<glm::u8vec4>()>& expected = {});

}  // namespace halfspace
