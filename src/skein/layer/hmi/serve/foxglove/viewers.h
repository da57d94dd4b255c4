// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <map>

#include "skein/layer/hmi/serve/foxglove/view.h"
#include "skein/layer/hmi/serve/web_server.h"

namespace skein::hmi::foxglove {

/// Those who watch a run by Foxglove's protocol, what they have subscribed to, and what
/// they are sent of it: how things are some four times a second, what happens at once.
/// Who reads too slowly is not sent some of it. By the server's thread alone.
class Viewers {
 public:
  /// Of how things are.
  static constexpr auto kPeriod = std::chrono::milliseconds(250);
  /// As long as more than this waits for a viewer, it is sent nothing.
  static constexpr std::size_t kMaxWaiting = 4 << 20;

  explicit Viewers(const Facts& facts);

  /// Once, before anything else.
  void attach(WebServer& server) { server_ = &server; }

  void join(ClientNumber client, bool sees_truth);
  void leave(ClientNumber client) { clients_.erase(client); }
  /// From now on it is sent the other view.
  void set_sees_truth(ClientNumber client, bool sees_truth);
  void said(ClientNumber client, std::string_view message, bool is_text);

  /// All have missed something: they are shown the state first.
  void fall_behind() {
    for (Side& side : sides_) side.behind = true;
  }

  /// Takes in what the run says to those who see the truth, or to the others.
  /// @param news, state  as in LiveBatch; null: none.
  /// @returns            whether the state is needed.
  bool deliver(bool with_truth, const SharedBytes& news, const SharedBytes& state);

 private:
  using Moment = std::chrono::steady_clock::time_point;
  struct Side {
    View view;
    bool behind = true;  // needs the state first
    Moment next{};
  };
  struct Client {
    bool sees_truth = false;
    std::map<std::uint32_t, std::uint32_t> channel_of;  // by subscription
  };
  bool is_watched(bool with_truth) const;
  void announce(bool with_truth);
  void publish(bool with_truth, const View::Said& said);
  void publish_changes(Side& side, bool with_truth);
  void send(ClientNumber client, std::uint32_t subscription, const View::Said& said);

  Facts facts_;
  WebServer* server_ = nullptr;
  std::array<Side, 2> sides_;  // without and with the truth
  std::map<ClientNumber, Client> clients_;
};

}  // namespace skein::hmi::foxglove
