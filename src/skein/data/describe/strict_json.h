// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <initializer_list>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "skein/base/result.h"

/// Reading JSON that other people wrote, strictly: every key is known and given once,
/// every number is within its bounds, and whatever is wrong is said with its place
/// (`[3].events[0].t_s`). Problems are collected.
///
/// Includes all of the JSON library: for source files only.
namespace skein::strict_json {

using Json = nlohmann::ordered_json;  // objects keep the order of the text

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

constexpr int kMaxNesting = 64;  ///< of lists and objects in each other

/// The document; none, and a problem, when it is no JSON, nests more than kMaxNesting
/// deep, or has a key twice in an object.
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
  /// The path of a key, whether it is there or not.
  std::string path_of(std::string_view key) const;
  Problems& problems() const { return *problems_; }

  /// The items of a list of at most `max_items`; reports when it is none.
  std::vector<Value> items(std::size_t max_items) const;

  /// A number within bounds; reports when it is none, and gives `low` then.
  double number(double low, double high) const;
  /// An integer within bounds, 2.0 too; likewise.
  std::int64_t integer(std::int64_t low, std::int64_t high) const;
  /// A text of 1 to `max_bytes` bytes without control characters; likewise, empty.
  std::string text(std::size_t max_bytes) const;

 private:
  const Json* json_;
  std::string path_;
  Problems* problems_;
};

/// Takes the fields of one object. What is missing, of another type or out of its range
/// is a problem, and the value then is harmless; so is, at the end, a key that nobody
/// asked for.
class Fields {
 public:
  explicit Fields(const Value& object);
  ~Fields();
  Fields(const Fields&) = delete;
  Fields& operator=(const Fields&) = delete;

  bool has(std::string_view key);
  /// A number within [min, max]; without it `otherwise`, where that is given.
  double number(std::string_view key, double min, double max,
                std::optional<double> otherwise = {});
  /// A whole number within [min, max].
  std::int64_t whole(std::string_view key, std::int64_t min, std::int64_t max);
  bool flag(std::string_view key, bool otherwise);
  /// A text that is not empty; without it `otherwise`, where that is given.
  std::string text(std::string_view key,
                   const std::optional<std::string>& otherwise = {});
  /// The index of one of `words`.
  std::size_t word(std::string_view key, const std::vector<std::string>& words,
                   std::optional<std::size_t> otherwise = {});
  /// The value of a key; none, and a problem unless it is optional, where it is missing.
  std::optional<Value> value(std::string_view key, bool optional = false);
  /// The items of a list; none where it is missing.
  std::vector<Value> items(std::string_view key, std::size_t max_items,
                           bool optional = false);
  /// The keys of an object that is the value of a key, with their values.
  std::vector<std::pair<std::string, Value>> members(std::string_view key,
                                                     std::size_t max_members);
  void problem(std::string_view key, const std::string& message);

 private:
  Value object_;
  std::vector<std::string> requested_;
};

}  // namespace skein::strict_json
