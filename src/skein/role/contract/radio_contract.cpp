// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <map>
#include <set>

#include "skein/role/contract/checks.h"
#include "skein/role/radio.h"

namespace skein::contract {
namespace {

using Name = std::pair<std::uint32_t, std::uint64_t>;  // sender and number

Name name_of(const Message& message) {
  return {message.from.value, message.number};
}

// Messages of several senders at random times, in the order of time and entity.
std::vector<Message> traffic(std::span<const EntityId> entities) {
  RandomStream random = draws(21);
  std::vector<Message> all;
  std::map<std::uint32_t, std::uint64_t> numbers;
  for (int step = 0; step < 200; ++step)
    for (const EntityId from : entities) {
      const double luck = random.uniform();
      const auto to = static_cast<std::size_t>(random.uniform() *
                                               static_cast<double>(entities.size()));
      if (luck < 0.5 || entities[to] == from) continue;
      Message message;
      message.from = from;
      message.to = entities[to];
      message.number = ++numbers[from.value];
      message.sent = Time::from_seconds(0.1 * step);
      message.content =
          FireReading{message.sent, from, place_within(random, 500), 1, true};
      all.push_back(message);
    }
  return all;
}

// What a radio does with messages: each with when it came out, in that order.
struct Outcome {
  std::vector<Name> arrived, lost;
};

Outcome pass(Radio& radio, const std::vector<Message>& messages, Checks& checks) {
  constexpr int kSteps = 200 + 1200;  // two minutes after the last was sent
  std::map<Name, const Message*> in_transit;
  Outcome outcome;
  std::size_t next = 0;
  for (int step = 0; step < kSteps; ++step) {
    const Time now = Time::from_seconds(0.1 * step);
    for (; next < messages.size() && messages[next].sent <= now; ++next) {
      radio.send(messages[next]);
      in_transit.emplace(name_of(messages[next]), &messages[next]);
    }
    RadioNews news;
    radio.deliver(now, news);
    for (const MessageOutcome& end : news.ended) {
      const Message& message = end.message;
      const auto sent = in_transit.find(name_of(message));
      checks.expect(sent != in_transit.end(),
                    "a message comes out twice, or was never sent");
      if (sent == in_transit.end()) continue;
      checks.expect(message.to == sent->second->to &&
                        message.sent == sent->second->sent &&
                        message.content.index() == sent->second->content.index(),
                    "a message is changed in transit");
      in_transit.erase(sent);
      (end.cause == LossCause::kNone ? outcome.arrived : outcome.lost)
          .push_back(name_of(message));
    }
  }
  checks.expect(in_transit.empty(),
                "after two minutes a message is neither delivered nor lost");
  RadioNews last;
  radio.end(last);
  checks.expect(last.ended.empty(), "what has ended is pending in the end");
  return outcome;
}

// A run that ends while messages are on their way.
void cut_short(Radio& radio, const std::vector<Message>& messages, Checks& checks) {
  constexpr int kSteps = 60;
  std::map<Name, int> sent;
  RadioNews news;
  std::size_t next = 0;
  for (int step = 0; step < kSteps; ++step) {
    const Time now = Time::from_seconds(0.1 * step);
    for (; next < messages.size() && messages[next].sent <= now; ++next) {
      radio.send(messages[next]);
      ++sent[name_of(messages[next])];
    }
    radio.deliver(now, news);
  }
  radio.end(news);
  for (const MessageOutcome& end : news.ended) --sent[name_of(end.message)];
  checks.expect(std::all_of(sent.begin(), sent.end(),
                            [](const auto& each) { return each.second == 0; }),
                "when a run ends a message is not delivered, lost or pending, once");
}

}  // namespace

Violations radio_violations(const Make<Radio>& make, std::span<const EntityId> entities) {
  Checks checks;
  const std::vector<Message> messages = traffic(entities);
  const auto radio = make(), twin = make();
  const Outcome one = pass(*radio, messages, checks);
  const Outcome other = pass(*twin, messages, checks);
  checks.expect(one.arrived == other.arrived && one.lost == other.lost,
                "two equal ones treat the same messages differently");
  cut_short(*make(), messages, checks);
  return checks.take();
}

}  // namespace skein::contract
