// SPDX-License-Identifier: Apache-2.0
//
// The extension module halfspace._core.
#include <exception>
#include <new>
#include <stdexcept>

#include "bindings.h"
#include "halfspace/core/cpu.h"
#include "halfspace/core/lanes.h"
#include "halfspace/core/parallel.h"
#include "halfspace/core/tool_folder.h"
#include "halfspace/scene/scene_file.h"
#include "memory.h"
#include "messages.h"

namespace halfspace::python {

namespace {

[[noreturn]] void throw_failed_check(const CheckFailure& failure) { throw std::logic_error(failure.message); }

std::vector<std::string> scene_names() {
  std::vector<std::string> names;
  for (const ShippedScene& scene : shipped_scenes()) names.emplace_back(scene.name);
  return names;
}

PyObject* input_error = nullptr;  // the type of the Python exception

// Called before the translator of register_exception(), because it is registered later.
void translate_input_error(std::exception_ptr raised) {
  try {
    if (raised) std::rethrow_exception(raised);
  } catch (const InputError& e) {
    PyErr_SetString(input_error, in_python_terms(e.what()).c_str());
  }
}

void translate_bad_alloc(std::exception_ptr raised) {
  try {
    if (raised) std::rethrow_exception(raised);
  } catch (const MemoryShortage& e) {
    PyErr_SetString(PyExc_MemoryError, e.what());
  } catch (const std::bad_alloc&) {
    PyErr_SetString(PyExc_MemoryError, allocation_problem().c_str());
  }
}

}  // namespace

PYBIND11_MODULE(_core, m) {
  set_check_handler(throw_failed_check);
  input_error = py::register_exception<InputError>(m, "InputError", PyExc_ValueError).ptr();
  py::register_exception_translator(translate_input_error);
  py::register_exception_translator(translate_bad_alloc);
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
  bind_model_file(m);
  bind_shapes(m);
  bind_image(m);
  bind_files(m);
  bind_labels(m);
  bind_draw_state(m);
  bind_draw(m);
}

}  // namespace halfspace::python
