// SPDX-License-Identifier: Apache-2.0
//
// The file that a reader decodes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "halfspace/image/image_format.h"

namespace halfspace::HS_LANES {

/// An image file on disk or in memory. Members throw InputError, with a message that begins with the path or name.
class ImageSource {
 public:
  /// Opens the file. `expected` lists formats for messages. Throws if the file is empty, larger than 2 GiB or not an image.
  ImageSource(const std::filesystem::path& path, const char* expected);
  /// Refers to the bytes, which must outlive this object.
  ImageSource(std::span<const std::byte> bytes, const std::string& name, const char* expected);
  ~ImageSource();
  ImageSource(const ImageSource&) = delete;
  ImageSource& operator=(const ImageSource&) = delete;

  const std::string& name() const { return name_; }
  /// The format, or nothing for PNG.
  const std::optional<ToolFormat>& tool_format() const { return tool_format_; }

  /// Returns the whole file. Valid as long as this object exists.
  std::span<const std::byte> bytes();
  /// Returns an open descriptor of the whole file, which this object closes.
  int descriptor();

 private:
  void find_format(const char* expected);
  std::vector<std::byte> read(std::size_t count) const;

  std::string name_;
  std::size_t size_ = 0;
  std::span<const std::byte> bytes_;   // empty if the file is on disk and has not been read yet
  std::vector<std::byte> read_bytes_;  // the memory of bytes_, if the file is on disk
  int descriptor_ = -1;
  std::optional<ToolFormat> tool_format_;
};

}  // namespace halfspace::HS_LANES
