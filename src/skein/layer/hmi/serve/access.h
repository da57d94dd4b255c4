// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "skein/base/result.h"
#include "skein/data/event/live.h"

namespace skein::hmi {

/// Who asks, as far as the server knows.
struct Access {
  AccessRole role = AccessRole::kViewer;
  std::string name;  ///< for people; empty: none was given
};

/// Who may see and steer a run. Without tokens everybody may do everything: for a server
/// that only this machine reaches.
class AccessTable {
 public:
  AccessTable() = default;

  /// Reads lines `TOKEN ROLE [NAME]`; empty ones and those that begin with # are passed
  /// over.
  /// @param place  of the text, for errors.
  /// Fails: kBadInput for an unknown role, a token of less than 16 or other characters
  /// than letters, digits, - and _, one that is there twice, and when there is none.
  static Result<AccessTable> parse(std::string_view text, const std::string& place);

  bool is_open() const { return tokens_.empty(); }

  /// Who has this token; nothing: nobody. Takes as long for a wrong token as for a right
  /// one.
  std::optional<Access> find(std::string_view token) const;

 private:
  struct Entry {
    std::string token;
    Access access;
  };
  std::vector<Entry> tokens_;
};

/// The token among the cookies of a request; empty: none.
std::string_view token_in_cookies(std::string_view cookies);

/// The header with which a browser keeps a token for this server alone, out of the reach
/// of scripts.
/// @param secure  it is only sent over TLS.
std::string token_cookie(std::string_view token, bool secure);

/// The token of an Authorization header; nothing: it has another scheme. That may be
/// written in any case (RFC 9110, 11.1).
std::optional<std::string_view> bearer_token(std::string_view authorization);

/// Whether a browser's page of this server asks: its origin is the host that it asks.
/// Without an origin no browser asks.
bool is_same_origin(std::string_view origin, std::string_view host);

/// What a browser says of where a request comes from; empty: it says nothing.
struct RequestSource {
  std::string_view origin;      ///< Origin
  std::string_view host;        ///< Host
  std::string_view fetch_site;  ///< Sec-Fetch-Site
  std::string_view fetch_mode;  ///< Sec-Fetch-Mode
};

/// Whether a page of another server asks, or a file of the disk, also when it only wants
/// to look. A link elsewhere that leads here does not count where it leads to the page,
/// which asks for everything itself.
/// @param is_page  the request is for a file of the page, which holds nothing of a run.
/// Reference: Fetch Metadata Request Headers, W3C.
bool comes_from_elsewhere(const RequestSource& source, bool is_page);

/// Whether a request's host is this machine by one of the names that only it has
/// ("localhost:8080", "127.0.0.1", "[::1]:80"): a page of elsewhere that has its own name
/// lead here is told by that.
bool names_this_machine(std::string_view host);

/// The name in a Host header, without its port and the brackets of an IPv6 address.
std::string_view name_in_host(std::string_view host);

/// Whether a Host header has a number for a name, which nobody can have lead elsewhere.
bool is_address(std::string_view host);

/// Whether two names of machines are the same: case does not count.
bool is_same_name(std::string_view a, std::string_view b);

}  // namespace skein::hmi
