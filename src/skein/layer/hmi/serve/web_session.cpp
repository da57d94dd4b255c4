#include "skein/layer/hmi/serve/web_session.h"

#include <utility>  // before Asio, which lacks it in C++20

#include <algorithm>
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

constexpr auto kRequestTime = std::chrono::seconds(30);
constexpr std::uint32_t kMaxHeader = 16384;

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

// Who asks; nothing: nobody that may.
std::optional<Access> access_of(const Request& request, const WebOptions& options) {
  if (options.access.is_open()) {
    if (!names_this_machine(view(request[http::field::host]))) return std::nullopt;
    return Access{AccessRole::kInstructor, ""};
  }
  const std::string_view header = view(request[http::field::authorization]);
  constexpr std::string_view kBearer = "Bearer ";
  if (header.substr(0, kBearer.size()) == kBearer)
    return options.access.find(header.substr(kBearer.size()));
  return options.access.find(token_in_cookies(view(request[http::field::cookie])));
}

bool comes_from_here(const Request& request) {
  return is_same_origin(view(request[http::field::origin]),
                        view(request[http::field::host]));
}

// Whether a page of another server may watch by a protocol.
bool is_guest(const Request& request, const std::string& protocol,
              const WebOptions& options) {
  const auto has = [](const std::vector<std::string>& list, std::string_view text) {
    return std::find(list.begin(), list.end(), text) != list.end();
  };
  return has(options.guest_origins, view(request[http::field::origin])) &&
         has(options.guest_protocols, protocol);
}

// The best of the server's protocols that the client knows; empty: none.
std::string protocol_of(const Request& request, const WebOptions& options) {
  http::token_list offered(request[http::field::sec_websocket_protocol]);
  for (const std::string& protocol : options.protocols)
    if (offered.exists(protocol)) return protocol;
  return {};
}

template <class Stream>
class WebSocket final : public Client,
                        public std::enable_shared_from_this<WebSocket<Stream>> {
 public:
  WebSocket(Stream stream, Server& server, Access access, std::string protocol)
      : socket_(std::move(stream)),
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
    waiting_ += bytes->size();
    queue_.push_back({std::move(bytes), is_text});
    if (queue_.size() == 1) write();
  }
  std::size_t waiting() const override { return waiting_; }

  void close() override {
    if (closing_) return;
    closing_ = true;
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
    socket_.text(next.is_text);
    socket_.async_write(net::buffer(next.bytes->data(), next.bytes->size()),
                        [self = this->shared_from_this()](Failure failure, std::size_t) {
                          self->written(failure);
                        });
  }

  void written(Failure failure) {
    if (failure) return close();  // the reader notices
    waiting_ -= queue_.front().bytes->size();
    queue_.pop_front();
    if (!queue_.empty() && !closing_) write();
  }

  void end() {
    close();
    if (std::exchange(ended_, true)) return;
    server_.leave(number_);
    server_.to().left(number_);
  }

  websocket::stream<Stream> socket_;
  Server& server_;
  Access access_;
  std::string protocol_;
  ClientNumber number_ = 0;
  beast::flat_buffer buffer_;
  std::deque<Outgoing> queue_;
  std::size_t waiting_ = 0;
  MessageRate rate_{WebServer::kMessagesPerSecond};
  bool closing_ = false, ended_ = false;
};

template <class Stream>
class HttpSession : public std::enable_shared_from_this<HttpSession<Stream>> {
 public:
  HttpSession(Stream stream, Server& server)
      : stream_(std::move(stream)), server_(server) {}

  void begin() {
    if constexpr (std::is_same_v<Stream, Tls>) {
      beast::get_lowest_layer(stream_).expires_after(kRequestTime);
      stream_.async_handshake(net::ssl::stream_base::server,
                              [self = this->shared_from_this()](Failure failure) {
                                if (!failure) self->read();
                              });
    } else {
      read();
    }
  }

 private:
  void read() {
    parser_.emplace();
    parser_->body_limit(WebServer::kMaxBody);
    parser_->header_limit(kMaxHeader);
    beast::get_lowest_layer(stream_).expires_after(kRequestTime);
    http::async_read(stream_, buffer_, *parser_,
                     [self = this->shared_from_this()](Failure failure, std::size_t) {
                       if (!failure) self->answer();
                     });
  }

  void answer() {
    const Request request = parser_->release();
    const auto access = access_of(request, server_.options());
    if (websocket::is_upgrade(request)) return upgrade(request, access);
    const std::string_view target = view(request.target());
    const std::size_t question = std::min(target.find('?'), target.size());
    HttpRequest asked;
    asked.method = view(request.method_string());
    asked.path = target.substr(0, question);
    asked.query = target.substr(std::min(question + 1, target.size()));
    asked.body = request.body();
    if (request.method() != http::verb::get && !comes_from_here(request))
      return send(request, plain(403, "This page comes from another server.\n"));
    if (asked.path == "/login" && request.method() == http::verb::post)
      return log_in(request);
    // The page itself asks for a token; it holds nothing of the run.
    const bool is_page = asked.path.find("/api/") != 0;
    if (!access && !(is_page && !server_.options().access.is_open()))
      return send(request, server_.options().access.is_open()
                               ? plain(403, "Ask this machine by its own name.\n")
                               : plain(401, "A token is needed.\n"));
    asked.access = access.value_or(Access{});
    send(request, server_.to().answer(asked));
  }

  static HttpAnswer plain(unsigned status, const char* text) {
    HttpAnswer answer;
    answer.status = status;
    answer.type = "text/plain; charset=utf-8";
    answer.body = std::make_shared<const std::string>(text);
    return answer;
  }

  void log_in(const Request& request) {
    const auto said = nlohmann::json::parse(request.body(), nullptr, false);
    std::string token;
    if (said.is_object() && said.contains("token") && said["token"].is_string())
      token = said["token"].get<std::string>();
    if (!server_.options().access.find(token))
      return send(request, plain(403, "Nobody has this token.\n"));
    HttpAnswer done = plain(204, "");
    send(request, done, token_cookie(token, !server_.options().certificate_file.empty()));
  }

  void upgrade(const Request& request, const std::optional<Access>& access) {
    if (!access) return send(request, plain(401, "A token is needed.\n"));
    const std::string protocol = protocol_of(request, server_.options());
    if (!comes_from_here(request) && !is_guest(request, protocol, server_.options()))
      return send(request, plain(403, "This page comes from another server.\n"));
    if (protocol.empty())
      return send(request, plain(400, "None of these protocols is spoken here.\n"));
    if (server_.is_full()) return send(request, plain(503, "Too many watch already.\n"));
    std::make_shared<WebSocket<Stream>>(std::move(stream_), server_, *access, protocol)
        ->accept(request);
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
    if (!cookie.empty()) response_.set(http::field::set_cookie, cookie);
    response_.keep_alive(request.keep_alive());
    const bool is_head = request.method() == http::verb::head;
    if (answer.body && !is_head) response_.body() = *answer.body;
    if (is_head)
      response_.content_length(answer.body ? answer.body->size() : 0);
    else if (answer.status != 204)
      response_.prepare_payload();
    http::async_write(stream_, response_,
                      [self = this->shared_from_this()](Failure failure, std::size_t) {
                        self->sent(failure);
                      });
  }

  void sent(Failure failure) {
    if (failure) return;
    if (response_.keep_alive()) return read();
    Failure ignored;
    beast::get_lowest_layer(stream_).socket().shutdown(tcp::socket::shutdown_send,
                                                       ignored);
  }

  Stream stream_;
  Server& server_;
  beast::flat_buffer buffer_{kMaxHeader + WebServer::kMaxBody};
  std::optional<http::request_parser<http::string_body>> parser_;
  http::response<http::string_body> response_;
};

}  // namespace

void serve(tcp::socket socket, Server& server) {
  std::make_shared<HttpSession<Plain>>(Plain(std::move(socket)), server)->begin();
}

void serve(tcp::socket socket, net::ssl::context& tls, Server& server) {
  std::make_shared<HttpSession<Tls>>(Tls(std::move(socket), tls), server)->begin();
}

}  // namespace skein::hmi::web
