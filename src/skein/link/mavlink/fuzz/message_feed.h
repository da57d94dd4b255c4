// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <type_traits>
#include <vector>

#include "skein/base/check.h"
#include "skein/base/time.h"
#include "skein/data/describe/type_traits.h"
#include "skein/link/mavlink/frame.h"
#include "skein/link/mavlink/frame_parser.h"
#include "skein/link/mavlink/payload.h"

/// For fuzzers of whatever takes part in MAVLink's protocols: a fuzzer's bytes read as
/// what happens at the links of a program.
namespace skein::mavlink {

using FeedChannel = std::uint32_t;

/// A fuzzer's bytes from the first on; zeros behind the last.
class FeedBytes {
 public:
  explicit FeedBytes(std::span<const std::uint8_t> bytes) : left_(bytes) {}
  bool empty() const { return left_.empty(); }
  std::uint8_t next() {
    if (left_.empty()) return 0;
    const std::uint8_t byte = left_.front();
    left_ = left_.subspan(1);
    return byte;
  }

 private:
  std::span<const std::uint8_t> left_;
};

namespace detail {

/// A number that protocols stumble over, or any.
template <class Number>
Number feed_number(FeedBytes& bytes) {
  const std::uint8_t code = bytes.next();
  if (code < 200) return static_cast<Number>(code);
  using Limits = std::numeric_limits<Number>;
  switch (code % 10) {
    case 0:
      return Limits::max();
    case 1:
      return Limits::lowest();
    case 2:
      return static_cast<Number>(-1);
    case 3:
      return static_cast<Number>(Limits::max() - 1);
    case 4:
      return static_cast<Number>(1000 * bytes.next());
    default:
      break;
  }
  if constexpr (std::is_floating_point_v<Number>) {
    if (code % 10 == 5) return Limits::quiet_NaN();
    if (code % 10 == 6) return Limits::infinity();
    if (code % 10 == 7) return -Limits::infinity();
    if (code % 10 == 8) return static_cast<Number>(bytes.next()) / 8;
  }
  std::array<std::uint8_t, sizeof(Number)> raw;
  for (std::uint8_t& byte : raw) byte = bytes.next();
  return std::bit_cast<Number>(raw);
}

/// Some fields of a message get values, the others keep theirs.
template <Message T>
void feed_fields(T& message, FeedBytes& bytes) {
  for (int left = bytes.next() % 8; left > 0; --left) {
    const std::size_t chosen = bytes.next() % kFieldCount<T>;
    std::size_t at = 0;
    for_each_field<T>([&](const auto& field) {
      if (at++ != chosen) return;
      auto& value = message.*field.member;
      if constexpr (type_traits::kIsArray<std::remove_cvref_t<decltype(value)>>) {
        using Item = typename std::remove_cvref_t<decltype(value)>::value_type;
        const std::size_t count = bytes.next() % (value.size() + 1);
        for (std::size_t i = 0; i < count; ++i)
          value[i] = std::is_same_v<Item, char> ? static_cast<Item>(bytes.next())
                                                : feed_number<Item>(bytes);
      } else {
        value = feed_number<std::remove_cvref_t<decltype(value)>>(bytes);
      }
    });
  }
}

/// The whole payload of a kind of message, for somebody.
template <Message T>
std::vector<std::byte> feed_payload(FeedBytes& bytes, std::uint8_t system,
                                    std::uint8_t component) {
  T message;
  if constexpr (requires { message.target_system; }) message.target_system = system;
  if constexpr (requires { message.target_component; })
    message.target_component = component;
  feed_fields(message, bytes);
  const auto payload = pack(message);
  return {payload.begin(), payload.end()};
}

}  // namespace detail

/// A fuzzer's bytes as what happens at the links of a program: frames from several
/// senders over several links, time that passes, links that are lost and others that
/// come.
///
///   MessageFeed<MissionCount, MissionItemInt> feed(bytes, 7, 1);
///   feed.run(subject);
///
/// The subject has
///
///   void open(FeedChannel);       a link is there; numbers are never used again
///   void close(FeedChannel);      it is gone
///   void receive(const Frame&, FeedChannel, Time now);
///   void step(Time now);          some time has passed
///
/// @tparam Kinds  the messages that the subject is about: their fields are given numbers
///                that protocols stumble over, and targets that fit. Messages of all
///                other kinds come too, as any bytes.
template <Message... Kinds>
class MessageFeed {
 public:
  /// @param system, component  for whom messages of Kinds are, unless the bytes say else.
  MessageFeed(std::span<const std::uint8_t> bytes, std::uint8_t system,
              std::uint8_t component)
      : bytes_(bytes), system_(system), component_(component) {}

  /// A byte for the subject's options, to be taken before run().
  std::uint8_t option() { return bytes_.next(); }

  template <class Subject>
  void run(Subject&& subject) {
    for (const FeedChannel channel : links_) subject.open(channel);
    while (!bytes_.empty()) {
      const std::uint8_t what = bytes_.next();
      if (what < 120) {
        make_frame();
        deliver(subject);
      } else if (what < 160) {
        make_expected();
        deliver(subject);
      } else if (what < 176) {
        make_any_frame();
        deliver(subject);
      } else if (what < 192) {
        deliver(subject);  // the last one, again
      } else if (what < 208) {
        set_sender(bytes_.next());  // and from somebody else
        deliver(subject);
      } else if (what < 248) {
        pass(subject, what);
      } else {
        renew(subject, links_[what % links_.size()]);
      }
    }
  }

  /// The subject waits for a message from somebody: it may be among what comes next, as
  /// it is or with other bytes. So a fuzzer finds its way through long exchanges.
  template <Message T>
  void expect(const T& message, FeedChannel channel, std::uint8_t system,
              std::uint8_t component) {
    const auto payload = pack(message);
    expected_ = {
        kFacts<T>.id, {payload.begin(), payload.end()}, channel, {system, component}};
  }

  bool is_open(FeedChannel channel) const {
    return std::ranges::find(links_, channel) != links_.end();
  }
  Time now() const { return now_; }

 private:
  struct Sender {
    std::uint8_t system = 0, component = 0;
  };
  static constexpr std::array<Sender, 4> kSenders = {
      {{255, 190}, {254, 190}, {255, 191}, {0, 0}}};
  struct Expected {
    std::uint32_t id = 0;
    std::vector<std::byte> payload;
    FeedChannel channel = 0;
    Sender sender;
  };

  void set_sender(std::uint8_t code) {
    link_ = code % links_.size();
    sender_ = kSenders[code / links_.size() % kSenders.size()];
  }

  void make_frame() {
    using Make = std::vector<std::byte> (*)(FeedBytes&, std::uint8_t, std::uint8_t);
    static constexpr std::array<Make, sizeof...(Kinds)> kMakes = {
        detail::feed_payload<Kinds>...};
    static constexpr std::array<std::uint32_t, sizeof...(Kinds)> kIds = {
        kFacts<Kinds>.id...};
    const std::size_t kind = bytes_.next() % sizeof...(Kinds);
    const std::uint8_t sender = bytes_.next();
    begin_frame(kIds[kind], kMakes[kind](bytes_, system_, component_), sender);
  }

  void make_expected() {
    if (expected_.payload.empty() || !is_open(expected_.channel)) return;
    std::vector<std::byte> payload = expected_.payload;
    for (int left = bytes_.next() % 4; left > 0; --left)
      payload[bytes_.next() % payload.size()] = std::byte{bytes_.next()};
    begin_frame(expected_.id, payload, 0);
    sender_ = expected_.sender;
    link_ = static_cast<std::size_t>(std::ranges::find(links_, expected_.channel) -
                                     links_.begin());
  }

  // Of any kind, with a payload of any length.
  void make_any_frame() {
    const auto all = all_messages();
    const std::size_t kind = bytes_.next() * 256U + bytes_.next();
    const std::uint32_t id =
        kind < all.size() ? all[kind].id : static_cast<std::uint32_t>(kind);
    const std::uint8_t sender = bytes_.next();
    std::vector<std::byte> payload(bytes_.next());
    for (std::byte& byte : payload) byte = std::byte{bytes_.next()};
    begin_frame(id, payload, sender);
  }

  // Without a CRC: frames are handed out by a parser that has checked it.
  void begin_frame(std::uint32_t id, std::span<const std::byte> payload,
                   std::uint8_t sender) {
    const std::array<std::uint32_t, kHeader2> header = {
        kMagic2, static_cast<std::uint32_t>(payload.size()), 0, 0, 0, 0, 0, id, id >> 8,
        id >> 16};
    frame_.assign(kHeader2 + payload.size() + kCrcLength, std::byte{});
    for (std::size_t i = 0; i < header.size(); ++i)
      frame_[i] = static_cast<std::byte>(header[i] & 0xff);
    std::ranges::copy(payload, frame_.begin() + kHeader2);
    message_ = find_message(id);
    set_sender(sender);
  }

  template <class Subject>
  void deliver(Subject& subject) {
    if (frame_.empty()) return;
    frame_[4] = std::byte{sequence_++};
    frame_[5] = std::byte{sender_.system};
    frame_[6] = std::byte{sender_.component};
    // The subject's own: behind the last byte of this copy is nothing that it may read.
    const std::vector<std::byte> copy = frame_;
    subject.receive(Frame{copy, message_}, links_[link_], now_);
  }

  template <class Subject>
  void pass(Subject& subject, std::uint8_t what) {
    static constexpr std::array<std::int64_t, 8> kSpans = {1,    20,   100,    500,
                                                           1000, 5000, 11'000, 70'000};
    now_ += Time::from_ns(kSpans[what % kSpans.size()] * 1'000'000);
    subject.step(now_);
  }

  template <class Subject>
  void renew(Subject& subject, FeedChannel& link) {
    const FeedChannel gone = link;
    link = 0;  // not open any more
    subject.close(gone);
    link = next_link_++;
    subject.open(link);
  }

  FeedBytes bytes_;
  std::uint8_t system_, component_;
  Time now_;
  std::array<FeedChannel, 3> links_ = {1, 2, 3};
  FeedChannel next_link_ = 4;
  std::vector<std::byte> frame_;
  const MessageEntry* message_ = nullptr;
  std::size_t link_ = 0;  // by which the next frame comes
  Sender sender_ = kSenders[0];
  Expected expected_;
  std::uint8_t sequence_ = 0;
};

/// Reads bytes that the subject sends: they must be one frame, of a kind that is known.
template <class Take>
void take_sent(std::span<const std::byte> bytes, Take&& take) {
  FrameParser parser;
  int found = 0;
  parser.read(bytes, [&](const Frame& frame) {
    ++found;
    SKEIN_CHECK(frame.message != nullptr && frame.bytes.size() == bytes.size());
    take(frame);
  });
  SKEIN_CHECK(found == 1);
}

}  // namespace skein::mavlink
