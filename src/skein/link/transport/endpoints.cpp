// SPDX-License-Identifier: Apache-2.0
#include "skein/link/transport/endpoints.h"

#include <boost/asio/executor_work_guard.hpp>
#include <boost/asio/post.hpp>
#include <deque>
#include <utility>

#include "skein/link/transport/hub.h"
#include "skein/link/transport/streams.h"
#include "skein/link/transport/udp.h"

namespace skein::transport {

class Endpoints::Implementation {
 public:
  explicit Implementation(ChannelListener& listener)
      : loop(listener), work(loop.io.get_executor()) {}

  Loop loop;
  std::deque<Hub> hubs;  // of the endpoints
  // Without anything to wait for, run_for() waits all the same.
  boost::asio::executor_work_guard<boost::asio::io_context::executor_type> work;
  std::vector<std::unique_ptr<Endpoint>> endpoints;  // gone before the loop
};

namespace {

struct Opening {
  Hub& hub;

  Result<std::unique_ptr<Endpoint>> operator()(const TcpServer& a) const {
    return open_tcp(hub, a);
  }
  Result<std::unique_ptr<Endpoint>> operator()(const TcpClient& a) const {
    return open_tcp(hub, a);
  }
  Result<std::unique_ptr<Endpoint>> operator()(const SerialLine& a) const {
    return open_serial(hub, a);
  }
  template <class Udp>
  Result<std::unique_ptr<Endpoint>> operator()(const Udp& a) const {
    return open_udp(hub, a);
  }
};

}  // namespace

Endpoints::Endpoints(ChannelListener& listener)
    : implementation_(std::make_unique<Implementation>(listener)) {}
Endpoints::~Endpoints() = default;

Result<EndpointId> Endpoints::open(const EndpointAddress& address) {
  const auto number = static_cast<EndpointId>(implementation_->hubs.size());
  Hub& hub = implementation_->hubs.emplace_back(implementation_->loop, number);
  auto opened = std::visit(Opening{hub}, address);
  if (!opened) {
    implementation_->hubs.pop_back();
    return opened.error();
  }
  implementation_->endpoints.push_back(std::move(opened.value()));
  return number;
}

std::vector<std::string> Endpoints::places() const {
  std::vector<std::string> places;
  for (const auto& endpoint : implementation_->endpoints)
    if (std::string place = endpoint->place(); !place.empty())
      places.push_back(std::move(place));
  return places;
}

std::string Endpoints::place(EndpointId endpoint) const {
  return implementation_->endpoints.at(endpoint)->place();
}

bool Endpoints::send(ChannelId channel, std::span<const std::byte> bytes) {
  const auto owner = implementation_->loop.owners.find(channel);
  return owner != implementation_->loop.owners.end() &&
         owner->second->send(channel, bytes);
}

void Endpoints::run_for(std::chrono::milliseconds duration) {
  implementation_->loop.io.restart();
  implementation_->loop.io.run_for(duration);
}

void Endpoints::wake() {
  // As a handler, so that it is not lost between two runs.
  boost::asio::io_context& io = implementation_->loop.io;
  boost::asio::post(io, [&io] { io.stop(); });
}

bool Endpoints::run_one_for(std::chrono::nanoseconds patience) {
  boost::asio::io_context& io = implementation_->loop.io;
  io.restart();
  // Without patience run_one_for() would not even look.
  return io.poll_one() > 0 || io.run_one_for(patience) > 0;
}

bool is_local_channel(const std::string& name) {
  constexpr std::string_view kFrom = " from ";  // as servers name their peers
  const std::size_t from = name.find(kFrom);
  const auto address = parse_endpoint(
      from == std::string::npos ? name : "tcp:" + name.substr(from + kFrom.size()));
  return address && is_local(address.value());
}

}  // namespace skein::transport
