// SPDX-License-Identifier: Apache-2.0
//
// Cameras that are defined by matrices.
#include <array>

#include "bindings.h"
#include "halfspace/render/view.h"
#include "matrices.h"

namespace halfspace::python {

void bind_camera(py::module_& m) {
  using Vector = std::array<double, 3>;
  py::class_<CameraDescription>(m, "Camera")
      .def_static("from_matrices",
                  [](const Array<double>& world_from_camera, const Array<double>& clip_from_camera) {
                    return matrix_camera({matrix_of(world_from_camera), matrix_of(clip_from_camera)});
                  })
      .def_static("look_at",
                  [](const Vector& position, const Vector& target, const Vector& up, double fov, double height, double near, double far) {
                    CameraDescription c;
                    c.type = height > 0.0 ? Projection::orthographic : Projection::perspective;
                    c.position = {position[0], position[1], position[2]};
                    c.target = {target[0], target[1], target[2]};
                    c.up = {up[0], up[1], up[2]};
                    if (height > 0.0) c.height = height;
                    c.fov = fov;
                    c.near = near;
                    c.far = far;
                    return c;
                  });
}

}  // namespace halfspace::python
