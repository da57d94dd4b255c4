// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "skein/link/modem/modem_link.h"
#include "skein/role/entity_port.h"
#include "skein/role/radio.h"

// What joins a run to a modem. All refer to the link, which outlives them.

namespace skein::modem {

/// The port of an entity whose messages go over the modem; all else goes over its port.
/// A message that comes by the port does not count: nobody has judged it.
/// What comes by the modem is given out as what the entity says, so it is recorded with
/// all other reports: events "neighbour-found" and "neighbour-lost" among it.
class ModemPort final : public EntityPort {
 public:
  ModemPort(std::unique_ptr<EntityPort> port, ModemLink& link, EntityId self)
      : port_(std::move(port)), link_(link), self_(self) {}

  void receive(Time now, std::vector<VehicleReport>& out) override;
  void send(Time now, EntityInput input) override;

 private:
  std::unique_ptr<EntityPort> port_;
  ModemLink& link_;
  EntityId self_;
};

/// What the radio of a world with a modem does with real entities.
struct ModemRadioParts {
  std::unique_ptr<Radio> medium;    ///< of all that is simulated
  std::unique_ptr<Radio> by_range;  ///< of what real entities say; null: the medium too
  bool inject = false;              ///< what is said here is sent by the modem too
};

/// The radio of a world of which some entities are beyond a modem: the medium carries
/// what is simulated, and what the modem hears, unless that is carried by range alone.
/// The end of a step for the modem is deliver().
class ModemRadio final : public Radio {
 public:
  ModemRadio(ModemRadioParts parts, ModemLink& link)
      : parts_(std::move(parts)), link_(link) {}

  void send(const Message& message) override;
  void deliver(Time now, RadioNews& news) override;
  void turn(EntityId id, bool on) override { parts_.medium->turn(id, on); }
  void end(RadioNews& news) override;
  RadioStatus status(EntityId id) const override { return parts_.medium->status(id); }
  RadioStatistics take_statistics() override { return parts_.medium->take_statistics(); }

 private:
  void inject(Time now);

  ModemRadioParts parts_;
  ModemLink& link_;
  // A message that may be sent on the modem too, once it is known that no copy of it goes
  // there anyway.
  struct Candidate {
    Message message;
    bool goes_out = false;
  };
  std::vector<Candidate> candidates_;
};

/// The radio of an agent that has a modem. Its load is that of the modem's air, where it
/// is known what the modem can carry.
class AgentModemRadio final : public Radio {
 public:
  /// @param names  of all entities, for events
  AgentModemRadio(ModemLink& link, EntityId self, std::vector<std::string> names)
      : link_(link), self_(self), names_(std::move(names)) {}

  bool carries_broadcasts() const override { return true; }
  void send(const Message& message) override { link_.send(message.sent, message); }
  void deliver(Time now, RadioNews& news) override;
  RadioStatus status(EntityId) const override;

 private:
  ModemLink& link_;
  EntityId self_;
  std::vector<std::string> names_;
};

}  // namespace skein::modem
