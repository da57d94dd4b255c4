// SPDX-License-Identifier: Apache-2.0
#include "skein/link/world_link/session.h"

#include <algorithm>
#include <cstring>
#include <utility>

namespace skein::world_link {
namespace {

constexpr std::uint64_t kWindow = 64;      // parcels under way
constexpr std::size_t kPacketSize = 1200;  // that links carry in one piece [bytes]
constexpr std::size_t kMaxShown = 64;
constexpr int kMaxBurst = 16;  // packets of one step
const Time kMinResend = Time::from_seconds(0.1);
constexpr double kResendFactor = 1.2;  // of a round trip

std::vector<std::uint8_t> as_numbers(const std::vector<std::byte>& bytes) {
  std::vector<std::uint8_t> numbers(bytes.size());
  if (!bytes.empty()) std::memcpy(numbers.data(), bytes.data(), bytes.size());
  return numbers;
}

}  // namespace

bool Session::post(const std::vector<std::byte>& coded, Time now) {
  if (coded.size() > kMaxValue) return false;
  bytes_ += coded.size();
  parcels_.push_back({as_numbers(coded), now, std::nullopt, false});
  while (parcels_.size() > options_.max_parcels || bytes_ > options_.max_bytes)
    drop_oldest();
  return true;
}

void Session::show(const std::vector<std::byte>& coded) {
  if (!up_ || coded.size() > kMaxValue) return;
  if (shown_.size() >= kMaxShown) shown_.erase(shown_.begin());
  shown_.push_back(as_numbers(coded));
}

void Session::drop_oldest() {
  if (!parcels_.front().acknowledged) ++dropped_;
  bytes_ -= parcels_.front().coded.size();
  parcels_.pop_front();
  ++first_;
}

void Session::change(SessionChange::Kind kind, std::string text) {
  changes_.push_back({kind, std::move(text)});
}

std::vector<SessionChange> Session::take_changes() {
  return std::exchange(changes_, {});
}

bool Session::admits(std::uint64_t session, Time now) const {
  return peer_ == 0 || session >= peer_ || now - heard_ > options_.silence;
}

// Whether the packet is of the other side's session that counts; takes up a new one.
bool Session::meet(const Packet& packet, Time now) {
  if (packet.session == peer_) return true;
  if (!packet.hello) {
    // Who is that? It may ask the same.
    answer_due_ = greets_ = true;
    return false;
  }
  if (!admits(packet.session, now)) return false;
  const bool was_up = std::exchange(up_, false);
  peer_ = packet.session;
  peer_hello_ = *packet.hello;
  knows_us_ = false;
  alignment_.forget();
  newest_ = 0;
  expected_ = packet.oldest;
  early_.clear();
  shown_.clear();
  for (Waiting& parcel : parcels_) parcel.sent.reset();
  answer_due_ = true;
  if (was_up) change(SessionChange::Kind::kRestarted, peer_hello_.software);
  return true;
}

void Session::receive(const Packet& packet, Time now, const Deliver& deliver) {
  if (packet.bye) {
    if (packet.bye->refused) {
      if (packet.heard_session == options_.id && packet.bye->why != refusal_)
        change(SessionChange::Kind::kRefused, refusal_ = packet.bye->why);
    } else if (packet.session == peer_) {
      ended_ = peer_;
      knows_us_ = false;
      if (std::exchange(up_, false)) change(SessionChange::Kind::kDown, packet.bye->why);
    }
    return;
  }
  if (packet.session == ended_ || !meet(packet, now)) return;
  heard_ = now;
  alignment_.hear(packet.sent, now);
  knows_us_ = packet.heard_session == options_.id;
  if (knows_us_) {
    answered_ = now;
    if (packet.echo && packet.echo->held >= Time())
      alignment_.round_trip(packet.echo->sent + packet.echo->held, packet.sent, now);
    if (!std::exchange(up_, true)) change(SessionChange::Kind::kUp, peer_hello_.software);
    refusal_.clear();
    hear_acknowledgements(packet);
  }
  const Time shift = alignment_.to_here(packet.sent, now) - packet.sent;
  if (packet.number > newest_) {
    newest_ = packet.number;
    newest_sent_ = packet.sent;
    newest_heard_ = now;
    for (const auto& coded : packet.newest) deliver({coded, shift});
  }
  hear_parcels(packet, deliver, shift);
}

void Session::hear_acknowledgements(const Packet& packet) {
  while (!parcels_.empty() && first_ < packet.acknowledged) {
    parcels_.front().acknowledged = true;
    drop_oldest();
  }
  for (std::uint64_t k = 0; k < kWindow; ++k) {
    const std::uint64_t number = packet.acknowledged + 1 + k;
    if ((packet.ahead >> k & 1u) == 0 || number < first_) continue;
    if (number - first_ >= parcels_.size()) return;
    parcels_[number - first_].acknowledged = true;
  }
  while (!parcels_.empty() && parcels_.front().acknowledged) drop_oldest();
}

void Session::hear_parcels(const Packet& packet, const Deliver& deliver, Time shift) {
  for (const Parcel& parcel : packet.parcels) {
    answer_due_ = true;
    if (parcel.number >= expected_ && parcel.number - expected_ <= kWindow)
      early_.try_emplace(parcel.number, parcel.coded);
  }
  while (!early_.empty()) {
    const std::uint64_t first = early_.begin()->first;
    // What comes no more is not waited for.
    if (first >= packet.oldest) {
      expected_ = std::max(expected_, packet.oldest);
      if (first > expected_) break;
    }
    const auto next = early_.extract(early_.begin());
    expected_ = first + 1;
    deliver({next.mapped(), shift});
  }
  expected_ = std::max(expected_, packet.oldest);
}

void Session::expire(Time now) {
  while (!parcels_.empty() && now - parcels_.front().posted > options_.lifetime)
    drop_oldest();
}

bool Session::due(const Waiting& parcel, Time now) const {
  if (parcel.acknowledged) return false;
  const Time resend = std::max(
      kMinResend, Time::from_seconds(kResendFactor * alignment_.shortest_round_trip()));
  return !parcel.sent || now - *parcel.sent >= resend;
}

bool Session::parcel_due(Time now) const {
  const std::size_t count = std::min<std::size_t>(parcels_.size(), kWindow);
  return std::any_of(parcels_.begin(),
                     parcels_.begin() + static_cast<std::ptrdiff_t>(count),
                     [&](const Waiting& parcel) { return due(parcel, now); });
}

Packet Session::next_packet(Time now) {
  Packet packet;
  packet.session = options_.id;
  packet.heard_session = peer_;
  packet.number = ++packets_;
  packet.sent = now;
  if (newest_ > 0) packet.echo = Echo{newest_sent_, now - newest_heard_};
  packet.oldest = first_;
  packet.acknowledged = expected_;
  for (const auto& [number, coded] : early_)
    if (number > expected_ && number - expected_ <= kWindow)
      packet.ahead |= std::uint64_t{1} << (number - expected_ - 1);
  if (!knows_us_ || std::exchange(greets_, false)) packet.hello = options_.hello;
  return packet;
}

// As much of what is due as goes into one packet, at least one value.
void Session::fill(Packet& packet, Time now) {
  std::size_t room = kPacketSize;
  const auto fits = [&](std::size_t size) {
    if (size > room && room < kPacketSize) return false;
    room -= std::min(room, size);
    return true;
  };
  std::size_t taken = 0;
  while (taken < shown_.size() && fits(shown_[taken].size()))
    packet.newest.push_back(std::move(shown_[taken++]));
  shown_.erase(shown_.begin(), shown_.begin() + static_cast<std::ptrdiff_t>(taken));
  for (std::size_t k = 0; k < parcels_.size() && k < kWindow; ++k) {
    Waiting& parcel = parcels_[k];
    if (!due(parcel, now)) continue;
    if (!fits(parcel.coded.size())) return;
    parcel.sent = now;
    packet.parcels.push_back({first_ + k, parcel.coded});
  }
}

void Session::step(Time now, const Send& send) {
  expire(now);
  if (up_ && now - answered_ > options_.silence) {
    up_ = false;
    knows_us_ = false;
    shown_.clear();
    change(SessionChange::Kind::kDown, "nothing is heard");
  }
  for (int k = 0; k < kMaxBurst; ++k) {
    const bool values = up_ && (!shown_.empty() || parcel_due(now));
    const bool quiet = !last_sent_ || now - *last_sent_ >= options_.keep_alive;
    if (!values && !answer_due_ && !quiet) return;
    answer_due_ = false;
    Packet packet = next_packet(now);
    if (up_) fill(packet, now);
    last_sent_ = now;
    send(packet);
  }
}

void Session::say_bye(Time now, const std::string& why, const Send& send) {
  Packet packet = next_packet(now);
  packet.hello.reset();
  packet.bye = Bye{false, why};
  send(packet);
}

}  // namespace skein::world_link
