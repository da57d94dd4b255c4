// SPDX-License-Identifier: Apache-2.0
// The keys of radio files.
#include "skein/assemble/radio/radio_fields.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>

#include "skein/base/math.h"
#include "skein/scenario/numbers.h"

namespace skein::assemble {
namespace {

using communication::AccessMethod;
using communication::MacProfile;
using communication::PacketError;
using communication::PhyProfile;
using communication::PropagationProfile;
using scenario::Fields;
using scenario::Range;

constexpr Range kLevel{.at_least = -200, .at_most = 100};          // [dBm]
constexpr Range kGain{.at_least = -100, .at_most = 100};           // [dB]
constexpr Range kMicroseconds{.at_least = 0.001, .at_most = 1e6};  // whole nanoseconds
constexpr double kMinLifetime = 1e-9, kMaxLifetime = 86400;        // [s]
constexpr std::uint32_t kMaxSlots = 65535;

Time from_us(double us) {
  return Time::from_ns(std::llround(us * 1e3));
}

double in_us(Time time) {
  return static_cast<double>(time.ns()) / 1e3;
}

std::optional<std::uint32_t> slots_in(const std::string& text) {
  std::uint32_t slots = 0;
  const char* end = text.data() + text.size();
  const auto [rest, error] = std::from_chars(text.data(), end, slots);
  if (error != std::errc() || rest != end || slots > kMaxSlots) return std::nullopt;
  return slots;
}

std::optional<double> lifetime_in(const std::string& text) {
  const auto seconds = scenario::parse_number(text);
  if (!seconds || !(*seconds >= kMinLifetime && *seconds <= kMaxLifetime))
    return std::nullopt;
  return seconds;
}

scenario::Word<AccessMethod> word_of(const AccessWord& access) {
  return {access.name, access.method, access.help};
}

}  // namespace

Fields<PhySection> phy_fields() {
  using T = PhySection;
  const auto in = [](auto member) {
    return [member](T & t) -> auto& {
      return t.phy.*member;
    };
  };
  return Fields<T>()
      .number("frequency_hz", in(&PhyProfile::frequency), "Of the carrier.",
              {.at_least = 1e5, .at_most = 1e12})
      .number("rate_bps", in(&PhyProfile::rate), "Of the payload of all frames.",
              {.at_least = 1, .at_most = 1e12})
      .number("preamble_header_us", &T::preamble_header_us,
              "Before the payload of every frame.", {.at_least = 60, .at_most = 1e6})
      .number("transmit_power_dbm", in(&PhyProfile::transmit_power_dbm),
              "Of nodes that have none of their own.", kLevel)
      .number("transmit_gain_db", in(&PhyProfile::transmit_gain_db),
              "Of the sending antenna.", kGain)
      .number("receive_gain_db", in(&PhyProfile::receive_gain_db),
              "Of the receiving antenna.", kGain)
      .number("decode_threshold_dbm", in(&PhyProfile::decode_threshold_dbm),
              "Weaker frames are not received.", kLevel)
      .number("carrier_sense_threshold_dbm", in(&PhyProfile::carrier_sense_threshold_dbm),
              "From this sum of all signals on the medium is busy.", kLevel)
      .number("interference_floor_dbm", in(&PhyProfile::interference_floor_dbm),
              "Weaker signals do not exist.", kLevel)
      .number("noise_temperature_k", in(&PhyProfile::noise_temperature), "Of the noise.",
              {.at_least = 1, .at_most = 1e5})
      .number("noise_bandwidth_hz", in(&PhyProfile::noise_bandwidth), "Of the receiver.",
              {.at_least = 1, .at_most = 1e12})
      .number("noise_figure_db", in(&PhyProfile::noise_figure_db), "Of the receiver.",
              kGain)
      .number("lock_window_us", &T::lock_window_us,
              "From a frame's first bit to its detection, shorter than the preamble.",
              {.at_least = 0.001, .at_most = 1e5})
      .number("lock_sinr_db", in(&PhyProfile::lock_sinr_db),
              "Least ratio of signal to noise and interference at that moment.", kGain)
      .kind(
          "error_model", &T::error_model, "error-model",
          "How errors follow from that ratio, by the modulation. It goes with the rate.")
      .word("packet_error", in(&PhyProfile::packet_error),
            "What becomes of a frame with a packet error ratio between 0 and 1.",
            {{"random", PacketError::kRandom, "lost with that probability"},
             {"half", PacketError::kHalf, "lost if and only if it is at least 0.5"}})
      .rule("lock_window_us",
            [](const T& t) -> std::string {
              return t.lock_window_us < t.preamble_header_us
                         ? ""
                         : "must be shorter than preamble_header_us.";
            })
      .rule("interference_floor_dbm", [](const T& t) -> std::string {
        return t.phy.interference_floor_dbm <= t.phy.decode_threshold_dbm
                   ? ""
                   : "must not be above decode_threshold_dbm.";
      });
}

Fields<PropagationSection> propagation_fields() {
  using T = PropagationSection;
  const auto in = [](auto member) {
    return [member](T & t) -> auto& {
      return t.propagation.*member;
    };
  };
  return Fields<T>()
      .kind("model", &T::model, "propagation", "How signals get weaker on their way.")
      .number("received_power_dbm", in(&PropagationProfile::received_power_dbm),
              "Of `fixed`.", kLevel)
      .number("exponent", in(&PropagationProfile::exponent), "Of `log-distance`.",
              {.at_least = 1, .at_most = 10})
      .number("reference_distance_m", in(&PropagationProfile::reference_distance),
              "Of `log-distance`: up to there it is free space.",
              {.at_least = 0.1, .at_most = 1e5})
      .number("shadowing_db", in(&PropagationProfile::shadowing_db),
              "Of `log-distance`: standard deviation of what obstacles take or give.",
              {.at_least = 0, .at_most = 40})
      .number("shadowing_distance_m", in(&PropagationProfile::shadowing_distance),
              "Of `log-distance`: over which shadowing is alike.",
              {.at_least = 1, .at_most = 1e5})
      .number("antenna_height_m", in(&PropagationProfile::antenna_height),
              "Of `two-ray`: above the place of a node.",
              {.at_least = 0, .at_most = 1000})
      .object("obstacles", &T::obstacles, obstacle_fields(),
              "What stands between nodes, with any model.")
      .items({.at_most = kMaxObstacles});
}

Fields<MacSection> mac_fields() {
  using T = MacSection;
  const auto in = [](auto member) {
    return [member](T & t) -> auto& {
      return t.mac.*member;
    };
  };
  return Fields<T>()
      .word(
          "access", in(&MacProfile::access), "How nodes share the medium.",
          {word_of(kAccessWords[0]), word_of(kAccessWords[1]), word_of(kAccessWords[2])})
      .number("slot_us", &T::slot_us,
              "A slot of the back-off; with `tdma` that a node sends in.", kMicroseconds)
      .number("sifs_us", &T::sifs_us, "Before an answer.", kMicroseconds)
      .number("difs_us", &T::difs_us, "That the medium is idle before slots count.",
              kMicroseconds)
      .number("eifs_us", &T::eifs_us, "The same after a frame that was not understood.",
              kMicroseconds)
      .number("ack_timeout_us", &T::ack_timeout_us,
              "From the end of a frame, for the header of its answer.", kMicroseconds)
      .integer("cw_min", in(&MacProfile::cw_min), "Contention window at first, in slots.",
               {.at_least = 0, .at_most = kMaxSlots})
      .integer("cw_max", in(&MacProfile::cw_max),
               "It doubles with each failure up to this.",
               {.at_least = 0, .at_most = kMaxSlots})
      .text("backoff_slots", &T::backoff_slots,
            "`random`: uniform in the contention window; a number: of every back-off.")
      .integer("rts_threshold_bytes", in(&MacProfile::rts_threshold_bytes),
               "Larger unicast frames are announced by RTS and CTS; 65535: none.",
               {.at_least = 0, .at_most = 65535})
      .integer("short_retry_limit", in(&MacProfile::short_retry_limit),
               "Transmissions without RTS; RTS in a row.",
               {.at_least = 1, .at_most = 255})
      .integer("long_retry_limit", in(&MacProfile::long_retry_limit),
               "Transmissions that RTS announced.", {.at_least = 1, .at_most = 255})
      .integer("queue_packets", in(&MacProfile::queue_packets),
               "That wait at a node, with the one in service; more are refused.",
               {.at_least = 1, .at_most = 100'000})
      .text("queue_lifetime_s", &T::queue_lifetime_s,
            "Older packets are dropped before they are sent; `none`: never.")
      .integer("data_overhead_bytes", in(&MacProfile::data_overhead_bytes),
               "Of headers and check sequence around the payload of a data frame.",
               {.at_least = 1, .at_most = 1000})
      .integer("part_bytes", in(&MacProfile::part_bytes),
               "In a run longer messages go in parts of so much.",
               {.at_least = 20, .at_most = 65'000})
      .boolean("adaptive_power", in(&MacProfile::adaptive_power),
               "With `dcf`: unicasts and their acknowledgements go with the power that "
               "they need, all else with full power.")
      .number("power_margin_db", in(&MacProfile::power_margin_db),
              "With `adaptive_power`: by how much they arrive above "
              "phy.decode_threshold_dbm.",
              {.at_least = 0, .at_most = 100})
      .number("power_step_db", in(&MacProfile::power_step_db),
              "With `adaptive_power`: so much more after each failure.",
              {.at_least = 0, .at_most = 30})
      .number("min_power_dbm", in(&MacProfile::min_power_dbm),
              "With `adaptive_power`: never less, but for nodes that have less.", kLevel)
      .duration_s("latency_s", in(&MacProfile::latency),
                  "With `direct`: from the end of a packet to its arrival.",
                  {.at_least = 0, .at_most = 3600})
      .number("loss", in(&MacProfile::loss),
              "With `direct`: probability that a receiver misses a packet.",
              {.at_least = 0, .at_most = 1})
      .rule("cw_max",
            [](const T& t) -> std::string {
              return t.mac.cw_min <= t.mac.cw_max ? "" : "must not be below cw_min.";
            })
      .rule("difs_us",
            [](const T& t) -> std::string {
              return t.mac.access != AccessMethod::kDcf || t.sifs_us < t.difs_us
                         ? ""
                         : "must be longer than sifs_us: answers come first.";
            })
      .rule("adaptive_power",
            [](const T& t) -> std::string {
              return !t.mac.adaptive_power || t.mac.access == AccessMethod::kDcf
                         ? ""
                         : "needs access: dcf; nothing else acknowledges.";
            })
      .rule("backoff_slots",
            [](const T& t) -> std::string {
              if (t.backoff_slots == "random" || slots_in(t.backoff_slots)) return "";
              return fmt::format(
                  "found {}; needs \"random\" or a whole number from 0 to {}.",
                  t.backoff_slots, kMaxSlots);
            })
      .rule("queue_lifetime_s", [](const T& t) -> std::string {
        if (t.queue_lifetime_s == "none" || lifetime_in(t.queue_lifetime_s)) return "";
        return fmt::format("found {}; needs \"none\" or a number from {} to {}.",
                           t.queue_lifetime_s, kMinLifetime, kMaxLifetime);
      });
}

PhyProfile phy_of(const PhySection& section) {
  PhyProfile phy = section.phy;
  phy.preamble_header = from_us(section.preamble_header_us);
  phy.lock_window = from_us(section.lock_window_us);
  return phy;
}

ErrorModelContext error_model_context(const PhyProfile& phy) {
  return {phy.rate, math::pow(10, phy.lock_sinr_db / 10), phy.noise_bandwidth};
}

PropagationChoice propagation_of(const PropagationSection& section) {
  PropagationChoice propagation{section.model, section.propagation};
  for (const ObstacleSection& each : section.obstacles)
    propagation.section.obstacles.push_back(obstacle_of(each));
  return propagation;
}

MacProfile mac_of(const MacSection& section) {
  MacProfile mac = section.mac;
  mac.slot = from_us(section.slot_us);
  mac.sifs = from_us(section.sifs_us);
  mac.difs = from_us(section.difs_us);
  mac.eifs = from_us(section.eifs_us);
  mac.ack_timeout = from_us(section.ack_timeout_us);
  mac.backoff_slots = slots_in(section.backoff_slots);
  if (const auto seconds = lifetime_in(section.queue_lifetime_s))
    mac.queue_lifetime = Time::from_seconds(*seconds);
  return mac;
}

PhySection section_of(const PhyProfile& phy, const scenario::Choice& error_model) {
  return {phy, error_model, in_us(phy.preamble_header), in_us(phy.lock_window)};
}

PropagationSection section_of(const PropagationChoice& propagation) {
  PropagationSection section{propagation.model, propagation.section, {}};
  section.propagation.obstacles.clear();
  for (const communication::Obstacle& each : propagation.section.obstacles)
    section.obstacles.push_back(section_of(each));
  return section;
}

MacSection section_of(const MacProfile& mac) {
  MacSection section;
  section.mac = mac;
  section.slot_us = in_us(mac.slot);
  section.sifs_us = in_us(mac.sifs);
  section.difs_us = in_us(mac.difs);
  section.eifs_us = in_us(mac.eifs);
  section.ack_timeout_us = in_us(mac.ack_timeout);
  if (mac.backoff_slots) section.backoff_slots = std::to_string(*mac.backoff_slots);
  if (mac.queue_lifetime)
    section.queue_lifetime_s = fmt::format("{}", mac.queue_lifetime->seconds());
  return section;
}

}  // namespace skein::assemble
