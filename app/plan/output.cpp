// SPDX-License-Identifier: Apache-2.0
#include "app/plan/output.h"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "app/common/commands.h"
#include "app/common/common.h"
#include "app/common/output.h"
#include "skein/base/output_file.h"
#include "skein/exchange/plan/samples.h"
#include "skein/exchange/table/formats.h"
#include "skein/exchange/table/text_shown.h"
#include "skein/geo/vec.h"
#include "skein/model/path/flight_plan.h"

namespace skein::app {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t kMaxRows = 60;  // of a table for people

// Without a zero's minus sign.
double bearing_deg(double angle) {
  return geo::degrees(geo::wrap_2pi(angle)) + 0.0;
}

// Also where neither is there yet, or one is a link to the other.
bool is_same_file(const std::filesystem::path& a, const std::filesystem::path& b) {
  std::error_code none;
  if (std::filesystem::equivalent(a, b, none)) return true;
  const auto whole = [&none](const std::filesystem::path& file) {
    return std::filesystem::weakly_canonical(std::filesystem::absolute(file, none), none);
  };
  const std::filesystem::path whole_a = whole(a);
  return !whole_a.empty() && whole_a == whole(b);
}

Json place(const Vec3& p) {
  return {{"north_m", p.x()}, {"east_m", p.y()}, {"altitude_m", 0.0 - p.z()}};
}

Json element_json(const FlightElement& e) {
  const model::FlightMoment end = model::end_of(e);
  Json is = {{"kind", exchange::kind_of(e)},
             {"start_s", e.start},
             {"duration_s", e.duration},
             {"length_m", model::ground_length(e)},
             {"start", place(e.p_N)},
             {"end", place(end.p_N)},
             {"heading_deg", bearing_deg(e.heading)},
             {"end_heading_deg", bearing_deg(end.heading)},
             {"turned_deg", geo::degrees(e.turn_rate * e.duration)},
             {"airspeed_mps", e.airspeed},
             {"climb_mps", e.climb_rate}};
  if (e.climb_acceleration != 0) is["climb_mps2"] = e.climb_acceleration;
  if (e.turn_rate != 0) is["turn_radius_m"] = e.airspeed / std::abs(e.turn_rate);
  return is;
}

Json plan_json(const exchange::NamedPlan& plan) {
  Json is = {{"name", plan.name}};
  if (!plan.word.empty()) is["word"] = plan.word;
  is["time_s"] = model::duration(plan.plan);
  is["length_m"] = model::ground_length(plan.plan);
  is["elements"] = Json::array();
  for (const FlightElement& e : plan.plan) is["elements"].push_back(element_json(e));
  return is;
}

void print_plan(const exchange::NamedPlan& plan) {
  print("\n{}{}: {}, {} over ground\n", plan.name,
        plan.word.empty() ? "" : fmt::format(" ({})", plan.word),
        exchange::shown_time(model::duration(plan.plan)),
        exchange::shown_length(model::ground_length(plan.plan)));
  print(
      "   #  element              start s    time s  length m  heading deg       north m "
      "    "
      "east m  altitude m\n");
  for (std::size_t k = 0; k < plan.plan.size() && k < kMaxRows; ++k) {
    const FlightElement& e = plan.plan[k];
    print(
        "{:>4}  {:<18} {:>9.2f} {:>9.2f} {:>9.1f}  {:>5} > {:>5} {:>11} {:>10} {:>11}\n",
        k + 1, exchange::kind_of(e), e.start, e.duration, model::ground_length(e),
        exchange::shown_bearing(e.heading),
        exchange::shown_bearing(model::end_of(e).heading),
        exchange::shown_tenths(e.p_N.x()), exchange::shown_tenths(e.p_N.y()),
        exchange::shown_tenths(-e.p_N.z()));
  }
  if (plan.plan.size() > kMaxRows)
    print("      ... {} more; --json and files have all.\n", plan.plan.size() - kMaxRows);
}

void print_document(const exchange::Document& document) {
  print("{}\n", document.title);
  for (const auto& [name, value] : document.facts) print("  {}: {}\n", name, value);
  for (const exchange::NamedPlan& plan : document.plans) print_plan(plan);
}

}  // namespace

Result<void> check_files(const PlanOutput& output,
                         const std::vector<std::filesystem::path>& inputs) {
  const auto wrong = [](const std::filesystem::path& file, const char* what) {
    return Error{ErrorCode::kBadInput, file.string(), what, "Give --out another name."};
  };
  for (std::size_t i = 0; i < output.files.size(); ++i) {
    const std::filesystem::path& file = output.files[i];
    if (const auto format = exchange::format_of(file); !format) return format.error();
    for (const std::filesystem::path& input : inputs)
      if (is_same_file(file, input))
        return wrong(file, "is an input as well as an output.");
    for (std::size_t k = 0; k < i; ++k)
      if (is_same_file(file, output.files[k]))
        return wrong(file, "is given twice as an output.");
  }
  return {};
}

Result<void> check_formats(const PlanOutput& output, const exchange::Known& known) {
  for (const std::filesystem::path& file : output.files) {
    const auto format = exchange::format_of(file);
    if (!format) return format.error();
    if (auto good = exchange::check_known(format.value(), known); !good) {
      Error error = good.error();
      error.place = file.string();
      return error;
    }
  }
  return {};
}

Result<void> write_plan_files(const exchange::Document& document,
                              const PlanOutput& output) {
  const exchange::WritingOptions options{output.tolerance, output.step};
  for (const std::filesystem::path& file : output.files) {
    const auto format = exchange::format_of(file);
    if (!format) return format.error();
    auto text = exchange::to_text(document, format.value(), options);
    if (!text) {
      Error error = text.error();
      error.place = file.string();
      return error;
    }
    if (auto good = write_file(file, text.value()); !good) return good.error();
  }
  return {};
}

void print_plan_json(const exchange::Document& document, const Json& about) {
  Json all = about;
  all["plans"] = Json::array();
  for (const exchange::NamedPlan& plan : document.plans)
    all["plans"].push_back(plan_json(plan));
  put_out(all.dump(2, ' ', false, Json::error_handler_t::replace) + "\n");
}

int put_plan(const exchange::Document& document, const Json& about,
             const PlanOutput& output) {
  if (auto good = write_plan_files(document, output); !good)
    return say_error(good.error());
  if (output.json)
    print_plan_json(document, about);
  else
    print_document(document);
  return kDone;
}

}  // namespace skein::app
