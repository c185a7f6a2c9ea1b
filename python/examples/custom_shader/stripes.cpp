// SPDX-License-Identifier: Apache-2.0
//
// A custom shader in an extension module: draws the triangles of a NumPy array into a NumPy image, with stripes along x.
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <glm/glm.hpp>
#include <stdexcept>

#include "halfspace/core/check.h"
#include "halfspace/core/lane_math.h"
#include "halfspace/raster/pass.h"

namespace py = pybind11;

namespace {

using halfspace::floor, halfspace::select;  // work for floats and for SIMD lanes
using halfspace::vec3, halfspace::vec4;

// Members without `R` are the uniforms.
struct Stripes {
  float count = 8.0f;  // stripes per unit of x

  template <class R>
  struct Attributes {
    vec3<R> position;
  };
  template <class R>
  struct Varyings {
    R x;
  };

  template <class R>
  vec4<R> vertex(const Attributes<R>& in, Varyings<R>& out) const {
    out.x = in.position.x * R(count);
    return vec4<R>(in.position, R(1));  // the array contains clip-space positions
  }
  template <class R>
  halfspace::Fragment<R> fragment(const Varyings<R>& in, const halfspace::Pixel<R>&) const {
    const R light = select(in.x - floor(in.x) < R(0.5f), R(1), R(0));
    return {vec4<R>(light, light, light, R(1))};
  }
};

template <class T>
using Array = py::array_t<T, py::array::c_style>;

// positions: (3 N, 3), three rows per triangle. image: (H, W, 4), written in place.
void draw(const Array<float>& positions, Array<uint8_t> image, float count) {
  if (positions.ndim() != 2 || positions.shape(1) != 3 || positions.shape(0) % 3 != 0 || positions.size() == 0 || image.ndim() != 3 ||
      image.shape(2) != 4 || image.size() == 0)
    throw std::invalid_argument("expected positions of shape (3 N, 3) and an image of shape (H, W, 4), neither of them empty");
  const std::span rows(reinterpret_cast<const glm::vec3*>(positions.data()), static_cast<std::size_t>(positions.shape(0)));
  const int width = static_cast<int>(image.shape(1)), height = static_cast<int>(image.shape(0));
  const halfspace::ColorTarget target{.format = halfspace::ColorFormat::srgb8a8,
                                      .data = reinterpret_cast<std::byte*>(image.mutable_data()),
                                      .width = width,
                                      .height = height};
  const py::gil_scoped_release release;
  halfspace::Pass pass(width, height, target, {});
  pass.draw(Stripes{count}, halfspace::make_vertex_view(halfspace::stream(rows)));
  pass.run(halfspace::Workers(halfspace::Workers::cores()));
}

// A violated precondition of the library raises a Python exception. Without a handler, it would end the process.
[[noreturn]] void throw_failed_check(const halfspace::CheckFailure& failure) { throw std::runtime_error(failure.message); }

}  // namespace

PYBIND11_MODULE(stripes, m) {
  halfspace::set_check_handler(throw_failed_check);
  m.doc() = "Draws triangles with stripes.";
  m.def("draw", &draw, py::arg("positions").noconvert(), py::arg("image").noconvert(), py::arg("count") = 8.0f);
}
