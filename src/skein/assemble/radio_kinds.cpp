// Radios: one row each.

#include "skein/assemble/kinds_of.h"
#include "skein/assemble/ranges.h"
#include "skein/assemble/team_setup.h"
#include "skein/layer/communication/ideal_radio.h"

namespace skein::assemble {
namespace {

using scenario::Fields;
using scenario::Range;

constexpr Range kProbability{.at_least = 0, .at_most = 1};

Fields<communication::IdealRadioOptions> ideal_fields() {
  using T = communication::IdealRadioOptions;
  return Fields<T>()
      .duration_s("delay_s", &T::delay, "From sending to arrival.")
      .duration_s("jitter_s", &T::jitter, "Further delay, uniform between 0 and this.")
      .number("loss", &T::loss, "Probability that a message is lost.", kProbability)
      .number("range_m", &T::range, "Messages that go further are lost; 0: no limit.",
              kNotNegative)
      .number("outages_per_hour", &T::outages_per_hour,
              "How often an entity's modem neither sends nor receives for a while: mean "
              "number in an hour without.",
              {.at_least = 0, .at_most = 3600})
      .duration_s("outage_mean_s", &T::outage_mean, "Mean length of these.",
                  {.above = 0, .at_most = 86400});
}

}  // namespace

double radio_range(const scenario::Choice& radio) {
  const auto* ideal = std::any_cast<communication::IdealRadioOptions>(&radio.options);
  return ideal ? ideal->range : 0;
}

Kinds<Radio, RadioContext> radio_kinds() {
  Kinds<Radio, RadioContext> kinds("radio");
  kinds.add("ideal", "No medium: messages arrive after a delay, or are lost by chance.",
            ideal_fields(),
            [](const communication::IdealRadioOptions& o, const RadioContext& c) {
              return std::make_unique<communication::IdealRadio>(o, c.seed, c.position);
            });
  return kinds;
}

}  // namespace skein::assemble
