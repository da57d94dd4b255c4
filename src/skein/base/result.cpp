// SPDX-License-Identifier: Apache-2.0
#include "skein/base/result.h"

namespace skein {

std::string Error::text() const {
  std::string text = place.empty() ? message : place + ": " + message;
  if (hint.empty()) return text;
  const bool ended = !text.empty() && (text.back() == '.' || text.back() == '?' ||
                                       text.back() == '!' || text.back() == '\n');
  if (ended) return text + " " + hint;
  // A message that is no sentence yet: the hint begins one.
  const bool lower = hint[0] >= 'a' && hint[0] <= 'z';
  return text + (lower ? "; " : ". ") + hint;
}

Error internal_error(const std::string& what) {
  return {ErrorCode::kInternal, "internal error", what,
          "This is a bug in Skein, please report it."};
}

}  // namespace skein
