// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "skein/link/vehicle_services/command.h"
#include "skein/link/vehicle_services/outbox.h"
#include "skein/link/vehicle_services/take_off_progress.h"
#include "skein/link/vehicle_services/vehicle_parts.h"

namespace skein::vehicle_services {

/// The command protocol of a vehicle: each command is answered to its sender, and
/// executed once.
///
/// A command is the same again when its sender sends the same with the same parameters,
/// and says so (confirmation above 0) within thirty seconds of the last time; or within
/// ten, when the frame has come twice, or when it cannot say so (COMMAND_INT) and nothing
/// else was executed since. It is answered as before. A take-off is reported on each
/// second, by the altitude, until it is done; others that ask for one meanwhile are
/// refused.
class CommandService {
 public:
  /// @param sequence  of the frame that brought it.
  /// @param for_all   it was for every vehicle: only queries are answered.
  void handle(const Command& command, const Peer& from, std::uint8_t sequence,
              bool for_all, VehicleParts& parts, Outbox& out);

  void step(VehicleParts& parts, Outbox& out);
  void close(Channel channel);

 private:
  struct Executed {
    Command command;
    Peer from;
    std::uint8_t sequence = 0;
    Time at;  // or asked for again, by the wall clock
    mavlink::CommandResult result{};
  };
  struct Running {
    Command command;
    Peer from;
    TakeOffProgress progress;
    Time reported;  // by the wall clock
    std::uint8_t percent = 0;
  };

  Executed* find_repeated(const Command& command, const Peer& from, std::uint8_t sequence,
                          Time wall);
  void remember(const Executed& executed);

  std::vector<Executed> executed_;  // the latest ones, the newest last
  std::optional<Running> running_;
};

/// Answers a command.
void acknowledge(mavlink::CommandId id, mavlink::CommandResult result,
                 std::uint8_t percent, const Peer& to, Outbox& out);

}  // namespace skein::vehicle_services
