// SPDX-License-Identifier: Apache-2.0
#include "skein/assemble/relay/relay_order.h"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "skein/assemble/relay/relay_fields.h"
#include "skein/scenario/document.h"
#include "skein/scenario/numbers.h"
#include "skein/scenario/text.h"

namespace skein::assemble {
namespace {

using impairment::Directions;
using impairment::ImpairmentChange;

constexpr double kMaxOutage = 86'400;  // [s]
constexpr const char* kForms =
    "Known: KEY VALUE [to-a|to-b] with a key of a profile, outage SECONDS [to-a|to-b], "
    "reset, stats.";

Error bad_order(std::string message) {
  return {ErrorCode::kBadInput, "", std::move(message), kForms};
}

std::vector<std::string_view> words_of(std::string_view line) {
  constexpr std::string_view kBlank = " \t\r";
  std::vector<std::string_view> words;
  while (true) {
    const std::size_t begin = line.find_first_not_of(kBlank);
    if (begin == std::string_view::npos) return words;
    line.remove_prefix(begin);
    const std::size_t end = std::min(line.find_first_of(kBlank), line.size());
    words.push_back(line.substr(0, end));
    line.remove_prefix(end);
  }
}

// Whether a word is a plain one: a key, a number or the like, nothing that means more.
bool is_plain(std::string_view word) {
  return std::all_of(word.begin(), word.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
           c == '_' || c == '.' || c == '+' || c == '-';
  });
}

const scenario::Document& order_document() {
  static const scenario::Document document = [] {
    scenario::Fields<ImpairmentChange> fields;
    add_impairment_keys<ImpairmentChange>(fields, [](auto member) { return member; });
    return scenario::Document{fields.description(), "an order", "",
                              "nothing is changed", "",         ""};
  }();
  return document;
}

Result<ImpairmentChange> read_change(std::string_view key, std::string_view value) {
  ImpairmentChange change;
  const auto reading =
      scenario::read_document_text(fmt::format("{}: {}", key, value), "order", {},
                                   order_document(), scenario::KindTable{}, {}, &change);
  if (reading.ok()) return change;
  const scenario::Problem& first = reading.problems.front();
  return Error{ErrorCode::kBadInput, first.key, first.message, first.hint};
}

}  // namespace

Result<RelayOrder> parse_relay_order(std::string_view line) {
  const std::vector<std::string_view> words = words_of(line);
  RelayOrder order;
  if (words.empty()) return bad_order("the line is empty.");
  const std::string_view what = words[0];
  if (what == "reset" || what == "stats") {
    if (words.size() > 1) return bad_order(fmt::format("{} stands alone.", what));
    if (what == "reset") order.kind = RelayOrder::Kind::kReset;
    return order;
  }
  if (words.size() < 2 || words.size() > 3)
    return bad_order(
        fmt::format("{} needs a value, and a direction at most.", scenario::quote(what)));
  for (const std::string_view word : words)
    if (!is_plain(word))
      return bad_order(
          fmt::format("{} is neither key nor value.", scenario::quote(word)));
  if (words.size() == 3) {
    if (words[2] != "to-a" && words[2] != "to-b")
      return bad_order(fmt::format("{} is no direction.", scenario::quote(words[2])));
    order.directions = words[2] == "to-a" ? Directions::kToA : Directions::kToB;
  }
  if (what == "outage") {
    const auto seconds = scenario::parse_number(words[1]);
    if (!seconds || !(*seconds >= 0 && *seconds <= kMaxOutage))
      return Error{ErrorCode::kBadInput, "outage",
                   fmt::format("found {}; needs a number of seconds from 0 to {}.",
                               scenario::quote(words[1]), kMaxOutage),
                   ""};
    order.kind = RelayOrder::Kind::kOutage;
    order.length = Time::from_seconds(*seconds);
    return order;
  }
  auto change = read_change(what, words[1]);
  if (!change) return change.error();
  order.kind = RelayOrder::Kind::kChange;
  order.change = change.value();
  return order;
}

}  // namespace skein::assemble
