#include "skein/layer/environment/recorded/feature_times.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <set>

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
  LayerTimes(const PerimeterFileOptions& options, Assumptions& assumed)
      : options_(options), assumed_(assumed) {}

  Result<Times> times_of(std::span<const VectorFeature> layer) {
    const std::string name = time_attribute(layer);
    Times times;
    if (name.empty()) {
      times = options_.time_field.empty() ? times_in_names(layer) : Times(layer.size());
    } else {
      times = read_times(layer, name, order_of(layer, name));
      for (std::size_t k = 0; k < layer.size(); ++k)
        if (const Attribute* each = find_attribute(layer[k], name);
            each != nullptr && !times[k])
          return Error{ErrorCode::kBadInput, layer[k].outline.place,
                       fmt::format("attribute {} is no time: \"{}\"", name, each->text),
                       time_hint(layer[k])};
      complete(layer, name, times);
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
  DateOrder order_of(std::span<const VectorFeature> layer, const std::string& name) {
    bool slashes = false;
    for (const VectorFeature& feature : layer)
      if (const Attribute* each = find_attribute(feature, name)) {
        if (const auto order = shown_order(each->text)) return *order;
        slashes = slashes || has_slash_date(each->text);
      }
    if (slashes) assumed_.add(fmt::format("in {} the month stands before the day", name));
    return DateOrder::kMonthFirst;
  }

  Times read_times(std::span<const VectorFeature> layer, const std::string& name,
                   DateOrder order) const {
    Times times;
    for (const VectorFeature& feature : layer) {
      const Attribute* each = find_attribute(feature, name);
      times.push_back(each != nullptr ? parse_date_or_number(each->text, order,
                                                             is_plain_seconds(name))
                                      : std::nullopt);
    }
    return times;
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

  // The attribute with the times of a layer; empty: none.
  std::string time_attribute(std::span<const VectorFeature> layer) {
    Names names;  // of all attributes, in their order
    for (const VectorFeature& feature : layer)
      for (const Attribute& each : feature.attributes)
        if (std::find(names.begin(), names.end(), each.name) == names.end())
          names.push_back(each.name);
    if (!options_.time_field.empty()) {
      for (const std::string& name : names)
        if (in_capitals(name) == in_capitals(options_.time_field)) return name;
      return "";
    }
    Names known;
    for (const std::string_view own : kOwnNames)
      for (const std::string& name : names)
        if (in_capitals(name) == in_capitals(std::string(own))) known.push_back(name);
    const std::size_t own_names = known.size();
    for (const std::string_view agency : kAgencyNames)
      for (const std::string& name : names)
        if (is_named(name, agency) &&
            std::find(known.begin(), known.end(), name) == known.end())
          known.push_back(name);
    std::string chosen;
    for (const std::string& name : known) {
      const Times times = read_times(layer, name, DateOrder::kMonthFirst);
      if (!any(times) && !any(read_times(layer, name, DateOrder::kDayFirst))) continue;
      if (chosen.empty() || is_surer(times, chosen)) chosen = name;
      if (is_utc(times)) break;
    }
    if (!chosen.empty()) {
      const auto at = std::find(known.begin(), known.end(), chosen);
      if (at - known.begin() >= static_cast<std::ptrdiff_t>(own_names)) {
        known.erase(at);
        assumed_.add(fmt::format(
            "times are in {}{}", chosen,
            known.empty() ? "" : fmt::format(" (not in {})", fmt::join(known, ", "))));
      }
      return chosen;
    }
    if (!known.empty()) return known.front();  // what it holds instead is reported
    return most_different_dates(layer, names);
  }

  std::string most_different_dates(std::span<const VectorFeature> layer,
                                   const Names& names) {
    std::string best;
    std::size_t most = layer.size() == 1 ? 0 : 1;
    for (const std::string& name : names) {
      std::set<double> values;
      bool good = true;
      for (const VectorFeature& feature : layer)
        if (const Attribute* each = find_attribute(feature, name)) {
          auto date = parse_date(each->text, DateOrder::kMonthFirst);
          if (!date) date = parse_date(each->text, DateOrder::kDayFirst);
          // A number of eight digits under any name is more likely a number.
          good = good && date && each->text.find_first_of("-/.:") != std::string::npos;
          if (date) values.insert(date->value);
        }
      if (!good || values.size() <= most) continue;
      most = values.size();
      best = name;
    }
    if (!best.empty())
      assumed_.add("times are in " + best + ", the dates that differ most");
    return best;
  }

  Times times_in_names(std::span<const VectorFeature> layer) {
    Times times;
    for (const VectorFeature& feature : layer) {
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
  void complete(std::span<const VectorFeature> layer, const std::string& dates,
                Times& times) {
    const bool without = std::all_of(times.begin(), times.end(), [](const auto& t) {
      return !t || (t->utc && !t->time_of_day);
    });
    if (!without || !any(times)) return;
    for (std::size_t k = 0; k < layer.size(); ++k) {
      if (!times[k]) continue;
      for (const Attribute& each : layer[k].attributes) {
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

  const PerimeterFileOptions& options_;
  Assumptions& assumed_;
};

}  // namespace

Result<Times> times_of_layer(std::span<const VectorFeature> layer,
                             const PerimeterFileOptions& options, Assumptions& assumed) {
  return LayerTimes(options, assumed).times_of(layer);
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
