// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "skein/base/random.h"
#include "skein/layer/communication/ideal_radio.h"
#include "skein/layer/communication/medium/medium.h"
#include "skein/layer/communication/neighbours.h"
#include "skein/layer/communication/radio_meter.h"
#include "skein/layer/communication/security/attackers.h"
#include "skein/layer/communication/security/authenticity.h"
#include "skein/role/propagation.h"
#include "skein/role/radio.h"
#include "skein/role/routing.h"

namespace skein::communication {

struct MediumRadioOptions {
  RadioProfile profile;
  /// Agents of a run think at the same moments, radios of a team do not send at the same
  /// one: a message reaches its radio later, by up to this, uniform [s].
  double spread = 0.1;
  /// Of a node's word that it is there, 10 % earlier or later [s]; 0: it says nothing.
  double advertisement_period = 0;
  std::vector<Attack> attacks;
  std::optional<AuthenticationOptions> authentication;  ///< none: messages carry no seals
};

/// What entities are called, in events.
using NameLookup = std::function<std::string(EntityId)>;

/// The entities that have radios.
struct RadioNodes {
  std::size_t count = 0;    ///< messages to others are lost
  PositionLookup position;  ///< who is without a place hears and says nothing
  NameLookup name;
  NodeAntennas antennas = {};
  /// By entity, at whose node it is reached, and from where its messages are sent; the
  /// others have no node of their own. Empty: each is reached at its own.
  std::vector<EntityId> reached_at = {};
};

/// A radio whose messages fight for a medium: airtime, carrier sense, collisions, queues,
/// retries.
///
/// A message to all is one frame; a message to one is acknowledged and repeated. Messages
/// are as long as their wire form (data/describe/wire.h) and go in parts when a frame
/// cannot hold them (MacProfile::part_bytes), with 4 bytes more each; all parts must
/// arrive. Urgent ones go first (urgency_of). What happens between two calls of deliver()
/// happens where nodes are at the second.
///
/// Whoever gets a message that is not for him alone passes it on once, if the routing
/// (role/routing.h) says so and to whom. What a radio on the way does not acknowledge
/// goes to all instead, once.
///
/// A node that has heard another knows it as its neighbour until it was silent for three
/// periods of advertisements (three seconds without these): events "neighbour-found" and
/// "neighbour-lost", where there are advertisements.
///
/// Entities that are reached at the node of another one (RadioNodes::reached_at) hear
/// what that hears. What is said between two at one node has arrived at once, and is on
/// the air all the same.
///
/// Attackers are further nodes of the medium (security/attackers.h). What they send in
/// the name of entities are messages that are `forged`. With authentication every message
/// carries a seal (security/seal.h), which counts as bytes on the air; receivers, those
/// who pass it on too, refuse what is not authentic: its end is LossCause::kRefused.
class MediumRadio final : public Radio, private MediumListener {
 public:
  /// What a part of a message has to hold at least besides its content: the routing's
  /// head and which part it is [byte]. MacProfile::part_bytes is above that.
  static std::uint32_t part_head(const Routing& routing);

  /// @param routing  null: NoRouting
  MediumRadio(const MediumRadioOptions& options, std::unique_ptr<Propagation> propagation,
              RadioNodes nodes, std::uint64_t seed,
              std::unique_ptr<Routing> routing = nullptr);

  void send(const Message& message) override;
  void deliver(Time now, RadioNews& news) override;
  void turn(EntityId id, bool on) override;
  void end(RadioNews& news) override;
  RadioStatus status(EntityId id) const override;
  RadioStatistics take_statistics() override { return meter_.take(); }

 private:
  /// A message to one, or the copies of a message to several, until all that carries them
  /// has ended.
  struct Transfer {
    NodeIndex from = 0;
    bool to_all = false;
    std::uint32_t bytes = 0;
    std::uint8_t urgency = 0;
    std::uint32_t posts = 0;             // that have not ended
    Time ended;                          // when the last one did
    LossCause cause = LossCause::kNone;  // of what was lost first at a sender
    MessageWay way;
    struct Copy {
      Message message;
      bool arrived = false;
    };
    std::vector<Copy> copies;
    std::vector<std::byte> sealed;  // with authentication: its wire form and its seal
    std::vector<bool> reached;      // of routing: nodes that have it
    std::vector<std::uint32_t> carried;  // posts, to be used again in the end
    bool leaves = false;                 // stands in leaving_
  };
  /// A transfer as one radio sends it.
  struct Post {
    std::uint32_t transfer = 0;
    NodeIndex from = 0;
    std::uint32_t hop = 0;  // radios that passed it on before
    bool again = false;     // it goes to all because one has not acknowledged it
    std::uint32_t parts = 1, parts_ended = 0;
    std::vector<std::pair<NodeIndex, std::uint32_t>> received;  // parts, by receiver
  };

  bool has_node(EntityId id) const;
  NodeIndex node_of(EntityId id) const;
  void collect();
  void begin(std::size_t first, std::size_t end);
  std::uint32_t new_transfer(NodeIndex from, std::span<Message> copies);
  void seal(Transfer& transfer);
  void launch(std::uint32_t transfer, Time time);
  RoutedMessage routed(const Transfer& transfer, std::uint32_t hop) const;
  std::optional<std::uint32_t> way_from(const Transfer& transfer, NodeIndex node,
                                        std::uint32_t hop);
  void post(std::uint32_t transfer, NodeIndex from, std::uint32_t to, std::uint32_t hop,
            Time time);
  bool has_all(Post& post, NodeIndex receiver);
  void arrive(Transfer& transfer, NodeIndex receiver, std::uint32_t hop, LossCause cause,
              Time now);
  bool refuses(Transfer& transfer, NodeIndex receiver, Time now);
  void attack(Time now);
  void pass_on(std::uint32_t transfer, NodeIndex node, std::uint32_t hop, Time now);
  void try_again(const Packet& packet, Time now);
  void leave(std::uint32_t transfer, Time now);
  void end_part(std::uint32_t index, LossCause cause, Time now);
  void settle(Time now);
  LossCause cause_of(const Transfer& transfer, EntityId to);
  void advertise(Time now);
  void note_neighbours(Time now, std::vector<Event>& events);

  void on_frame(const Frame& frame, Time now) override;
  void on_delivered(const Frame& data, NodeIndex receiver, Time now,
                    const Reception& reception) override;
  void on_overheard(const Frame& data, NodeIndex receiver, Time now) override;
  void on_finished(const Packet& packet, PacketEnd end, Time now) override;

  MediumRadioOptions options_;
  std::unique_ptr<Propagation> propagation_;
  std::size_t entities_;
  PositionLookup position_;
  NameLookup name_;
  std::uint64_t seed_;
  Attackers attackers_;
  std::unique_ptr<Routing> routing_;
  std::vector<bool> on_;              // entities whose radios are
  std::vector<EntityId> reached_at_;  // RadioNodes
  Medium medium_;
  RadioMeter meter_;
  Neighbours neighbours_;
  Time next_check_;                          // for lost ones
  std::vector<Neighbours::Change> changes_;  // since the last deliver()
  std::vector<RandomStream> advertisement_times_;
  std::vector<Time> next_advertisements_;
  std::vector<Message> written_;  // since the last deliver()
  std::vector<Transfer> transfers_;
  std::vector<Post> posts_;
  std::vector<std::uint32_t> free_transfers_, free_posts_;
  std::vector<std::uint32_t> leaving_;  // transfers that may still be on the way
  std::vector<std::uint32_t> waiting_;  // packets in the queue of each node
  std::optional<Authenticity> authenticity_;
  RefusalLog refusals_;
  AttackOrders attack_orders_;
  std::vector<Message> overheard_;
  RadioNews* news_ = nullptr;
};

}  // namespace skein::communication
