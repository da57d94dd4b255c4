// SPDX-License-Identifier: Apache-2.0
#include "skein/exchange/team/strict_json.h"

#include <fmt/format.h>

#include <cmath>
#include <functional>

#include "skein/data/describe/strict_json.h"

namespace skein::exchange {
namespace {

constexpr int kMaxNesting = 64;

// At most so much of a text from outside in a message.
std::string shortened(const std::string& text) {
  constexpr std::size_t kLongest = 60;
  return text.size() <= kLongest ? text : text.substr(0, kLongest) + "...";
}

}  // namespace

void JsonProblems::add(std::string place, std::string message) {
  if (count_++ == 0)
    first_ = {ErrorCode::kBadInput, std::move(place), std::move(message), ""};
}

Error JsonProblems::error() const {
  Error error = first_;
  if (count_ > 1) error.hint = fmt::format("There are {} more problems.", count_ - 1);
  return error;
}

Result<StrictJson> parse_strictly(std::string_view text, const std::string& place) {
  strict_json::ParserWatch<StrictJson> watch(kMaxNesting);
  StrictJson parsed;
  try {
    parsed = StrictJson::parse(text, std::ref(watch));
  } catch (const StrictJson::exception& fault) {
    return Error{ErrorCode::kBadInput, place,
                 fmt::format("this is no JSON: {}", shortened(fault.what())), ""};
  }
  if (const std::string problem = watch.problem(); !problem.empty())
    return Error{ErrorCode::kBadInput, place, problem, ""};
  return parsed;
}

JsonFields::JsonFields(const StrictJson& object, std::string place,
                       JsonProblems& problems)
    : object_(object), place_(std::move(place)), problems_(problems) {
  if (!object_.is_object()) problems_.add(place_, "must be an object.");
}

JsonFields::~JsonFields() {
  if (!object_.is_object()) return;
  for (const auto& [key, value] : object_.items()) {
    if (asked_.contains(key)) continue;
    std::string allowed;
    for (const std::string& name : asked_)
      allowed += (allowed.empty() ? "" : ", ") + name;
    problems_.add(place_ + "." + shortened(key),
                  fmt::format("unknown key. Allowed: {}.", allowed));
  }
}

void JsonFields::problem(const char* key, std::string message) {
  problems_.add(place_ + "." + key, std::move(message));
}

const StrictJson* JsonFields::find(const char* key, bool optional) {
  asked_.insert(key);
  if (!object_.is_object()) return nullptr;
  const auto found = object_.find(key);
  if (found != object_.end()) return &*found;
  if (!optional) problem(key, "is missing.");
  return nullptr;
}

bool JsonFields::has(const char* key) {
  return find(key, true) != nullptr;
}

double JsonFields::number(const char* key, double min, double max,
                          std::optional<double> otherwise) {
  const StrictJson* found = find(key, otherwise.has_value());
  if (!found) return otherwise.value_or(min);
  const double value = found->is_number() ? found->get<double>() : std::nan("");
  if (value >= min && value <= max) return value;
  problem(key, fmt::format("must be a number within {} to {}.", min, max));
  return min;
}

std::int64_t JsonFields::whole(const char* key, std::int64_t min, std::int64_t max) {
  const StrictJson* found = find(key, false);
  if (!found) return min;
  const bool fits =
      found->is_number_integer() &&
      (!found->is_number_unsigned() || found->get<std::uint64_t>() < (1ULL << 62));
  const std::int64_t value = fits ? found->get<std::int64_t>() : min - 1;
  if (value >= min && value <= max) return value;
  problem(key, fmt::format("must be a whole number within {} to {}.", min, max));
  return min;
}

bool JsonFields::flag(const char* key, bool otherwise) {
  const StrictJson* found = find(key, true);
  if (!found) return otherwise;
  if (found->is_boolean()) return found->get<bool>();
  problem(key, "must be true or false.");
  return otherwise;
}

std::string JsonFields::text(const char* key,
                             const std::optional<std::string>& otherwise) {
  const StrictJson* found = find(key, otherwise.has_value());
  if (!found) return otherwise.value_or("");
  if (found->is_string() && !found->get_ref<const std::string&>().empty())
    return found->get<std::string>();
  problem(key, "must be a text that is not empty.");
  return otherwise.value_or("");
}

std::size_t JsonFields::word(const char* key, const std::vector<std::string>& words,
                             std::optional<std::size_t> otherwise) {
  const StrictJson* found = find(key, otherwise.has_value());
  if (!found) return otherwise.value_or(0);
  for (std::size_t k = 0; k < words.size(); ++k)
    if (*found == words[k]) return k;
  problem(key, fmt::format("must be one of: {}.", fmt::join(words, ", ")));
  return otherwise.value_or(0);
}

const StrictJson* JsonFields::list(const char* key, bool optional) {
  const StrictJson* found = find(key, optional);
  if (!found || found->is_array()) return found;
  problem(key, "must be a list.");
  return nullptr;
}

const StrictJson* JsonFields::object(const char* key) {
  const StrictJson* found = find(key, false);
  if (!found || found->is_object()) return found;
  problem(key, "must be an object.");
  return nullptr;
}

}  // namespace skein::exchange
