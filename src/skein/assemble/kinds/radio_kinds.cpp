// SPDX-License-Identifier: Apache-2.0
// Radios: one row each.

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "skein/assemble/kinds/kind_registry.h"
#include "skein/assemble/kinds/kinds_of.h"
#include "skein/assemble/kinds/modem_setup.h"
#include "skein/assemble/kinds/radio_security.h"
#include "skein/assemble/kinds/ranges.h"
#include "skein/assemble/kinds/routine_periods.h"
#include "skein/assemble/kinds/team_setup.h"
#include "skein/assemble/radio/antenna_fields.h"
#include "skein/assemble/radio/obstacle_fields.h"
#include "skein/assemble/radio/radio_file.h"
#include "skein/layer/communication/ideal_radio.h"
#include "skein/layer/communication/medium_radio.h"
#include "skein/layer/communication/propagation/terrain_diffraction.h"
#include "skein/link/modem/modem_parts.h"

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

// A medium whose radio stands in a radio file.
struct MediumChoice {
  std::string profile = "wifi-dsss-2";
  std::string file;
  communication::MediumRadioOptions radio;  // without its profile and its security
  scenario::Choice routing{"none"};
  std::vector<ObstacleSection> obstacles;
  bool terrain = false;
  double terrain_step = 30;  // [m]
  std::optional<AntennaChoice> antenna, station_antenna;
  std::vector<AttackChoice> attacks;
  std::optional<AuthenticationChoice> authentication;
  std::optional<ModemChoice> modem;
};

Fields<MediumChoice> medium_fields() {
  using T = MediumChoice;
  return Fields<T>()
      .file("profile", &T::profile,
            "A built-in radio by its name (`skein list radio-profile`), or a radio file.",
            {.or_name = true})
      .file("file", &T::file, "A radio file instead; \"\": none.", {.may_be_empty = true})
      .duration_s("spread_s", [](T & t) -> auto& { return t.radio.spread; },
                  "Agents think at the same moments; their messages reach the radios "
                  "later, by up to this.",
                  {.at_least = 0, .at_most = 10})
      .kind("routing", &T::routing, "routing", "Who passes on what was for others.")
      .duration_s("advertisement_period_s",
                  [](T & t) -> auto& { return t.radio.advertisement_period; },
                  "Between a radio's words that it is there, by which others find their "
                  "neighbours; 0: none.",
                  {.at_least = 0, .at_most = 3600})
      .object("obstacles", &T::obstacles, obstacle_fields(),
              "What stands between radios, besides the obstacles of the radio file.")
      .items({.at_most = kMaxObstacles})
      .boolean("terrain", &T::terrain,
               "The ground takes from signals what diffraction at its edges takes.")
      .number("terrain_step_m", &T::terrain_step,
              "With `terrain`: between looks at the ground, of which each link has at "
              "most 64.",
              {.at_least = 1, .at_most = 1000})
      .object("antenna", &T::antenna, antenna_fields(),
              "Of aircraft, instead of that of the radio. Null: that one.")
      .object("station_antenna", &T::station_antenna, antenna_fields(),
              "The same for ground stations.")
      .object("attacks", &T::attacks, attack_fields(),
              "Who disturbs the radio, or lies by it.")
      .items({.at_most = 100})
      .object("authentication", &T::authentication, authentication_fields(),
              "Messages carry a tag of the team's key, and so does what goes over the "
              "modem; null: none.")
      .object(
          "modem", &T::modem, modem_fields(),
          "A real modem in the same medium: the messages of some entities go over it.");
}

Result<RadioFile> load(const MediumChoice& choice, const RadioParts& parts) {
  return load_radio(choice.file.empty() ? choice.profile : choice.file, {}, parts);
}

// Signals of a run on their way.
Result<std::unique_ptr<Propagation>> propagation_in_run(const MediumChoice& choice,
                                                        const RadioFile& file,
                                                        const RadioContext& context) {
  RadioFile radio = file;
  for (const ObstacleSection& each : choice.obstacles)
    radio.propagation.section.obstacles.push_back(obstacle_of(each));
  auto made = make_propagation(radio, context.seed, context.terrain);
  if (!made || !choice.terrain) return made;
  if (!context.terrain)
    return Error{ErrorCode::kBadInput, "terrain", "there is no terrain here.", ""};
  return std::unique_ptr<Propagation>(std::make_unique<communication::TerrainDiffraction>(
      std::move(made).value(), *context.terrain, file.radio.phy.frequency,
      choice.terrain_step));
}

// Antennas of all entities of a run.
Result<communication::NodeAntennas> antennas_in_run(const MediumChoice& choice,
                                                    const RadioFile& file,
                                                    const RadioContext& context) {
  const auto aircraft = make_antenna(file.parts, choice.antenna.value_or(file.antenna));
  if (!aircraft) return aircraft.error();
  const auto station =
      make_antenna(file.parts, choice.station_antenna.value_or(file.station_antenna));
  if (!station) return station.error();
  communication::NodeAntennas antennas;
  if (!aircraft.value() && !station.value()) return antennas;
  antennas.of.assign(context.entities, aircraft.value());
  for (std::size_t k = 0; k < std::min(context.stations, context.entities); ++k)
    antennas.of[k] = station.value();
  if (context.attitude)
    antennas.attitude = [attitude = context.attitude](communication::NodeIndex node,
                                                      Time) {
      return attitude(EntityId{node});
    };
  return antennas;
}

// How far its frames are understood where nothing interferes and nothing stands in the
// way [m]; 0: no limit.
double range_of(const RadioFile& file) {
  RadioFile open = file;
  open.propagation.section.obstacles.clear();
  open.propagation.section.shadowing_db = 0;  // as far in all directions
  const auto made = make_propagation(open, 0);
  if (!made) return 0;
  const auto& propagation = made.value();
  const auto& phy = file.radio.phy;
  const double radiated = communication::watts(
      phy.transmit_power_dbm + phy.transmit_gain_db + phy.receive_gain_db);
  const double threshold = communication::watts(phy.decode_threshold_dbm);
  const auto reached = [&](double distance) {
    return propagation->received(radiated, Vec3::Zero(), Vec3(distance, 0, 0)) >=
           threshold;
  };
  double near = 1, far = 1e7;
  if (reached(far)) return 0;
  while (far - near > 1) (reached((near + far) / 2) ? near : far) = (near + far) / 2;
  return near;
}

// Where the messages of real entities go by range alone; null: over the medium.
std::unique_ptr<Radio> by_range(const MediumChoice& choice, const RadioFile& file,
                                const RadioContext& context) {
  if (choice.modem->receive) return nullptr;
  communication::IdealRadioOptions options;
  options.range = range_of(file);
  return std::make_unique<communication::IdealRadio>(options, context.seed,
                                                     context.position);
}

// At whose node of the medium entities are reached: of those beyond the modem the first
// station. Empty: each at its own.
std::vector<EntityId> reached_at(const MediumChoice& choice,
                                 const RadioContext& context) {
  std::vector<EntityId> nodes;
  const bool altering = choice.modem && choice.modem->gateway == GatewayMethod::kAltering;
  if (!altering || !context.modem) return nodes;
  for (std::uint32_t k = 0; k < context.entities; ++k) {
    const bool beyond = context.modem->is_beyond(EntityId{k});
    nodes.push_back(beyond ? EntityId{0} : EntityId{k});
  }
  return nodes;
}

}  // namespace

const ModemChoice* modem_of(const scenario::Choice& radio) {
  const auto* medium = std::any_cast<MediumChoice>(&radio.options);
  return medium && medium->modem ? &*medium->modem : nullptr;
}

const AuthenticationChoice* authentication_of(const scenario::Choice& radio) {
  const auto* medium = std::any_cast<MediumChoice>(&radio.options);
  return medium && medium->authentication ? &*medium->authentication : nullptr;
}

double radio_range(const scenario::Choice& radio, const RadioParts& parts) {
  if (const auto* medium = std::any_cast<MediumChoice>(&radio.options)) {
    const auto file = load(*medium, parts);
    return file ? range_of(file.value()) : 0;
  }
  const auto* ideal = std::any_cast<communication::IdealRadioOptions>(&radio.options);
  return ideal ? ideal->range : 0;
}

double shared_rate(const scenario::Choice& radio, const RadioParts& parts) {
  const auto* medium = std::any_cast<MediumChoice>(&radio.options);
  if (!medium) return 0;
  const auto file = load(*medium, parts);
  if (!file) return 0;
  const auto& profile = file.value().radio;
  const bool shared = profile.mac.access != communication::AccessMethod::kDirect;
  return shared ? profile.phy.rate : 0;
}

Kinds<Radio, RadioContext> radio_kinds() {
  Kinds<Radio, RadioContext> kinds("radio");
  kinds.add("ideal", "No medium: messages arrive after a delay, or are lost by chance.",
            ideal_fields(),
            [](const communication::IdealRadioOptions& o, const RadioContext& c) {
              return std::make_unique<communication::IdealRadio>(o, c.seed, c.position);
            });
  kinds.add(
      "medium", "Messages fight for the air: carrier sense, collisions, queues, retries.",
      medium_fields(),
      [](const MediumChoice& o, const RadioContext& c) -> Result<std::unique_ptr<Radio>> {
        const auto file = load(o, *c.kinds);
        if (!file) return file.error();
        auto propagation = propagation_in_run(o, file.value(), c);
        if (!propagation) return propagation.error();
        auto antennas = antennas_in_run(o, file.value(), c);
        if (!antennas) return antennas.error();
        communication::MediumRadioOptions options = o.radio;
        options.profile = file.value().radio;
        auto attacks = make_attacks(o.attacks, c, options.profile.mac);
        if (!attacks) return attacks.error();
        options.attacks = std::move(attacks).value();
        if (o.authentication) {
          const auto authentication = make_authentication(*o.authentication);
          if (!authentication) return authentication.error();
          options.authentication = authentication.value();
        }
        auto routing = c.kinds->routing.make(o.routing, {c.seed, c.entities});
        if (!routing) return routing.error();
        const std::uint32_t head =
            communication::MediumRadio::part_head(*routing.value());
        if (options.profile.mac.part_bytes <= head)
          return Error{
              ErrorCode::kBadInput, "routing",
              fmt::format("adds {} bytes to each part of a message, of which the "
                          "radio's mac.part_bytes allows {}.",
                          head, options.profile.mac.part_bytes),
              "Take a radio with longer parts."};
        std::unique_ptr<Radio> medium = std::make_unique<communication::MediumRadio>(
            options, std::move(propagation).value(),
            communication::RadioNodes{c.entities, c.position, c.name,
                                      std::move(antennas).value(), reached_at(o, c)},
            c.seed, std::move(routing).value());
        if (!o.modem || !c.modem) return medium;
        return std::unique_ptr<Radio>(std::make_unique<modem::ModemRadio>(
            modem::ModemRadioParts{std::move(medium), by_range(o, file.value(), c),
                                   o.modem->inject},
            *c.modem));
      });
  return kinds;
}

}  // namespace skein::assemble
