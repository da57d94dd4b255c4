// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include "skein/base/time.h"
#include "skein/role/error_model.h"

namespace skein::communication {

/// What becomes of a frame with a packet error ratio between 0 and 1.
enum class PacketError {
  kRandom,  ///< lost with that probability
  kHalf,    ///< lost if and only if the ratio is at least 0.5: for repeatable traces
};

/// What a transceiver does with signals. Levels in dBm are powers after the antenna.
struct PhyProfile {
  double frequency = 2.4e9;                       ///< [Hz]
  double rate = 2e6;                              ///< of all payloads [bit/s]
  Time preamble_header = Time::from_ns(192'000);  ///< before every payload
  double transmit_power_dbm = 15;
  double transmit_gain_db = 0;
  double receive_gain_db = 0;
  double decode_threshold_dbm = -90;         ///< weaker frames are not received
  double carrier_sense_threshold_dbm = -90;  ///< of the sum of all signals
  double interference_floor_dbm = -101;      ///< weaker signals do not exist
  double noise_temperature = 290;            ///< [K]
  double noise_bandwidth = 20e6;             ///< [Hz]
  double noise_figure_db = 7;
  Time lock_window = Time::from_ns(4'000);  ///< from a frame's start to its detection
  double lock_sinr_db = 4;                  ///< least ratio at that moment
  std::shared_ptr<const ErrorModel> error_model;  ///< null: Dsss2 of the rate
  PacketError packet_error = PacketError::kRandom;

  /// How long a frame of so many bytes is on the air.
  Time airtime(std::uint32_t bytes) const {
    return preamble_header + Time::from_seconds(bytes * 8.0 / rate);
  }
};

/// How nodes share the medium.
enum class AccessMethod {
  kDcf,     ///< carrier sense and back-off, as IEEE 802.11
  kTdma,    ///< a slot for each node, in turn
  kDirect,  ///< a line for each node, nothing to share
};

/// When a station may send. Without another word the keys are those of the distributed
/// coordination function of IEEE 802.11.
struct MacProfile {
  AccessMethod access = AccessMethod::kDcf;
  Time slot = Time::from_ns(20'000);  ///< of the back-off; of TDMA: that a node sends in
  Time sifs = Time::from_ns(10'000);
  Time difs = Time::from_ns(50'000);
  Time eifs = Time::from_ns(364'000);         ///< instead of DIFS after a failed payload
  Time ack_timeout = Time::from_ns(222'000);  ///< from the end of the own frame
  std::uint32_t cw_min = 31, cw_max = 1023;   ///< slots
  /// Slots of every back-off; none: uniform in [0, contention window].
  std::optional<std::uint32_t> backoff_slots;
  /// Unicasts whose frame is larger are announced by RTS and CTS; 65535 = never.
  std::uint32_t rts_threshold_bytes = 65535;
  std::uint32_t short_retry_limit = 7;  ///< transmissions without RTS; RTS in a row
  std::uint32_t long_retry_limit = 4;   ///< transmissions announced by RTS
  std::uint32_t queue_packets = 10;     ///< with the one in service; more are refused
  std::optional<Time> queue_lifetime;   ///< older ones that wait are dropped; none: never
  std::uint32_t data_overhead_bytes = 36;  ///< around the payload of a data frame
  /// Longer messages of a run go in parts of so much (MediumRadio).
  std::uint32_t part_bytes = 1500;
  /// Unicasts and their acknowledgements are sent with the power that they need
  /// (PowerControl); kDcf only.
  bool adaptive_power = false;
  double power_margin_db = 6;  ///< above the decode threshold
  double power_step_db = 3;    ///< more after a failure
  double min_power_dbm = -20;
  Time latency;     ///< of kDirect: from the last bit's start to its arrival
  double loss = 0;  ///< of kDirect: probability that a receiver misses a packet
};

/// A kind of radio: transceiver and access to the medium.
struct RadioProfile {
  PhyProfile phy;
  MacProfile mac;
};

}  // namespace skein::communication
