#include "skein/layer/hmi/serve/access.h"

#include <fmt/format.h>

#include <algorithm>

#include "skein/base/shown_text.h"

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
    table.tokens_.push_back({std::string(token), {*role, std::string(trimmed(line))}});
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

bool is_same_origin(std::string_view origin, std::string_view host) {
  if (origin.empty()) return true;
  const std::size_t scheme = origin.find("://");
  return scheme != std::string_view::npos && origin.substr(scheme + 3) == host;
}

bool names_this_machine(std::string_view host) {
  const bool is_v6 = !host.empty() && host.front() == '[';
  const std::size_t end = is_v6 ? host.find(']') : std::min(host.find(':'), host.size());
  if (end == std::string_view::npos) return false;
  const std::string_view name = host.substr(0, end + (is_v6 ? 1 : 0));
  if (name == "localhost" || name == "[::1]") return true;
  return name.substr(0, 4) == "127." &&
         name.find_first_not_of("0123456789.") == std::string_view::npos;
}

}  // namespace skein::hmi
