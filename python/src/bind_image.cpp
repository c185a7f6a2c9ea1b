// SPDX-License-Identifier: Apache-2.0
//
// Encodes arrays as image files, protects files of others, and removes what killed processes left.
#include <optional>

#include "bindings.h"
#include "halfspace/image/atomic_output.h"
#include "halfspace/image/image_io.h"
#include "halfspace/image/image_text.h"
#include "halfspace/image/png.h"
#include "images.h"

namespace halfspace::python {

namespace {

ImageText software() { return {.software = std::string(kSoftwareName) + HALFSPACE_VERSION}; }

py::bytes png_of(const Array<uint8_t>& array) {
  std::vector<std::byte> file;
  {
    const py::gil_scoped_release release;
    file = encode_png(codes_of(array), PngCodes::srgb, software());
  }
  return {reinterpret_cast<const char*>(file.data()), file.size()};
}

// Writes a file, in the format of its extension.
void save_codes(const std::string& path, const Array<uint8_t>& array) {
  const py::gil_scoped_release release;
  write_image(path, codes_of(array), software());
}

void save_light(const std::string& path, const Array<float>& array) {
  const py::gil_scoped_release release;
  write_image(path, light_of(array), software());
}

// Returns the bytes of a file in the format of an extension such as ".png". name: begins error messages.
template <class Pixel>
py::bytes encoded(const Image<Pixel>& image, const std::string& extension, const std::string& name) {
  std::vector<std::byte> file;
  {
    const py::gil_scoped_release release;
    const std::optional<ImageFile> format = image_file_of("picture" + extension);
    if (!format) throw InputError("format: is unknown; expected an image format");
    file = encode_image(image, *format, name, software());
  }
  return {reinterpret_cast<const char*>(file.data()), file.size()};
}

py::bytes encode_codes(const Array<uint8_t>& array, const std::string& extension, const std::string& name) {
  return encoded(codes_of(array), extension, name);
}

py::bytes encode_light(const Array<float>& array, const std::string& extension, const std::string& name) {
  return encoded(light_of(array), extension, name);
}

}  // namespace

void bind_image(py::module_& m) {
  m.def("png", &png_of, py::arg("codes").noconvert());
  m.def("save_codes", &save_codes, py::arg("path"), py::arg("codes").noconvert());
  m.def("encode_codes", &encode_codes, py::arg("codes").noconvert(), py::arg("extension"), py::arg("name"));
  m.def("encode_light", &encode_light, py::arg("light").noconvert(), py::arg("extension"), py::arg("name"));
  m.def("save_light", &save_light, py::arg("path"), py::arg("light").noconvert());
  m.def(
      "check_own_image", [](const std::string& path) { check_own_image(path); }, py::call_guard<py::gil_scoped_release>());
  m.def(
      "remove_abandoned_output", [](const std::string& folder) { remove_abandoned_output(folder); },
      py::call_guard<py::gil_scoped_release>());
}

}  // namespace halfspace::python
