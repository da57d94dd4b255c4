// SPDX-License-Identifier: Apache-2.0
// What another implementation of MAVLink speaks with, over real sockets: the program that
// tools/interop/codec.mjs starts.
//
//   mavlink_peer ENDPOINT...
//
// It says its definitions and where its servers wait, as lines of JSON, and compares each
// message that comes, field by field, with what the other side must have put into it
// (agreed_values.h). Each is answered by one of the same kind and form, with the values
// of the round that is kRounds later. The frame's system says the form, its component the
// round. When standard input ends it says what came, and fails if a field was wrong.
#include <fmt/format.h>
#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <map>
#include <string>
#include <tuple>
#include <vector>

#include "skein/link/mavlink/frame_parser.h"
#include "skein/link/mavlink/frame_writer.h"
#include "skein/link/mavlink/messages.h"
#include "skein/link/mavlink/sequence_watch.h"
#include "skein/link/router/test/agreed_values.h"
#include "skein/link/transport/endpoints.h"

namespace skein::mavlink {
namespace {

using transport::ChannelId;

// Systems of frames: what form these have.
constexpr std::uint8_t kFirstVersion = 11, kSecondVersion = 12, kSigned = 13,
                       kOtherKey = 14;  // signed with a key that the receiver has not
constexpr std::uint8_t kUnanswered = 99;
constexpr int kRounds = 6;
constexpr std::size_t kMaxTexts = 20;  // of what was wrong

std::uint64_t now() {
  return signing_time(std::chrono::duration_cast<std::chrono::nanoseconds>(
                          std::chrono::system_clock::now().time_since_epoch())
                          .count());
}

void say(const std::string& line) {
  std::fputs((line + '\n').c_str(), stdout);
  std::fflush(stdout);
}

// The fields of a definition as JSON.
struct Definition final : FieldVisitor {
  void visit(const AnyField& field) override {
    text += fmt::format(R"({}["{}","{}",{},{}])", text.empty() ? "" : ",", field.name,
                        field.type, field.count, field.extension);
  }
  std::string text;
};

struct Fill final : FieldVisitor {
  explicit Fill(const AgreedValues& of) : values(of) {}
  void visit(const AnyField& field) override {
    auto* at = static_cast<std::byte*>(field.place);
    for (std::size_t i = 0; i < field.elements(); ++i, at += field.width) {
      const std::uint64_t bits = values.bits(field, i);
      std::memcpy(at, &bits, field.width);
    }
  }
  AgreedValues values;
};

struct Compare final : FieldVisitor {
  explicit Compare(const AgreedValues& of) : values(of) {}
  void visit(const AnyField& field) override {
    const auto* at = static_cast<const std::byte*>(field.place);
    for (std::size_t i = 0; i < field.elements(); ++i, at += field.width) {
      const std::uint64_t expected = values.bits(field, i);
      std::uint64_t found = 0;
      std::memcpy(&found, at, field.width);
      // The other side keeps numbers as 64-bit floats: a NaN may come with other bits.
      const bool nans = field.type == "float" && is_nan(expected) && is_nan(found);
      if (found != expected && !nans)
        wrong +=
            fmt::format("{}[{}] is {:#x}, not {:#x}; ", field.name, i, found, expected);
      ++compared;
    }
  }
  static bool is_nan(std::uint64_t bits) { return (bits & 0x7fff'ffffU) > 0x7f80'0000U; }

  AgreedValues values;
  std::uint64_t compared = 0;
  std::string wrong;
};

// What is done with a kind of message, whatever its type.
struct Kind {
  std::uint32_t id;
  void (*define)(FieldVisitor&);
  void (*read)(std::span<const std::byte> payload, FieldVisitor&);
  std::span<const std::byte> (*write)(FieldVisitor&, FrameWriter&, Signer*);
};

template <Message T>
constexpr Kind kind_of_message() {
  return {kFacts<T>.id,
          [](FieldVisitor& visitor) {
            T message;
            visit_fields(message, visitor);
          },
          [](std::span<const std::byte> payload, FieldVisitor& visitor) {
            T message = unpack<T>(payload);
            visit_fields(message, visitor);
          },
          [](FieldVisitor& visitor, FrameWriter& writer, Signer* signer) {
            T message;
            visit_fields(message, visitor);
            return signer ? writer.write(message, *signer, now()) : writer.write(message);
          }};
}

template <class... Ts>
std::vector<Kind> kinds_of(const std::tuple<Ts...>*) {
  return {kind_of_message<Ts>()...};
}

class TestPeer final : public transport::ChannelListener {
 public:
  transport::Endpoints& endpoints() { return endpoints_; }

  void say_definitions() const {
    for (const Kind& kind : kinds_) {
      Definition fields;
      kind.define(fields);
      const MessageEntry& entry = *find_message(kind.id);
      say(fmt::format(R"({{"id":{},"name":"{}","crc_extra":{},"fields":[{}]}})", entry.id,
                      entry.name, entry.crc_extra, fields.text));
    }
  }

  void say_summary() const {
    ParserCounts in = closed_;
    std::uint64_t lost = closed_lost_;
    for (const auto& [channel, link] : links_) add(link, in, lost);
    std::string texts;
    for (const std::string& text : wrong_texts_)
      texts += fmt::format(R"({}"{}")", texts.empty() ? "" : ",", text);
    using enum SignatureVerdict;
    const auto judged = [&](SignatureVerdict verdict) {
      const auto found = verdicts_.find(verdict);
      return found == verdicts_.end() ? 0 : found->second;
    };
    say(fmt::format(
        R"({{"frames":{},"compared":{},"fields":{},"kinds":{},"wrong":{},"texts":[{}],)"
        R"("valid":{},"unsigned":{},"wrong_key":{},"repeated":{},"old":{},)"
        R"("unknown":{},"bad_crc":{},"incompatible":{},"skipped_bytes":{},"lost":{}}})",
        in.frames, compared_, fields_, seen_.size(), wrong_, texts, judged(kValid),
        judged(kUnsigned), judged(kWrong), judged(kRepeated), judged(kOld), in.unknown,
        in.bad_crc, in.incompatible, in.skipped_bytes, lost));
  }

  bool all_is_right() const { return wrong_ == 0; }

 private:
  struct Link {
    FrameParser parser;
    SequenceWatch watch;
    std::map<std::pair<std::uint8_t, std::uint8_t>, FrameWriter> writers;
    Signer signer, other_signer;
  };

  void opened(ChannelId channel, transport::EndpointId, const std::string&) override {
    const auto link_id = static_cast<std::uint8_t>(channel);
    links_.emplace(channel, Link{{}, {}, {}, {kKey, link_id, 0}, {kNoKey, link_id, 0}});
    // A client speaks first, so that the other side knows where it is.
    FrameWriter hello(kUnanswered, 1);
    endpoints_.send(channel, hello.write(Heartbeat()));
  }
  void received(ChannelId channel, std::span<const std::byte> bytes) override {
    Link& link = links_.at(channel);
    link.parser.read(bytes, [&](const Frame& frame) { take(channel, link, frame); });
  }
  void closed(ChannelId channel, const std::string&) override {
    add(links_.at(channel), closed_, closed_lost_);
    links_.erase(channel);
  }

  static void add(const Link& link, ParserCounts& sum, std::uint64_t& lost) {
    const ParserCounts& more = link.parser.counts();
    sum.frames += more.frames;
    sum.unknown += more.unknown;
    sum.bad_crc += more.bad_crc;
    sum.incompatible += more.incompatible;
    sum.skipped_bytes += more.skipped_bytes;
    lost += link.watch.lost();
  }

  void take(ChannelId channel, Link& link, const Frame& frame) {
    link.watch.hear(frame);
    if (!frame.message || frame.system() == kUnanswered) return;
    const SignatureVerdict verdict = checker_.check(frame, now());
    ++verdicts_[verdict];
    const bool is_other = frame.system() == kOtherKey;
    if (frame.is_signed() &&
        verdict != (is_other ? SignatureVerdict::kWrong : SignatureVerdict::kValid))
      return;  // repeated or old, as the other side intends; it counts them
    if (frame.is_signed() != (frame.system() == kSigned || is_other) ||
        frame.version() != (frame.system() == kFirstVersion ? 1 : 2))
      complain(frame, "it has another form");
    const Kind& kind =
        *std::ranges::lower_bound(kinds_, frame.id(), std::less<>(), &Kind::id);
    const int round = frame.component() - 1;
    Compare compare(AgreedValues(frame.id(), round));
    kind.read(frame.payload(), compare);
    if (!compare.wrong.empty()) complain(frame, compare.wrong);
    ++compared_;
    fields_ += compare.compared;
    seen_[frame.id()] = true;
    answer(channel, link, kind, frame.system(), round + kRounds);
  }

  void answer(ChannelId channel, Link& link, const Kind& kind, std::uint8_t system,
              int round) {
    const auto component = static_cast<std::uint8_t>(round + 1);
    FrameWriter& writer =
        link.writers
            .try_emplace({system, component},
                         FrameWriter(system, component, system == kFirstVersion ? 1 : 2))
            .first->second;
    Signer* signer = system == kSigned     ? &link.signer
                     : system == kOtherKey ? &link.other_signer
                                           : nullptr;
    Fill fill(AgreedValues(kind.id, round));
    endpoints_.send(channel, kind.write(fill, writer, signer));
  }

  void complain(const Frame& frame, const std::string& what) {
    ++wrong_;
    if (wrong_texts_.size() < kMaxTexts)
      wrong_texts_.push_back(fmt::format("{} of {}/{}: {}", frame.message->name,
                                         frame.system(), frame.component(), what));
  }

  static inline const SigningKey kKey = key_of("both know it"),
                                 kNoKey = key_of("nobody else knows it");

  const std::vector<Kind> kinds_ = kinds_of(static_cast<const AllMessages*>(nullptr));
  SignatureChecker checker_{kKey};
  std::map<ChannelId, Link> links_;
  ParserCounts closed_;
  std::uint64_t closed_lost_ = 0;
  std::map<SignatureVerdict, std::uint64_t> verdicts_;
  std::map<std::uint32_t, bool> seen_;
  std::uint64_t compared_ = 0, fields_ = 0, wrong_ = 0;
  std::vector<std::string> wrong_texts_;
  transport::Endpoints endpoints_{*this};
};

bool input_has_ended() {
  pollfd input{STDIN_FILENO, POLLIN, 0};
  char byte = 0;
  return poll(&input, 1, 0) > 0 && read(STDIN_FILENO, &byte, 1) <= 0;
}

int run(int count, char** texts) {
  TestPeer peer;
  for (int i = 1; i < count; ++i) {
    const auto address = transport::parse_endpoint(texts[i]);
    const auto opened =
        address.ok() ? peer.endpoints().open(address.value()) : address.error();
    if (!opened.ok()) {
      say(fmt::format(R"({{"error":"{}"}})", opened.error().text()));
      return 2;
    }
  }
  peer.say_definitions();
  std::string places;
  for (const std::string& place : peer.endpoints().places())
    places += fmt::format(R"({}"{}")", places.empty() ? "" : ",", place);
  say(fmt::format(R"({{"places":[{}]}})", places));
  while (!input_has_ended()) peer.endpoints().run_for(std::chrono::milliseconds(20));
  peer.say_summary();
  return peer.all_is_right() ? 0 : 1;
}

}  // namespace
}  // namespace skein::mavlink

int main(int count, char** texts) {
  return skein::mavlink::run(count, texts);
}
