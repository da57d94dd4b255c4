// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/hmi/serve/access.h"

#include <fmt/format.h>

#include <algorithm>

#include "skein/base/loopback.h"
#include "skein/base/shown_text.h"
#include "skein/base/valid_text.h"

namespace skein::hmi {
namespace {

constexpr std::size_t kMinTokenLength = 16;
constexpr std::string_view kCookie = "skein_token";
constexpr std::string_view kBlanks = " \t\r";

bool may_be_in_token(char c) {
  return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') ||
         c == '-' || c == '_';
}

// Takes the first word off a line.
std::string_view take_word(std::string_view& line) {
  line.remove_prefix(std::min(line.find_first_not_of(kBlanks), line.size()));
  const std::size_t end = std::min(line.find_first_of(kBlanks), line.size());
  const std::string_view word = line.substr(0, end);
  line.remove_prefix(end);
  return word;
}

std::string_view trimmed(std::string_view text) {
  text.remove_prefix(std::min(text.find_first_not_of(kBlanks), text.size()));
  return text.substr(0, text.find_last_not_of(kBlanks) + 1);
}

std::optional<AccessRole> role_of(std::string_view word) {
  const auto names = names_of(static_cast<const AccessRole*>(nullptr));
  for (std::size_t k = 0; k < names.size(); ++k)
    if (names[k] == word) return static_cast<AccessRole>(k);
  return std::nullopt;
}

// Without a look at where the first difference is.
bool is_equal(std::string_view a, std::string_view b) {
  if (a.size() != b.size()) return false;
  unsigned difference = 0;
  for (std::size_t k = 0; k < a.size(); ++k)
    difference |= static_cast<unsigned>(static_cast<unsigned char>(a[k])) ^
                  static_cast<unsigned>(static_cast<unsigned char>(b[k]));
  return difference == 0;
}

}  // namespace

Result<AccessTable> AccessTable::parse(std::string_view text, const std::string& place) {
  AccessTable table;
  std::size_t number = 0;
  while (!text.empty()) {
    std::string_view line = text.substr(0, text.find('\n'));
    text.remove_prefix(std::min(line.size() + 1, text.size()));
    ++number;
    const std::string where = fmt::format("{}:{}", place, number);
    const std::string_view token = take_word(line);
    if (token.empty() || token.front() == '#') continue;
    if (token.size() < kMinTokenLength || !std::ranges::all_of(token, may_be_in_token))
      return Error{ErrorCode::kBadInput, where,
                   "a token has 16 characters at least, of letters, digits, - and _.",
                   "Make one with: openssl rand -hex 16"};
    const std::string_view word = take_word(line);
    const auto role = role_of(word);
    if (!role)
      return Error{ErrorCode::kBadInput, where,
                   fmt::format("\"{}\" is no role: viewer, operator or instructor.",
                               shown(std::string(word))),
                   ""};
    if (table.find(token))
      return Error{ErrorCode::kBadInput, where, "this token is there twice.", ""};
    table.tokens_.push_back({std::string(token), {*role, valid_text(trimmed(line))}});
  }
  if (table.tokens_.empty())
    return Error{ErrorCode::kBadInput, place, "there is no token in it.",
                 "One a line: TOKEN ROLE [NAME]"};
  return table;
}

std::optional<Access> AccessTable::find(std::string_view token) const {
  std::optional<Access> found;
  for (const Entry& entry : tokens_)
    if (is_equal(entry.token, token)) found = entry.access;
  return found;
}

std::string_view token_in_cookies(std::string_view cookies) {
  while (!cookies.empty()) {
    const std::string_view cookie = trimmed(cookies.substr(0, cookies.find(';')));
    const std::size_t equals = cookie.find('=');
    if (equals != std::string_view::npos && cookie.substr(0, equals) == kCookie)
      return cookie.substr(equals + 1);
    const std::size_t end = cookies.find(';');
    if (end == std::string_view::npos) break;
    cookies.remove_prefix(end + 1);
  }
  return {};
}

std::string token_cookie(std::string_view token, bool secure) {
  return fmt::format("{}={}; Path=/; HttpOnly; SameSite=Strict{}", kCookie, token,
                     secure ? "; Secure" : "");
}

bool is_same_name(std::string_view a, std::string_view b) {
  const auto lower = [](char c) {
    return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  };
  return std::ranges::equal(a, b, {}, lower, lower);
}

std::optional<std::string_view> bearer_token(std::string_view authorization) {
  std::string_view rest = authorization;
  if (!is_same_name(take_word(rest), "Bearer")) return std::nullopt;
  return trimmed(rest);
}

bool comes_from_elsewhere(const RequestSource& source, bool is_page) {
  if (!is_same_origin(source.origin, source.host)) return true;
  const bool is_own = source.fetch_site.empty() || source.fetch_site == "same-origin" ||
                      source.fetch_site == "none";
  return !is_own && !(is_page && source.fetch_mode == "navigate");
}

bool is_same_origin(std::string_view origin, std::string_view host) {
  if (origin.empty()) return true;
  const std::size_t scheme = origin.find("://");
  return scheme != std::string_view::npos && origin.substr(scheme + 3) == host;
}

std::string_view name_in_host(std::string_view host) {
  if (!host.starts_with('[')) return host.substr(0, host.find(':'));
  const std::size_t end = host.find(']');
  return end == std::string_view::npos ? std::string_view() : host.substr(1, end - 1);
}

bool names_this_machine(std::string_view host) {
  return is_loopback(name_in_host(host));
}

bool is_address(std::string_view host) {
  const std::string_view name = name_in_host(host);
  if (name.empty()) return false;
  if (host.starts_with('['))
    return name.find_first_not_of("0123456789abcdefABCDEF:.") == std::string_view::npos;
  return name.find_first_not_of("0123456789.") == std::string_view::npos;
}

}  // namespace skein::hmi
