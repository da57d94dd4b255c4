// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/hmi/serve/web_session.h"

#include <utility>  // before Asio, which lacks it in C++20

#include <algorithm>
#include <array>
#include <boost/asio/steady_timer.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/ssl.hpp>
#include <boost/beast/websocket.hpp>
#include <boost/beast/websocket/ssl.hpp>
#include <deque>
#include <nlohmann/json.hpp>
#include <optional>

#include "skein/layer/hmi/serve/message_rate.h"

namespace skein::hmi::web {
namespace {

namespace beast = boost::beast;
namespace http = beast::http;
namespace websocket = beast::websocket;
namespace net = boost::asio;
using tcp = net::ip::tcp;
using Failure = beast::error_code;
using Request = http::request<http::string_body>;

using Plain = beast::tcp_stream;
using Tls = beast::ssl_stream<beast::tcp_stream>;

constexpr std::uint32_t kMaxHeader = 16384;
constexpr auto kFarewell = std::chrono::seconds(2);  // for the other side to close

std::string_view view(beast::string_view text) {
  return {text.data(), text.size()};
}

// What pages of this server may load: from here, and pictures of the ground from where
// the user has said.
std::string policy(const std::string& imagery) {
  return "default-src 'self'; img-src 'self' data: blob: " + imagery +
         "; worker-src 'self' blob:; connect-src 'self' " + imagery +
         "; style-src 'self' 'unsafe-inline'; script-src 'self'; object-src 'none'; "
         "base-uri 'none'; form-action 'self'; frame-ancestors 'none'";
}

using Header = http::request_header<>;

// Who asks; nobody: without a token, or with a wrong one.
struct Asker {
  std::optional<Access> access;
  bool is_wrong = false;
};

Asker asker_of(const Header& request, const WebOptions& options) {
  if (options.access.is_open()) return {Access{AccessRole::kInstructor, ""}};
  std::string_view token;
  if (const auto bearer = bearer_token(view(request[http::field::authorization])))
    token = *bearer;
  else
    token = token_in_cookies(view(request[http::field::cookie]));
  Asker asker{options.access.find(token)};
  asker.is_wrong = !asker.access && !token.empty();
  return asker;
}

bool comes_from_elsewhere(const Header& request, bool for_page) {
  return hmi::comes_from_elsewhere(
      {view(request[http::field::origin]), view(request[http::field::host]),
       view(request["Sec-Fetch-Site"]), view(request["Sec-Fetch-Mode"])},
      for_page);
}

std::string_view path_of(const Header& request) {
  const std::string_view target = view(request.target());
  return target.substr(0, target.find('?'));
}

// The page itself asks for a token; it holds nothing of the run.
bool is_page(const Header& request) {
  const std::string_view path = path_of(request);
  return !path.starts_with("/api/") && path != "/login" && path != "/live" &&
         !websocket::is_upgrade(request);
}

// A login brings its own.
bool needs_token(const Header& request) {
  return !is_page(request) && path_of(request) != "/login";
}

HttpAnswer plain(unsigned status, const char* text) {
  HttpAnswer answer;
  answer.status = status;
  answer.type = "text/plain; charset=utf-8";
  answer.body = std::make_shared<const std::string>(text);
  return answer;
}

HttpAnswer busy() {
  HttpAnswer answer;
  answer.status = 503;
  answer.body = std::make_shared<const std::string>(
      "{\"error\": \"a file of yours is being read already, or too many of others: try "
      "again in a moment.\"}\n");
  answer.retry_after_s = 2;
  return answer;
}

HttpAnswer no_such_method(const char* allow) {
  HttpAnswer answer = plain(405, "There is no such method of this.\n");
  answer.allow = allow;
  return answer;
}

// Whether a page of another server may watch by a protocol.
bool is_guest(const Header& request, const std::string& protocol,
              const WebOptions& options) {
  const auto has = [](const std::vector<std::string>& list, std::string_view text) {
    return std::find(list.begin(), list.end(), text) != list.end();
  };
  return has(options.guest_origins, view(request[http::field::origin])) &&
         has(options.guest_protocols, protocol);
}

// The best of the server's protocols that the client knows; empty: none.
std::string protocol_of(const Header& request, const WebOptions& options) {
  http::token_list offered(request[http::field::sec_websocket_protocol]);
  for (const std::string& protocol : options.protocols)
    if (offered.exists(protocol)) return protocol;
  return {};
}

template <class Stream>
class WebSocket final : public Client,
                        public std::enable_shared_from_this<WebSocket<Stream>> {
 public:
  WebSocket(Stream stream, Seat seat, Server& server, Access access, std::string protocol)
      : socket_(std::move(stream)),
        seat_(std::move(seat)),
        server_(server),
        access_(std::move(access)),
        protocol_(std::move(protocol)) {}

  void accept(const Request& request) {
    beast::get_lowest_layer(socket_).expires_never();
    websocket::stream_base::timeout patience{std::chrono::seconds(10),
                                             std::chrono::seconds(60), true};
    socket_.set_option(patience);
    socket_.set_option(websocket::stream_base::decorator(
        [protocol = protocol_](websocket::response_type& response) {
          if (!protocol.empty())
            response.set(http::field::sec_websocket_protocol, protocol);
        }));
    socket_.read_message_max(WebServer::kMaxMessage);
    socket_.auto_fragment(false);
    socket_.async_accept(request, [self = this->shared_from_this()](Failure failure) {
      if (!failure) self->begin();
    });
  }

  void send(SharedBytes bytes, bool is_text) override {
    if (closing_) return;
    if (waiting_ + bytes->size() > WebServer::kMaxWaiting) return drop_slow();
    waiting_ += bytes->size();
    queue_.push_back({std::move(bytes), is_text});
    if (queue_.size() == 1) write();
  }
  std::size_t waiting() const override { return waiting_; }

  void close() override {
    if (closing_) return;
    closing_ = true;
    patience_.cancel();
    Failure ignored;
    beast::get_lowest_layer(socket_).socket().shutdown(tcp::socket::shutdown_both,
                                                       ignored);
  }

 private:
  struct Outgoing {
    SharedBytes bytes;
    bool is_text = false;
  };

  void begin() {
    number_ = server_.enter(this->shared_from_this());
    server_.to().joined(number_, access_, protocol_);
    read();
  }

  void read() {
    socket_.async_read(buffer_,
                       [self = this->shared_from_this()](Failure failure, std::size_t) {
                         self->hear(failure);
                       });
  }

  void hear(Failure failure) {
    if (failure || closing_ || !rate_.allows(std::chrono::steady_clock::now()))
      return end();
    const auto data = buffer_.cdata();
    server_.to().said(number_, {static_cast<const char*>(data.data()), data.size()},
                      socket_.got_text());
    buffer_.consume(buffer_.size());
    read();
  }

  void write() {
    const Outgoing& next = queue_.front();
    patience_.expires_after(server_.options().patience.message);
    patience_.async_wait([weak = this->weak_from_this()](Failure stopped) {
      if (stopped) return;
      if (const auto self = weak.lock()) self->drop_slow();
    });
    socket_.text(next.is_text);
    socket_.async_write(net::buffer(next.bytes->data(), next.bytes->size()),
                        [self = this->shared_from_this()](Failure failure, std::size_t) {
                          self->written(failure);
                        });
  }

  void written(Failure failure) {
    patience_.cancel();
    if (failure) return close();  // the reader notices
    waiting_ -= queue_.front().bytes->size();
    queue_.pop_front();
    if (!queue_.empty() && !closing_) write();
  }

  void drop_slow() {
    if (closing_) return;
    server_.count_slow();
    close();
  }

  void end() {
    close();
    if (std::exchange(ended_, true)) return;
    server_.leave(number_);
    server_.to().left(number_);
  }

  websocket::stream<Stream> socket_;
  Seat seat_;
  Server& server_;
  Access access_;
  std::string protocol_;
  ClientNumber number_ = 0;
  beast::flat_buffer buffer_;
  std::deque<Outgoing> queue_;
  std::size_t waiting_ = 0;
  net::steady_timer patience_{socket_.get_executor()};  // with the message under way
  MessageRate rate_{WebServer::kMessagesPerSecond};
  bool closing_ = false, ended_ = false;
};

template <class Stream>
class HttpSession final : public Connection,
                          public std::enable_shared_from_this<HttpSession<Stream>> {
 public:
  HttpSession(Stream stream, Seat seat, Server& server)
      : stream_(std::move(stream)), seat_(std::move(seat)), server_(server) {}

  void begin() {
    patience(server_.options().patience.header);
    if constexpr (std::is_same_v<Stream, Tls>) {
      stream_.async_handshake(net::ssl::stream_base::server,
                              [self = this->shared_from_this()](Failure failure) {
                                if (!failure) return self->read_header();
                                self->note_slow(failure);
                              });
    } else {
      read_header();
    }
  }

  void abort() override {
    Failure ignored;
    delay_.cancel();
    beast::get_lowest_layer(stream_).socket().shutdown(tcp::socket::shutdown_both,
                                                       ignored);
  }

 private:
  // The clock of what is read or written next; it runs from now on.
  void patience(std::chrono::milliseconds most) {
    beast::get_lowest_layer(stream_).expires_after(most);
  }
  void note_slow(Failure failure) {
    if (failure == beast::error::timeout) server_.count_slow();
  }

  // Within the patience that was begun before.
  void read_header() {
    seat_.set_waiting(true);
    asker_ = {};
    parser_.emplace();
    parser_->body_limit(WebServer::kMaxBody);
    parser_->header_limit(kMaxHeader);
    http::async_read_header(
        stream_, buffer_, *parser_,
        [self = this->shared_from_this()](Failure failure, std::size_t) {
          if (failure) return self->refuse_broken(failure);
          self->read_body();
        });
  }

  void read_body() {
    seat_.set_waiting(false);
    const Header& header = parser_->get();
    if (needs_token(header)) asker_ = asker_of(header, server_.options());
    const std::size_t limit =
        asker_.access ? WebServer::kMaxBody : WebServer::kMaxBodyBeforeLogin;
    parser_->body_limit(limit);
    if (parser_->content_length() && *parser_->content_length() > limit)
      return refuse_broken(http::error::body_limit);
    patience(server_.options().patience.body);
    http::async_read(stream_, buffer_, *parser_,
                     [self = this->shared_from_this()](Failure failure, std::size_t) {
                       if (failure) return self->refuse_broken(failure);
                       self->answer(self->parser_->release());
                     });
  }

  // What cannot be read as a request is answered where there is somebody to read it.
  void refuse_broken(Failure failure) {
    note_slow(failure);
    HttpAnswer answer;
    if (failure == http::error::body_limit)
      answer = plain(413, "The body is too large.\n");
    else if (failure == http::error::header_limit)
      answer = plain(431, "The header is too large.\n");
    else if (failure.category() == make_error_code(http::error::bad_method).category() &&
             failure != http::error::end_of_stream &&
             failure != http::error::partial_message)
      answer = plain(400, "This is no HTTP request.\n");
    else
      return;
    Request none;
    none.version(11);
    none.keep_alive(false);
    send(none, answer);
  }

  void answer(const Request& request) {
    const auto& options = server_.options();
    const bool is_upgrade = websocket::is_upgrade(request);
    if (!server_.knows_host(view(request[http::field::host])))
      return send(request,
                  plain(403, options.access.is_open()
                                 ? "Ask this machine by its own name.\n"
                                 : "This server does not know the name that it is asked "
                                   "by: see --host.\n"));
    const std::string protocol = is_upgrade ? protocol_of(request, options) : "";
    const bool guest = is_upgrade && is_guest(request, protocol, options);
    if (!guest && comes_from_elsewhere(request, is_page(request)))
      return send(request, plain(403, "This page comes from another server.\n"));
    if (asker_.is_wrong) return refuse_token(request, 401, "Nobody has this token.\n");
    if (is_upgrade) return upgrade(request, protocol);
    if (path_of(request) == "/login") return log_in(request);
    if (!asker_.access && needs_token(request))
      return send(request, plain(401, "A token is needed.\n"));
    if (path_of(request) == "/live") return point_to_feed(request);
    const std::string_view target = view(request.target());
    HttpRequest asked;
    asked.method = view(request.method_string());
    asked.path = path_of(request);
    asked.query = target.substr(std::min(asked.path.size() + 1, target.size()));
    asked.body = request.body();
    asked.access = asker_.access.value_or(Access{});
    HttpAnswer answered = server_.to().answer(asked);
    if (!answered.work) return send(request, answered);
    const bool begun = server_.begin_work(
        seat_.group() + " " + asked.access.name, std::move(answered.work),
        [self = this->shared_from_this(), request = without_body(request)](
            const HttpAnswer& made) { self->send(request, made); });
    if (!begun) send(request, busy());
  }

  // A wrong token is answered the later the more there have been; meanwhile the
  // connection keeps its place.
  void refuse_token(const Request& request, unsigned status, const char* text) {
    const auto wait = server_.wrong_token(seat_.group());
    delay_.expires_after(wait);
    delay_.async_wait(
        [self = this->shared_from_this(), request = without_body(request),
         answer = plain(status, text)](Failure) { self->send(request, answer); });
  }

  static Request without_body(const Request& request) {
    Request head(request.method(), request.target(), request.version());
    head.keep_alive(request.keep_alive());
    return head;
  }

  void log_in(const Request& request) {
    if (request.method() != http::verb::post)
      return send(request, no_such_method("POST"));
    const auto said = nlohmann::json::parse(request.body(), nullptr, false);
    std::string token;
    if (said.is_object() && said.contains("token") && said["token"].is_string())
      token = said["token"].get<std::string>();
    if (!server_.options().access.find(token))
      return refuse_token(request, 403, "Nobody has this token.\n");
    HttpAnswer done = plain(204, "");
    send(request, done, token_cookie(token, !server_.options().certificate_file.empty()));
  }

  void point_to_feed(const Request& request) {
    if (request.method() != http::verb::get) return send(request, no_such_method("GET"));
    send(request, plain(426, "The feed is a WebSocket.\n"));
  }

  void upgrade(const Request& request, const std::string& protocol) {
    if (!asker_.access) return send(request, plain(401, "A token is needed.\n"));
    if (protocol.empty())
      return send(request, plain(400, "None of these protocols is spoken here.\n"));
    if (server_.is_full()) return send(request, plain(503, "Too many watch already.\n"));
    auto socket = std::make_shared<WebSocket<Stream>>(
        std::move(stream_), std::move(seat_), server_, *asker_.access, protocol);
    socket->accept(request);
  }

  void send(const Request& request, const HttpAnswer& answer,
            const std::string& cookie = {}) {
    response_ = {};
    response_.version(request.version());
    response_.result(answer.status);
    response_.set(http::field::content_type, answer.type);
    response_.set(http::field::cache_control,
                  answer.may_be_kept ? "no-cache" : "no-store");
    response_.set("Content-Security-Policy", policy(server_.options().imagery_origin));
    response_.set("X-Content-Type-Options", "nosniff");
    response_.set("Referrer-Policy", "no-referrer");
    response_.set("Cross-Origin-Resource-Policy", "same-origin");
    if (answer.gzip) response_.set(http::field::content_encoding, "gzip");
    if (!answer.file.empty())
      response_.set(http::field::content_disposition,
                    "attachment; filename=\"" + answer.file + "\"");
    if (!answer.allow.empty()) response_.set(http::field::allow, answer.allow);
    if (answer.retry_after_s > 0)
      response_.set(http::field::retry_after, std::to_string(answer.retry_after_s));
    if (answer.status == 401) response_.set(http::field::www_authenticate, "Bearer");
    if (answer.status == 426) response_.set(http::field::upgrade, "websocket");
    if (!cookie.empty()) response_.set(http::field::set_cookie, cookie);
    response_.keep_alive(request.keep_alive());
    const bool is_head = request.method() == http::verb::head;
    if (answer.body && !is_head) response_.body() = *answer.body;
    if (is_head)
      response_.content_length(answer.body ? answer.body->size() : 0);
    else if (answer.status != 204)
      response_.prepare_payload();
    patience(server_.options().patience.answer);
    http::async_write(stream_, response_,
                      [self = this->shared_from_this()](Failure failure, std::size_t) {
                        self->sent(failure);
                      });
  }

  void sent(Failure failure) {
    if (failure) return note_slow(failure);
    const bool goes_on = response_.keep_alive();
    response_ = {};  // an answer may be large
    if (goes_on) {
      patience(server_.options().patience.next);
      return read_header();
    }
    Failure ignored;
    beast::get_lowest_layer(stream_).socket().shutdown(tcp::socket::shutdown_send,
                                                       ignored);
    patience(kFarewell);
    drain();
  }

  // Until the other side closes too: bytes that nobody reads would take back the answer.
  void drain() {
    beast::get_lowest_layer(stream_).async_read_some(
        net::buffer(rest_),
        [self = this->shared_from_this()](Failure failure, std::size_t) {
          if (!failure) self->drain();
        });
  }

  Stream stream_;
  Seat seat_;
  Server& server_;
  net::steady_timer delay_{beast::get_lowest_layer(stream_).get_executor()};
  beast::flat_buffer buffer_{kMaxHeader + WebServer::kMaxBody};
  std::optional<http::request_parser<http::string_body>> parser_;
  Asker asker_;
  http::response<http::string_body> response_;
  std::array<char, 2048> rest_{};
};

}  // namespace

std::weak_ptr<Connection> serve(tcp::socket socket, Seat seat, Server& server) {
  auto session = std::make_shared<HttpSession<Plain>>(Plain(std::move(socket)),
                                                      std::move(seat), server);
  session->begin();
  return session;
}

std::weak_ptr<Connection> serve(tcp::socket socket, Seat seat, net::ssl::context& tls,
                                Server& server) {
  auto session = std::make_shared<HttpSession<Tls>>(Tls(std::move(socket), tls),
                                                    std::move(seat), server);
  session->begin();
  return session;
}

}  // namespace skein::hmi::web
