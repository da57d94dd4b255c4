// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "skein/base/result.h"

/// JSON of which nothing is passed over in silence. Includes all of the JSON library: for
/// source files only.
namespace skein::exchange {

using StrictJson = nlohmann::json;

/// What is wrong with a document, in the order in which it was found.
class JsonProblems {
 public:
  void add(std::string place, std::string message);
  bool none() const { return count_ == 0; }
  /// The first of them, with how many more there are.
  Error error() const;

 private:
  Error first_;
  std::size_t count_ = 0;
};

/// Parses a document. Fails: kBadInput for what is no JSON, nests more than 64 deep, or
/// has a key twice in one object.
Result<StrictJson> parse_strictly(std::string_view text, const std::string& place);

/// Takes the fields of one object. What is missing, of another type or out of its range
/// is a problem, and the value then is harmless; so is, at the end, a key that nobody
/// asked for.
class JsonFields {
 public:
  JsonFields(const StrictJson& object, std::string place, JsonProblems& problems);
  ~JsonFields();
  JsonFields(const JsonFields&) = delete;
  JsonFields& operator=(const JsonFields&) = delete;

  const std::string& place() const { return place_; }
  bool has(const char* key);
  /// A number within [min, max]; without it `otherwise`, where that is given.
  double number(const char* key, double min, double max,
                std::optional<double> otherwise = {});
  /// A whole number within [min, max].
  std::int64_t whole(const char* key, std::int64_t min, std::int64_t max);
  bool flag(const char* key, bool otherwise);
  std::string text(const char* key, const std::optional<std::string>& otherwise = {});
  /// The index of one of `words`.
  std::size_t word(const char* key, const std::vector<std::string>& words,
                   std::optional<std::size_t> otherwise = {});
  /// The value of a list or an object; nullptr: a problem, or missing where allowed.
  const StrictJson* list(const char* key, bool optional = false);
  const StrictJson* object(const char* key);
  void problem(const char* key, std::string message);

 private:
  const StrictJson* find(const char* key, bool optional);

  const StrictJson& object_;
  std::string place_;
  JsonProblems& problems_;
  std::set<std::string> asked_;
};

}  // namespace skein::exchange
