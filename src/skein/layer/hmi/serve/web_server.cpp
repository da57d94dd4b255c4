#include "skein/layer/hmi/serve/web_server.h"

#include <fmt/format.h>

#include <utility>  // before Asio, which lacks it in C++20

#include <algorithm>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/ssl/context.hpp>
#include <boost/asio/steady_timer.hpp>
#include <map>
#include <thread>

#include "skein/layer/hmi/serve/web_session.h"

namespace skein::hmi {
namespace {

namespace net = boost::asio;
using tcp = net::ip::tcp;
using Failure = boost::system::error_code;

Error unavailable(const WebOptions& options, const Failure& failure) {
  return {ErrorCode::kUnavailable, fmt::format("{}:{}", options.address, options.port),
          fmt::format("no server can wait there: {}.", failure.message()),
          "Another port: --serve ADDRESS:PORT; port 0 takes a free one."};
}

}  // namespace

struct WebServer::Impl final : web::Server {
  Impl(const WebOptions& how, WebListener& to) : listener(to), limits(how) {}

  ~Impl() override {
    if (thread.joinable()) {
      net::post(io, [this] {
        Failure ignored;
        acceptor.close(ignored);
        retry.cancel();
        for (auto& [number, client] : std::map(clients)) client->close();
        // Those who have not read what was sent to them are not waited for.
        io.stop();
      });
      thread.join();
    }
    clients.clear();
  }

  Result<void> listen();
  Result<void> load_certificate();
  void accept();

  const WebOptions& options() const override { return limits; }
  WebListener& to() override { return listener; }
  ClientNumber enter(std::shared_ptr<web::Client> client) override {
    const ClientNumber number = ++counted;
    clients.emplace(number, std::move(client));
    return number;
  }
  bool is_full() const override { return clients.size() >= limits.most_clients; }
  void leave(ClientNumber number) override { clients.erase(number); }

  web::Client* find(ClientNumber number) const {
    const auto found = clients.find(number);
    return found == clients.end() ? nullptr : found->second.get();
  }

  WebListener& listener;
  WebOptions limits;
  net::io_context io{1};
  net::ssl::context tls{net::ssl::context::tls_server};
  tcp::acceptor acceptor{io};
  net::steady_timer retry{io};
  std::map<ClientNumber, std::shared_ptr<web::Client>> clients;
  ClientNumber counted = 0;
  std::string place;
  std::thread thread;
};

Result<void> WebServer::Impl::load_certificate() {
  if (limits.certificate_file.empty()) return {};
  Failure failure;
  tls.set_options(net::ssl::context::default_workarounds | net::ssl::context::no_tlsv1 |
                      net::ssl::context::no_tlsv1_1,
                  failure);
  tls.use_certificate_chain_file(limits.certificate_file, failure);
  if (failure)
    return Error{
        ErrorCode::kBadInput, limits.certificate_file,
        fmt::format("no certificate can be read from it: {}.", failure.message()),
        "It is a PEM file: the server's certificate, then those that sign it."};
  tls.use_private_key_file(limits.key_file, net::ssl::context::pem, failure);
  if (failure)
    return Error{ErrorCode::kBadInput, limits.key_file,
                 fmt::format("no key can be read from it: {}.", failure.message()),
                 "It is the PEM file of the certificate's private key."};
  return {};
}

Result<void> WebServer::Impl::listen() {
  Failure failure;
  const auto address = net::ip::make_address(limits.address, failure);
  if (failure)
    return Error{ErrorCode::kBadInput, limits.address,
                 "it is no address: 127.0.0.1, ::1, 0.0.0.0 or one of this machine's.",
                 ""};
  if (!address.is_loopback() && limits.access.is_open())
    return Error{ErrorCode::kBadInput, limits.address,
                 "other machines reach it: whoever may see and steer the run needs a "
                 "token.",
                 "Give a file of them with --tokens."};
  const tcp::endpoint wanted(address, limits.port);
  acceptor.open(wanted.protocol(), failure);
  if (!failure) acceptor.set_option(net::socket_base::reuse_address(true), failure);
  if (!failure) acceptor.bind(wanted, failure);
  if (!failure) acceptor.listen(net::socket_base::max_listen_connections, failure);
  if (failure) return unavailable(limits, failure);
  const auto port = acceptor.local_endpoint(failure).port();
  if (failure) return unavailable(limits, failure);
  place =
      fmt::format("{}://{}:{}/", limits.certificate_file.empty() ? "http" : "https",
                  address.is_v6() ? "[" + limits.address + "]" : limits.address, port);
  accept();
  return {};
}

void WebServer::Impl::accept() {
  acceptor.async_accept([this](Failure failure, tcp::socket socket) {
    if (!acceptor.is_open()) return;
    if (failure) {  // no file descriptor is free...: a while later there may be one
      retry.expires_after(std::chrono::milliseconds(200));
      retry.async_wait([this](Failure stopped) {
        if (!stopped) accept();
      });
      return;
    }
    Failure ignored;
    socket.set_option(tcp::no_delay(true), ignored);
    if (limits.certificate_file.empty())
      web::serve(std::move(socket), *this);
    else
      web::serve(std::move(socket), tls, *this);
    accept();
  });
}

WebServer::WebServer(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
WebServer::~WebServer() = default;

Result<std::unique_ptr<WebServer>> WebServer::open(const WebOptions& options,
                                                   WebListener& listener) {
  auto impl = std::make_unique<Impl>(options, listener);
  if (auto loaded = impl->load_certificate(); !loaded) return loaded.error();
  if (auto listens = impl->listen(); !listens) return listens.error();
  return std::unique_ptr<WebServer>(new WebServer(std::move(impl)));
}

void WebServer::start() {
  impl_->thread = std::thread([io = &impl_->io] { io->run(); });
}

std::string WebServer::place() const {
  return impl_->place;
}

void WebServer::post(std::function<void()> task) {
  net::post(impl_->io, std::move(task));
}

void WebServer::send(ClientNumber client, SharedBytes bytes, bool is_text) {
  if (web::Client* found = impl_->find(client)) found->send(std::move(bytes), is_text);
}

std::size_t WebServer::waiting(ClientNumber client) const {
  const web::Client* found = impl_->find(client);
  return found ? found->waiting() : 0;
}

void WebServer::disconnect(ClientNumber client) {
  if (web::Client* found = impl_->find(client)) found->close();
}

}  // namespace skein::hmi
