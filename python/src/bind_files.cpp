// SPDX-License-Identifier: Apache-2.0
//
// The commands `export`, `info` and `compare`. Results are JSON text.
#include <nlohmann/json.hpp>
#include <optional>

#include "bindings.h"
#include "halfspace/image/atomic_output.h"
#include "halfspace/image/image_io.h"
#include "halfspace/render/export/export_files.h"
#include "halfspace/render/frame/image_comparison.h"
#include "halfspace/render/model_file/input_files.h"
#include "halfspace/render/model_file/model_info.h"
#include "halfspace/render/program_info.h"
#include "images.h"
#include "messages.h"

namespace halfspace::python {

namespace {

using WithoutGil = py::call_guard<py::gil_scoped_release>;

std::string json_text(const nlohmann::ordered_json& json) { return json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace); }

// up_axis: "y", "z" or empty for that of the file.
std::string info_of(const std::string& file, bool allow_outside, const std::string& up_axis) {
  const auto up = up_axis.empty() ? std::nullopt : std::optional(up_axis == "z" ? UpAxis::z : UpAxis::y);
  return json_text(model_info(file, allow_outside, up));
}

// Returns the warnings.
std::vector<std::string> export_model(const std::string& file, const std::string& out, bool allow_outside) {
  std::vector<std::string> warnings;
  const auto warn = [&](const std::string& warning) { warnings.push_back(in_python_terms(warning)); };
  write_files(out, exported_files(export_source(file, allow_outside), out, model_format_of(out).value(), warn));
  return warnings;
}

// Compares two images. An empty name of the picture means none. Returns the results, and a message if they exceed the tolerance.
std::pair<std::string, std::string> compare_of(const ComparedImage& a, const ComparedImage& b, const std::string& picture,
                                               std::optional<double> tolerance, const std::string& expected) {
  Image<glm::u8vec4> difference;
  if (!picture.empty()) {
    reject_overwriting(picture, {a.name, b.name});
    check_writable(picture);
  }
  const Comparison c = compare(a, b, picture.empty() ? nullptr : &difference);
  if (!picture.empty()) write_png(picture, difference);
  return {json_text(comparison_json(c)), tolerance ? excess(c, *tolerance, expected) : std::string()};
}

}  // namespace

void bind_files(py::module_& m) {
  m.def("model_info", &info_of, WithoutGil());
  m.def("program_info", [] { return json_text(program_info(HALFSPACE_VERSION)); });
  m.def("export_model", &export_model, WithoutGil());
  m.def("is_model_format", [](const std::string& out) { return model_format_of(out).has_value(); });
  py::class_<ComparedImage>(m, "ComparedImage")
      .def_static("read", &read_compared_image, WithoutGil())
      .def_static(
          "codes",
          [](const std::string& name, const Array<uint8_t>& array) {
            return ComparedImage{name, codes_of(array)};
          },
          py::arg("name"), py::arg("codes").noconvert())
      .def_static(
          "light",
          [](const std::string& name, const Array<float>& array) {
            return ComparedImage{name, light_of(array)};
          },
          py::arg("name"), py::arg("light").noconvert());
  m.def("compare", &compare_of, WithoutGil());
}

}  // namespace halfspace::python
