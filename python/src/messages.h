// SPDX-License-Identifier: Apache-2.0
//
// Messages of the library mention options of the command line. Python has arguments instead.
#pragma once

#include <string>

namespace halfspace::python {

/// Returns a message of the library with the names of Python's arguments in place of options of the command line. Options without an
/// equivalent argument are omitted.
std::string in_python_terms(std::string message);

}  // namespace halfspace::python
