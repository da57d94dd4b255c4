#include "base/result.h"

namespace skein {

std::string Error::text() const {
  std::string text = place.empty() ? message : place + ": " + message;
  if (!hint.empty()) text += " " + hint;
  return text;
}

}  // namespace skein
