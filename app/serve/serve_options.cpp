// SPDX-License-Identifier: Apache-2.0
#include "app/serve/serve_options.h"

#include <charconv>

namespace skein::serve {

Result<void> read_place(const std::string& text, ServeOptions& options) {
  const Error bad{ErrorCode::kBadInput, text,
                  "it is no place for a page: a port, or ADDRESS:PORT.",
                  "For instance 8080, 0.0.0.0:8080 or [::1]:8080."};
  const std::size_t colon = text.rfind(':');
  const std::string port = colon == std::string::npos ? text : text.substr(colon + 1);
  const auto [end, error] =
      std::from_chars(port.data(), port.data() + port.size(), options.port);
  if (port.empty() || error != std::errc() || end != port.data() + port.size())
    return bad;
  if (colon == std::string::npos) return {};
  options.address = text.substr(0, colon);
  if (options.address.empty()) return bad;
  if (options.address.front() == '[') {
    if (options.address.back() != ']') return bad;
    options.address = options.address.substr(1, options.address.size() - 2);
  }
  return {};
}

}  // namespace skein::serve
