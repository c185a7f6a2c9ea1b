// SPDX-License-Identifier: Apache-2.0
//
// Encodes arrays as image files.
#include <cstring>

#include "bindings.h"
#include "halfspace/image/image_io.h"
#include "halfspace/image/png.h"

namespace halfspace::python {

namespace {

// Copies an array of shape (H, W, 3) or (H, W, 4).
Image<glm::u8vec4> codes_of(const Array<uint8_t>& array) {
  const auto channels = static_cast<std::size_t>(array.shape(2));
  Image<glm::u8vec4> image(static_cast<int>(array.shape(1)), static_cast<int>(array.shape(0)));
  const uint8_t* in = array.data();
  glm::u8vec4* out = image.data();
  for (std::size_t i = 0; i < image.texels().size(); ++i, in += channels) {
    out[i] = glm::u8vec4(in[0], in[1], in[2], channels == 4 ? in[3] : uint8_t{255});
  }
  return image;
}

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
  Image<glm::vec4> image(static_cast<int>(array.shape(1)), static_cast<int>(array.shape(0)));
  std::memcpy(image.data(), array.data(), static_cast<std::size_t>(array.nbytes()));
  write_image(path, image);
}

}  // namespace

void bind_image(py::module_& m) {
  m.def("png", &png_of, py::arg("codes").noconvert());
  m.def("save_codes", &save_codes, py::arg("path"), py::arg("codes").noconvert());
  m.def("save_light", &save_light, py::arg("path"), py::arg("light").noconvert());
}

}  // namespace halfspace::python
