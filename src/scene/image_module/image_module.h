// SPDX-License-Identifier: Apache-2.0
//
// The interface between the program and the image module, in C types: two binaries that share nothing else.
#pragma once

#include <stddef.h>
#include <stdint.h>

extern "C" {

struct HalfspaceImageRequest {
  const char* path;
  const char* format;   // OpenImageIO's name of the format, for example "jpeg"
  uint64_t most_pixels;  // larger images are refused
  uint64_t file_bytes;
  // Called once, with the size: returns width·height·4 bytes to decode into, or null to refuse.
  uint8_t* (*allocate)(void* user, int width, int height);
  void* user;
  // Where a failure is told, one line without the path: what is wrong; what would be right.
  char* error;
  size_t error_size;
};

// Decodes to RGBA, 8 bits a channel, top row first. 1 on success, 0 on failure. Throws nothing.
typedef int HalfspaceReadImage(const HalfspaceImageRequest* request);
}

#define HALFSPACE_READ_IMAGE "halfspace_read_image_1"  // the function's name; the number changes with the interface
