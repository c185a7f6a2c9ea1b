// SPDX-License-Identifier: Apache-2.0
//
// The meshes of shapes as arrays: positions, normals, uvs (v = 0 is the top row of an image) and faces.
#include "bindings.h"
#include "halfspace/geometry/shapes.h"

namespace halfspace::python {

namespace {

template <class V>
py::array rows_array(const std::vector<V>& rows) {
  return py::array_t<float>({static_cast<py::ssize_t>(rows.size()), py::ssize_t{V::length()}}, &rows.data()->x);
}

py::tuple arrays_of(const Mesh& mesh) {
  const py::array_t<uint32_t> faces({static_cast<py::ssize_t>(mesh.indices.size() / 3), py::ssize_t{3}}, mesh.indices.data());
  return py::make_tuple(rows_array(mesh.positions), rows_array(mesh.normals), rows_array(mesh.uvs), faces);
}

}  // namespace

void bind_shapes(py::module_& m) {
  m.def("uv_sphere", [](float radius, int bands, int sectors) { return arrays_of(uv_sphere(bands, sectors, radius)); });
  m.def("icosphere", [](float radius, int level) { return arrays_of(icosphere(level, radius)); });
  m.def("plane", [](float size, int segments) { return arrays_of(plane(size, segments)); });
  m.def("cube", [](float size, int segments) { return arrays_of(cube(size, segments)); });
  m.def("cylinder", [](float radius, float length, int bands, int sectors) { return arrays_of(cylinder(radius, length, bands, sectors)); });
  m.def("cone", [](float radius, float length, int bands, int sectors) { return arrays_of(cone(radius, length, bands, sectors)); });
  m.def("torus", [](float radius, float tube, int bands, int sectors) { return arrays_of(torus(radius, tube, bands, sectors)); });
  m.def("torus_knot", [](float radius, float tube, int bands, int sectors) { return arrays_of(torus_knot(radius, tube, bands, sectors)); });
}

}  // namespace halfspace::python
