// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/environment/recorded/feature_times.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <set>

#include "skein/layer/environment/raster/date_column.h"

namespace skein::environment {
namespace {

using Names = std::vector<std::string>;
using Times = std::vector<std::optional<DateTime>>;

constexpr std::string_view kOwnNames[] = {"seconds",    "time_s", "time_utc",
                                          "time_local", "time",   "datetime",
                                          "timestamp",  "date"};

// Names of agencies for the time of a perimeter, the best first: when it was seen, then
// when it was valid, then when it was written down.
constexpr std::string_view kAgencyNames[] = {
    "perimeterdatetime", "perdattime",  "polygondatetime", "collectiondatetime",
    "observationtime",   "observed",    "obsdate",         "obstime",
    "acquisitiontime",   "acquisition", "acqdatetime",     "acqdate",
    "captdate",          "capturedate", "imagedate",       "imagerydate",
    "imagedatetime",     "flightdate",  "flighttime",      "surveydate",
    "srcdate",           "sourcedate",  "begin",           "validtime",
    "perimeterdate",     "mapdate",     "reportdate",      "lastdate",
    "finaldate",         "datecurrent", "lastupdate",      "updatedate",
    "createdate",        "datecreated", "trackdate",       "loaddate"};

constexpr std::string_view kTimesOfDay[] = {"timeofday",  "acqtime", "acquisitiontime",
                                            "obstime",    "obshour", "perimetertime",
                                            "flighttime", "maptime", "time",
                                            "imagetime",  "hhmm",    "hour"};
constexpr std::string_view kTitles[] = {"name", "title", "label", "mission"};

class LayerTimes {
 public:
  LayerTimes(std::span<const VectorFeature> layer, const PerimeterFileOptions& options,
             Assumptions& assumed)
      : layer_(layer), options_(options), assumed_(assumed) {}

  Result<Times> times() {
    const std::string name = time_attribute();
    Times times;
    if (name.empty()) {
      times = options_.time_field.empty() ? times_in_names() : Times(layer_.size());
    } else {
      DateColumn column = column_of(name);
      if (column.wrong) {
        const VectorFeature& feature = layer_[*column.wrong];
        return Error{ErrorCode::kBadInput, feature.outline.place,
                     fmt::format("attribute {} is no time: \"{}\"", name,
                                 find_attribute(feature, name)->text),
                     time_hint(feature)};
      }
      note(column, name);
      times = std::move(column.times);
      complete(name, times);
      if (options_.time_field.empty()) fill_from_others(name, times);
    }
    for (auto& time : times) {
      if (!time || !time->utc) continue;
      if (!time->time_of_day) assumed_.add("dates without a time of day are 00:00");
      if (time->zone) continue;
      time->value -= 3600 * options_.utc_offset_h;
      if (options_.utc_offset_h == 0)
        assumed_.add("times without a zone are UTC (else give utc_offset_h)");
    }
    return times;
  }

 private:
  DateColumn column_of(const std::string& name, bool numbers = true) const {
    std::vector<std::string> texts;
    for (const VectorFeature& feature : layer_) {
      const Attribute* each = find_attribute(feature, name);
      texts.push_back(each != nullptr ? each->text : "");
    }
    return read_date_column(texts, name,
                            {.order = options_.date_order,
                             .plain_seconds = is_plain_seconds(name),
                             .numbers = numbers});
  }

  void note(const DateColumn& column, const std::string& name) {
    for (const std::string& line : column.understood) assumed_.add(line);
    if (column.null_count > 0)
      assumed_.add(
          fmt::format("{} value(s) of {} mean that there is no time, such as "
                      "\"{}\"",
                      column.null_count, name, column.first_null));
  }

  static bool any(const Times& times) {
    return std::any_of(times.begin(), times.end(), [](const auto& t) { return !!t; });
  }

  static bool is_utc(const Times& times) {
    return std::any_of(times.begin(), times.end(),
                       [](const auto& t) { return t && t->utc; });
  }

  // Than numbers under the name `chosen`: dates; with a zone, if those are plain seconds.
  static bool is_surer(const Times& times, const std::string& chosen) {
    if (!is_plain_seconds(chosen)) return is_utc(times);
    return std::all_of(times.begin(), times.end(),
                       [](const auto& t) { return t && t->utc && t->zone; });
  }

  // Features whose own attribute says nothing, from the next known ones that do.
  void fill_from_others(const std::string& chosen, Times& times) {
    if (!is_utc(times)) return;
    for (const std::string& name : known_) {
      if (name == chosen) continue;
      if (std::all_of(times.begin(), times.end(), [](const auto& t) { return !!t; }))
        return;
      DateColumn column = column_of(name);
      if (column.wrong || !is_utc(column.times)) continue;
      complete(name, column.times);
      int filled = 0;
      for (std::size_t k = 0; k < times.size(); ++k) {
        if (times[k] || !column.times[k] || !column.times[k]->utc) continue;
        times[k] = column.times[k];
        ++filled;
      }
      if (filled == 0) continue;
      note(column, name);
      assumed_.add(fmt::format("{} time(s) are from {}, as {} is empty there", filled,
                               name, chosen));
    }
  }

  Names all_names() const {
    Names names;  // in their order
    for (const VectorFeature& feature : layer_)
      for (const Attribute& each : feature.attributes)
        if (std::find(names.begin(), names.end(), each.name) == names.end())
          names.push_back(each.name);
    return names;
  }

  // The attribute with the times of a layer; empty: none.
  std::string time_attribute() {
    const Names names = all_names();
    if (!options_.time_field.empty()) {
      for (const std::string& name : names)
        if (in_capitals(name) == in_capitals(options_.time_field)) return name;
      return "";
    }
    for (const std::string_view own : kOwnNames)
      for (const std::string& name : names)
        if (in_capitals(name) == in_capitals(std::string(own))) known_.push_back(name);
    const std::size_t own_names = known_.size();
    for (const std::string_view agency : kAgencyNames)
      for (const std::string& name : names)
        if (is_named(name, agency) &&
            std::find(known_.begin(), known_.end(), name) == known_.end())
          known_.push_back(name);
    std::string chosen;
    for (const std::string& name : known_) {
      const Times times = column_of(name).times;
      if (!any(times)) continue;
      if (chosen.empty() || is_surer(times, chosen)) chosen = name;
      if (is_utc(times)) break;
    }
    if (!chosen.empty()) {
      const auto at = std::find(known_.begin(), known_.end(), chosen);
      if (at - known_.begin() >= static_cast<std::ptrdiff_t>(own_names)) {
        Names others = known_;
        std::erase(others, chosen);
        assumed_.add(fmt::format(
            "times are in {}{}", chosen,
            others.empty() ? "" : fmt::format(" (not in {})", fmt::join(others, ", "))));
      }
      return chosen;
    }
    if (!known_.empty()) return known_.front();  // what it holds instead is reported
    return most_different_dates(names);
  }

  std::string most_different_dates(const Names& names) {
    std::string best;
    std::size_t most = layer_.size() == 1 ? 0 : 1;
    for (const std::string& name : names) {
      // A number of eight digits under any name is more likely a number.
      const DateColumn column = column_of(name, false);
      std::set<double> values;
      bool good = !column.wrong;
      for (std::size_t k = 0; k < layer_.size(); ++k) {
        if (!column.times[k]) continue;
        good = good && find_attribute(layer_[k], name)->text.find_first_of("-/.: ") !=
                           std::string::npos;
        values.insert(column.times[k]->value);
      }
      if (!good || values.size() <= most) continue;
      most = values.size();
      best = name;
    }
    if (!best.empty())
      assumed_.add("times are in " + best + ", the dates that differ most");
    return best;
  }

  Times times_in_names() {
    Times times;
    for (const VectorFeature& feature : layer_) {
      std::optional<DateTime> time;
      if (const Attribute* title = find_known(feature, kTitles)) {
        time = find_date(title->text);
        if (time) assumed_.add("times are those in " + title->name);
      }
      if (!time) {
        time = find_date(feature.layer);
        if (time) assumed_.add("times are those in the layers' names");
      }
      if (!time) {
        time = find_date(std::filesystem::path(file_of(feature)).filename().string());
        if (time) assumed_.add("times are those in the files' names");
      }
      times.push_back(time);
    }
    return times;
  }

  // Times of day from another attribute, where there are dates only.
  void complete(const std::string& dates, Times& times) {
    const bool without = std::all_of(times.begin(), times.end(), [](const auto& t) {
      return !t || (t->utc && !t->time_of_day);
    });
    if (!without || !any(times)) return;
    for (std::size_t k = 0; k < layer_.size(); ++k) {
      if (!times[k]) continue;
      for (const Attribute& each : layer_[k].attributes) {
        const bool named =
            std::any_of(std::begin(kTimesOfDay), std::end(kTimesOfDay),
                        [&](std::string_view n) { return is_named(each.name, n); });
        if (!named || each.name == dates) continue;
        const auto time = parse_time_of_day(each.text);
        if (!time) continue;
        times[k]->value += *time;
        times[k]->time_of_day = true;
        assumed_.add("times of day are in " + each.name);
        break;
      }
    }
  }

  std::span<const VectorFeature> layer_;
  const PerimeterFileOptions& options_;
  Assumptions& assumed_;
  Names known_;  // attributes that may have times, the best first
};

}  // namespace

Result<Times> times_of_layer(std::span<const VectorFeature> layer,
                             const PerimeterFileOptions& options, Assumptions& assumed) {
  return LayerTimes(layer, options, assumed).times();
}

std::string time_hint(const VectorFeature& feature) {
  Names names;
  for (const Attribute& each : feature.attributes) names.push_back(each.name);
  return fmt::format("name it in time_field; its attributes: {}",
                     names.empty() ? "none" : fmt::format("{}", fmt::join(names, ", ")));
}

std::span<const std::string_view> time_names() {
  return kOwnNames;
}

bool is_plain_seconds(const std::string& name) {
  return bare_name(name) == "seconds" || bare_name(name) == "times";
}

}  // namespace skein::environment
