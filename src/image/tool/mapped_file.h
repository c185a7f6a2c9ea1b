// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sys/mman.h>

#include <cerrno>
#include <cstddef>
#include <cstring>
#include <string>

#include "halfspace/image/tool/failure.h"

namespace halfspace::HS_LANES {

/// The bytes of an open file. If another program truncates the file, reading its bytes kills this process. The parent process reports this
/// like any other crash of the decoder.
class MappedFile {
 public:
  MappedFile(int file, std::size_t bytes) : bytes_(bytes), start_(::mmap(nullptr, bytes, PROT_READ, MAP_PRIVATE, file, 0)) {
    if (start_ == MAP_FAILED) throw Failure{std::string("cannot be read (") + std::strerror(errno) + "); expected an image"};
  }
  ~MappedFile() { ::munmap(start_, bytes_); }
  MappedFile(const MappedFile&) = delete;
  MappedFile& operator=(const MappedFile&) = delete;

  const unsigned char* data() const { return static_cast<const unsigned char*>(start_); }
  std::size_t size() const { return bytes_; }

 private:
  std::size_t bytes_;
  void* start_;
};

}  // namespace halfspace::HS_LANES
