// SPDX-License-Identifier: MIT
// Growing columns whose rows come one at a time. Internal.
#pragma once

#include <vector>

namespace sunder {

/// Appends a row; a full column grows by an eighth, where std::vector would double: a column of a
/// shattered body is then at most an eighth too large, for some eight copies of each row on the
/// way (a few ns a row).
template <class T>
void append_row(std::vector<T>& column, T value) {
  if (column.size() == column.capacity()) column.reserve(column.size() + column.size() / 8 + 8);
  column.push_back(value);
}

}  // namespace sunder
