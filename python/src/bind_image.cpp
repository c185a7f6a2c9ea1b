// SPDX-License-Identifier: Apache-2.0
//
// Encodes arrays as image files.
#include "bindings.h"
#include "halfspace/image/image_io.h"
#include "halfspace/image/png.h"
#include "images.h"

namespace halfspace::python {

namespace {

py::bytes png_of(const Array<uint8_t>& array) {
  std::vector<std::byte> file;
  {
    const py::gil_scoped_release release;
    file = encode_png(codes_of(array));
  }
  return {reinterpret_cast<const char*>(file.data()), file.size()};
}

void save_codes(const std::string& path, const Array<uint8_t>& array) {
  const py::gil_scoped_release release;
  write_image(path, codes_of(array));
}

void save_light(const std::string& path, const Array<float>& array) {
  const py::gil_scoped_release release;
  write_image(path, light_of(array));
}

}  // namespace

void bind_image(py::module_& m) {
  m.def("png", &png_of, py::arg("codes").noconvert());
  m.def("save_codes", &save_codes, py::arg("path"), py::arg("codes").noconvert());
  m.def("save_light", &save_light, py::arg("path"), py::arg("light").noconvert());
}

}  // namespace halfspace::python
