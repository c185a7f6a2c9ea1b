// SPDX-License-Identifier: Apache-2.0
//
// Errors about images that need more memory than there is.
#pragma once

#include <cstddef>
#include <cstdint>
#include <new>
#include <string>

#include "bindings.h"
#include "scene_core.h"

namespace halfspace::python {

/// Becomes a MemoryError in Python. The message says how much memory is needed and what the limit is.
class MemoryShortage : public std::bad_alloc {
 public:
  /// needed: in bytes.
  MemoryShortage(const std::string& place, uint64_t needed);
  const char* what() const noexcept override { return message_.c_str(); }

 private:
  std::string message_;
};

/// Throws MemoryShortage if an allocation of this size must fail: if it exceeds the memory of the machine or a limit of the process.
void check_memory(const std::string& place, uint64_t needed);

/// Returns the message of an allocation that failed elsewhere.
std::string allocation_problem();

/// Calls f(), which allocates images and arrays of this size with these bytes per pixel in total, and returns its result. Throws
/// MemoryShortage if that fails or must fail.
template <class F>
auto with_memory(PictureSize size, std::size_t bytes_per_pixel, const F& f) {
  const uint64_t needed = static_cast<uint64_t>(size.width) * static_cast<uint64_t>(size.height) * bytes_per_pixel;
  const std::string place = "size " + std::to_string(size.width) + "x" + std::to_string(size.height);
  check_memory(place, needed);
  try {
    return f();
  } catch (const MemoryShortage&) {
    throw;
  } catch (const std::bad_alloc&) {
    throw MemoryShortage(place, needed);
  } catch (py::error_already_set& e) {
    if (!e.matches(PyExc_MemoryError)) throw;
    throw MemoryShortage(place, needed);  // NumPy could not allocate an array
  }
}

}  // namespace halfspace::python
