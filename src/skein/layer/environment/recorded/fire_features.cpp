#include "skein/layer/environment/recorded/fire_features.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <span>

#include "skein/layer/environment/raster/date_time.h"

namespace skein::environment {
namespace {

using Features = std::vector<VectorFeature>;
using Names = std::vector<std::string>;

// Letters and digits only, small.
std::string bare(const std::string& name) {
  std::string result;
  for (const char c : name)
    if (std::isalnum(static_cast<unsigned char>(c)) != 0)
      result += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return result;
}

// Names of agencies for the time of a perimeter, the best first: when it was seen, then
// when it was valid, then when it was written down.
const Names& agency_names() {
  static const Names names{
      "perimeterdatetime", "perdattime",  "polygondatetime", "collectiondatetime",
      "observationtime",   "observed",    "obsdate",         "obstime",
      "acquisitiontime",   "acquisition", "acqdatetime",     "acqdate",
      "captdate",          "capturedate", "imagedate",       "imagerydate",
      "imagedatetime",     "flightdate",  "flighttime",      "surveydate",
      "srcdate",           "sourcedate",  "begin",           "validtime",
      "perimeterdate",     "mapdate",     "reportdate",      "lastdate",
      "finaldate",         "datecurrent", "lastupdate",      "updatedate",
      "createdate",        "datecreated", "trackdate",       "loaddate"};
  return names;
}

const Names kTimesOfDay = {"timeofday",  "acqtime", "acquisitiontime",
                           "obstime",    "obshour", "perimetertime",
                           "flighttime", "maptime", "time",
                           "imagetime",  "hhmm",    "hour"};
const Names kIncidents = {"incidentname", "firename", "incident", "fire"};
const Names kTitles = {"name", "title", "label", "mission"};

// Whether an attribute is the known one: perhaps prefixed, perhaps cut to ten letters.
bool is_named(const std::string& attribute, const std::string& known) {
  const std::string name = bare(attribute);
  for (const char* prefix : {"", "poly", "attr"}) {
    const std::string whole = prefix + known;
    if (name == whole) return true;
    if (attribute.size() == 10 && name.size() >= 8 && whole.starts_with(name))
      return true;
  }
  return false;
}

const Attribute* find(const VectorFeature& feature, const std::string& name) {
  for (const Attribute& each : feature.attributes)
    if (each.name == name) return &each;
  return nullptr;
}

const Attribute* find_known(const VectorFeature& feature, const Names& known) {
  for (const std::string& name : known)
    for (const Attribute& each : feature.attributes)
      if (is_named(each.name, name)) return &each;
  return nullptr;
}

std::string upper(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  while (!text.empty() && text.back() == ' ') text.pop_back();
  return text;
}

bool has_area(const VectorFeature& feature) {
  return !feature.outline.polygons.empty();
}

class Interpreter {
 public:
  Interpreter(const std::string& place, const PerimeterFileOptions& options,
              std::vector<std::string>& warnings)
      : place_(place), options_(options), warnings_(warnings) {}

  Result<RawSeries> series(Features features) {
    if (auto good = keep_incident(features); !good) return good.error();
    keep_perimeters(features);
    RawSeries series;
    std::size_t without = 0;
    bool first = true;
    std::optional<Error> problem;
    for (std::size_t i = 0; i < features.size();) {
      std::size_t end = i + 1;
      while (end < features.size() && features[end].layer == features[i].layer &&
             file_of(features[end]) == file_of(features[i]))
        ++end;
      const std::span<VectorFeature> layer(&features[i], end - i);
      auto times = times_of(layer);
      if (!times) return times.error();
      for (std::size_t k = 0; k < layer.size(); ++k) {
        const auto& time = times.value()[k];
        if (!time) {
          ++without;
          if (!problem) problem = no_time(layer[k]);
          continue;
        }
        if (!first && time->utc != series.utc) return mixed_times(layer[k].outline.place);
        first = false;
        series.utc = time->utc;
        layer[k].outline.time = time->value;
        series.perimeters.push_back(std::move(layer[k].outline));
      }
      i = end;
    }
    if (first)
      return problem.value_or(
          Error{ErrorCode::kBadInput, place_, "has no perimeter", ""});
    if (without > 0)
      assume(fmt::format("{} feature(s) without a time left out", without));
    for (const std::string& each : assumed_) warnings_.push_back(place_ + ": " + each);
    return series;
  }

 private:
  using Times = std::vector<std::optional<DateTime>>;
  // What follows a feature's file in its place.
  static std::string file_of(const VectorFeature& feature) {
    return feature.outline.place.substr(0, feature.outline.place.rfind(": feature"));
  }

  void assume(const std::string& what) {
    const std::string line = "assumed: " + what;
    if (std::find(assumed_.begin(), assumed_.end(), line) == assumed_.end())
      assumed_.push_back(line);
  }

  Result<void> keep_incident(Features& features) {
    std::map<std::string, int> incidents;
    std::vector<std::string> names(features.size());
    for (std::size_t i = 0; i < features.size(); ++i) {
      const Attribute* name = find_known(features[i], kIncidents);
      names[i] = name != nullptr ? upper(name->text) : "";
      if (!names[i].empty()) ++incidents[names[i]];
    }
    const std::string wanted = upper(options_.incident);
    if (wanted.empty() && incidents.size() < 2) return {};
    if (!incidents.contains(wanted)) {
      std::vector<std::pair<int, std::string>> all;
      for (const auto& [name, count] : incidents) all.emplace_back(-count, name);
      std::sort(all.begin(), all.end());
      std::string list;
      for (std::size_t i = 0; i < all.size() && i < 12; ++i)
        list += fmt::format("{}{} ({})", i > 0 ? ", " : "", all[i].second, -all[i].first);
      if (all.size() > 12) list += fmt::format(" and {} more", all.size() - 12);
      return Error{ErrorCode::kBadInput, place_,
                   wanted.empty()
                       ? fmt::format("holds {} incidents", incidents.size())
                       : fmt::format("has no incident \"{}\"", options_.incident),
                   "name one as incident; by number of features: " +
                       (list.empty() ? "none has a name" : list)};
    }
    Features kept;
    for (std::size_t i = 0; i < features.size(); ++i)
      if (names[i] == wanted) kept.push_back(std::move(features[i]));
    features = std::move(kept);
    return {};
  }

  // Without what is deleted, of another category, or a line beside areas.
  void keep_perimeters(Features& features) {
    const auto leave_out = [&](const auto& is_out, const std::string& what) {
      const std::size_t before = features.size();
      std::erase_if(features, is_out);
      if (features.size() < before)
        assume(fmt::format("{} feature(s) left out: {}", before - features.size(), what));
    };
    leave_out(
        [](const VectorFeature& feature) {
          const Attribute* deleted = find_known(feature, {"deletethis"});
          return deleted != nullptr && upper(deleted->text) == "YES";
        },
        "marked as deleted");
    const auto category = [](const VectorFeature& feature) {
      const Attribute* found = find_known(feature, {"featurecategory"});
      return found != nullptr ? upper(found->text) : std::string();
    };
    const auto is_perimeter = [&](const VectorFeature& feature) {
      return category(feature).find("PERIMETER") != std::string::npos;
    };
    if (std::any_of(features.begin(), features.end(), is_perimeter))
      leave_out([&](const VectorFeature& feature) { return !is_perimeter(feature); },
                "of another category than perimeters");
    std::set<std::string> with_areas;
    for (const VectorFeature& feature : features)
      if (has_area(feature)) with_areas.insert(feature.layer);
    leave_out(
        [&](const VectorFeature& feature) {
          return !with_areas.empty() && !with_areas.contains(feature.layer) &&
                 !feature.outline.lines.empty();
        },
        "lines, in layers beside those with areas");
  }

  DateOrder order_of(std::span<const VectorFeature> layer, const std::string& name) {
    bool slashes = false;
    for (const VectorFeature& feature : layer)
      if (const Attribute* each = find(feature, name)) {
        if (const auto order = shown_order(each->text)) return *order;
        slashes = slashes || has_slash_date(each->text);
      }
    if (slashes) assume(fmt::format("in {} the month stands before the day", name));
    return DateOrder::kMonthFirst;
  }

  Times read_times(std::span<const VectorFeature> layer, const std::string& name,
                   DateOrder order) const {
    Times times;
    for (const VectorFeature& feature : layer) {
      const Attribute* each = find(feature, name);
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
        if (upper(name) == upper(options_.time_field)) return name;
      return "";
    }
    Names known;
    for (const std::string& own : time_names())
      for (const std::string& name : names)
        if (upper(name) == upper(own)) known.push_back(name);
    const std::size_t own_names = known.size();
    for (const std::string& agency : agency_names())
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
        assume(fmt::format(
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
        if (const Attribute* each = find(feature, name)) {
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
    if (!best.empty()) assume("times are in " + best + ", the dates that differ most");
    return best;
  }

  Times times_in_names(std::span<const VectorFeature> layer) {
    Times times;
    for (const VectorFeature& feature : layer) {
      std::optional<DateTime> time;
      if (const Attribute* title = find_known(feature, kTitles)) {
        time = find_date(title->text);
        if (time) assume("times are those in " + title->name);
      }
      if (!time) {
        time = find_date(feature.layer);
        if (time) assume("times are those in the layers' names");
      }
      if (!time) {
        time = find_date(std::filesystem::path(file_of(feature)).filename().string());
        if (time) assume("times are those in the files' names");
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
            std::any_of(kTimesOfDay.begin(), kTimesOfDay.end(),
                        [&](const std::string& n) { return is_named(each.name, n); });
        if (!named || each.name == dates) continue;
        const auto time = parse_time_of_day(each.text);
        if (!time) continue;
        times[k]->value += *time;
        times[k]->time_of_day = true;
        assume("times of day are in " + each.name);
        break;
      }
    }
  }

  Result<Times> times_of(std::span<const VectorFeature> layer) {
    const std::string name = time_attribute(layer);
    Times times;
    if (name.empty()) {
      times = options_.time_field.empty() ? times_in_names(layer) : Times(layer.size());
    } else {
      times = read_times(layer, name, order_of(layer, name));
      for (std::size_t k = 0; k < layer.size(); ++k)
        if (const Attribute* each = find(layer[k], name); each != nullptr && !times[k])
          return Error{ErrorCode::kBadInput, layer[k].outline.place,
                       fmt::format("attribute {} is no time: \"{}\"", name, each->text),
                       attribute_hint(layer[k])};
      complete(layer, name, times);
    }
    for (auto& time : times) {
      if (!time || !time->utc) continue;
      if (!time->time_of_day) assume("dates without a time of day are 00:00");
      if (time->zone) continue;
      time->value -= 3600 * options_.utc_offset_h;
      if (options_.utc_offset_h == 0)
        assume("times without a zone are UTC (else give utc_offset_h)");
    }
    return times;
  }

  static std::string attribute_hint(const VectorFeature& feature) {
    Names names;
    for (const Attribute& each : feature.attributes) names.push_back(each.name);
    return fmt::format(
        "name it in time_field; its attributes: {}",
        names.empty() ? "none" : fmt::format("{}", fmt::join(names, ", ")));
  }

  static Error no_time(const VectorFeature& feature) {
    return {ErrorCode::kBadInput, feature.outline.place, "has no attribute with a time",
            attribute_hint(feature)};
  }

  const std::string& place_;
  const PerimeterFileOptions& options_;
  std::vector<std::string>& warnings_;
  std::vector<std::string> assumed_;
};

}  // namespace

Error mixed_times(const std::string& place) {
  return {
      ErrorCode::kBadInput, place,
      "has a time of another kind than the ones before it: seconds and dates are mixed",
      ""};
}

Result<RawSeries> dated_perimeters(std::vector<VectorFeature> features,
                                   const std::string& place,
                                   const PerimeterFileOptions& options,
                                   std::vector<std::string>& warnings) {
  return Interpreter(place, options, warnings).series(std::move(features));
}

const std::vector<std::string>& time_names() {
  static const std::vector<std::string> names{"seconds",    "time_s", "time_utc",
                                              "time_local", "time",   "datetime",
                                              "timestamp",  "date"};
  return names;
}

bool is_plain_seconds(const std::string& name) {
  return bare(name) == "seconds" || bare(name) == "times";
}

}  // namespace skein::environment
