// SPDX-License-Identifier: Apache-2.0
//
// Quotes of source code. The source files are embedded in the library when it is built, so quotes always match the code that runs.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "halfspace/core/namespace.h"

namespace halfspace {

/// A source file of the library, for example "src/raster/primitives/bin.cpp", or a part of the page.
struct EmbeddedFile {
  std::string_view name, text;
};
/// Written by cmake/embed_page.cmake.
std::span<const EmbeddedFile> embedded_files();
/// Returns the text of a file. It must exist.
std::string_view embedded_text(std::string_view name);

/// Lines of a source file: from the first line that contains `from` to the first line at or after it that contains `to`.
struct QuoteRange {
  std::string_view chapter, file, from, to;
};
std::span<const QuoteRange> quote_ranges();

struct Quote {
  std::string file;
  int line = 0;  ///< of the first line, from 1; 0: not found
  std::string text;
};
/// Returns the lines, without their common indentation.
Quote quote(const QuoteRange& range);

}  // namespace halfspace
