// SPDX-License-Identifier: Apache-2.0
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
#include "skein/data/radio/message.h"
#include "skein/link/modem/alerts.h"
#include "skein/link/modem/modem_peer.h"
#include "skein/link/modem/stream_frames.h"
#include "skein/link/transport/endpoints.h"

namespace skein::modem {

/// Something is wrong with a modem, or on its air.
struct ModemAlert {
  EntityId who;  ///< an entity beyond this modem: the one that is named, if it is one
  std::uint32_t hw = 0;  ///< of this modem
  AlertKind kind = AlertKind::kSameAddress;
  std::uint64_t count = 1;  ///< of these since the last alert of the kind
};

/// Something that came by a modem.
using Heard = std::variant<Message, NeighbourChange, ModemAlert>;

struct ModemLinkOptions {
  transport::EndpointAddress endpoint;  ///< of the modem; a server may have several peers
  ModemPeerOptions peer;
};

/// A modem at an endpoint, in a thread of its own.
///
/// It holds 5000 messages that wait each way, and of what else has come something for
/// each entity: what is more is dropped, and counted.
///
/// Threads: those of the simulation call everything; send() and take() of one entity may
/// be called beside those of others. Times that go in and out are of its clock.
class ModemLink final : public transport::ChannelListener {
 public:
  explicit ModemLink(ModemLinkOptions options);
  /// Ends the thread.
  ~ModemLink() override;

  /// Whether somebody is reached through another modem than this one: entities that the
  /// options do not name as identities.
  bool is_beyond(EntityId who) const;

  /// Opens the endpoint, and begins. Until then nothing goes out and nothing comes.
  /// Serial lines and connections that are not there are tried again each second: until
  /// one is open, and when it is lost, there is a warning and an alert.
  /// @returns  where a server waits, with the port that it has got.
  /// Fails: kBadInput where the endpoint cannot be opened.
  Result<std::vector<std::string>> start();

  /// Whether it was started.
  bool is_open() const { return running_; }

  /// As ModemPeer has it, once flush() is called.
  void send(Time now, const Message& message) { put(now, message, false); }
  void inject(Time now, const Message& message) { put(now, message, true); }

  /// Hands over what was said since the last call, at the end of a step: copies of a
  /// message go out as one, however the threads run.
  void flush();

  /// That the modem can carry [bit/s]; 0: not known.
  double rate() const { return options_.peer.queue.rate; }
  std::uint32_t hw() const { return options_.peer.hw; }

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
    Time at;  // of the simulation's clock, when it was said
  };

  void opened(transport::ChannelId channel, transport::EndpointId endpoint,
              const std::string& name) override;
  void received(transport::ChannelId channel, std::span<const std::byte> bytes) override;
  void closed(transport::ChannelId channel, const std::string& why) override;
  void put(Time now, const Message& message, bool injected);
  bool send_to_all(std::span<const std::byte> bytes);
  void hand_in();
  void hand_in(const NeighbourChange& change);
  void hand_in(const Alert& alert);
  void look_at_lines();
  EntityId whom_it_concerns(const Alert& alert) const;
  void to_clock(Time at, std::vector<Heard>& taken) const;
  void step();
  void run();
  Time now() const;

  ModemLinkOptions options_;
  bool stream_;
  std::vector<bool> here_;  // by identity
  Clock::time_point begin_ = Clock::now();
  ModemPeer peer_;
  std::map<transport::ChannelId, Channel> channels_;
  bool awaits_line_ = false;  // there was one, or should be
  LineAlerts lines_;
  std::vector<Message> arrived_;  // while bytes are taken in
  std::uint64_t damaged_ = 0;     // frames, of all channels that there were

  mutable std::mutex mutex_;    // of what follows; times in it are of the link's clock
  std::vector<Outgoing> said_;  // since the last flush(), by the simulation's clock
  std::vector<Outgoing> out_;
  std::vector<Heard> in_;
  ModemStatistics statistics_;  // of peer_
  std::uint64_t put_full_ = 0, take_full_ = 0;

  transport::Endpoints endpoints_;
  std::atomic<bool> stop_ = false, running_ = false;
  std::thread thread_;
};

}  // namespace skein::modem
