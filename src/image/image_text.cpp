// SPDX-License-Identifier: Apache-2.0
#include "halfspace/image/image_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <iterator>
#include <optional>
#include <span>
#include <utility>

#include "halfspace/core/check.h"
#include "halfspace/image/exr_header.h"
#include "halfspace/image/image_format.h"
#include "halfspace/image/png.h"

namespace halfspace::HS_LANES {

namespace {

constexpr std::string_view kSoftwareLabel = "Software: ", kCommentLabel = "Comment: ", kFingerprintLabel = "Fingerprint: ",
                           kPixelBytesLabel = "Pixel bytes: ";

// A file that is read in parts. After an error, all results are empty.
class FileParts {
 public:
  explicit FileParts(const std::filesystem::path& path) : stream_(path, std::ios::binary) {
    std::error_code error;
    const auto size = std::filesystem::file_size(path, error);
    size_ = error || !stream_ ? 0 : size;
  }

  uint64_t size() const { return size_; }

  // Returns the bytes from an offset, or an empty text if the file does not have all of them.
  std::string at(uint64_t offset, uint64_t count) {
    if (offset > size_ || count > size_ - offset) return {};
    std::string bytes(count, '\0');
    stream_.seekg(static_cast<std::streamoff>(offset));
    stream_.read(bytes.data(), static_cast<std::streamsize>(count));
    return stream_ ? bytes : std::string();
  }
  std::string start() {
    constexpr uint64_t kStartBytes = 1 << 17;  // more than the longest JPEG comment
    return at(0, std::min(kStartBytes, size_));
  }
  std::string end(uint64_t count) { return count > size_ ? std::string() : at(size_ - count, count); }

 private:
  std::ifstream stream_;
  uint64_t size_ = 0;
};

template <class T>
T number_at(std::string_view bytes, std::size_t offset) {
  T n = 0;
  if (offset <= bytes.size() && sizeof n <= bytes.size() - offset) std::memcpy(&n, bytes.data() + offset, sizeof n);
  return n;
}

// Returns the rest of the line that begins with a label, or an empty text.
std::string line_of(std::string_view lines, std::string_view label) {
  while (!lines.empty()) {
    const std::string_view line = lines.substr(0, lines.find('\n'));
    if (line.starts_with(label)) return std::string(line.substr(label.size()));
    lines.remove_prefix(std::min(lines.size(), line.size() + 1));
  }
  return {};
}

ImageText parse_lines(std::string_view lines) {
  return {line_of(lines, kSoftwareLabel), line_of(lines, kCommentLabel), line_of(lines, kFingerprintLabel)};
}

// Returns the first comment of a JPEG file. Source: ITU-T T.81, B.1.1.4 (marker segments) and B.2.4.5 (COM).
std::string jpeg_comment(std::string_view start) {
  constexpr unsigned char kComMarker = 0xfe, kScanMarker = 0xda;
  std::size_t at = 2;  // after SOI
  while (at + 4 <= start.size() && static_cast<unsigned char>(start[at]) == 0xff) {
    const auto marker = static_cast<unsigned char>(start[at + 1]);
    const std::size_t length = static_cast<unsigned char>(start[at + 2]) * 256u + static_cast<unsigned char>(start[at + 3]);
    if (marker == kScanMarker || length < 2 || at + 2 + length > start.size()) break;
    if (marker == kComMarker) return std::string(start.substr(at + 4, length - 2));
    at += 2 + length;
  }
  return {};
}

// The header of a Radiance file: everything before its pixels.
std::string_view radiance_header_of(std::string_view start) {
  const std::size_t blank = start.find("\n\n");
  const std::size_t size = blank == std::string_view::npos ? blank : start.find('\n', blank + 2);  // the line with the resolution
  return size == std::string_view::npos ? std::string_view() : start.substr(0, size + 1);
}

// One entry of a TIFF directory.
struct TiffField {
  uint16_t tag = 0, type = 0;
  uint32_t count = 0, value = 0;

  // Returns the size of one element, or 0 if the type is unknown. Source: TIFF 6.0, section 2.
  uint64_t element_bytes() const {
    constexpr unsigned char kBytes[] = {0, 1, 1, 2, 4, 8, 1, 1, 2, 4, 8, 4, 8};
    return type < std::size(kBytes) ? kBytes[type] : 0;
  }
  uint64_t bytes() const { return element_bytes() * count; }
  bool is_elsewhere() const { return bytes() > 4; }  // otherwise, `value` contains the elements
};

// The directory of a little-endian TIFF file with 32-bit offsets.
class TiffDirectory {
 public:
  explicit TiffDirectory(FileParts& file) : file_(file) {
    const std::string header = file.at(0, 8);
    if (!header.starts_with(std::string_view("II\x2a\0", 4))) return;
    const uint64_t offset = number_at<uint32_t>(header, 4), count = number_at<uint16_t>(file.at(offset, 2), 0);
    const std::string entries = file.at(offset + 2, 12 * count + 4);  // with the offset of the next directory
    for (std::size_t i = 0; i + 12 <= entries.size(); i += 12) {
      fields_.push_back({number_at<uint16_t>(entries, i), number_at<uint16_t>(entries, i + 2), number_at<uint32_t>(entries, i + 4),
                         number_at<uint32_t>(entries, i + 8)});
    }
  }

  std::string text(uint16_t tag) const {
    const TiffField f = field(tag);
    std::string text = f.element_bytes() == 1 && f.is_elsewhere() ? file_.at(f.value, f.count) : std::string();
    return text.substr(0, text.find('\0'));
  }

  // Returns whether the file contains everything to which the directory refers.
  bool is_whole() const {
    constexpr uint16_t kStripOffsets = 273, kStripByteCounts = 279;
    const uint64_t last_strip = last_number(field(kStripOffsets)), bytes = last_number(field(kStripByteCounts));
    return last_strip > 0 && last_strip + bytes <= file_.size() &&
           std::ranges::all_of(fields_, [&](const TiffField& f) { return !f.is_elsewhere() || f.value + f.bytes() <= file_.size(); });
  }

 private:
  TiffField field(uint16_t tag) const {
    const auto found = std::ranges::find(fields_, tag, &TiffField::tag);
    return found == fields_.end() ? TiffField{} : *found;
  }
  // Returns the last element of a field with integers, or 0.
  uint64_t last_number(const TiffField& f) const {
    const uint64_t bytes = f.element_bytes();
    if (f.count == 0 || (bytes != 2 && bytes != 4)) return 0;
    std::string elements(reinterpret_cast<const char*>(&f.value), sizeof f.value);
    if (f.is_elsewhere()) elements = file_.at(f.value, f.bytes());
    const std::size_t at = elements.size() < f.bytes() ? elements.size() : bytes * (f.count - 1);
    return bytes == 2 ? number_at<uint16_t>(elements, at) : number_at<uint32_t>(elements, at);
  }

  FileParts& file_;
  std::vector<TiffField> fields_;
};

bool is_whole_radiance(FileParts& file) {
  const std::string start = file.start();
  const std::string_view header = radiance_header_of(start);
  const std::string bytes = line_of(header, kPixelBytesLabel);
  return !bytes.empty() && bytes == std::to_string(file.size() - header.size());
}

// Returns the name of the format as in find_tool_format(), "png", or an empty text.
std::string_view format_of(const std::filesystem::path& path, std::string_view start) try {
  if (is_png(std::as_bytes(std::span(start)))) return "png";
  const std::optional<ToolFormat> format = start.empty() ? std::nullopt : find_tool_format(path.string(), start);
  return format ? format->name : std::string_view();
} catch (const InputError&) {
  return {};
}

}  // namespace

ImageText read_image_text(const std::filesystem::path& path) {
  FileParts file(path);
  const std::string start = file.start();
  const std::string_view format = format_of(path, start.substr(0, kFormatBytes));
  if (format == "png") return png_text(std::as_bytes(std::span(start)));
  if (format == "openexr") return exr_text(path);
  if (format == "jpeg") return parse_lines(jpeg_comment(start));
  constexpr uint16_t kImageDescription = 270;
  if (format == "tiff") return parse_lines(TiffDirectory(file).text(kImageDescription));
  if (format == "hdr") return parse_lines(radiance_header_of(start));
  return {};
}

bool is_whole_image(const std::filesystem::path& path) {
  FileParts file(path);
  const std::string_view format = format_of(path, file.at(0, std::min<uint64_t>(kFormatBytes, file.size())));
  if (format == "png") return file.end(8) == std::string_view("IEND\xae\x42\x60\x82", 8);
  if (format == "jpeg") return file.end(2) == "\xff\xd9";
  if (format == "openexr") return is_whole_exr(path);
  if (format == "tiff") return TiffDirectory(file).is_whole();
  return format == "hdr" && is_whole_radiance(file);
}

void check_own_image(const std::filesystem::path& path) {
  std::error_code error;
  if (std::filesystem::is_regular_file(path, error) && !read_image_text(path).software.starts_with(kSoftwareName))
    throw OutputError(path.string() + ": exists, and Halfspace did not write it; expected another output file");
}

std::string text_lines(const ImageText& text) {
  std::string lines;
  for (const auto& [label, value] : {std::pair(kFingerprintLabel, &text.fingerprint), std::pair(kSoftwareLabel, &text.software),
                                     std::pair(kCommentLabel, &text.comment)}) {
    if (!value->empty()) lines += fmt::format("{}{}\n", label, *value);
  }
  return lines;
}

void insert_radiance_text(std::vector<std::byte>& file, const ImageText& text) {
  std::string lines = text_lines(text);
  if (lines.empty()) return;
  const std::string_view bytes(reinterpret_cast<const char*>(file.data()), file.size());
  lines += fmt::format("{}{}\n", kPixelBytesLabel, file.size() - radiance_header_of(bytes).size());
  const auto second_line = static_cast<std::ptrdiff_t>(bytes.find('\n') + 1);
  const auto added = std::as_bytes(std::span(lines));
  file.insert(file.begin() + second_line, added.begin(), added.end());
}

}  // namespace halfspace::HS_LANES
