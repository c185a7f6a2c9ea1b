// SPDX-License-Identifier: Apache-2.0
//
// Starts the programs of a package. The launcher runs on any x86-64 processor and opens a shared library that contains the program. The
// dynamic loader selects the library for the processor from the subfolders glibc-hwcaps/x86-64-v3 and glibc-hwcaps/x86-64-v4 of the library
// folder, which is in the RUNPATH of the launcher (cmake/program.cmake). start_check.cpp is also linked; it exits with an error if the
// processor cannot run the library for x86-64-v3.
#include <dlfcn.h>
#include <stdio.h>

int main(int argc, char** argv) {
  void* library = dlopen(HALFSPACE_LIBRARY, RTLD_NOW);
  void* run = library == nullptr ? nullptr : dlsym(library, HALFSPACE_FUNCTION);
  if (run == nullptr) {
    fprintf(stderr, "halfspace: %s; expected an installation with this library\n", dlerror());
    return 1;
  }
  return reinterpret_cast<int (*)(int, char**)>(run)(argc, argv);
}
