// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/hmi/serve/foxglove/viewers.h"

#include <algorithm>
#include <variant>

#include "skein/data/describe/wire.h"

namespace skein::hmi::foxglove {
namespace {

constexpr std::size_t kMaxSubscriptions = 20000;  // of a viewer

}  // namespace

Viewers::Viewers(const Facts& facts)
    : facts_(facts), sides_{Side{View(facts)}, Side{View(facts)}} {}

bool Viewers::is_watched(bool with_truth) const {
  return std::any_of(clients_.begin(), clients_.end(), [with_truth](const auto& each) {
    return each.second.sees_truth == with_truth;
  });
}

void Viewers::join(ClientNumber client, bool sees_truth) {
  // While nobody watched, nothing was taken in.
  if (!is_watched(sees_truth)) sides_[sees_truth].behind = true;
  announce(sees_truth);
  clients_[client].sees_truth = sees_truth;
  server_->send(client, server_info(facts_.name, facts_.session), true);
  server_->send(client, advertise(sides_[sees_truth].view.channels()), true);
}

void Viewers::set_sees_truth(ClientNumber client, bool sees_truth) {
  const auto found = clients_.find(client);
  if (found == clients_.end() || found->second.sees_truth == sees_truth) return;
  if (!is_watched(sees_truth)) sides_[sees_truth].behind = true;
  // Channels are the same, but what they show is not.
  std::vector<std::uint32_t> gone;
  for (const Channel& channel : sides_[!sees_truth].view.channels())
    gone.push_back(channel.id);
  server_->send(client, unadvertise(gone), true);
  announce(sees_truth);
  found->second.channel_of.clear();
  found->second.sees_truth = sees_truth;
  server_->send(client, advertise(sides_[sees_truth].view.channels()), true);
}

void Viewers::said(ClientNumber client, std::string_view message, bool is_text) {
  if (!is_text) return server_->send(client, warning("this server only shows."), true);
  const auto parsed = parse_client_message(message);
  if (!parsed) return server_->send(client, warning(parsed.error().text()), true);
  Client& who = clients_[client];
  if (const auto* unsubscribe = std::get_if<Unsubscribe>(&parsed.value())) {
    for (const std::uint32_t id : unsubscribe->ids) who.channel_of.erase(id);
    return;
  }
  const View& view = sides_[who.sees_truth].view;
  for (const Subscription& each : std::get<Subscribe>(parsed.value()).all) {
    const bool exists =
        std::any_of(view.channels().begin(), view.channels().end(),
                    [&](const Channel& channel) { return channel.id == each.channel; });
    if (!exists || who.channel_of.size() >= kMaxSubscriptions) {
      server_->send(client, warning("there is no such channel, or too many are sent."),
                    true);
      continue;
    }
    who.channel_of[each.id] = each.channel;
    if (const auto last = view.state(each.channel)) send(client, each.id, *last);
  }
}

void Viewers::announce(bool with_truth) {
  const auto channels = sides_[with_truth].view.take_new_channels();
  if (channels.empty()) return;
  const SharedBytes message = advertise(channels);
  for (const auto& [number, client] : clients_)
    if (client.sees_truth == with_truth) server_->send(number, message, true);
}

bool Viewers::deliver(bool with_truth, const SharedBytes& news,
                      const SharedBytes& state) {
  if (!is_watched(with_truth)) return false;
  Side& side = sides_[with_truth];
  const SharedBytes& taken = side.behind ? state : news;
  if (!taken) return side.behind;
  auto items = wire::decode<std::vector<LiveItem>>(*taken);
  if (!items) return false;
  side.behind = false;
  side.view.take(items.value());
  announce(with_truth);
  for (const View::Said& said : side.view.take_happened()) publish(with_truth, said);
  const Moment now = std::chrono::steady_clock::now();
  // Nothing may come behind the end of a run.
  if (now >= side.next || side.view.is_over()) {
    side.next = now + kPeriod;
    publish_changes(side, with_truth);
  }
  return false;
}

// Only what somebody has subscribed to is put into words.
void Viewers::publish_changes(Side& side, bool with_truth) {
  std::set<std::uint32_t> wanted;
  for (const auto& [number, client] : clients_)
    if (client.sees_truth == with_truth)
      for (const auto& [subscription, channel] : client.channel_of)
        wanted.insert(channel);
  for (const std::uint32_t channel : side.view.take_changed())
    if (wanted.count(channel) > 0)
      if (const auto said = side.view.state(channel)) publish(with_truth, *said);
}

void Viewers::publish(bool with_truth, const View::Said& said) {
  for (const auto& [number, client] : clients_) {
    if (client.sees_truth != with_truth) continue;
    for (const auto& [subscription, channel] : client.channel_of)
      if (channel == said.channel) send(number, subscription, said);
  }
}

void Viewers::send(ClientNumber client, std::uint32_t subscription,
                   const View::Said& said) {
  if (server_->waiting(client) <= kMaxWaiting)
    server_->send(client, message_data(subscription, said.time_ns, said.payload));
}

}  // namespace skein::hmi::foxglove
