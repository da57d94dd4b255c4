#pragma once

#include <atomic>
#include <chrono>
#include <cstddef>
#include <map>
#include <mutex>
#include <string>
#include <thread>
#include <variant>
#include <vector>

#include "skein/base/id.h"
#include "skein/base/result.h"
#include "skein/base/time.h"
#include "skein/data/message.h"
#include "skein/link/modem/modem_peer.h"
#include "skein/link/modem/stream_frames.h"
#include "skein/link/transport/endpoints.h"

namespace skein::modem {

/// Something that came by a modem.
using Heard = std::variant<Message, NeighbourChange>;

struct ModemLinkOptions {
  transport::EndpointAddress endpoint;  ///< of the modem; a server may have several peers
  ModemPeerOptions peer;
};

/// A modem at an endpoint, in a thread of its own.
///
/// Threads: the simulation's calls everything. Times that go in and out are of its clock.
class ModemLink final : public transport::ChannelListener {
 public:
  explicit ModemLink(ModemLinkOptions options);
  /// Ends the thread.
  ~ModemLink() override;

  /// Whether somebody is reached through another modem than this one: entities that the
  /// options do not name as identities.
  bool is_beyond(EntityId who) const;

  /// Opens the endpoint, and begins. Until then nothing goes out and nothing comes.
  /// @returns  where a server waits, with the port that it has got.
  /// Fails: kBadInput where the endpoint cannot be opened.
  Result<std::vector<std::string>> start();

  /// Whether it was started.
  bool is_open() const { return running_; }

  /// As ModemPeer has it.
  void send(Time now, const Message& message) { put(now, message, false); }
  void inject(Time now, const Message& message) { put(now, message, true); }

  /// Takes what has come of one entity, in order.
  std::vector<Heard> take(Time now, EntityId who);
  /// Takes what has come of all.
  std::vector<Heard> take(Time now);

  ModemStatistics statistics() const;

 private:
  using Clock = std::chrono::steady_clock;
  struct Channel {
    StreamFrames frames;
  };
  struct Outgoing {
    Message message;
    bool injected = false;
  };

  void opened(transport::ChannelId channel, transport::EndpointId endpoint,
              const std::string& name) override;
  void received(transport::ChannelId channel, std::span<const std::byte> bytes) override;
  void closed(transport::ChannelId channel, const std::string& why) override;
  void put(Time now, const Message& message, bool injected);
  void send_to_all(std::span<const std::byte> bytes);
  void step();
  void run();
  Time now() const;

  ModemLinkOptions options_;
  bool stream_;
  std::vector<bool> here_;  // by identity
  Clock::time_point begin_ = Clock::now();
  ModemPeer peer_;
  std::map<transport::ChannelId, Channel> channels_;
  std::vector<Message> arrived_;  // while bytes are taken in

  mutable std::mutex mutex_;  // of what follows; times in it are of the link's clock
  std::vector<Outgoing> out_;
  std::vector<Heard> in_;
  ModemStatistics statistics_;

  transport::Endpoints endpoints_;
  std::atomic<bool> stop_ = false, running_ = false;
  std::thread thread_;
};

}  // namespace skein::modem
