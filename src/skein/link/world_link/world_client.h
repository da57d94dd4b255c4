// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "skein/base/id.h"
#include "skein/base/result.h"
#include "skein/data/vehicle/entity_input.h"
#include "skein/data/vehicle/entity_report.h"
#include "skein/link/transport/endpoints.h"
#include "skein/link/world_link/framing.h"
#include "skein/link/world_link/session.h"
#include "skein/link/world_link/team_link.h"

namespace skein::world_link {

struct WorldClientOptions {
  std::string entity;  ///< its name in the scenario
  EntityId self;
  std::size_t entities = 0;  ///< of the scenario
  std::string software;      ///< name and version, for the world's people
  std::string scenario;      ///< fingerprint, see EntityLinks
  std::optional<transport::EndpointAddress> world;  ///< none: it is alone
  std::vector<transport::EndpointAddress> team;     ///< where other agents are met
};

/// The links of an agent to the world that it takes part in, and to the other agents of
/// its team, in a thread of their own.
///
/// Messages to others go by the world, which carries them over its radio. While the world
/// is lost those for agents that are heard directly go there; the others wait for the
/// world, not for long.
///
/// Threads: the simulation's calls everything. Times that go in and out are of its clock.
class WorldClient final : public transport::ChannelListener {
 public:
  explicit WorldClient(WorldClientOptions options);
  /// Says bye, and ends the thread.
  ~WorldClient() override;

  /// Opens the endpoints, and begins.
  /// @returns  where servers wait, with the ports that they have got.
  /// Fails: kBadInput where an endpoint cannot be opened or carries no packets.
  Result<std::vector<std::string>> start();

  /// Something for the world; of states only the newest goes.
  void say(Time now, EntitySaying saying);

  /// Appends the messages that have come for this agent.
  void receive(Time now, std::vector<Message>& out);

  /// Appends what virtual payload has measured in the world.
  void take_samples(Time now, std::vector<SensorSample>& out);

  /// What the world's operator asks of this vehicle.
  std::vector<Command> take_commands();

  /// What happened to the link with the world.
  std::vector<SessionChange> take_changes();

 private:
  using Clock = std::chrono::steady_clock;
  struct Peer {
    transport::EndpointId endpoint = 0;
    bool connection = false;
    FrameReader frames;
  };

  void opened(transport::ChannelId channel, transport::EndpointId endpoint,
              const std::string& name) override;
  void received(transport::ChannelId channel, std::span<const std::byte> bytes) override;
  void closed(transport::ChannelId channel, const std::string& why) override;
  bool of_world(const Peer& peer) const { return options_.world && peer.endpoint == 0; }
  void take_packet(std::span<const std::byte> bytes);
  void take_team_packet(std::span<const std::byte> bytes);
  void deliver(const Delivery& delivery);
  void keep(Message message);
  bool is_for_us(const Command& command) const;
  void send_to_world(const Packet& packet);
  void send_to_team(std::span<const std::byte> bytes);
  void put_out(EntitySaying& saying);
  void step();
  void run();
  Time now() const;

  WorldClientOptions options_;
  Clock::time_point begin_ = Clock::now();
  Session session_;
  TeamLink team_;
  std::map<transport::ChannelId, Peer> peers_;
  std::vector<std::byte> coded_;  // used again for each packet

  std::mutex mutex_;  // of what follows; times in it are of the links' clock
  std::vector<EntitySaying> out_;
  std::vector<Message> messages_;
  std::vector<SensorSample> samples_;
  std::vector<Command> commands_;
  std::vector<SessionChange> changes_;

  transport::Endpoints endpoints_;
  std::atomic<bool> stop_ = false;
  std::thread thread_;
};

}  // namespace skein::world_link
