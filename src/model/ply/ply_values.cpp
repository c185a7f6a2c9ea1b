// SPDX-License-Identifier: Apache-2.0
#include "halfspace/model/ply/ply_values.h"

#include <fmt/format.h>

#include "halfspace/core/check.h"
#include "halfspace/model/text/parse_number.h"
#include "halfspace/model/text/text_lines.h"

namespace halfspace::HS_LANES {

namespace {

bool is_space(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

}  // namespace

double PlyValues::ascii_number() {
  while (at_ != end_ && is_space(*at_)) ++at_;
  const char* const begin = at_;
  while (at_ != end_ && !is_space(*at_)) ++at_;
  const std::string_view word(begin, static_cast<std::size_t>(at_ - begin));
  if (word.empty()) fail_at_end();
  const std::optional<double> value = parse_number(word);
  if (!value) fail(fmt::format("{} is not a number; expected a number", in_quotes(word)));
  return *value;
}

void PlyValues::fail(const std::string& what) const {
  throw InputError(fmt::format("{}: element {}, row {}: {}", file_, in_quotes(element_->name), row_, what));
}

void PlyValues::fail_at_end() const { fail(fmt::format("the file ends here; expected {} rows of this element", element_->count)); }

void PlyValues::fail_length(const PlyProperty& list, double length, std::size_t max_length) const {
  fail(fmt::format("a list {} of length {}; expected 0 to {}, the most that the rest of the file can hold", in_quotes(list.name), length,
                   max_length));
}

}  // namespace halfspace::HS_LANES
