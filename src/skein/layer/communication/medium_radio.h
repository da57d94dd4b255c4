#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "skein/layer/communication/ideal_radio.h"
#include "skein/layer/communication/medium/medium.h"
#include "skein/role/propagation.h"
#include "skein/role/radio.h"

namespace skein::communication {

struct MediumRadioOptions {
  RadioProfile profile;
  /// Agents of a run think at the same moments, radios of a team do not send at the same
  /// one: a message reaches its radio later, by up to this, uniform [s].
  double spread = 0.1;
};

/// A radio whose messages fight for a medium: airtime, carrier sense, collisions, queues,
/// retries.
///
/// A message to all is one frame; a message to one is acknowledged and repeated. Messages
/// are as long as their wire form (data/wire.h) and go in parts when a frame cannot hold
/// them (MacProfile::part_bytes), with 4 bytes more each; all parts must arrive. What
/// happens between two calls of deliver() happens where nodes are at the second.
class MediumRadio final : public Radio, private MediumListener {
 public:
  /// @param entities  how many there are; messages to others are lost
  /// @param position  where an entity is; one without a place hears and says nothing
  /// @param antennas  of the entities
  MediumRadio(const MediumRadioOptions& options, std::unique_ptr<Propagation> propagation,
              std::size_t entities, PositionLookup position, std::uint64_t seed,
              NodeAntennas antennas = {});

  void send(const Message& message) override;
  void deliver(Time now, std::vector<Message>& arrived,
               std::vector<Message>& lost) override;

 private:
  /// What is sent as one: a message to one, or the copies of a message to several.
  struct Post {
    NodeIndex from = 0;
    bool to_all = false;
    std::uint32_t parts = 1, parts_ended = 0;
    Time ended;  // when the last part left
    struct Copy {
      Message message;
      std::uint32_t parts_received = 0;
      bool arrived = false;
    };
    std::vector<Copy> copies;
  };
  struct Departure {
    Time time;
    std::uint64_t order;
    std::uint32_t post;
  };

  static bool later(const Departure& a, const Departure& b);
  void collect();
  void depart(std::uint32_t index);
  void end_part(std::uint32_t index, Time now);
  void settle(Time now);

  void on_frame(const Frame& frame, Time now) override;
  void on_delivered(const Frame& data, NodeIndex receiver, Time now) override;
  void on_finished(const Packet& packet, PacketEnd end, Time now) override;

  MediumRadioOptions options_;
  std::unique_ptr<Propagation> propagation_;
  std::size_t entities_;
  PositionLookup position_;
  std::uint64_t seed_;
  Medium medium_;
  std::vector<Message> written_;       // since the last deliver()
  std::vector<Departure> departures_;  // a heap, earliest first
  std::uint64_t departed_ = 0;
  std::vector<Post> posts_;
  std::vector<std::uint32_t> free_;
  std::vector<std::uint32_t> leaving_;  // posts that left and may still be on the way
  std::vector<Message>* arrived_ = nullptr;
  std::vector<Message>* lost_ = nullptr;
};

}  // namespace skein::communication
