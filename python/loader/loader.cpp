// SPDX-License-Identifier: Apache-2.0
//
// The extension module halfspace._core. Loading code for an instruction set that the processor lacks would end the interpreter with an
// illegal instruction, because its static objects are initialized at once. This module is compiled for baseline x86-64. It checks the
// processor, opens the library with the bindings and returns the module that they create. In packages, the dynamic loader selects the
// library for the processor, as for the programs (apps/launcher/launcher.cpp).
#include <Python.h>
#include <dlfcn.h>

#include "halfspace/core/cpu.h"

PyMODINIT_FUNC PyInit__core() {
  const char* missing = halfspace::missing_cpu_features();
  if (missing[0] != '\0') return PyErr_Format(PyExc_ImportError, "halfspace: %s", missing);
  void* library = dlopen(HALFSPACE_LIBRARY, RTLD_NOW);
  void* init = library == nullptr ? nullptr : dlsym(library, "PyInit__core");
  if (init == nullptr) return PyErr_Format(PyExc_ImportError, "halfspace: %s; expected an installation with this library", dlerror());
  return reinterpret_cast<PyObject* (*)()>(init)();
}
