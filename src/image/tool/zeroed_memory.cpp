// SPDX-License-Identifier: Apache-2.0
//
// Replaces the global operator new with one that returns zeroed memory. If a file is damaged, some readers of OpenImageIO return pixels
// that they have not set. Without this, such pixels would depend on the images that the process decoded before, and could show parts of
// them.
#include <cstdlib>
#include <new>

void* operator new(std::size_t bytes) {
  void* memory = std::calloc(bytes == 0 ? 1 : bytes, 1);
  if (memory == nullptr) throw std::bad_alloc();
  return memory;
}

void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
