// SPDX-License-Identifier: Apache-2.0
#include "skein/link/relay/udp_relay.h"

#include <array>
#include <boost/asio/buffer.hpp>
#include <boost/asio/ip/udp.hpp>
#include <map>

#include "skein/base/loopback.h"
#include "skein/link/relay/core_relay.h"
#include "skein/link/relay/lane.h"
#include "skein/link/relay/own_place.h"
#include "skein/link/transport/resolve.h"

namespace skein::relay {
namespace {

using boost::asio::ip::udp;
using impairment::Direction;

constexpr std::chrono::seconds kLook{1};  // between looks for silent sessions
constexpr int kAtOnce = 64;               // datagrams of a socket before others' turn
constexpr int kReceiveBuffer = 1 << 20;   // of a socket, asked for [B]

using Buffer = std::array<std::byte, 65'536>;

boost::system::error_code open_socket(udp::socket& socket, const udp::endpoint& at) {
  boost::system::error_code error, smaller;
  socket.open(at.protocol(), error);
  if (!error) socket.bind(at, error);
  if (!error) socket.non_blocking(true, error);
  socket.set_option(boost::asio::socket_base::receive_buffer_size(kReceiveBuffer),
                    smaller);
  return error;
}

// One caller, and the socket that stands for it towards end b.
class UdpSession final : public Session, public std::enable_shared_from_this<UdpSession> {
 public:
  UdpSession(RelayCore& core, udp::socket& listener, Buffer& buffer,
             const udp::endpoint& caller, std::uint32_t number)
      : core_(core),
        caller_(caller),
        number_(number),
        listener_(listener),
        buffer_(buffer),
        socket_(core.io()),
        to_b_(core,
              core.make_channel(impairment::Traffic::kPackets, number, Direction::kToB)),
        to_a_(core,
              core.make_channel(impairment::Traffic::kPackets, number, Direction::kToA)) {
  }

  boost::system::error_code open(const udp::endpoint& target) {
    const bool local = is_loopback(target.address().to_string());
    boost::system::error_code error =
        open_socket(socket_, local ? udp::endpoint(target.address(), 0)
                                   : udp::endpoint(target.protocol(), 0));
    // Connected: whether nobody is there is heard.
    if (!error) socket_.connect(target, error);
    return error;
  }

  void begin() { receive(); }
  void came_from_a(std::span<const std::byte> bytes) {
    heard_ = core_.now();
    to_b_.channel().put(bytes, heard_);
    pump_to_b();
  }

  bool is_silent(Time now) {
    return now - heard_ >= core_.options().idle && to_b_.channel().empty() &&
           to_a_.channel().empty();
  }

  impairment::ImpairedChannel& channel(Direction direction) override {
    return (direction == Direction::kToB ? to_b_ : to_a_).channel();
  }
  void pump() override {
    pump_to_b();
    pump_to_a();
  }
  void stop() override {
    over_ = true;
    to_b_.stop();
    to_a_.stop();
    boost::system::error_code ignored;
    socket_.close(ignored);
  }
  SessionReport report() override {
    SessionReport report;
    report.number = number_;
    report.name = transport::name_of(caller_);
    report.directions[index_of(Direction::kToB)] = to_b_.report();
    report.directions[index_of(Direction::kToA)] = to_a_.report();
    report.directions[index_of(Direction::kToB)].refused = refused_;
    report.directions[index_of(Direction::kToB)].unsent = unsent_to_b_;
    report.directions[index_of(Direction::kToA)].unsent = unsent_to_a_;
    return report;
  }

  const udp::endpoint& caller() const { return caller_; }
  std::uint32_t number() const { return number_; }

 private:
  void receive() {
    socket_.async_wait(udp::socket::wait_read,
                       [self = shared_from_this()](boost::system::error_code error) {
                         if (error || self->over_) return;
                         self->drain();
                         self->receive();
                       });
  }

  void drain() {
    for (int k = 0; k < kAtOnce; ++k) {
      boost::system::error_code error;
      const std::size_t count = socket_.receive(boost::asio::buffer(buffer_), 0, error);
      if (error == boost::asio::error::connection_refused) {
        ++refused_;
        continue;
      }
      if (error) break;
      heard_ = core_.now();
      to_a_.channel().put(std::span(buffer_).first(count), heard_);
    }
    pump_to_a();
  }

  void pump_to_b() {
    if (over_) return;
    const Time now = core_.now();
    while (const auto packet = to_b_.channel().take(now)) send_to_b(*packet);
    to_b_.wait([self = shared_from_this()] { self->pump_to_b(); });
  }

  void pump_to_a() {
    if (over_) return;
    const Time now = core_.now();
    while (const auto packet = to_a_.channel().take(now)) {
      boost::system::error_code error;
      listener_.send_to(boost::asio::buffer(packet->data(), packet->size()), caller_, 0,
                        error);
      if (error) ++unsent_to_a_;
    }
    to_a_.wait([self = shared_from_this()] { self->pump_to_a(); });
  }

  void send_to_b(std::span<const std::byte> packet) {
    // That an earlier packet was refused is said in place of sending this one.
    for (int k = 0; k < 2; ++k) {
      boost::system::error_code error;
      socket_.send(boost::asio::buffer(packet.data(), packet.size()), 0, error);
      if (!error) return;
      if (error != boost::asio::error::connection_refused) break;
      ++refused_;
    }
    ++unsent_to_b_;
  }

  RelayCore& core_;
  udp::endpoint caller_;
  std::uint32_t number_;
  udp::socket& listener_;
  Buffer& buffer_;
  udp::socket socket_;
  Lane to_b_, to_a_;
  Time heard_;
  std::uint64_t refused_ = 0, unsent_to_b_ = 0, unsent_to_a_ = 0;
  bool over_ = false;
};

class UdpRelay final : public CoreRelay {
 public:
  UdpRelay(const RelayOptions& options, RelayNews news)
      : CoreRelay(options, std::move(news)), socket_(core_.io()), timer_(core_.io()) {}
  ~UdpRelay() override { core_.stop(); }

  Result<void> begin(const RelayOptions& options) {
    const transport::NetworkPlace& at = std::get<transport::UdpServer>(options.listen).at;
    const auto here = transport::resolve<udp>(core_.io(), at);
    if (!here) return here.error();
    const auto there = transport::resolve<udp>(core_.io(), options.to);
    if (!there) return there.error();
    target_ = there.value();
    if (const auto error = open_socket(socket_, here.value()))
      return transport::bad_place(at, error);
    const auto good = check_not_itself(socket_.local_endpoint(), target_);
    if (!good) return good;
    receive();
    look();
    return {};
  }

  std::string place() const override {
    return "udpin:" + transport::name_of(socket_.local_endpoint());
  }

 private:
  void receive() {
    socket_.async_wait(udp::socket::wait_read, [this](boost::system::error_code error) {
      if (error) return;
      drain();
      receive();
    });
  }

  void drain() {
    for (int k = 0; k < kAtOnce; ++k) {
      udp::endpoint caller;
      boost::system::error_code error;
      const std::size_t count =
          socket_.receive_from(boost::asio::buffer(buffer_), caller, 0, error);
      if (error) return;
      if (UdpSession* session = session_of(caller))
        session->came_from_a(std::span(buffer_).first(count));
      else
        core_.count_turned_away();
    }
  }

  // Null: there are too many, or the system has no socket for it.
  UdpSession* session_of(const udp::endpoint& caller) {
    const auto known = sessions_.find(caller);
    if (known != sessions_.end()) return known->second.get();
    if (core_.full()) return nullptr;
    core_.now();
    const std::uint32_t number = core_.next_number();
    const auto session =
        std::make_shared<UdpSession>(core_, socket_, buffer_, caller, number);
    if (session->open(target_)) return nullptr;
    sessions_.emplace(caller, session);
    core_.add(number, session);
    session->begin();
    return session.get();
  }

  void look() {
    timer_.expires_after(kLook);
    timer_.async_wait([this](boost::system::error_code error) {
      if (error) return;
      const Time now = core_.now();
      for (auto each = sessions_.begin(); each != sessions_.end();) {
        const std::shared_ptr<UdpSession> session = each->second;
        ++each;
        if (!session->is_silent(now)) continue;
        session->stop();
        sessions_.erase(session->caller());
        core_.remove(session->number(), "silent");
      }
      look();
    });
  }

  udp::socket socket_;
  boost::asio::steady_timer timer_;
  udp::endpoint target_;
  std::map<udp::endpoint, std::shared_ptr<UdpSession>> sessions_;
  Buffer buffer_;
};

}  // namespace

Result<std::unique_ptr<Relay>> open_udp_relay(const RelayOptions& options,
                                              RelayNews news) {
  auto relay = std::make_unique<UdpRelay>(options, std::move(news));
  if (auto begun = relay->begin(options); !begun) return begun.error();
  return std::unique_ptr<Relay>(std::move(relay));
}

}  // namespace skein::relay
