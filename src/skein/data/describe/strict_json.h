// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fmt/format.h>

#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "skein/base/result.h"

/// Reading JSON that other people wrote, strictly: every key is known and given once,
/// every number is within its bounds, and whatever is wrong is said with its place
/// (`[3].events[0].t_s`). Problems are collected.
///
/// Includes all of the JSON library: for source files only.
namespace skein::strict_json {

using Json = nlohmann::json;

/// What is wrong with a document; at most kMaxProblems are kept.
class Problems {
 public:
  static constexpr std::size_t kMaxProblems = 20;

  /// @param name  of the document, for messages.
  explicit Problems(std::string name) : name_(std::move(name)) {}

  void add(const std::string& path, const std::string& what);
  bool any() const { return count_ > 0; }
  bool full() const { return count_ >= kMaxProblems; }
  /// All of them in one error.
  Error error() const;

 private:
  std::string name_, first_place_, text_;
  std::size_t count_ = 0;
};

/// Watches a parser, of either kind of JSON, for what it would pass over in silence: a
/// key twice in one object, of which it keeps one, and nesting that is too deep.
template <class AnyJson>
class ParserWatch {
 public:
  /// @param max_nesting  of lists and objects in each other.
  explicit ParserWatch(int max_nesting = std::numeric_limits<int>::max())
      : max_nesting_(max_nesting) {}

  bool operator()(int depth, typename AnyJson::parse_event_t event, AnyJson& part) {
    using Event = typename AnyJson::parse_event_t;
    too_deep_ = too_deep_ || depth > max_nesting_;
    if (event == Event::object_start) open_.emplace_back();
    if (event == Event::object_end && !open_.empty()) open_.pop_back();
    if (event == Event::key && !open_.empty()) {
      auto key = part.template get<std::string>();
      if (!open_.back().insert(key).second && !twice_) twice_ = std::move(key);
    }
    return true;
  }

  /// What is wrong; empty when nothing is.
  std::string problem() const {
    constexpr std::size_t kShown = 60;
    if (too_deep_) return fmt::format("it nests more than {} deep.", max_nesting_);
    if (twice_)
      return fmt::format("the key \"{}\" stands twice in an object.",
                         twice_->substr(0, kShown));
    return {};
  }

 private:
  int max_nesting_;
  std::vector<std::set<std::string>> open_;  // keys of the objects around
  std::optional<std::string> twice_;
  bool too_deep_ = false;
};

/// The document; none when it is no JSON or a key stands twice in an object, which is
/// then among the problems.
std::optional<Json> parse(std::string_view text, Problems& problems);

/// A value in a document, and its path there.
class Value {
 public:
  Value(const Json& json, std::string path, Problems& problems)
      : json_(&json), path_(std::move(path)), problems_(&problems) {}

  const Json& json() const { return *json_; }
  const std::string& path() const { return path_; }
  void report(const std::string& what) const { problems_->add(path_, what); }

  /// Whether it is an object with all `required` keys and no other than those and the
  /// `optional` ones; reports what is wrong.
  bool is_object_of(std::initializer_list<std::string_view> required,
                    std::initializer_list<std::string_view> optional = {}) const;
  bool has(std::string_view key) const { return json_->contains(key); }
  /// The value of a key that is there.
  Value at(std::string_view key) const;

  /// The items of a list of at most `max_items`; reports when it is none.
  std::vector<Value> items(std::size_t max_items) const;

  /// A number within bounds; reports when it is none, and gives `low` then.
  double number(double low, double high) const;
  /// An integer within bounds; likewise.
  std::int64_t integer(std::int64_t low, std::int64_t high) const;
  /// A text of 1 to `max_bytes` bytes without control characters; likewise, empty.
  std::string text(std::size_t max_bytes) const;

 private:
  const Json* json_;
  std::string path_;
  Problems* problems_;
};

}  // namespace skein::strict_json
