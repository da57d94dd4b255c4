// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <utility>  // before Asio, which lacks it in C++20

#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/ssl/context.hpp>
#include <functional>
#include <memory>
#include <string>

#include "skein/layer/hmi/serve/connection_table.h"
#include "skein/layer/hmi/serve/web_server.h"

// One connection of a server: requests, until it becomes a WebSocket. For web_server.cpp
// alone; all by the server's thread.
namespace skein::hmi::web {

/// A connected WebSocket.
class Client {
 public:
  virtual ~Client() = default;
  virtual void send(SharedBytes bytes, bool is_text) = 0;
  virtual std::size_t waiting() const = 0;  ///< bytes
  virtual void close() = 0;
};

/// A connection, of whatever kind.
class Connection {
 public:
  virtual ~Connection() = default;
  /// Closes it for others; what is under way fails.
  virtual void abort() = 0;
};

/// What connections need of their server.
class Server {
 public:
  virtual ~Server() = default;
  /// Whether a Host header names this server.
  virtual bool knows_host(std::string_view host) = 0;
  virtual void set_waiting(ConnectionTable::Number number, bool waits) = 0;
  virtual void end_connection(ConnectionTable::Number number) = 0;
  /// A wrong token was given. @returns how long its answer waits.
  virtual std::chrono::milliseconds wrong_token(const std::string& group) = 0;
  virtual void count_slow() = 0;
  /// Has another thread make an answer; `done` takes it by the server's thread.
  /// @param client  one answer at a time is made for each.
  /// @returns       false when one is under way, or too many of others.
  virtual bool begin_work(const std::string& client, std::function<HttpAnswer()> work,
                          std::function<void(const HttpAnswer&)> done) = 0;
  virtual const WebOptions& options() const = 0;
  virtual WebListener& to() = 0;
  virtual bool is_full() const = 0;
  virtual ClientNumber enter(std::shared_ptr<Client> client) = 0;
  virtual void leave(ClientNumber client) = 0;
};

/// A connection's place among all of the server's, until it ends; `server` outlives it.
class Seat {
 public:
  Seat(Server& server, ConnectionTable::Number number, std::string group)
      : server_(&server), number_(number), group_(std::move(group)) {}
  Seat(Seat&& other) noexcept
      : server_(std::exchange(other.server_, nullptr)),
        number_(other.number_),
        group_(std::move(other.group_)) {}
  Seat& operator=(Seat&&) = delete;
  ~Seat() {
    if (server_) server_->end_connection(number_);
  }

  void set_waiting(bool waits) const { server_->set_waiting(number_, waits); }
  /// Whom the connection comes from: address_group().
  const std::string& group() const { return group_; }

 private:
  Server* server_;
  ConnectionTable::Number number_;
  std::string group_;
};

/// Serves a connection until it ends; `server` outlives it. What can close it before.
std::weak_ptr<Connection> serve(boost::asio::ip::tcp::socket socket, Seat seat,
                                Server& server);
/// The same over TLS.
std::weak_ptr<Connection> serve(boost::asio::ip::tcp::socket socket, Seat seat,
                                boost::asio::ssl::context& tls, Server& server);

}  // namespace skein::hmi::web
