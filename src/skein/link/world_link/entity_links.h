// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "skein/base/result.h"
#include "skein/link/transport/endpoints.h"
#include "skein/link/world_link/framing.h"
#include "skein/link/world_link/session.h"
#include "skein/role/entity_port.h"

namespace skein::world_link {

/// An entity whose vehicle and agent are in another program.
struct LinkedEntity {
  std::string name;  ///< as its agent says
  transport::EndpointAddress endpoint;
  Time silence = Time::from_seconds(2);
};

/// The links of a world to entities in other programs, in a thread of their own. Several
/// may share an endpoint: they are told apart by their names.
///
/// Use: add entities, take ports, start(). Ports may be used until this ends, and before
/// start(): then nothing comes.
class EntityLinks final : public transport::ChannelListener {
 public:
  /// @param software  name and version, for the other side's people.
  /// @param scenario  fingerprint of what agents must have in common with the world.
  EntityLinks(std::string software, std::string scenario);
  /// Says bye, and ends the thread.
  ~EntityLinks() override;

  /// @returns  its number here.
  /// Fails: kBadInput for a name that is taken, or an endpoint that carries no packets.
  Result<std::size_t> add(const LinkedEntity& entity);

  /// The simulation's end of an entity, by the number that add() gave it.
  std::unique_ptr<EntityPort> port(std::size_t entity);

  /// Opens the endpoints, and begins; nothing without entities.
  /// @returns  where servers wait, with the ports that they have got.
  /// Fails: kBadInput where an endpoint cannot be opened.
  Result<std::vector<std::string>> start();

 private:
  using Clock = std::chrono::steady_clock;
  struct Entity;
  struct Mailbox;
  class Port;
  struct Peer {
    transport::EndpointId endpoint = 0;
    bool connection = false;
    FrameReader frames;
    Entity* entity = nullptr;  // whose agent it is
  };

  void opened(transport::ChannelId channel, transport::EndpointId endpoint,
              const std::string& name) override;
  void received(transport::ChannelId channel, std::span<const std::byte> bytes) override;
  void closed(transport::ChannelId channel, const std::string& why) override;
  void take(transport::ChannelId channel, Peer& peer, std::span<const std::byte> bytes);
  void meet(transport::ChannelId channel, Peer& peer, const Packet& packet);
  void deliver(Entity& entity, const Delivery& delivery);
  void report(Entity& entity);
  void answer(transport::ChannelId channel, const Packet& to, std::optional<Bye> bye);
  void send(transport::ChannelId channel, const Packet& packet);
  void run();
  void step(Entity& entity);
  Time now() const;

  std::string software_, scenario_;
  std::uint64_t session_;
  Clock::time_point begin_ = Clock::now();
  std::vector<transport::EndpointAddress> addresses_;  // of endpoints, by their numbers
  std::vector<std::unique_ptr<Entity>> entities_;
  std::map<transport::ChannelId, Peer> peers_;
  std::vector<std::byte> coded_;  // used again for each packet
  transport::Endpoints endpoints_;
  std::atomic<bool> stop_ = false;
  std::thread thread_;
};

/// Now, in nanoseconds since 1970: a session's id.
std::uint64_t session_of_now();

}  // namespace skein::world_link
