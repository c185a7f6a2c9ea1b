// SPDX-License-Identifier: Apache-2.0
#include "fuzz/fuzz_model.h"
#include "halfspace/model/obj/read_obj.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, std::size_t size) {
  return halfspace::fuzz_model(halfspace::read_obj, "a.obj", data, size);
}
