#pragma once

#include <utility>  // before Asio, which lacks it in C++20

#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/ssl/context.hpp>
#include <memory>

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

/// What connections need of their server.
class Server {
 public:
  virtual ~Server() = default;
  virtual const WebOptions& options() const = 0;
  virtual WebListener& to() = 0;
  virtual bool is_full() const = 0;
  virtual ClientNumber enter(std::shared_ptr<Client> client) = 0;
  virtual void leave(ClientNumber client) = 0;
};

/// Serves a connection until it ends; `server` outlives it.
void serve(boost::asio::ip::tcp::socket socket, Server& server);
/// The same over TLS.
void serve(boost::asio::ip::tcp::socket socket, boost::asio::ssl::context& tls,
           Server& server);

}  // namespace skein::hmi::web
