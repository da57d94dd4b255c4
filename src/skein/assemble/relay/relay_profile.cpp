// SPDX-License-Identifier: Apache-2.0
#include "skein/assemble/relay/relay_profile.h"

#include <fmt/format.h>

#include <utility>

#include "skein/assemble/relay/relay_fields.h"

namespace skein::assemble {
namespace {

using impairment::Direction;
using impairment::Directions;
using impairment::Impairment;
using impairment::ImpairmentChange;
using impairment::TimedChange;
using scenario::Fields;

Fields<ImpairmentChange> one_way_fields() {
  Fields<ImpairmentChange> fields;
  add_impairment_keys<ImpairmentChange>(fields, [](auto member) { return member; });
  return fields;
}

Fields<RelayOutage> relay_outage_fields() {
  using T = RelayOutage;
  return Fields<T>()
      .duration_s("from_s", &T::from, "When it begins.")
      .duration_s("until_s", &T::until, "When it ends.")
      .rule("until_s", [](const T& t) -> std::string {
        return t.until >= t.from ? "" : "must not be before from_s.";
      });
}

Fields<TimedChange> change_fields() {
  using T = TimedChange;
  Fields<T> fields;
  fields.duration_s("at_s", &T::at, "When, after the begin of the relay.")
      .required()
      .word("direction", &T::directions, "Which way.",
            {{"both", Directions::kBoth, "both ways"},
             {"to-b", Directions::kToB, "from those who call to the target"},
             {"to-a", Directions::kToA, "back"}});
  add_impairment_keys<ImpairmentChange>(fields, [](auto member) {
    return [member](T & t) -> auto& {
      return t.change.*member;
    };
  });
  return fields;
}

Fields<RelayProfile> profile_fields() {
  using T = RelayProfile;
  Fields<T> fields;
  fields.text("name", &T::name, "What it is called.")
      .text("description", &T::description, "One line about it.");
  add_impairment_keys<Impairment>(fields, [](auto member) {
    return [member](T & t) -> auto& {
      return t.both.*member;
    };
  });
  fields
      .object("to_b", &T::to_b, one_way_fields(),
              "What is different from those who call to the target; null: nothing.")
      .object("to_a", &T::to_a, one_way_fields(),
              "What is different on the way back; null: nothing.")
      .object("outages", &T::outages, relay_outage_fields(),
              "Outages at given times, both ways.")
      .number("outages_per_hour", &T::outages_per_hour,
              "Further ones by chance, mean number in an hour without.",
              {.at_least = 0, .at_most = 3600})
      .duration_s("outage_mean_s", &T::outage_mean, "Mean length of those by chance.",
                  {.above = 0, .at_most = 86400})
      .object("changes", &T::changes, change_fields(),
              "New values from given times on; what is null or not given stays.");
  return fields;
}

Result<RelayProfile> outcome(const scenario::Reading& reading, RelayProfile profile) {
  if (reading.ok()) return profile;
  std::string report = reading.report();
  report.pop_back();  // the last line feed
  return Error{ErrorCode::kBadInput, "", std::move(report), ""};
}

ImpairmentChange packet_part_of(const Impairment& both) {
  return {.loss = both.loss, .duplicate = both.duplicate, .reorder = both.reorder};
}

}  // namespace

const scenario::Document& relay_document() {
  static const scenario::Document document = {
      profile_fields().description(),
      "a relay profile",
      "Give it keys such as delay_s and loss.",
      "the relay does not begin",
      "Skein relay profile",
      "# Keys of a relay profile\n\n"
      "Written by the program (`skein keys relay`) from the description that also reads "
      "and checks the files. The unit of a number ends its key. [relay.md](relay.md) "
      "says "
      "what a relay does.\n\n## Relay profile\n\n"};
  return document;
}

Result<RelayProfile> load_relay_profile(const std::filesystem::path& file,
                                        const std::vector<std::string>& overrides) {
  std::vector<scenario::Override> changes;
  for (const std::string& each : overrides) changes.push_back({each});
  RelayProfile profile;
  const auto reading =
      file.empty()
          ? scenario::read_document_text("{}", "relay", {}, relay_document(),
                                         scenario::KindTable{}, changes, &profile)
          : scenario::read_document(file, relay_document(), scenario::KindTable{},
                                    changes, &profile);
  return outcome(reading, std::move(profile));
}

Result<RelayProfile> read_relay_profile(std::string_view text, const std::string& name) {
  RelayProfile profile;
  const auto reading = scenario::read_document_text(text, name, {}, relay_document(),
                                                    scenario::KindTable{}, {}, &profile);
  return outcome(reading, std::move(profile));
}

std::string write_relay_profile(const RelayProfile& profile) {
  return scenario::write_document(relay_document(), &profile, scenario::KindTable{});
}

impairment::ImpairmentPlan plan_of(const RelayProfile& profile) {
  impairment::ImpairmentPlan plan;
  plan.first = {profile.both, profile.both};
  apply(profile.to_b, plan.first[index_of(Direction::kToB)]);
  apply(profile.to_a, plan.first[index_of(Direction::kToA)]);
  plan.changes = profile.changes;
  for (const RelayOutage& outage : profile.outages)
    plan.outages.spans.push_back({outage.from.seconds(), outage.until.seconds()});
  plan.outages.per_hour = profile.outages_per_hour;
  plan.outages.mean_duration = profile.outage_mean;
  return plan;
}

std::optional<std::string> packet_key_of(const ImpairmentChange& change) {
  if (change.loss.value_or(0) > 0) return "loss";
  if (change.duplicate.value_or(0) > 0) return "duplicate";
  if (change.reorder.value_or(0) > 0) return "reorder";
  return std::nullopt;
}

Result<void> check_for_streams(const RelayProfile& profile) {
  const auto error_of = [](const std::string& path, const ImpairmentChange& change) {
    const auto key = packet_key_of(change);
    return key ? path + *key : "";
  };
  std::string key = error_of("", packet_part_of(profile.both));
  if (key.empty()) key = error_of("to_b.", profile.to_b);
  if (key.empty()) key = error_of("to_a.", profile.to_a);
  for (std::size_t k = 0; k < profile.changes.size() && key.empty(); ++k)
    key = error_of(fmt::format("changes[{}].", k), profile.changes[k].change);
  if (key.empty()) return {};
  return Error{ErrorCode::kBadInput, key,
               "a TCP connection neither loses, doubles nor reorders bytes: it would "
               "break.",
               "Use delay_s, rate_bps and outages, or relay UDP."};
}

}  // namespace skein::assemble
