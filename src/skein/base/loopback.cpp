// SPDX-License-Identifier: Apache-2.0
#include "skein/base/loopback.h"

#include <arpa/inet.h>

#include <algorithm>
#include <cstdint>
#include <string>

namespace skein {
namespace {

bool is_localhost(std::string_view name) {
  constexpr std::string_view kName = "localhost";
  if (name.ends_with('.')) name.remove_suffix(1);
  return std::equal(
      name.begin(), name.end(), kName.begin(), kName.end(),
      [](char a, char b) { return (a >= 'A' && a <= 'Z' ? a - 'A' + 'a' : a) == b; });
}

bool is_loopback_v4(std::uint32_t address) {  // in the order of this machine
  return address >> 24 == 127;
}

}  // namespace

bool is_loopback(std::string_view host) {
  if (is_localhost(host)) return true;
  const bool in_brackets = host.starts_with('[') && host.ends_with(']');
  if (in_brackets) host = host.substr(1, host.size() - 2);
  const std::string text(host);
  in6_addr v6{};
  if (::inet_pton(AF_INET6, text.c_str(), &v6) == 1) {
    if (IN6_IS_ADDR_LOOPBACK(&v6)) return true;
    return IN6_IS_ADDR_V4MAPPED(&v6) && v6.s6_addr[12] == 127;
  }
  // As the resolver reads it: 127.1 too. It would pass over what follows a blank.
  in_addr v4{};
  return !in_brackets && text.find_first_not_of("0123456789.") == std::string::npos &&
         ::inet_aton(text.c_str(), &v4) != 0 && is_loopback_v4(ntohl(v4.s_addr));
}

}  // namespace skein
