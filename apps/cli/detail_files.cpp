// SPDX-License-Identifier: Apache-2.0
#include "cli/detail_files.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <optional>
#include <span>
#include <system_error>
#include <vector>

#include "cli/file_hash.h"
#include "halfspace/core/check.h"
#include "halfspace/image/atomic_output.h"

namespace halfspace {

namespace {

namespace fs = std::filesystem;

// A file consists of the error, the indices, and the hash of both as text.
constexpr std::size_t kHashDigits = 32;

std::string_view bytes_of(const auto& list) { return {reinterpret_cast<const char*>(list.data()), list.size() * sizeof(list[0])}; }

std::string name_of(const TriangleList& mesh, int step) {
  return hash_of(hash_of(bytes_of(mesh.positions)) + hash_of(bytes_of(mesh.indices)) + std::to_string(step) + " " + detail_version()) +
         ".detail";
}

std::string contents_of(const SimplifiedMesh& simple) {
  std::string contents(sizeof(double), '\0');
  std::memcpy(contents.data(), &simple.error, sizeof(double));
  contents += bytes_of(simple.indices);
  return contents + hash_of(contents);
}

// Returns the mesh, or nothing if the contents cannot be those of a file for `mesh`.
std::optional<SimplifiedMesh> mesh_in(std::string_view contents, const TriangleList& mesh) {
  if (contents.size() < sizeof(double) + kHashDigits) return std::nullopt;
  const std::string_view data = contents.substr(0, contents.size() - kHashDigits);
  if (hash_of(data) != contents.substr(data.size())) return std::nullopt;
  SimplifiedMesh simple;
  const std::size_t count = (data.size() - sizeof(double)) / sizeof(uint32_t);
  if (data.size() != sizeof(double) + count * sizeof(uint32_t) || count % 3 != 0) return std::nullopt;
  simple.indices.resize(count);
  std::memcpy(&simple.error, data.data(), sizeof(double));
  if (count != 0) std::memcpy(simple.indices.data(), data.data() + sizeof(double), count * sizeof(uint32_t));
  const bool in_range = std::ranges::all_of(simple.indices, [&](uint32_t i) { return i < mesh.positions.size(); });
  return in_range && simple.error >= 0.0 ? std::optional(std::move(simple)) : std::nullopt;
}

// Returns the contents of a file, at most `limit` bytes, or nothing if there is no such file.
std::optional<std::string> read_at_most(const fs::path& file, std::size_t limit) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream) return std::nullopt;
  std::string contents(limit, '\0');
  stream.read(contents.data(), static_cast<std::streamsize>(limit));
  contents.resize(static_cast<std::size_t>(stream.gcount()));
  return contents;
}

}  // namespace

fs::path detail_folder() {
  const auto folder_in = [](const char* variable) { return fs::path(std::getenv(variable) == nullptr ? "" : std::getenv(variable)); };
  if (const fs::path cache = folder_in("XDG_CACHE_HOME"); cache.is_absolute()) return cache / "halfspace" / "detail";
  const fs::path home = folder_in("HOME");
  return home.is_absolute() ? home / ".cache" / "halfspace" / "detail" : fs::path();
}

std::optional<SimplifiedMesh> DetailFiles::find(const TriangleList& mesh, int step) {
  const fs::path file = folder_ / name_of(mesh, step);
  const std::size_t largest = sizeof(double) + mesh.indices.size() * sizeof(uint32_t) + kHashDigits;
  std::error_code ignored;
  if (!fs::is_regular_file(file, ignored)) return std::nullopt;
  const std::optional<std::string> contents = read_at_most(file, largest + 1);
  if (!contents) return std::nullopt;
  std::optional<SimplifiedMesh> found = contents->size() <= largest ? mesh_in(*contents, mesh) : std::nullopt;
  if (!found && !warned_.exchange(true)) warn_(file.string() + ": is damaged and is not used");
  if (found) fs::last_write_time(file, fs::file_time_type::clock::now(), ignored);
  return found;
}

void DetailFiles::store(const TriangleList& mesh, int step, const SimplifiedMesh& simple) {
  try {
    const std::string contents = contents_of(simple);
    write_file(folder_ / name_of(mesh, step), std::as_bytes(std::span(contents)));
    remove_abandoned_output(folder_);
    remove_oldest();
  } catch (const OutputError&) {
    // the folder cannot be written; the mesh is made again when it is needed
  }
}

void DetailFiles::remove_oldest() const {
  struct File {
    fs::path path;
    fs::file_time_type used;
    uint64_t bytes;
  };
  std::vector<File> files;
  uint64_t total = 0;
  std::error_code error;
  for (fs::directory_iterator entry(folder_, error), end; !error && entry != end; entry.increment(error)) {
    std::error_code gone;  // another process may have removed the file
    const File file{entry->path(), entry->last_write_time(gone), entry->file_size(gone)};
    if (gone || file.path.extension() != ".detail") continue;
    files.push_back(file);
    total += file.bytes;
  }
  std::ranges::sort(files, {}, &File::used);
  for (const File& file : files) {
    if (total <= max_bytes_) return;
    fs::remove(file.path, error);
    total -= file.bytes;
  }
}

}  // namespace halfspace
