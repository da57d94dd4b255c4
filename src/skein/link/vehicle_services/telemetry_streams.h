// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "skein/link/mavlink/constants.h"
#include "skein/link/vehicle_services/telemetry.h"

namespace skein::vehicle_services {

/// How often each message goes out over each link, by the run's clock.
///
/// A message goes out at most once in a step, and by the wall clock at most ten times as
/// often as asked for: a run that is faster does not flood its links. While the run
/// stands still nothing goes out.
class TelemetryStreams {
 public:
  explicit TelemetryStreams(Make make, std::uint8_t system);

  void open(Channel channel, Time simulated);
  void close(Channel channel);

  /// @param interval_us  as in SET_MESSAGE_INTERVAL: 0: its own, below 0: none.
  /// @returns  false for a message that has no rate.
  bool set_interval(Channel channel, std::uint32_t id, double interval_us,
                    Time simulated);
  /// As MESSAGE_INTERVAL has it [us]: -1: none; 0: there is no such message.
  std::int32_t interval_us(Channel channel, std::uint32_t id) const;

  /// @param rate  of all messages of a group [1/s]; 0: none.
  void set_group(Channel channel, mavlink::StreamGroup group, double rate,
                 Time simulated);

  /// Sends what is due.
  void step(const ServedVehicle& vehicle, Outbox& out);

 private:
  struct Stream {
    std::int64_t interval_ns = 0;  // 0: none
    Time due;                      // of the run
    Time last_wall;
  };
  struct Link {
    Channel channel = 0;
    Time next;  // nothing is due before
    std::array<Stream, kTelemetryRows> streams;
  };

  const Link* find(Channel channel) const;
  Link* find(Channel channel);
  std::int64_t own_interval_ns(std::size_t row) const;
  void set(Link& link, std::size_t row, std::int64_t interval_ns, Time simulated) const;
  void change(Link& link, std::size_t row, std::int64_t interval_ns,
              Time simulated) const;
  void send_due(Link& link, const ServedVehicle& vehicle, Outbox& out) const;

  Make make_;
  std::uint8_t system_;
  std::vector<Link> links_;
  Time last_;  // step, of the run
};

}  // namespace skein::vehicle_services
