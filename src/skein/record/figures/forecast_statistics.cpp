// SPDX-License-Identifier: Apache-2.0
#include "skein/record/figures/forecast_statistics.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace skein::record {
namespace {

// Of a distribution that is linear between its steps, against a fire that came at
// `reached` or not yet.
double crps(const ArrivalForecast& forecast, std::optional<Time> reached) {
  double sum = 0;
  for (std::size_t k = 1; k < forecast.steps.size(); ++k) {
    const ArrivalStep &a = forecast.steps[k - 1], &b = forecast.steps[k];
    const double length = (b.time - a.time).seconds();
    // The fire comes a share of the step after its begin.
    double share = 1;
    if (reached) share = std::clamp((*reached - a.time).seconds() / length, 0.0, 1.0);
    const double middle = a.probability + share * (b.probability - a.probability);
    const auto square = [](double from, double to) {  // mean of a linear function's
      return (from * from + from * to + to * to) / 3;
    };
    sum += length * (share * square(a.probability, middle) +
                     (1 - share) * square(1 - middle, 1 - b.probability));
  }
  return sum;
}

}  // namespace

void ForecastStatistics::forecast(const ForecastRecord& record) {
  open_.emplace(record.forecast.boundary.time, record);
}

void ForecastStatistics::arrival(const ArrivalRecord& record) {
  arrivals_.push_back(record.forecast);
  places_[{record.forecast.phenomenon, record.forecast.place}].point =
      record.forecast.point;
}

void ForecastStatistics::truth(Time time, std::uint32_t phenomenon,
                               const TrueBoundary& truth) {
  last_ = std::max(last_, time);
  for (auto& [key, place] : places_)
    if (key.first == phenomenon && !place.reached && truth.index().contains(place.point))
      place.reached = time;
  for (auto it = open_.begin(); it != open_.end() && it->first <= time;) {
    const ForecastRecord& record = it->second;
    if (record.forecast.phenomenon != phenomenon) {
      ++it;
      continue;
    }
    ForecastScore scored{{record.believer, record.forecast.mission},
                         record.forecast.made,
                         it->first,
                         perimeter_metrics(truth, record.forecast.boundary)};
    score(scored);
    scores_.push_back(std::move(scored));
    it = open_.erase(it);
  }
}

void ForecastStatistics::score(const ForecastScore& score) {
  if (std::find(believers_.begin(), believers_.end(), score.who) == believers_.end())
    believers_.push_back(score.who);
  std::vector<Mean>& means = means_[{score.who, (score.time - score.made).ns()}];
  means.resize(metric_fields().size());
  for (std::size_t k = 0; k < means.size(); ++k) {
    const auto value = score.metrics.*metric_fields()[k].value;
    if (!value) continue;
    means[k].sum += *value;
    ++means[k].count;
  }
}

std::vector<ForecastScore> ForecastStatistics::take_scores() {
  return std::exchange(scores_, {});
}

void ForecastStatistics::add_figures(std::map<std::string, double>& figures) const {
  for (const auto& [horizon, means] : means_) {
    const auto& [who, ns] = horizon;
    const std::string prefix =
        (who == believers_.front() ? "" : "mission_" + who.mission + "_") +
        fmt::format("forecast_{:g}s_", Time::from_ns(ns).seconds());
    for (std::size_t k = 0; k < means.size(); ++k) {
      const MetricField& field = metric_fields()[k];
      if (means[k].count > 0)
        figures[prefix + std::string(field.name) + "_mean" + std::string(field.unit)] =
            means[k].sum / means[k].count;
    }
  }
  for (const auto& [key, place] : places_) {
    if (!place.reached) continue;
    const double reached = place.reached->seconds();
    const auto [figure, first] =
        figures.try_emplace("arrival_" + key.second + "_s", reached);
    figure->second = std::min(figure->second, reached);
  }
  Mean mean;
  for (const ArrivalForecast& forecast : arrivals_) {
    const Place& place = places_.at({forecast.phenomenon, forecast.place});
    if (forecast.steps.empty() || forecast.steps.back().time > last_) continue;
    mean.sum += crps(forecast, place.reached);
    ++mean.count;
  }
  if (mean.count > 0) figures["arrival_crps_mean_s"] = mean.sum / mean.count;
}

}  // namespace skein::record
