#include "skein/layer/communication/medium_radio.h"

#include <algorithm>
#include <utility>

#include "skein/base/check.h"

namespace skein::communication {
namespace {

constexpr std::uint32_t kSpreads = 4;    // of a node's random streams for its radio
constexpr std::uint32_t kPartBytes = 4;  // which part of which message it is
constexpr Time kLongestWay = Time::from_ns(1'000'000);  // 300 km at the speed of light
// Where nothing reaches: an entity without a place.
const Vec3 kNowhere(1e9, 1e9, 0);

Links::Nodes nodes_of(std::size_t entities, double transmit_power_dbm,
                      const PositionLookup& position, NodeAntennas antennas) {
  Links::Nodes nodes;
  nodes.move = false;  // but when places_changed() says so
  nodes.transmit_power_dbm.assign(entities, transmit_power_dbm);
  nodes.place = [position](NodeIndex node, Time) {
    return position(EntityId{node}).value_or(kNowhere);
  };
  nodes.antennas = std::move(antennas);
  return nodes;
}

}  // namespace

MediumRadio::MediumRadio(const MediumRadioOptions& options,
                         std::unique_ptr<Propagation> propagation, std::size_t entities,
                         PositionLookup position, std::uint64_t seed,
                         NodeAntennas antennas)
    : options_(options),
      propagation_(std::move(propagation)),
      entities_(entities),
      position_(std::move(position)),
      seed_(seed),
      medium_(options.profile, *propagation_,
              nodes_of(entities, options.profile.phy.transmit_power_dbm, position_,
                       std::move(antennas)),
              seed, *this) {
  SKEIN_CHECK(options.profile.mac.part_bytes > kPartBytes);
}

bool MediumRadio::later(const Departure& a, const Departure& b) {
  return a.time != b.time ? a.time > b.time : a.order > b.order;
}

void MediumRadio::send(const Message& message) {
  written_.push_back(message);
}

void MediumRadio::deliver(Time now, std::vector<Message>& arrived,
                          std::vector<Message>& lost) {
  arrived_ = &arrived;
  lost_ = &lost;
  medium_.places_changed();
  collect();
  while (!departures_.empty() && departures_.front().time <= now) {
    std::pop_heap(departures_.begin(), departures_.end(), later);
    const Departure next = departures_.back();
    departures_.pop_back();
    medium_.advance(std::max(next.time, medium_.now()));
    depart(next.post);
  }
  medium_.advance(std::max(now, medium_.now()));
  settle(now);
  arrived_ = lost_ = nullptr;
}

// Makes posts of what was written: a message with the copies that follow it is one.
void MediumRadio::collect() {
  for (std::size_t i = 0; i < written_.size();) {
    std::size_t end = i + 1;
    while (end < written_.size() && written_[end].copy &&
           written_[end].from == written_[i].from)
      ++end;
    std::uint32_t index = 0;
    if (free_.empty()) {
      index = static_cast<std::uint32_t>(posts_.size());
      posts_.emplace_back();
    } else {
      index = free_.back();
      free_.pop_back();
    }
    Post& post = posts_[index];
    const Message& first = written_[i];
    RandomStream random(seed_, first.from.value, Purpose::kRadio, kSpreads);
    random.seek(first.number);
    const Time time = first.sent + Time::from_seconds(options_.spread * random.uniform());
    post.from = first.from.value;
    post.to_all = end > i + 1;
    const std::size_t bytes = coded_size(first);
    const std::uint32_t room = options_.profile.mac.part_bytes - kPartBytes;
    post.parts = bytes <= options_.profile.mac.part_bytes
                     ? 1
                     : static_cast<std::uint32_t>((bytes + room - 1) / room);
    post.parts_ended = 0;
    post.copies.clear();
    for (; i < end; ++i) post.copies.push_back({std::move(written_[i])});
    departures_.push_back({time, departed_++, index});
    std::push_heap(departures_.begin(), departures_.end(), later);
  }
  written_.clear();
}

// Hands the parts of a post to its radio.
void MediumRadio::depart(std::uint32_t index) {
  const Post& post = posts_[index];
  const std::uint32_t to = post.to_all ? kAllNodes : post.copies[0].message.to.value;
  const std::uint32_t parts = post.parts;
  const auto bytes = static_cast<std::uint32_t>(coded_size(post.copies[0].message));
  const bool known =
      post.from < entities_ && (to < entities_ || to == kAllNodes) && to != post.from;
  std::uint32_t left = bytes;
  for (std::uint32_t part = 0; part < parts; ++part) {
    const std::uint32_t here =
        parts == 1 ? bytes : std::min(left, options_.profile.mac.part_bytes - kPartBytes);
    left -= here;
    const std::uint32_t size = parts == 1 ? here : here + kPartBytes;
    if (!known || !medium_.send({posts_[index].from, to, size, index}))
      end_part(index, medium_.now());
  }
}

void MediumRadio::end_part(std::uint32_t index, Time now) {
  Post& post = posts_[index];
  if (++post.parts_ended < post.parts) return;
  post.ended = now;
  leaving_.push_back(index);  // its end may still be on the way
}

// What has not arrived by now never will.
void MediumRadio::settle(Time now) {
  std::erase_if(leaving_, [&](std::uint32_t index) {
    Post& post = posts_[index];
    if (post.ended + kLongestWay > now) return false;
    for (Post::Copy& copy : post.copies)
      if (!copy.arrived) lost_->push_back(std::move(copy.message));
    post.copies.clear();
    free_.push_back(index);
    return true;
  });
}

void MediumRadio::on_frame(const Frame&, Time) {}

void MediumRadio::on_delivered(const Frame& data, NodeIndex receiver, Time) {
  Post& post = posts_[data.tag];
  for (Post::Copy& copy : post.copies) {
    if (copy.message.to.value != receiver) continue;
    if (++copy.parts_received == post.parts) {
      copy.arrived = true;
      arrived_->push_back(std::move(copy.message));
    }
    return;
  }
}

void MediumRadio::on_finished(const Packet& packet, PacketEnd, Time now) {
  end_part(static_cast<std::uint32_t>(packet.order.tag), now);
}

}  // namespace skein::communication
