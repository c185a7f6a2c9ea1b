// SPDX-License-Identifier: Apache-2.0
#include "cli/file_hash.h"

#include <fmt/format.h>
#include <xxhash.h>

#include <fstream>
#include <map>
#include <memory>
#include <mutex>
#include <new>
#include <vector>

namespace halfspace {

namespace {

std::string hex(const XXH128_hash_t& hash) { return fmt::format("{:016x}{:016x}", hash.high64, hash.low64); }

// Reads a file, or returns a text that is not a hash if it cannot be read.
std::string new_hash_of_file(const std::filesystem::path& file) {
  std::error_code error;
  std::ifstream stream(file, std::ios::binary);
  if (!std::filesystem::is_regular_file(file, error) || !stream) return "none";
  const std::unique_ptr<XXH3_state_t, decltype(&XXH3_freeState)> state(XXH3_createState(), &XXH3_freeState);
  if (state == nullptr) throw std::bad_alloc();
  XXH3_128bits_reset(state.get());
  std::vector<char> buffer(std::size_t{1} << 20);
  while (stream.read(buffer.data(), static_cast<std::streamsize>(buffer.size())), stream.gcount() > 0)
    XXH3_128bits_update(state.get(), buffer.data(), static_cast<std::size_t>(stream.gcount()));
  return stream.bad() ? "none" : hex(XXH3_128bits_digest(state.get()));
}

}  // namespace

std::string hash_of(std::string_view text) { return hex(XXH3_128bits(text.data(), text.size())); }

std::string hash_of_file(const std::filesystem::path& file) {
  static std::mutex mutex;
  static std::map<std::filesystem::path, std::string> hashes;
  const std::lock_guard lock(mutex);
  const auto [entry, is_new] = hashes.try_emplace(file);
  if (is_new) entry->second = new_hash_of_file(file);
  return entry->second;
}

std::string hash_of_files(std::span<const std::filesystem::path> files) {
  std::string contents;
  for (const std::filesystem::path& file : files) contents += hash_of_file(file) + '\n';
  return hash_of(contents);
}

}  // namespace halfspace
