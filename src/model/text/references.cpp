// SPDX-License-Identifier: Apache-2.0
#include "halfspace/model/text/references.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <system_error>

#include "halfspace/model/text/text_lines.h"

namespace halfspace::HS_LANES {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMaxNameLength = 4096;

bool has_drive(std::string_view name) {
  return name.size() > 1 && name[1] == ':' && std::isalpha(static_cast<unsigned char>(name[0])) != 0;
}

// Returns true if a path is inside a folder. Both must be canonical, without symbolic links and dots.
bool is_inside(const fs::path& path, const fs::path& folder) { return std::ranges::mismatch(folder, path).in1 == folder.end(); }

// Returns the canonical path of a regular file, or nullopt if it does not exist or is not accessible.
std::optional<fs::path> canonical_file(const fs::path& path) {
  std::error_code error;
  if (!fs::is_regular_file(path, error)) return std::nullopt;
  fs::path canonical = fs::canonical(path, error);
  if (error) return std::nullopt;
  return canonical;
}

bool equal_ignoring_case(std::string_view a, std::string_view b) {
  const auto lower = [](char c) { return std::tolower(static_cast<unsigned char>(c)); };
  return std::ranges::equal(a, b, {}, lower, lower);
}

// Returns the entry of a folder whose name equals `name` except for case. If there are several, returns the first in alphabetical order.
std::optional<fs::path> entry_ignoring_case(const fs::path& folder, const std::string& name) {
  std::error_code error;
  if (fs::exists(folder / name, error)) return folder / name;
  std::optional<fs::path> best;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error)) {
    if (!equal_ignoring_case(entry->path().filename().string(), name)) continue;
    if (!best || entry->path() < *best) best = entry->path();
  }
  return best;
}

// Returns folder/relative with the case of the existing files and folders. The path must not contain "..".
std::optional<fs::path> path_ignoring_case(const fs::path& folder, const fs::path& relative) {
  fs::path path = folder;
  for (const fs::path& part : relative) {
    const std::optional<fs::path> next = entry_ignoring_case(path, part.string());
    if (!next) return std::nullopt;
    path = *next;
  }
  return path;
}

}  // namespace

References::References(const fs::path& model, bool allow_outside, std::vector<std::string>& warnings)
    : allow_outside_(allow_outside), warnings_(warnings) {
  std::error_code ignored;
  folder_ = fs::weakly_canonical(fs::absolute(model, ignored).parent_path(), ignored);
}

std::optional<fs::path> References::find(std::string_view name, std::string_view what) {
  std::optional<fs::path> file = search(name, what);
  if (file) found_.push_back(*file);
  return file;
}

// All rejected references share one warning, because a model can have hundreds of textures in the same folder.
void References::warn_outside(const std::string& reference) {
  if (outside_++ == 0) {
    outside_warning_ = warnings_.size();
    first_outside_ = reference;
    warnings_.push_back(reference + " is outside the folder of the model and was not opened; use --allow-outside to allow it");
    return;
  }
  warnings_[outside_warning_] = fmt::format("{} and {} more {} outside the folder of the model and were not opened; use --allow-outside",
                                            first_outside_, outside_ - 1, outside_ == 2 ? "file are" : "files are");
}

std::optional<fs::path> References::search(std::string_view name, std::string_view what) {
  const auto warn = [&](const std::string& text) { warnings_.push_back(fmt::format("{}: {} {}", what, in_quotes(name), text)); };
  std::string text(name);
  std::ranges::replace(text, '\\', '/');
  if (text.empty() || text.size() > kMaxNameLength || text.find('\0') != std::string::npos) {
    warn("is not a file name");
    return std::nullopt;
  }
  const bool drive = has_drive(text);
  const fs::path path = drive ? fs::path("/") : (folder_ / text).lexically_normal();
  bool outside = drive || !is_inside(path, folder_);
  if (!drive && (!outside || allow_outside_)) {
    const std::optional<fs::path> file = canonical_file(path);
    const bool leaves = file && !is_inside(*file, folder_);  // through a symbolic link
    if (file && (allow_outside_ || !leaves)) return path;
    outside = outside || leaves;
  }
  if (!outside) {
    const std::optional<fs::path> other = path_ignoring_case(folder_, path.lexically_relative(folder_));
    const std::optional<fs::path> file = other ? canonical_file(*other) : std::nullopt;
    if (file && is_inside(*file, folder_)) {
      warn("does not exist; using " + in_quotes(other->lexically_relative(folder_).string()));
      return other;
    }
  }
  const std::string bare = text.substr(text.find_last_of("/:") + 1);
  if (bare != text && !bare.empty() && bare != "." && bare != "..") {
    const std::optional<fs::path> other = entry_ignoring_case(folder_, bare);
    const std::optional<fs::path> file = other ? canonical_file(*other) : std::nullopt;
    if (file && is_inside(*file, folder_)) {
      warn(fmt::format("{}; using {}", outside && !allow_outside_ ? "is outside the folder of the model" : "does not exist",
                       in_quotes(other->filename().string())));
      return other;
    }
  }
  if (outside && !allow_outside_) {
    warn_outside(fmt::format("{}: {}", what, in_quotes(name)));
  } else {
    warn("does not exist");
  }
  return std::nullopt;
}

}  // namespace halfspace::HS_LANES
