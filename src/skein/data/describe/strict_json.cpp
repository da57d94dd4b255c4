// SPDX-License-Identifier: Apache-2.0
#include "skein/data/describe/strict_json.h"

#include <algorithm>
#include <functional>

namespace skein::strict_json {

void Problems::add(const std::string& path, const std::string& what) {
  if (count_++ >= kMaxProblems) return;
  if (count_ == 1) first_place_ = path.empty() ? name_ : name_ + " " + path;
  text_ += count_ == 1 ? what : fmt::format("\n{} {}: {}", name_, path, what);
}

Error Problems::error() const {
  std::string hint;
  if (count_ > kMaxProblems)
    hint = fmt::format("And {} more problems.", count_ - kMaxProblems);
  return {ErrorCode::kBadInput, first_place_, text_, hint};
}

std::optional<Json> parse(std::string_view text, Problems& problems) {
  ParserWatch<Json> watch;
  try {
    Json json = Json::parse(text, std::ref(watch));
    const std::string problem = watch.problem();
    if (problem.empty()) return json;
    problems.add("", problem);
  } catch (const Json::exception& error) {
    problems.add("", fmt::format("it is no JSON: {}.", error.what()));
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
  return {json_->at(std::string(key)), fmt::format("{}.{}", path_, key), *problems_};
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
  if (fits) {
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

}  // namespace skein::strict_json
