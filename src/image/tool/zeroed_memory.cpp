// SPDX-License-Identifier: Apache-2.0
//
// Replaces the global operator new by one that returns zeroed memory. Some readers of OpenImageIO return pixels that they have not set if a
// file is damaged. Without this, such pixels would depend on the images that the process has decoded before, and could show parts of them.
#include <cstdlib>
#include <new>

void* operator new(std::size_t bytes) {
  void* memory = std::calloc(bytes == 0 ? 1 : bytes, 1);
  if (memory == nullptr) throw std::bad_alloc();
  return memory;
}

void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
