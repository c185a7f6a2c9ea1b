// SPDX-License-Identifier: Apache-2.0
//
// Cameras: created from matrices or from positions, and read as matrices.
#include <array>

#include "bindings.h"
#include "halfspace/core/units.h"
#include "halfspace/geometry/camera.h"
#include "halfspace/render/view.h"
#include "matrices.h"

namespace halfspace::python {

namespace {

// Returns the matrices of a camera for an image of width x height pixels: the inverse of matrix_camera().
CameraMatrices camera_matrices_of(const CameraDescription& c, int width, int height) {
  if (c.matrices) return *c.matrices;
  const View view = make_view(c, width, height);
  const double aspect = static_cast<double>(width) / height;
  CameraMatrices m;
  const glm::dvec3 axes[] = {view.right_ws, view.up_ws, -view.forward_ws, view.eye_ws};
  for (int i = 0; i < 4; ++i) m.world_from_camera[i] = glm::dvec4(axes[i], i == 3 ? 1.0 : 0.0);
  m.clip_from_camera = c.type == Projection::perspective ? perspective_gl(c.fov * kRadiansPerDegree, aspect, near_plane(c), far_plane(c))
                                                         : orthographic_gl(c.height, aspect, near_plane(c), far_plane(c));
  return m;
}

}  // namespace

void bind_camera(py::module_& m) {
  using namespace py::literals;
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
                  })
      .def("pose", [](const CameraDescription& c) { return array_of(camera_matrices_of(c, 1, 1).world_from_camera); })
      .def("projection", [](const CameraDescription& c, int width,
                            int height) { return array_of(camera_matrices_of(c, width, height).clip_from_camera); })
      // The arguments of look_at().
      .def("look_at_arguments", [](const CameraDescription& c) {
        const auto vector = [](const glm::dvec3& v) { return Vector{v.x, v.y, v.z}; };
        const bool perspective = c.type == Projection::perspective;
        const auto plane = [](double distance) { return distance == 0.0 ? py::object(py::none()) : py::cast(distance); };
        return py::dict("position"_a = vector(c.position), "target"_a = vector(c.target), "up"_a = vector(c.up),
                        "fov"_a = perspective ? py::cast(c.fov) : py::none(), "height"_a = perspective ? py::none() : py::cast(c.height),
                        "near"_a = plane(c.near), "far"_a = plane(c.far));
      });
}

}  // namespace halfspace::python
