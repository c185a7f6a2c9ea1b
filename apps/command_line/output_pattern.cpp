// SPDX-License-Identifier: Apache-2.0
#include "command_line/output_pattern.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <string_view>
#include <utility>

#include "command_line/errors.h"

namespace halfspace {

namespace {

constexpr std::string_view kFrame = "{frame}", kName = "{name}";

bool is_digit(char c) { return c >= '0' && c <= '9'; }

// A place for the number at the start of a text.
struct Place {
  std::size_t length = 0;  // 0: none
  int digits = 0;          // 0: those of the last frame
  bool is_valid = true;
};

Place place_at(std::string_view text) {
  if (text.starts_with(kFrame)) return {kFrame.size()};
  if (!text.starts_with('%')) return {};
  const auto end = static_cast<std::size_t>(std::ranges::find_if_not(text.substr(1), is_digit) - text.begin());
  if (end == text.size() || text[end] != 'd') return {};
  const bool is_valid = end == 3 && text[1] == '0' && text[2] != '0';
  return {end + 1, is_valid ? text[2] - '0' : 0, is_valid};
}

}  // namespace

std::string short_name(const std::string& scene) { return std::filesystem::path(scene).stem().string(); }

std::filesystem::path named_output(const std::string& name, const std::string& scene) {
  std::string result = name;
  const std::string own = short_name(scene);
  for (std::size_t at = result.find(kName); at != std::string::npos; at = result.find(kName, at + own.size()))
    result.replace(at, kName.size(), own);
  return result;
}

OutputPattern::OutputPattern(const std::filesystem::path& name, const std::string& scene, const FrameRange& range) : range_(range) {
  const int usual = std::max(4, static_cast<int>(std::to_string(range.last).size()));
  const std::string text = name.string();
  std::string before;
  for (std::size_t i = 0; i < text.size();) {
    const std::string_view rest = std::string_view(text).substr(i);
    const Place place = place_at(rest);
    if (!place.is_valid)
      throw UsageError(
          fmt::format("-o is '{}'; expected %0Nd with N from 1 to 9 as the place for the number of the frame, for example %04d, "
                      "or %% for a percent sign",
                      text));
    if (place.length != 0) {
      parts_.push_back({std::exchange(before, {}), place.digits == 0 ? usual : place.digits});
      i += place.length;
    } else if (rest.starts_with(kName)) {
      before += short_name(scene);
      i += kName.size();
    } else {
      before += text[i];
      i += rest.starts_with("%%") ? 2 : 1;
    }
  }
  if (parts_.empty()) {
    const std::filesystem::path file = before;
    parts_.push_back({(file.parent_path() / file.stem()).string() + "_", usual});
    before = file.extension().string();
  }
  parts_.push_back({before, 0});
}

bool OutputPattern::has_place(const std::string& name) {
  for (std::size_t i = 0; i < name.size(); ++i) {
    const std::string_view rest = std::string_view(name).substr(i);
    const Place place = place_at(rest);
    if (place.length != 0 && place.is_valid) return true;
    i += rest.starts_with("%%") ? 1 : 0;
  }
  return false;
}

std::filesystem::path OutputPattern::path(int frame) const {
  std::string name;
  for (const Part& part : parts_) {
    name += part.text;
    if (part.digits != 0) name += fmt::format("{:0{}}", frame, part.digits);
  }
  return name;
}

std::vector<int> OutputPattern::existing_frames() const {
  std::vector<int> frames;
  const std::string &text = parts_.front().text, &after = parts_.back().text;
  const bool is_one_number = parts_.size() == 2 && after.find('/') == std::string::npos && (after.empty() || !is_digit(after.front()));
  if (!is_one_number) {
    for (int i = 0; i < range_.count(); ++i) frames.push_back(range_.at(i));
    return frames;
  }
  // Reads the folder instead of trying each name, because there may be millions of frames.
  const std::string before = text.substr(text.rfind('/') + 1);  // the part of the file name before the number
  const std::filesystem::path first = path(range_.first);
  std::error_code error;
  for (std::filesystem::directory_iterator entry(first.has_parent_path() ? first.parent_path() : ".", error), end; !error && entry != end;
       entry.increment(error)) {
    const std::string name = entry->path().filename().string();
    if (!name.starts_with(before)) continue;
    int frame = -1;
    std::from_chars(name.data() + before.size(), name.data() + name.size(), frame);
    if (frame < 0 || !range_.contains(frame)) continue;
    const std::string stem = path(frame).stem().string();
    if (name.starts_with(stem + ".") || name.starts_with(stem + "-")) frames.push_back(frame);
  }
  std::ranges::sort(frames);
  frames.erase(std::unique(frames.begin(), frames.end()), frames.end());
  return frames;
}

}  // namespace halfspace
