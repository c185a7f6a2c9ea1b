// SPDX-License-Identifier: Apache-2.0
//
// The parts of the extension module halfspace._core. The Python code of the package checks all arguments and passes contiguous arrays of
// the types below; _core is not a public interface.
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <glm/glm.hpp>
#include <span>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "halfspace/core/check.h"
#include "halfspace/core/image.h"

namespace halfspace::python {

namespace py = pybind11;

/// A C-contiguous array. Arrays of another type or layout are rejected, because a conversion would be a copy.
template <class T>
using Array = py::array_t<T, py::array::c_style>;

void bind_camera(py::module_& m);
void bind_draw(py::module_& m);
void bind_draw_state(py::module_& m);
void bind_scene(py::module_& m);
void bind_model(py::module_& m);
void bind_model_file(py::module_& m);
void bind_shapes(py::module_& m);
void bind_image(py::module_& m);
void bind_files(py::module_& m);
void bind_labels(py::module_& m);

/// Returns the elements of an array, whose last axis must have the length of T.
template <class T>
std::span<const T> rows_of(const Array<typename T::value_type>& array) {
  constexpr auto n = static_cast<py::ssize_t>(sizeof(T) / sizeof(typename T::value_type));
  if (array.ndim() == 0 || array.shape(array.ndim() - 1) != n) throw InputError("an array has the wrong shape");
  return {reinterpret_cast<const T*>(array.data()), static_cast<std::size_t>(array.size() / n)};
}

/// Copies texels to `out` without alpha.
inline void copy_rgb(std::span<const glm::u8vec4> texels, uint8_t* out) {
  for (const glm::u8vec4& texel : texels) {
    *out++ = texel.x;
    *out++ = texel.y;
    *out++ = texel.z;
  }
}

/// Returns an array of shape (height, width) that owns the image.
template <class Number>
requires std::is_arithmetic_v<Number> py::array array_of(Image<Number>&& image) {
  auto* owned = new Image<Number>(std::move(image));
  const py::capsule owner(owned, [](void* p) { delete static_cast<Image<Number>*>(p); });
  return py::array_t<Number>({py::ssize_t{owned->height()}, py::ssize_t{owned->width()}}, owned->data(), owner);
}

/// Returns an array of shape (height, width, channels) that owns the image.
template <class Pixel>
py::array array_of(Image<Pixel>&& image) {
  using Number = typename Pixel::value_type;
  constexpr auto channels = static_cast<py::ssize_t>(sizeof(Pixel) / sizeof(Number));
  auto* owned = new Image<Pixel>(std::move(image));
  const py::capsule owner(owned, [](void* p) { delete static_cast<Image<Pixel>*>(p); });
  return py::array_t<Number>({py::ssize_t{owned->height()}, py::ssize_t{owned->width()}, channels},
                             reinterpret_cast<Number*>(owned->data()), owner);
}

}  // namespace halfspace::python
