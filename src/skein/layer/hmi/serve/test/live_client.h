// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <utility>  // before Asio, which lacks it in C++20

#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "skein/data/describe/wire.h"
#include "skein/data/event/live.h"

// A client of the live feed, for tests: waits for what it asks for, as nobody else does.
namespace skein::hmi {

namespace beast = boost::beast;
namespace http = beast::http;
using tcp = boost::asio::ip::tcp;

/// One request, and what is answered.
struct Asked {
  http::verb method = http::verb::get;
  std::string target = "/";
  std::string host = "localhost";
  std::vector<std::pair<std::string, std::string>> headers = {};
  std::string body = {};
};

inline http::response<http::string_body> ask(std::uint16_t port, const Asked& asked) {
  boost::asio::io_context io;
  beast::tcp_stream stream(io);
  stream.connect(tcp::endpoint(boost::asio::ip::make_address("127.0.0.1"), port));
  http::request<http::string_body> request(asked.method, asked.target, 11);
  request.set(http::field::host, asked.host);
  for (const auto& [name, value] : asked.headers) request.set(name, value);
  request.body() = asked.body;
  request.prepare_payload();
  http::write(stream, request);
  beast::flat_buffer buffer;
  http::response<http::string_body> response;
  http::read(stream, buffer, response);
  return response;
}

class LiveClient {
 public:
  explicit LiveClient(
      std::uint16_t port,
      const std::vector<std::pair<std::string, std::string>>& headers = {},
      const std::string& protocol = "skein.live.v1") {
    socket_.next_layer().connect(
        tcp::endpoint(boost::asio::ip::make_address("127.0.0.1"), port));
    socket_.set_option(beast::websocket::stream_base::decorator(
        [&](beast::websocket::request_type& request) {
          request.set(http::field::sec_websocket_protocol, protocol);
          for (const auto& [name, value] : headers) request.set(name, value);
        }));
    socket_.read_message_max(0);
    socket_.handshake("localhost", "/live", failure_);
  }

  bool is_open() const { return !failure_; }

  void say(const std::string& text) {
    socket_.text(true);
    socket_.write(boost::asio::buffer(text), failure_);
  }

  /// The next message; empty when the connection has ended.
  std::string read() {
    beast::flat_buffer buffer;
    socket_.read(buffer, failure_);
    if (failure_) return {};
    bytes_heard_ += buffer.size();
    return {static_cast<const char*>(buffer.cdata().data()), buffer.size()};
  }
  /// It was text.
  bool read_text() const { return socket_.got_text(); }

  /// Its items.
  std::vector<LiveItem> hear() {
    const std::string message = read();
    if (failure_) return {};
    auto items = wire::decode<std::vector<LiveItem>>(
        std::as_bytes(std::span(message.data(), message.size())));
    return items ? std::move(items).value() : std::vector<LiveItem>();
  }

  /// The next item of a kind that `is_right` accepts; nothing: the connection ended.
  template <class T, class Right>
  std::optional<T> wait_for(Right is_right) {
    while (is_open())
      for (const LiveItem& item : hear())
        if (const auto* one = std::get_if<T>(&item); one && is_right(*one)) return *one;
    return std::nullopt;
  }
  template <class T>
  std::optional<T> wait_for() {
    return wait_for<T>([](const T&) { return true; });
  }
  std::optional<RequestReply> wait_for_reply(std::uint32_t number) {
    return wait_for<RequestReply>([number](const RequestReply& reply) {
      return reply.number == number && reply.state != RequestState::kGiven;
    });
  }
  std::size_t bytes_heard() const { return bytes_heard_; }

 private:
  boost::asio::io_context io_;
  beast::websocket::stream<tcp::socket> socket_{io_};
  beast::error_code failure_;
  std::size_t bytes_heard_ = 0;
};

}  // namespace skein::hmi
