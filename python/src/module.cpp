// SPDX-License-Identifier: Apache-2.0
//
// The extension module halfspace._core.
#include <stdexcept>

#include "bindings.h"
#include "halfspace/core/cpu.h"
#include "halfspace/core/lanes.h"
#include "halfspace/core/parallel.h"
#include "halfspace/core/tool_folder.h"
#include "halfspace/scene/scene_file.h"

namespace halfspace::python {

namespace {

[[noreturn]] void throw_failed_check(const CheckFailure& failure) { throw std::logic_error(failure.message); }

std::vector<std::string> scene_names() {
  std::vector<std::string> names;
  for (const ShippedScene& scene : shipped_scenes()) names.emplace_back(scene.name);
  return names;
}

}  // namespace

PYBIND11_MODULE(_core, m) {
  set_check_handler(throw_failed_check);
  py::register_exception<InputError>(m, "InputError", PyExc_ValueError);
  py::register_exception<OutputError>(m, "OutputError", PyExc_OSError);
  m.attr("version") = HALFSPACE_VERSION;
  m.attr("lanes") = kLanes;
  m.attr("arch") = build_arch();
  m.def("cores", &Workers::cores);
  m.def("scene_names", &scene_names);
  m.def("set_tool_folder", [](const std::string& folder) { set_tool_folder(folder); });
  bind_camera(m);
  bind_scene(m);
  bind_model(m);
  bind_image(m);
  bind_labels(m);
  bind_draw_state(m);
  bind_draw(m);
}

}  // namespace halfspace::python
