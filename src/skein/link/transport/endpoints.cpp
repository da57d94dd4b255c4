#include "skein/link/transport/endpoints.h"

#include <boost/asio/executor_work_guard.hpp>
#include <utility>

#include "skein/link/transport/hub.h"
#include "skein/link/transport/streams.h"
#include "skein/link/transport/udp.h"

namespace skein::transport {

class Endpoints::Implementation {
 public:
  explicit Implementation(ChannelListener& listener)
      : hub(listener), work(hub.io.get_executor()) {}

  Hub hub;
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

Result<void> Endpoints::open(const EndpointAddress& address) {
  auto opened = std::visit(Opening{implementation_->hub}, address);
  if (!opened) return opened.error();
  implementation_->endpoints.push_back(std::move(opened.value()));
  return {};
}

std::vector<std::string> Endpoints::places() const {
  std::vector<std::string> places;
  for (const auto& endpoint : implementation_->endpoints)
    if (std::string place = endpoint->place(); !place.empty())
      places.push_back(std::move(place));
  return places;
}

bool Endpoints::send(ChannelId channel, std::span<const std::byte> bytes) {
  const auto owner = implementation_->hub.owners.find(channel);
  return owner != implementation_->hub.owners.end() &&
         owner->second->send(channel, bytes);
}

void Endpoints::run_for(std::chrono::milliseconds duration) {
  implementation_->hub.io.restart();
  implementation_->hub.io.run_for(duration);
}

bool Endpoints::run_one_for(std::chrono::nanoseconds patience) {
  boost::asio::io_context& io = implementation_->hub.io;
  io.restart();
  // Without patience run_one_for() would not even look.
  return io.poll_one() > 0 || io.run_one_for(patience) > 0;
}

}  // namespace skein::transport
