// SPDX-License-Identifier: Apache-2.0
#include "skein/data/describe/json.h"

namespace skein::json {

std::string joined(std::string_view prefix, std::string_view name) {
  std::string all(prefix);
  if (!prefix.empty() && !name.empty()) all += '_';
  return all.append(name);
}

namespace detail {

const Json* Taker::find(const std::string& name) {
  const auto found = object_.find(name);
  return found == object_.end() ? nullptr : &*found;
}

bool Taker::has_parts(const std::string& name) const {
  const std::string begin = name + "_";
  for (auto at = object_.begin(); at != object_.end(); ++at)
    if (at.key().starts_with(begin)) return true;
  return false;
}

void Taker::fail(const std::string& name, const char* what) {
  if (wrong_.empty()) wrong_ = name + ": " + what + ".";
}

void Taker::take_number(const std::string& name, double factor, double& value) {
  const Json* found = find(name);
  if (!found || found->is_null()) return;
  if (!found->is_number()) return fail(name, "must be a number");
  value = found->get<double>() / factor;
}

void Taker::take_attitude(const std::string& name, Quat& value) {
  geo::Euler e = geo::to_euler(value);
  constexpr double kDegrees = unit::kDegree.factor;
  take_number(joined(name, "heading_deg"), kDegrees, e.yaw);
  take_number(joined(name, "roll_deg"), kDegrees, e.roll);
  take_number(joined(name, "pitch_deg"), kDegrees, e.pitch);
  value = geo::from_euler(e);
}

}  // namespace detail
}  // namespace skein::json
