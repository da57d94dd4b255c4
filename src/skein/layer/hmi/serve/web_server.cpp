// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/hmi/serve/web_server.h"

#include <fmt/format.h>
#include <openssl/x509v3.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <utility>  // before Asio, which lacks it in C++20

#include <algorithm>
#include <array>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/ssl/context.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/asio/thread_pool.hpp>
#include <exception>
#include <map>
#include <optional>
#include <set>
#include <thread>

#include "skein/base/log.h"
#include "skein/base/loopback.h"
#include "skein/layer/hmi/serve/login_guard.h"
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

// A server's connections leave half of the files that a process may have open to the run.
ConnectionLimits within_open_files(ConnectionLimits limits) {
  rlimit files{};
  if (::getrlimit(RLIMIT_NOFILE, &files) != 0 || files.rlim_cur == RLIM_INFINITY)
    return limits;
  const auto half = static_cast<std::size_t>(files.rlim_cur / 2);
  limits.in_all = std::min(limits.in_all, half);
  limits.per_address = std::min(limits.per_address, half);
  return limits;
}

// What this machine is called by itself and, without a name server, by its neighbours.
std::vector<std::string> own_names() {
  std::array<char, 256> name{};
  if (::gethostname(name.data(), name.size() - 1) != 0 || name[0] == '\0') return {};
  return {name.data(), std::string(name.data()) + ".local"};
}

// What cannot be made is answered too: there is nobody behind the worker to throw to.
HttpAnswer made_by(const std::function<HttpAnswer()>& work) {
  try {
    return work();
  } catch (const std::exception&) {
    HttpAnswer answer;
    answer.status = 500;
    answer.body = std::make_shared<const std::string>(
        "{\"error\": \"the server could not do this: is there enough memory?\"}\n");
    return answer;
  }
}

void warn_of_key(const std::string& file) {
  struct stat about {};
  if (::stat(file.c_str(), &about) == 0 && (about.st_mode & 007) != 0)
    log_line(
        LogLevel::kWarning,
        file + ": everybody on this machine can read the page's key; chmod 600 " + file);
}

}  // namespace

struct WebServer::Impl final : web::Server {
  Impl(const WebOptions& how, WebListener& to)
      : listener(to),
        limits(how),
        names(own_names()),
        table(within_open_files(how.connections)) {
    names.insert(names.end(), how.hosts.begin(), how.hosts.end());
  }

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
    if (workers) workers->join();
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
  bool knows_host(std::string_view host) override;
  void set_waiting(ConnectionTable::Number number, bool waits) override {
    table.set_waiting(number, waits);
  }
  void end_connection(ConnectionTable::Number number) override {
    table.leave(number);
    connections.erase(number);
  }
  std::chrono::milliseconds wrong_token(const std::string& group) override;
  void count_slow() override { ++met.slow_connections; }
  bool begin_work(const std::string& client, std::function<HttpAnswer()> work,
                  std::function<void(const HttpAnswer&)> done) override;
  void serve(tcp::socket socket);
  void leave(ClientNumber number) override { clients.erase(number); }

  web::Client* find(ClientNumber number) const {
    const auto found = clients.find(number);
    return found == clients.end() ? nullptr : found->second.get();
  }

  WebListener& listener;
  WebOptions limits;
  std::vector<std::string> names;
  // Connections that end with `io` still leave here.
  ConnectionTable table;
  std::map<ConnectionTable::Number, std::weak_ptr<web::Connection>> connections;
  LoginGuard guard;
  WebStatistics met;
  net::io_context io{1};
  net::ssl::context tls{net::ssl::context::tls_server};
  tcp::acceptor acceptor{io};
  net::steady_timer retry{io};
  std::map<ClientNumber, std::shared_ptr<web::Client>> clients;
  ClientNumber counted = 0;
  std::set<std::string> at_work;            // clients for which an answer is made
  std::optional<net::thread_pool> workers;  // once there is work
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
  warn_of_key(limits.key_file);
  return {};
}

// A page of elsewhere whose name leads here asks by that name. Numbers cannot be led
// elsewhere, and with tokens no name but these is answered.
bool WebServer::Impl::knows_host(std::string_view host) {
  if (names_this_machine(host)) return true;
  if (limits.access.is_open()) return false;
  if (is_address(host)) return true;
  const std::string_view name = name_in_host(host);
  if (name.empty()) return false;
  for (const std::string& own : names)
    if (is_same_name(own, name)) return true;
  X509* certificate = SSL_CTX_get0_certificate(tls.native_handle());
  return certificate &&
         X509_check_host(certificate, name.data(), name.size(), 0, nullptr) == 1;
}

std::chrono::milliseconds WebServer::Impl::wrong_token(const std::string& group) {
  const auto now = std::chrono::steady_clock::now();
  const auto wait = guard.wrong(group, now);
  met.wrong_tokens = guard.count();
  const int tries = guard.remembered(group, now);
  // The first ones, then each time that they are twice as many.
  if (tries == 1 || tries == LoginGuard::kFreeTries + 1 ||
      (met.wrong_tokens & (met.wrong_tokens - 1)) == 0)
    log_line(LogLevel::kWarning, fmt::format("page: wrong token from {} ({} in all)",
                                             group, met.wrong_tokens));
  return wait;
}

bool WebServer::Impl::begin_work(const std::string& client,
                                 std::function<HttpAnswer()> work,
                                 std::function<void(const HttpAnswer&)> done) {
  if (at_work.size() >= kMaxWork || !at_work.insert(client).second) return false;
  if (!workers) workers.emplace(kMaxWork);
  net::post(*workers,
            [this, client, work = std::move(work), done = std::move(done)]() mutable {
              HttpAnswer made = made_by(work);
              // `done` holds the connection, which ends with the server's thread.
              net::post(io, [this, client = std::move(client), done = std::move(done),
                             made = std::move(made)] {
                at_work.erase(client);
                done(made);
              });
            });
  return true;
}

void WebServer::Impl::serve(tcp::socket socket) {
  Failure failure;
  const auto from = socket.remote_endpoint(failure);
  if (failure) return;  // it has gone
  std::string group = address_group(from.address().to_string());
  const auto entry = table.enter(group);
  if (entry.evicted) {
    ++met.evicted_connections;
    const auto found = connections.find(*entry.evicted);
    if (found != connections.end())
      if (const auto connection = found->second.lock()) connection->abort();
  }
  if (!entry.taken) {
    ++met.refused_connections;
    return;  // closes it
  }
  socket.set_option(tcp::no_delay(true), failure);
  web::Seat seat(*this, *entry.taken, std::move(group));
  connections[*entry.taken] =
      limits.certificate_file.empty()
          ? web::serve(std::move(socket), std::move(seat), *this)
          : web::serve(std::move(socket), std::move(seat), tls, *this);
}

Result<void> WebServer::Impl::listen() {
  Failure failure;
  const auto address = net::ip::make_address(limits.address, failure);
  if (failure)
    return Error{ErrorCode::kBadInput, limits.address,
                 "it is no address: 127.0.0.1, ::1, 0.0.0.0 or one of this machine's.",
                 ""};
  if (!is_loopback(limits.address) && limits.access.is_open())
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
    serve(std::move(socket));
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

WebStatistics WebServer::statistics() const {
  WebStatistics now = impl_->met;
  now.connections = impl_->table.size();
  for (const auto& [number, client] : impl_->clients)
    now.waiting_bytes += client->waiting();
  return now;
}

}  // namespace skein::hmi
