// SPDX-License-Identifier: MIT
// Findings of the last creation of an engine, without memory of their own.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string_view>

#include "apps/host/sunder.h"
#include "topology/base/finding.hpp"

namespace sunder {

/// Copies as much of a struct as the caller has room for. `target` may be null.
template <class T>
void give(T* target, T source) {
  if (target == nullptr) return;
  const std::uint32_t size = std::min<std::uint32_t>(target->size, sizeof(T));
  source.size = target->size;
  std::memcpy(target, &source, size);
}

/// A finding as C sees it. The texts are the finding's own.
inline sunder_finding finding_of(const Finding& f) {
  return {.size = sizeof(sunder_finding),
          .severity = static_cast<std::uint32_t>(f.severity),
          .code = f.code.c_str(),
          .text = f.text.c_str(),
          .remedy = f.remedy.c_str(),
          .file = f.file.c_str(),
          .line = f.line,
          .count = f.count,
          .ids = f.ids.data(),
          .id_count = f.ids.size()};
}

/// The findings of a creation, one set per thread. The room is fixed, because a thread asks for
/// memory at the first use of an object with a destructor, and ends the process without memory.
/// Findings beyond the room are left out.
class CreationError {
 public:
  /// `lines`: the same findings as text.
  void say(std::string_view lines, std::span<const Finding> findings) {
    count_ = used_ = 0;
    keep_lines(lines);
    for (const Finding& f : findings) keep(f);
  }
  const char* lines() const { return lines_; }
  std::span<const sunder_finding> findings() const { return {rows_.data(), count_}; }

 private:
  void keep_lines(std::string_view words) {
    constexpr std::string_view more = "there is more\n";
    if (words.size() >= sizeof lines_) {
      words = words.substr(0, sizeof lines_ - 1 - more.size());
      words = words.substr(0, words.rfind('\n') + 1);
      std::memcpy(lines_ + words.size(), more.data(), more.size() + 1);
    } else {
      lines_[words.size()] = 0;
    }
    std::memcpy(lines_, words.data(), words.size());
  }
  void keep(const Finding& f) {
    const std::size_t room = f.code.size() + f.text.size() + f.remedy.size() + f.file.size() + 4;
    if (count_ == rows_.size() || used_ + room > sizeof texts_) return;
    sunder_finding& row = rows_[count_] = finding_of(f);
    for (const char** text : {&row.code, &row.text, &row.remedy, &row.file}) {
      const std::size_t size = std::strlen(*text) + 1;
      std::memcpy(texts_ + used_, *text, size);
      *text = texts_ + used_;
      used_ += size;
    }
    row.id_count = std::min(f.ids.size(), Finding::max_ids);
    std::copy_n(f.ids.begin(), row.id_count, ids_[count_].begin());
    row.ids = ids_[count_].data();
    ++count_;
  }

  char lines_[1 << 14] = {};
  char texts_[1 << 14] = {};
  std::array<sunder_finding, 64> rows_{};
  std::array<std::array<std::int64_t, Finding::max_ids>, 64> ids_{};
  std::size_t count_ = 0, used_ = 0;
};

}  // namespace sunder
