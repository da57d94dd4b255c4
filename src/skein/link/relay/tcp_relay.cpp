// SPDX-License-Identifier: Apache-2.0
#include "skein/link/relay/tcp_relay.h"

#include <array>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/write.hpp>
#include <map>

#include "skein/link/relay/core_relay.h"
#include "skein/link/relay/lane.h"
#include "skein/link/relay/own_place.h"
#include "skein/link/transport/resolve.h"

namespace skein::relay {
namespace {

using boost::asio::ip::tcp;
using impairment::Direction;
using impairment::kDirections;

constexpr std::chrono::seconds kAgain{1};        // after accepting has failed
constexpr std::chrono::seconds kConnecting{10};  // end b has to answer within
constexpr std::size_t kBytesAtOnce = 16'384;

void set_up(tcp::socket& socket) {
  boost::system::error_code ignored;
  socket.set_option(tcp::no_delay(true), ignored);
  socket.set_option(boost::asio::socket_base::keep_alive(true), ignored);
}

// One direction of a connection.
struct Way {
  Way(RelayCore& core, std::uint32_t session, Direction direction, tcp::socket& source,
      tcp::socket& sink)
      : lane(core, core.make_channel(impairment::Traffic::kBytes, session, direction)),
        from(source),
        to(sink) {}

  Lane lane;
  tcp::socket& from;
  tcp::socket& to;
  bool reading = false, writing = false;
  bool ended = false;  // nothing more comes in
  bool shut = false;   // nothing more goes out
  std::array<std::byte, kBytesAtOnce> in;
  std::vector<std::byte> out;
};

class TcpSession final : public Session, public std::enable_shared_from_this<TcpSession> {
 public:
  TcpSession(RelayCore& core, tcp::socket caller, std::string name, std::uint32_t number)
      : core_(core),
        name_(std::move(name)),
        number_(number),
        a_(std::move(caller)),
        b_(core.io()),
        timer_(core.io()),
        to_b_(core, number, Direction::kToB, a_, b_),
        to_a_(core, number, Direction::kToA, b_, a_) {}

  void connect(const tcp::endpoint& target) {
    b_.async_connect(
        target, [self = shared_from_this(), target](boost::system::error_code error) {
          self->timer_.cancel();
          if (self->over_) return;
          if (error) {
            self->core_.count_failed();
            return self->end(transport::name_of(target) + ": " + error.message());
          }
          set_up(self->b_);
          self->connected_ = true;
          self->pump();
        });
    timer_.expires_after(kConnecting);
    timer_.async_wait([self = shared_from_this()](boost::system::error_code error) {
      boost::system::error_code ignored;
      if (!error && !self->connected_) self->b_.close(ignored);
    });
  }

  void end(const std::string& why) {
    if (over_) return;
    stop();
    core_.remove(number_, why);
  }

  impairment::ImpairedChannel& channel(Direction direction) override {
    return way(direction).lane.channel();
  }
  void pump() override {
    pump(to_b_);
    pump(to_a_);
  }
  void stop() override {
    over_ = true;
    timer_.cancel();
    to_b_.lane.stop();
    to_a_.lane.stop();
    boost::system::error_code ignored;
    a_.close(ignored);
    b_.close(ignored);
  }
  SessionReport report() override {
    SessionReport report;
    report.number = number_;
    report.name = name_;
    for (const Direction direction : kDirections)
      report.directions[index_of(direction)] = way(direction).lane.report();
    return report;
  }

 private:
  Way& way(Direction direction) { return direction == Direction::kToB ? to_b_ : to_a_; }

  void pump(Way& way) {
    if (over_ || !connected_) return;
    const Time now = core_.now();
    if (!way.writing) write(way, now);
    if (over_) return;
    if (!way.reading && !way.ended && way.lane.channel().room() > 0) read(way);
    // While bytes go out nothing else can.
    if (!way.writing)
      way.lane.wait([self = shared_from_this(), &way] { self->pump(way); });
  }

  void write(Way& way, Time now) {
    while (way.out.size() < kBytesAtOnce) {
      const auto piece = way.lane.channel().take(now);
      if (!piece) break;
      way.out.insert(way.out.end(), piece->begin(), piece->end());
    }
    if (way.out.empty()) {
      if (way.ended && !way.shut && way.lane.channel().empty()) shut(way);
      return;
    }
    way.writing = true;
    boost::asio::async_write(
        way.to, boost::asio::buffer(way.out),
        [self = shared_from_this(), &way](boost::system::error_code error, std::size_t) {
          way.writing = false;
          way.out.clear();
          if (error) return self->end(error.message());
          self->pump(way);
        });
  }

  void shut(Way& way) {
    way.shut = true;
    boost::system::error_code ignored;
    way.to.shutdown(tcp::socket::shutdown_send, ignored);
    if (to_b_.shut && to_a_.shut) end("closed");
  }

  void read(Way& way) {
    way.reading = true;
    const std::size_t most = std::min(way.in.size(), way.lane.channel().room());
    way.from.async_read_some(boost::asio::buffer(way.in.data(), most),
                             [self = shared_from_this(), &way](
                                 boost::system::error_code error, std::size_t count) {
                               way.reading = false;
                               if (self->over_) return;
                               if (error && error != boost::asio::error::eof)
                                 return self->end(error.message());
                               if (error)
                                 way.ended = true;
                               else
                                 way.lane.channel().put(std::span(way.in).first(count),
                                                        self->core_.now());
                               self->pump(way);
                             });
  }

  RelayCore& core_;
  std::string name_;
  std::uint32_t number_;
  tcp::socket a_, b_;
  boost::asio::steady_timer timer_;
  Way to_b_, to_a_;
  bool connected_ = false, over_ = false;
};

class TcpRelay final : public CoreRelay {
 public:
  TcpRelay(const RelayOptions& options, RelayNews news)
      : CoreRelay(options, std::move(news)), acceptor_(core_.io()), timer_(core_.io()) {}
  ~TcpRelay() override { core_.stop(); }

  Result<void> begin(const RelayOptions& options) {
    const transport::NetworkPlace& at = std::get<transport::TcpServer>(options.listen).at;
    const auto here = transport::resolve<tcp>(core_.io(), at);
    if (!here) return here.error();
    const auto there = transport::resolve<tcp>(core_.io(), options.to);
    if (!there) return there.error();
    target_ = there.value();
    if (const auto error = listen(here.value())) return transport::bad_place(at, error);
    const auto good = check_not_itself(acceptor_.local_endpoint(), target_);
    if (!good) return good;
    accept();
    return {};
  }

  std::string place() const override {
    return "tcpin:" + transport::name_of(acceptor_.local_endpoint());
  }

 private:
  boost::system::error_code listen(const tcp::endpoint& at) {
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

  void wait() {
    timer_.expires_after(kAgain);
    timer_.async_wait([this](boost::system::error_code error) {
      if (!error) accept();
    });
  }

  void take(tcp::socket socket) {
    boost::system::error_code error;
    const tcp::endpoint caller = socket.remote_endpoint(error);
    if (error) return;  // it has gone
    if (core_.full()) return core_.count_turned_away();
    set_up(socket);
    core_.now();
    const std::uint32_t number = core_.next_number();
    const auto session = std::make_shared<TcpSession>(core_, std::move(socket),
                                                      transport::name_of(caller), number);
    core_.add(number, session);
    session->connect(target_);
  }

  tcp::acceptor acceptor_;
  boost::asio::steady_timer timer_;
  tcp::endpoint target_;
};

}  // namespace

Result<std::unique_ptr<Relay>> open_tcp_relay(const RelayOptions& options,
                                              RelayNews news) {
  auto relay = std::make_unique<TcpRelay>(options, std::move(news));
  if (auto begun = relay->begin(options); !begun) return begun.error();
  return std::unique_ptr<Relay>(std::move(relay));
}

}  // namespace skein::relay
