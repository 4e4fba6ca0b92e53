// SPDX-License-Identifier: MIT
// Growing columns, appended to one row at a time. Internal.
#pragma once

#include <vector>

namespace sunder {

/// Appends a row. A full column grows by an eighth, where std::vector would double. A column of a
/// shattered body is then at most an eighth too large. The price is some eight copies of each row
/// in all (a few ns per row).
template <class T>
void append_row(std::vector<T>& column, T value) {
  if (column.size() == column.capacity()) column.reserve(column.size() + column.size() / 8 + 8);
  column.push_back(value);
}

}  // namespace sunder
