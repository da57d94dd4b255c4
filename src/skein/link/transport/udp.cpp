// SPDX-License-Identifier: Apache-2.0
#include "skein/link/transport/udp.h"

#include <fmt/format.h>

#include <array>
#include <boost/asio/buffer.hpp>
#include <boost/asio/ip/multicast.hpp>
#include <boost/asio/ip/udp.hpp>
#include <boost/asio/steady_timer.hpp>
#include <chrono>
#include <map>

#include "skein/base/loopback.h"
#include "skein/link/transport/resolve.h"

namespace skein::transport {
namespace {

using boost::asio::ip::udp;
using Clock = std::chrono::steady_clock;

constexpr std::chrono::seconds kForgotten{60};  // after which a silent sender is
constexpr std::chrono::seconds kLook{1};        // between looks for such
constexpr std::size_t kMaxPeers = 512;
constexpr int kReceiveBuffer = 1 << 20;  // of a socket, asked for [B]

// Datagrams as they come; what cannot be sent at once is dropped.
class Datagrams : public Endpoint {
 public:
  explicit Datagrams(Hub& hub) : hub_(hub), socket_(hub.io) {}

  boost::system::error_code open(const udp::endpoint& at) {
    boost::system::error_code error;
    socket_.open(at.protocol(), error);
    if (!error) socket_.bind(at, error);
    if (!error) socket_.non_blocking(true, error);
    // Bursts of many vehicles; systems that allow less give what they can.
    boost::system::error_code smaller;
    socket_.set_option(boost::asio::socket_base::receive_buffer_size(kReceiveBuffer),
                       smaller);
    return error;
  }
  boost::system::error_code allow_broadcast() {
    boost::system::error_code error;
    socket_.set_option(boost::asio::socket_base::broadcast(true), error);
    return error;
  }
  // Several programs of a machine may be in one group.
  boost::system::error_code open_group(const udp::endpoint& group,
                                       const boost::asio::ip::address_v4& interface) {
    namespace multicast = boost::asio::ip::multicast;
    boost::system::error_code error;
    socket_.open(udp::v4(), error);
    if (!error) socket_.set_option(udp::socket::reuse_address(true), error);
    if (!error) socket_.bind(group, error);
    if (!error) socket_.non_blocking(true, error);
    const auto set = [&](const auto& option) {
      if (!error) socket_.set_option(option, error);
    };
    set(multicast::join_group(group.address().to_v4(), interface));
    set(multicast::outbound_interface(interface));
    set(multicast::hops(1));
    set(multicast::enable_loopback(true));
    return error;
  }
  void receive() {
    socket_.async_receive_from(
        boost::asio::buffer(in_), from_,
        [this](boost::system::error_code error, std::size_t count) {
          if (error == boost::asio::error::operation_aborted) return;
          // Other errors are of what was sent before.
          if (!error) came(from_, std::span(in_).first(count));
          receive();
        });
  }

 protected:
  virtual void came(const udp::endpoint& from, std::span<const std::byte> bytes) = 0;

  bool send_to(const udp::endpoint& to, std::span<const std::byte> bytes) {
    boost::system::error_code error;
    socket_.send_to(boost::asio::buffer(bytes.data(), bytes.size()), to, 0, error);
    return !error;
  }

  Hub& hub_;
  udp::socket socket_;

 private:
  std::array<std::byte, 65'536> in_;
  udp::endpoint from_;
};

// Answers those who have sent something.
class Server final : public Datagrams {
 public:
  explicit Server(Hub& hub) : Datagrams(hub), timer_(hub.io) {}

  void begin() {
    receive();
    watch();
  }

  bool send(ChannelId channel, std::span<const std::byte> bytes) override {
    const auto peer = peers_.find(channel);
    return peer != peers_.end() && send_to(peer->second.at, bytes);
  }

  std::string place() const override {
    return "udpin:" + name_of(socket_.local_endpoint());
  }

 private:
  struct Peer {
    udp::endpoint at;
    Clock::time_point heard;
  };

  void came(const udp::endpoint& from, std::span<const std::byte> bytes) override {
    auto known = channels_.find(from);
    if (known == channels_.end()) {
      if (peers_.size() >= kMaxPeers) return;
      const ChannelId channel =
          hub_.open(*this, fmt::format("{} from {}", place(), name_of(from)));
      known = channels_.emplace(from, channel).first;
      peers_.emplace(channel, Peer{from, {}});
    }
    peers_.at(known->second).heard = Clock::now();
    hub_.listener.received(known->second, bytes);
  }

  void watch() {
    timer_.expires_after(kLook);
    timer_.async_wait([this](boost::system::error_code error) {
      if (error) return;
      const Clock::time_point now = Clock::now();
      for (auto peer = peers_.begin(); peer != peers_.end();) {
        const auto [channel, state] = *peer;
        ++peer;
        if (now - state.heard < kForgotten) continue;
        peers_.erase(channel);
        channels_.erase(state.at);
        hub_.close(channel, fmt::format("silent for {} s", kForgotten.count()));
      }
      watch();
    });
  }

  boost::asio::steady_timer timer_;
  std::map<udp::endpoint, ChannelId> channels_;
  std::map<ChannelId, Peer> peers_;
};

// Sends to one place, and hears whoever answers.
class Client final : public Datagrams {
 public:
  Client(Hub& hub, const udp::endpoint& to) : Datagrams(hub), to_(to) {}

  void begin(const std::string& name) {
    channel_ = hub_.open(*this, name);
    receive();
  }

  bool send(ChannelId, std::span<const std::byte> bytes) override {
    return send_to(to_, bytes);
  }

 private:
  void came(const udp::endpoint&, std::span<const std::byte> bytes) override {
    hub_.listener.received(channel_, bytes);
  }

  udp::endpoint to_;
  ChannelId channel_ = 0;
};

template <class Address>
Result<std::unique_ptr<Endpoint>> open_client(Hub& hub, const Address& address,
                                              bool broadcast) {
  const Result<udp::endpoint> to = resolve<udp>(hub.io, address.to);
  if (!to) return to.error();
  auto client = std::make_unique<Client>(hub, to.value());
  // Who talks to this machine is heard by this machine alone.
  const bool local = is_loopback(to.value().address().to_string());
  boost::system::error_code error =
      client->open(local ? udp::endpoint(to.value().address(), 0)
                         : udp::endpoint(to.value().protocol(), 0));
  if (!error && broadcast) error = client->allow_broadcast();
  if (error) return bad_place(address.to, error);
  client->begin(text_of(address));
  return std::unique_ptr<Endpoint>(std::move(client));
}

}  // namespace

Result<std::unique_ptr<Endpoint>> open_udp(Hub& hub, const UdpServer& address) {
  const Result<udp::endpoint> at = resolve<udp>(hub.io, address.at);
  if (!at) return at.error();
  auto server = std::make_unique<Server>(hub);
  if (const auto error = server->open(at.value())) return bad_place(address.at, error);
  server->begin();
  return std::unique_ptr<Endpoint>(std::move(server));
}

Result<std::unique_ptr<Endpoint>> open_udp(Hub& hub, const UdpClient& address) {
  return open_client(hub, address, false);
}

Result<std::unique_ptr<Endpoint>> open_udp(Hub& hub, const UdpBroadcast& address) {
  return open_client(hub, address, true);
}

Result<std::unique_ptr<Endpoint>> open_udp(Hub& hub, const UdpMulticast& address) {
  const Result<udp::endpoint> group = resolve<udp>(hub.io, address.group);
  if (!group) return group.error();
  const Result<udp::endpoint> interface = resolve<udp>(hub.io, {address.interface, 0});
  if (!interface) return interface.error();
  auto client = std::make_unique<Client>(hub, group.value());
  if (const auto error =
          client->open_group(group.value(), interface.value().address().to_v4()))
    return bad_place(address.group, error);
  client->begin(text_of(address));
  return std::unique_ptr<Endpoint>(std::move(client));
}

}  // namespace skein::transport
