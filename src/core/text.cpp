// SPDX-License-Identifier: Apache-2.0
#include "halfspace/core/text.h"

#include <algorithm>
#include <vector>

namespace halfspace::inline HS_LANES_NAMESPACE {

bool has_word(std::string_view text, std::string_view word) {
  while (!text.empty()) {
    const std::size_t end = std::min(text.find(' '), text.size());
    if (text.substr(0, end) == word) return true;
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return false;
}

// Computes the optimal string alignment distance. Only three rows of the table of prefix distances are kept.
int edit_distance(std::string_view a, std::string_view b) {
  const std::size_t n = b.size();
  std::vector<int> before(n + 1), last(n + 1), row(n + 1);
  for (std::size_t j = 0; j <= n; ++j) row[j] = static_cast<int>(j);
  for (std::size_t i = 1; i <= a.size(); ++i) {
    before.swap(last);
    last.swap(row);
    row[0] = static_cast<int>(i);
    for (std::size_t j = 1; j <= n; ++j) {
      const int replaced = last[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
      row[j] = std::min({last[j] + 1, row[j - 1] + 1, replaced});
      const bool swapped = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
      if (swapped) row[j] = std::min(row[j], before[j - 2] + 1);
    }
  }
  return row[n];
}

std::string_view nearest_name(std::string_view wrong, std::span<const std::string_view> names) {
  if (wrong.size() > 64) return {};  // bounds the cost; no known name is that long
  std::string_view best;
  int best_distance = std::max(2, static_cast<int>(wrong.size()) / 3) + 1;
  for (const std::string_view name : names) {
    const int d = edit_distance(wrong, name);
    if (d < best_distance && d < static_cast<int>(name.size())) {
      best_distance = d;
      best = name;
    }
  }
  return best;
}

std::string suggestion(std::string_view wrong, std::span<const std::string_view> names) {
  if (const std::string_view name = nearest_name(wrong, names); !name.empty()) return "; did you mean '" + std::string(name) + "'?";
  std::string text = names.size() == 1 ? "; expected " : "; expected one of ";
  for (std::size_t i = 0; i < names.size(); ++i) text += (i == 0 ? "" : ", ") + std::string(names[i]);
  return text;
}

}  // namespace halfspace::inline HS_LANES_NAMESPACE
