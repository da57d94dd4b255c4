// SPDX-License-Identifier: Apache-2.0
#include "skein/data/describe/strict_json.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <set>

namespace skein::strict_json {
namespace {

constexpr std::size_t kMaxShown = 60;  // characters of a text from outside in a message

std::string shortened(std::string_view text) {
  return text.size() <= kMaxShown ? std::string(text)
                                  : std::string(text.substr(0, kMaxShown)) + "...";
}

// Sees what the parser would pass over in silence: a key twice in one object, of which it
// keeps one, and nesting that is too deep.
class ParserWatch {
 public:
  bool operator()(int depth, Json::parse_event_t event, Json& part) {
    using Event = Json::parse_event_t;
    too_deep_ = too_deep_ || depth > kMaxNesting;
    if (event == Event::object_start) open_.emplace_back();
    if (event == Event::object_end && !open_.empty()) open_.pop_back();
    if (event == Event::key && !open_.empty()) {
      auto key = part.get<std::string>();
      if (!open_.back().insert(key).second && !twice_) twice_ = std::move(key);
    }
    return !too_deep_;
  }

  // What is wrong; empty when nothing is.
  std::string problem() const {
    if (too_deep_) return fmt::format("it nests more than {} deep.", kMaxNesting);
    if (twice_)
      return fmt::format("the key \"{}\" stands twice in an object.", shortened(*twice_));
    return {};
  }

 private:
  std::vector<std::set<std::string>> open_;  // keys of the objects around
  std::optional<std::string> twice_;
  bool too_deep_ = false;
};

}  // namespace

void Problems::add(const std::string& path, const std::string& what) {
  if (count_++ >= kMaxProblems) return;
  if (count_ == 1) first_place_ = path.empty() ? name_ : name_ + ": " + path;
  if (count_ == 1)
    text_ = what;
  else
    text_ += fmt::format("\n{}{}: {}", name_, path.empty() ? "" : ": " + path, what);
}

Error Problems::error() const {
  std::string hint;
  if (count_ > kMaxProblems)
    hint = fmt::format("And {} more problems.", count_ - kMaxProblems);
  return {ErrorCode::kBadInput, first_place_, text_, hint};
}

std::optional<Json> parse(std::string_view text, Problems& problems) {
  ParserWatch watch;
  try {
    Json json = Json::parse(text, std::ref(watch));
    const std::string problem = watch.problem();
    if (problem.empty()) return json;
    problems.add("", problem);
  } catch (const Json::exception& error) {
    problems.add("", fmt::format("it is no JSON: {}", shortened(error.what())));
  }
  return std::nullopt;
}

bool Value::is_object_of(std::initializer_list<std::string_view> required,
                         std::initializer_list<std::string_view> optional) const {
  if (!json_->is_object()) {
    report("must be an object.");
    return false;
  }
  bool good = true;
  for (const std::string_view key : required)
    if (!json_->contains(key)) {
      report(fmt::format("lacks the key \"{}\".", key));
      good = false;
    }
  for (const auto& item : json_->items()) {
    const std::string_view key = item.key();
    if (std::ranges::find(required, key) == required.end() &&
        std::ranges::find(optional, key) == optional.end()) {
      report(fmt::format("has an unknown key \"{}\".", key));
      good = false;
    }
  }
  return good;
}

Value Value::at(std::string_view key) const {
  return {json_->at(std::string(key)), path_of(key), *problems_};
}

std::string Value::path_of(std::string_view key) const {
  return path_.empty() ? shortened(key) : fmt::format("{}.{}", path_, shortened(key));
}

std::vector<Value> Value::items(std::size_t max_items) const {
  std::vector<Value> all;
  if (!json_->is_array() || json_->size() > max_items) {
    report(fmt::format("must be a list of at most {} items.", max_items));
    return all;
  }
  all.reserve(json_->size());
  for (std::size_t i = 0; i < json_->size(); ++i)
    all.emplace_back((*json_)[i], fmt::format("{}[{}]", path_, i), *problems_);
  return all;
}

double Value::number(double low, double high) const {
  if (json_->is_number()) {
    const double value = json_->get<double>();
    if (value >= low && value <= high) return value;
  }
  report(fmt::format("must be a number from {:g} to {:g}.", low, high));
  return low;
}

std::int64_t Value::integer(std::int64_t low, std::int64_t high) const {
  const bool fits =
      json_->is_number_unsigned()
          ? json_->get<std::uint64_t>() <= static_cast<std::uint64_t>(INT64_MAX)
          : json_->is_number_integer();
  constexpr double kMaxExact = 9007199254740992;  // 2^53
  const bool is_whole_float = json_->is_number_float() &&
                              std::abs(json_->get<double>()) <= kMaxExact &&
                              json_->get<double>() == std::floor(json_->get<double>());
  if (fits || is_whole_float) {
    const auto value = json_->get<std::int64_t>();
    if (value >= low && value <= high) return value;
  }
  report(fmt::format("must be an integer from {} to {}.", low, high));
  return low;
}

std::string Value::text(std::size_t max_bytes) const {
  if (json_->is_string()) {
    const auto& value = json_->get_ref<const std::string&>();
    const bool plain = std::ranges::none_of(
        value, [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7f; });
    if (!value.empty() && value.size() <= max_bytes && plain) return value;
  }
  report(fmt::format("must be a text of 1 to {} bytes without control characters.",
                     max_bytes));
  return {};
}

Fields::Fields(const Value& object) : object_(object) {
  if (!object_.json().is_object()) object_.report("must be an object.");
}

Fields::~Fields() {
  if (!object_.json().is_object()) return;
  for (const auto& item : object_.json().items()) {
    if (std::ranges::find(requested_, item.key()) != requested_.end()) continue;
    problem(shortened(item.key()),
            fmt::format("unknown key. Allowed: {}.", fmt::join(requested_, ", ")));
  }
}

void Fields::problem(std::string_view key, const std::string& message) {
  Value(object_.json(), object_.path_of(key), object_.problems()).report(message);
}

std::optional<Value> Fields::value(std::string_view key, bool optional) {
  if (std::ranges::find(requested_, key) == requested_.end())
    requested_.emplace_back(key);
  if (!object_.json().is_object()) return std::nullopt;
  if (object_.has(key)) return object_.at(key);
  if (!optional) problem(key, "is missing.");
  return std::nullopt;
}

bool Fields::has(std::string_view key) {
  return value(key, true).has_value();
}

double Fields::number(std::string_view key, double min, double max,
                      std::optional<double> otherwise) {
  const auto found = value(key, otherwise.has_value());
  return found ? found->number(min, max) : otherwise.value_or(min);
}

std::int64_t Fields::whole(std::string_view key, std::int64_t min, std::int64_t max) {
  const auto found = value(key);
  return found ? found->integer(min, max) : min;
}

bool Fields::flag(std::string_view key, bool otherwise) {
  const auto found = value(key, true);
  if (!found) return otherwise;
  if (found->json().is_boolean()) return found->json().get<bool>();
  found->report("must be true or false.");
  return otherwise;
}

std::string Fields::text(std::string_view key,
                         const std::optional<std::string>& otherwise) {
  const auto found = value(key, otherwise.has_value());
  if (!found) return otherwise.value_or("");
  if (found->json().is_string() && !found->json().get_ref<const std::string&>().empty())
    return found->json().get<std::string>();
  found->report("must be a text that is not empty.");
  return otherwise.value_or("");
}

std::size_t Fields::word(std::string_view key, const std::vector<std::string>& words,
                         std::optional<std::size_t> otherwise) {
  const auto found = value(key, otherwise.has_value());
  if (!found) return otherwise.value_or(0);
  for (std::size_t k = 0; k < words.size(); ++k)
    if (found->json() == words[k]) return k;
  found->report(fmt::format("must be one of: {}.", fmt::join(words, ", ")));
  return otherwise.value_or(0);
}

std::vector<Value> Fields::items(std::string_view key, std::size_t max_items,
                                 bool optional) {
  const auto found = value(key, optional);
  return found ? found->items(max_items) : std::vector<Value>();
}

std::vector<std::pair<std::string, Value>> Fields::members(std::string_view key,
                                                           std::size_t max_members) {
  std::vector<std::pair<std::string, Value>> all;
  const auto found = value(key);
  if (!found) return all;
  if (!found->json().is_object() || found->json().size() > max_members) {
    found->report(fmt::format("must be an object of at most {} keys.", max_members));
    return all;
  }
  for (const auto& item : found->json().items())
    all.emplace_back(item.key(), found->at(item.key()));
  return all;
}

}  // namespace skein::strict_json
