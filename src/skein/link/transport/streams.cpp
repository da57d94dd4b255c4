// SPDX-License-Identifier: Apache-2.0
#include "skein/link/transport/streams.h"

#include <fmt/format.h>

#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/serial_port.hpp>
#include <boost/asio/steady_timer.hpp>
#include <chrono>

#include "skein/link/transport/resolve.h"
#include "skein/link/transport/stream_channel.h"

namespace skein::transport {
namespace {

using boost::asio::serial_port;
using boost::asio::ip::tcp;

constexpr std::chrono::seconds kAgain{1};  // between tries
constexpr std::size_t kMaxConnections = 512;
constexpr std::size_t kTcpRoom = std::size_t{256} << 10;  // bytes that may wait to go out
// More would be too old when it arrives: at 57600 baud this takes 1.4 s.
constexpr std::size_t kSerialRoom = std::size_t{8} << 10;

void set_up(tcp::socket& socket) {
  boost::system::error_code ignored;
  socket.set_option(tcp::no_delay(true), ignored);
  // A peer that vanishes without a word is found out.
  socket.set_option(boost::asio::socket_base::keep_alive(true), ignored);
}

// What belongs to a connection sends for itself; these only open connections.
class Opener : public Endpoint {
 public:
  bool send(ChannelId, std::span<const std::byte>) override { return false; }
};

class Listener final : public Opener {
 public:
  explicit Listener(Hub& hub) : hub_(hub), acceptor_(hub.io), timer_(hub.io) {}

  boost::system::error_code open(const tcp::endpoint& at) {
    boost::system::error_code error;
    acceptor_.open(at.protocol(), error);
    if (!error) acceptor_.set_option(tcp::acceptor::reuse_address(true), error);
    if (!error) acceptor_.bind(at, error);
    if (!error) acceptor_.listen(boost::asio::socket_base::max_listen_connections, error);
    return error;
  }

  void accept() {
    acceptor_.async_accept([this](boost::system::error_code error, tcp::socket socket) {
      if (error == boost::asio::error::operation_aborted) return;
      if (error) return wait();  // such as too many files open
      take(std::move(socket));
      accept();
    });
  }

  std::string place() const override {
    return "tcpin:" + name_of(acceptor_.local_endpoint());
  }

 private:
  void wait() {
    timer_.expires_after(kAgain);
    timer_.async_wait([this](boost::system::error_code error) {
      if (!error) accept();
    });
  }

  void take(tcp::socket socket) {
    boost::system::error_code error;
    const tcp::endpoint peer = socket.remote_endpoint(error);
    if (error || connections_ >= kMaxConnections) return;  // and with it the socket
    set_up(socket);
    ++connections_;
    std::make_shared<StreamChannel<tcp::socket>>(hub_, std::move(socket), kTcpRoom,
                                                 [this] { --connections_; })
        ->begin(fmt::format("{} from {}", place(), name_of(peer)));
  }

  Hub& hub_;
  tcp::acceptor acceptor_;
  boost::asio::steady_timer timer_;
  std::size_t connections_ = 0;
};

class Connector final : public Opener {
 public:
  Connector(Hub& hub, const tcp::endpoint& to, std::string name)
      : hub_(hub), to_(to), name_(std::move(name)), socket_(hub.io), timer_(hub.io) {}

  void connect() {
    socket_ = tcp::socket(hub_.io);
    socket_.async_connect(to_, [this](boost::system::error_code error) {
      timer_.cancel();
      if (error) return again();
      set_up(socket_);
      std::make_shared<StreamChannel<tcp::socket>>(hub_, std::move(socket_), kTcpRoom,
                                                   [this] { again(); })
          ->begin(name_);
    });
    // Where packets vanish, connecting itself would take minutes to fail.
    timer_.expires_after(3 * kAgain);
    timer_.async_wait([this](boost::system::error_code error) {
      boost::system::error_code ignored;
      if (!error) socket_.close(ignored);
    });
  }

 private:
  void again() {
    timer_.expires_after(kAgain);
    timer_.async_wait([this](boost::system::error_code error) {
      if (!error) connect();
    });
  }

  Hub& hub_;
  tcp::endpoint to_;
  std::string name_;
  tcp::socket socket_;
  boost::asio::steady_timer timer_;
};

class Line final : public Opener {
 public:
  Line(Hub& hub, const SerialLine& address)
      : hub_(hub), address_(address), timer_(hub.io) {}

  void connect() {
    serial_port port(hub_.io);
    boost::system::error_code error;
    port.open(address_.device, error);
    if (!error) port.set_option(serial_port::baud_rate(address_.baud), error);
    if (!error) port.set_option(serial_port::character_size(8), error);
    if (!error)
      port.set_option(serial_port::flow_control(serial_port::flow_control::none), error);
    if (error) return again();
    std::make_shared<StreamChannel<serial_port>>(hub_, std::move(port), kSerialRoom,
                                                 [this] { again(); })
        ->begin(text_of(address_));
  }

 private:
  void again() {
    timer_.expires_after(kAgain);
    timer_.async_wait([this](boost::system::error_code error) {
      if (!error) connect();
    });
  }

  Hub& hub_;
  SerialLine address_;
  boost::asio::steady_timer timer_;
};

}  // namespace

Result<std::unique_ptr<Endpoint>> open_tcp(Hub& hub, const TcpServer& address) {
  const Result<tcp::endpoint> at = resolve<tcp>(hub.io, address.at);
  if (!at) return at.error();
  auto listener = std::make_unique<Listener>(hub);
  if (const auto error = listener->open(at.value())) return bad_place(address.at, error);
  listener->accept();
  return std::unique_ptr<Endpoint>(std::move(listener));
}

Result<std::unique_ptr<Endpoint>> open_tcp(Hub& hub, const TcpClient& address) {
  const Result<tcp::endpoint> to = resolve<tcp>(hub.io, address.to);
  if (!to) return to.error();
  auto connector = std::make_unique<Connector>(hub, to.value(), text_of(address));
  connector->connect();
  return std::unique_ptr<Endpoint>(std::move(connector));
}

std::unique_ptr<Endpoint> open_serial(Hub& hub, const SerialLine& address) {
  auto line = std::make_unique<Line>(hub, address);
  line->connect();
  return line;
}

}  // namespace skein::transport
