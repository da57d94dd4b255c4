// SPDX-License-Identifier: Apache-2.0
// Propagation, antennas and error models: one row each.
#include "skein/assemble/radio/radio_parts.h"

#include <fmt/format.h>

#include <utility>

#include "skein/layer/communication/antenna/antenna_pattern.h"
#include "skein/layer/communication/medium/error_model.h"
#include "skein/layer/communication/propagation/obstructed.h"
#include "skein/layer/communication/propagation/path_loss.h"

namespace skein::assemble {
namespace {

using communication::Cck;
using scenario::Fields;

// Their keys are those of the section.
struct NoKeys {};

// Adds a row whose options are none.
template <class Product, class Context, class Make>
void add(Kinds<Product, Context>& kinds, const char* name, const char* help, Make make) {
  kinds.add(name, help, Fields<NoKeys>(),
            [make](const NoKeys&, const Context& c) { return make(c); });
}

Kinds<Propagation, PropagationContext> propagation_kinds() {
  using Context = PropagationContext;
  Kinds<Propagation, Context> kinds("propagation");
  add(kinds, "free-space", "With the distance squared.", [](const Context& c) {
    return std::make_unique<communication::FreeSpace>(c.frequency);
  });
  add(kinds, "fixed", "All arrive with `received_power_dbm`.", [](const Context& c) {
    return std::make_unique<communication::FixedPower>(c.section.received_power_dbm);
  });
  add(kinds, "log-distance",
      "With the distance to the power of `exponent`, and shadowing.",
      [](const Context& c) {
        return std::make_unique<communication::LogDistance>(c.frequency, c.section,
                                                            c.seed);
      });
  add(kinds, "two-ray",
      "Free space nearby, over level ground with the distance to the fourth; with "
      "heights above the run's terrain, in `skein net` above z = 0.",
      [](const Context& c) {
        return std::make_unique<communication::TwoRay>(
            c.frequency, c.section.antenna_height, c.ground);
      });
  return kinds;
}

Kinds<Antenna, AntennaContext> antenna_kinds() {
  using Context = AntennaContext;
  Kinds<Antenna, Context> kinds("antenna");
  add(kinds, "isotropic", "In all directions alike.",
      [](const Context&) { return std::make_unique<communication::Isotropic>(); });
  add(kinds, "dipole", "A half-wave dipole, upright in the body.", [](const Context& c) {
    return std::make_unique<communication::VerticalDipole>(c.section.min_gain_db);
  });
  add(kinds, "shadowed-by-body",
      "In all directions but those in which airframe and motor are in the way.",
      [](const Context& c) {
        return std::make_unique<communication::BodyShadow>(c.section);
      });
  add(kinds, "table", "By a table over azimuth and elevation.",
      [](const Context& c) -> Result<std::unique_ptr<Antenna>> {
        if (c.section.azimuths.empty() || c.section.elevations.empty())
          return Error{ErrorCode::kBadInput, "azimuths_deg", "the table is empty.", ""};
        return std::unique_ptr<Antenna>(
            std::make_unique<communication::GainTable>(c.section));
      });
  return kinds;
}

constexpr double kDsss1 = 1e6, kDsss2 = 2e6, kCck4 = 5.5e6, kCck8 = 11e6;  // [bit/s]
constexpr std::pair<std::string_view, double> kRates[] = {
    {"dsss-1", kDsss1}, {"dsss-2", kDsss2}, {"cck-5-5", kCck4}, {"cck-11", kCck8}};

Kinds<ErrorModel, ErrorModelContext> error_model_kinds() {
  using Context = ErrorModelContext;
  Kinds<ErrorModel, Context> kinds("error-model");
  add(kinds, "dsss-1", "IEEE 802.11 DSSS at 1 Mbit/s: DBPSK.",
      [](const Context&) { return std::make_unique<communication::Dsss1>(); });
  add(kinds, "dsss-2", "IEEE 802.11 DSSS at 2 Mbit/s: DQPSK.",
      [](const Context& c) { return std::make_unique<communication::Dsss2>(c.rate); });
  add(kinds, "cck-5-5", "IEEE 802.11b CCK at 5.5 Mbit/s.",
      [](const Context&) { return std::make_unique<Cck>(Cck::Bits::kFour); });
  add(kinds, "cck-11", "IEEE 802.11b CCK at 11 Mbit/s.",
      [](const Context&) { return std::make_unique<Cck>(Cck::Bits::kEight); });
  add(kinds, "fsk",
      "Binary frequency shift keying, detected without the carrier's phase, at up to "
      "half of `noise_bandwidth_hz`.",
      [](const Context& c) {
        return std::make_unique<communication::NoncoherentFsk>(c.rate, c.noise_bandwidth);
      });
  add(kinds, "threshold", "No errors at `lock_sinr_db` and above, all lost below.",
      [](const Context& c) {
        return std::make_unique<communication::ThresholdErrors>(c.lock_ratio);
      });
  return kinds;
}

}  // namespace

RadioParts own_radio_parts() {
  return {propagation_kinds(), antenna_kinds(), error_model_kinds()};
}

scenario::KindTable radio_table(const RadioParts& parts) {
  scenario::KindTable table;
  parts.propagation.describe(table);
  parts.antenna.describe(table);
  parts.error_model.describe(table);
  return table;
}

Result<std::unique_ptr<Propagation>> make_propagation(const RadioParts& parts,
                                                      const PropagationChoice& choice,
                                                      double frequency,
                                                      std::uint64_t seed,
                                                      const Terrain* ground) {
  auto open =
      parts.propagation.make(choice.model, {seed, frequency, choice.section, ground});
  if (!open || choice.section.obstacles.empty()) return open;
  return std::unique_ptr<Propagation>(std::make_unique<communication::Obstructed>(
      std::move(open).value(), choice.section.obstacles));
}

Result<std::shared_ptr<const Antenna>> make_antenna(const RadioParts& parts,
                                                    const AntennaChoice& choice) {
  auto made = parts.antenna.make(choice.model, {choice.section});
  if (!made) return made.error();
  // What is alike in all directions is not looked at for each link.
  if (dynamic_cast<const communication::Isotropic*>(made.value().get()))
    return std::shared_ptr<const Antenna>();
  return std::shared_ptr<const Antenna>(std::move(made).value());
}

std::string rate_violation(const scenario::Choice& error_model,
                           const ErrorModelContext& context) {
  if (error_model.kind == "fsk" && context.rate > context.noise_bandwidth / 2)
    return fmt::format(
        "must be at most half of noise_bandwidth_hz with error_model fsk, "
        "{}.",
        context.noise_bandwidth / 2);
  for (const auto& [kind, rate] : kRates)
    if (error_model.kind == kind && context.rate != rate)
      return fmt::format(
          "must be {} with error_model {}. Others: 1000000 is dsss-1, 2000000 dsss-2, "
          "5500000 cck-5-5, 11000000 cck-11; threshold takes any rate, fsk up to half of "
          "noise_bandwidth_hz.",
          rate, kind);
  return "";
}

}  // namespace skein::assemble
