// SPDX-License-Identifier: Apache-2.0
#include "fuzz/fuzz_model.h"
#include "halfspace/core/tool_folder.h"
#include "halfspace/model/gltf/read_gltf.h"

// Draco meshes are decoded by a separate program. Starting it would take most of the time, and it is not instrumented.
extern "C" int LLVMFuzzerInitialize(int*, char***) {
  halfspace::set_tool_folder("/no-such-folder");
  return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, std::size_t size) {
  return halfspace::fuzz_model(halfspace::read_gltf, "a.gltf", data, size);
}
