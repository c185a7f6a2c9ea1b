// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace halfspace {

/// Encodes the picture that standard input brings and writes the answer (see protocol.h) to standard output.
void write_and_answer(const std::string& format);

}  // namespace halfspace
