// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "skein/link/world_link/world_client.h"
#include "skein/role/agent.h"
#include "skein/role/operator_console.h"
#include "skein/role/radio.h"
#include "skein/role/recorder.h"
#include "skein/role/sensor.h"

// What joins the run of a single agent to the world that it takes part in. All refer to
// the client, which outlives them.

namespace skein::world_link {

/// Stands on board for the virtual payload, which looks at the world where that is.
class ReceivedPayload final : public Sensor {
 public:
  explicit ReceivedPayload(WorldClient& client) : client_(client) {}

  bool payload() const override { return true; }
  void sample(const SensorView& view, std::vector<SensorSample>& out) override {
    client_.take_samples(view.now, out);
  }

 private:
  WorldClient& client_;
};

/// The medium is elsewhere: in the world, or a modem's.
class WorldRadio final : public Radio {
 public:
  explicit WorldRadio(WorldClient& client) : client_(client) {}

  // Who else there is the world knows.
  bool carries_broadcasts() const override { return true; }
  void send(const Message& message) override { client_.say(message.sent, message); }
  void deliver(Time now, RadioNews& news) override;

 private:
  WorldClient& client_;
  std::vector<Message> arrived_;
};

/// An agent that also says when its world is lost and back: events "world-joined",
/// "world-lost", "world-back", "world-restarted", "world-refused".
class ConnectedAgent final : public Agent {
 public:
  ConnectedAgent(std::unique_ptr<Agent> agent, EntityId self, WorldClient& client)
      : agent_(std::move(agent)), self_(self), client_(client) {}

  void step(const AgentInput& in, AgentOutput& out) override;

 private:
  EventKind event_of(SessionChange::Kind kind);

  std::unique_ptr<Agent> agent_;
  EntityId self_;
  WorldClient& client_;
  bool joined_ = false;
};

/// Tells the world how the vehicle is and what happens on board: a listener of the run's
/// records, which must hold estimates of every step.
class WorldFeed final : public Recorder {
 public:
  WorldFeed(WorldClient& client, EntityId self) : client_(client), self_(self) {}

  void record(const Record& record) override;
  Result<void> step_done(Time time) override;

 private:
  struct Listener;

  WorldClient& client_;
  EntityId self_;
  std::optional<RemoteState> state_;
  std::vector<EntitySaying> said_;  // in this step
};

/// An operator's console to which what the world's operator asks of the vehicle is added.
class WorldConsole final : public OperatorConsole {
 public:
  /// Both outlive it.
  WorldConsole(OperatorConsole& console, WorldClient& client)
      : console_(console), client_(client) {}

  void show(const RunProgress& progress) override { console_.show(progress); }
  void announce(const Event& event, std::string_view who) override {
    console_.announce(event, who);
  }
  bool stop_requested() const override { return console_.stop_requested(); }
  std::vector<CommandRecord> commands() override;

 private:
  OperatorConsole& console_;
  WorldClient& client_;
};

}  // namespace skein::world_link
