// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "skein/base/result.h"
#include "skein/layer/hmi/serve/access.h"
#include "skein/layer/hmi/serve/connection_table.h"

namespace skein::hmi {

/// Counts the clients of a server, from 1.
using ClientNumber = std::uint32_t;

/// What is sent, to many at once without a copy for each.
using SharedBytes = std::shared_ptr<const std::vector<std::byte>>;

/// A request of a browser or program that the server knows.
struct HttpRequest {
  std::string_view method;
  std::string_view path;   ///< without what follows a question mark
  std::string_view query;  ///< that
  std::string_view body;
  Access access;
};

struct HttpAnswer {
  unsigned status = 200;
  std::string type = "application/json";
  std::shared_ptr<const std::string> body;
  bool may_be_kept = false;  ///< by the browser, until its name changes
  bool gzip = false;         ///< the body is compressed
  std::string file = {};     ///< it is saved under this name; empty: shown
  /// The methods that there are of what was asked for, with status 405: "GET, HEAD".
  std::string allow = {};
  int retry_after_s = 0;  ///< with status 503: when to ask again [s]
  /// Makes the answer in place of this one, where that takes long: by a thread beside the
  /// server's, so it owns what it needs. Each client has one under way at a time, all
  /// have kMaxWork; others are answered with 503.
  std::function<HttpAnswer()> work = {};
};

/// What a server has met with since it was opened.
struct WebStatistics {
  std::size_t connections = 0;            ///< now
  std::size_t waiting_bytes = 0;          ///< given to send(), and not sent yet
  std::uint64_t refused_connections = 0;  ///< there was no room
  std::uint64_t evicted_connections = 0;  ///< made room for others
  std::uint64_t slow_connections = 0;     ///< closed: they sent or read too slowly
  std::uint64_t wrong_tokens = 0;
};

/// What a server asks whoever it serves; by the server's thread alone.
class WebListener {
 public:
  virtual ~WebListener() = default;
  virtual HttpAnswer answer(const HttpRequest& request) = 0;
  /// @param protocol  one of WebOptions::protocols.
  virtual void joined(ClientNumber client, const Access& access,
                      std::string_view protocol) = 0;
  virtual void said(ClientNumber client, std::string_view message, bool is_text) = 0;
  virtual void left(ClientNumber client) = 0;
};

struct WebOptions {
  std::string address = "127.0.0.1";
  std::uint16_t port = 8080;  ///< 0: any that is free
  AccessTable access;
  /// Of WebSockets, the best one first.
  std::vector<std::string> protocols;
  std::string certificate_file;  ///< PEM, with its chain; empty: without TLS
  std::string key_file;          ///< PEM
  /// Pages of other servers, by their origins ("https://app.example.org"), that may watch
  /// by `guest_protocols`.
  std::vector<std::string> guest_origins, guest_protocols;
  std::string imagery_origin;  ///< pages may load pictures from there; empty: none
  /// Names by which others reach this machine, besides its own ones and those of the
  /// certificate; not those of a server without tokens.
  std::vector<std::string> hosts;
  std::size_t most_clients = 256;
  ConnectionLimits connections;
  /// How long who asks, reads or is silent may take.
  struct Patience {
    std::chrono::milliseconds header{10'000};  ///< of the first request, with TLS
    std::chrono::milliseconds next{30'000};    ///< until and with the next header
    std::chrono::milliseconds body{30'000};
    std::chrono::milliseconds answer{120'000};  ///< until it has been read
    std::chrono::milliseconds message{30'000};  ///< of a WebSocket, until it was read
  };
  Patience patience;
};

/// One port for pages, an HTTP interface and WebSockets.
///
/// Has a thread of its own once it is started. Messages of clients are limited in size
/// and rate; who is too slow, too fast or too large is disconnected. Requests of pages
/// that come from another server are refused, and those that call this machine by a name
/// that is not its own. Answers that take long are made by other threads
/// (HttpAnswer::work), so that nobody else waits for them. Connections are limited in all
/// and of each address; wrong tokens are answered the later the more there have been of
/// an address.
class WebServer {
 public:
  static constexpr std::size_t kMaxMessage = 65536;
  static constexpr double kMessagesPerSecond = 100;
  static constexpr std::size_t kMaxBody = 4 << 20;
  static constexpr std::size_t kMaxBodyBeforeLogin = 65536;
  static constexpr std::size_t kMaxWork = 2;  ///< answers that take long, at a time
  /// What may wait for a client that does not read; more ends the connection.
  static constexpr std::size_t kMaxWaiting = 64 << 20;

  /// Takes the port; who comes waits until start().
  /// @param listener  outlives the server.
  /// Fails: kUnavailable for an address or port that cannot be had; kNotFound or
  /// kBadInput for files that hold no certificate or key; kBadInput for an address that
  /// other machines reach without tokens.
  static Result<std::unique_ptr<WebServer>> open(const WebOptions& options,
                                                 WebListener& listener);
  ~WebServer();
  WebServer(const WebServer&) = delete;
  WebServer& operator=(const WebServer&) = delete;

  /// Answers from now on, whoever has come and comes. Once.
  void start();

  /// Where a browser finds it: "http://127.0.0.1:8080/".
  std::string place() const;

  /// Has the server's thread do something soon. By any thread.
  void post(std::function<void()> task);

  /// The rest is for the server's thread alone: within a listener's function or a task.
  void send(ClientNumber client, SharedBytes bytes, bool is_text = false);
  /// Bytes that have been given to send() for a client and are not sent yet.
  std::size_t waiting(ClientNumber client) const;
  WebStatistics statistics() const;

 private:
  struct Impl;
  explicit WebServer(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace skein::hmi
