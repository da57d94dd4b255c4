// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <atomic>
#include <boost/asio/read.hpp>
#include <boost/asio/write.hpp>
#include <chrono>
#include <future>
#include <memory>
#include <thread>

#include "skein/layer/hmi/serve/test/live_client.h"
#include "skein/layer/hmi/serve/web_server.h"

// What a server owes to its other clients while some of them are slow, many, curious or
// guess tokens: over sockets.
namespace skein::hmi::web_limits_test {
namespace {

using namespace std::chrono_literals;
using Headers = std::vector<std::pair<std::string, std::string>>;

constexpr const char* kTokens =
    "viewer-viewer-viewer viewer\n"
    "operator-operator-1 operator Anna\n";

class Plain final : public WebListener {
 public:
  HttpAnswer answer(const HttpRequest& request) override {
    HttpAnswer answer;
    answer.body =
        std::make_shared<const std::string>(std::to_string(request.body.size()));
    return answer;
  }
  void joined(ClientNumber client, const Access&, std::string_view) override {
    joined_ = client;
  }
  void said(ClientNumber, std::string_view, bool) override {}
  void left(ClientNumber) override { ++left_; }

  std::atomic<ClientNumber> joined_ = 0;
  std::atomic<int> left_ = 0;
};

class Served {
 public:
  explicit Served(const char* tokens = kTokens, WebOptions options = {}) {
    options.port = 0;
    options.protocols = {"skein.live.v1"};
    if (tokens) options.access = AccessTable::parse(tokens, "tokens").value();
    auto opened = WebServer::open(options, listener);
    EXPECT_TRUE(opened) << opened.error().text();
    server = std::move(opened).value();
    server->start();
    const std::string place = server->place();
    port = static_cast<std::uint16_t>(std::stoi(place.substr(place.rfind(':') + 1)));
  }

  WebStatistics statistics() {
    std::promise<WebStatistics> answer;
    server->post([&] { answer.set_value(server->statistics()); });
    return answer.get_future().get();
  }
  unsigned status(Asked asked) const { return ask(port, asked).result_int(); }

  Plain listener;
  std::unique_ptr<WebServer> server;
  std::uint16_t port = 0;
};

Headers with_token(std::string scheme = "Bearer") {
  return {{"Authorization", scheme + " operator-operator-1"}};
}
Headers with_token_and(Headers more) {
  more.emplace_back("Authorization", "Bearer operator-operator-1");
  return more;
}

// A connection on which bytes are sent as they are.
class Raw {
 public:
  explicit Raw(std::uint16_t port, int receive_buffer = 0) {
    socket_.open(tcp::v4());
    if (receive_buffer > 0)
      socket_.set_option(boost::asio::socket_base::receive_buffer_size(receive_buffer));
    socket_.connect(tcp::endpoint(boost::asio::ip::make_address("127.0.0.1"), port));
  }
  void say(const std::string& text) {
    boost::asio::write(socket_, boost::asio::buffer(text), failure_);
  }
  /// All that comes until the other side closes.
  std::string rest() {
    std::string all;
    beast::error_code failure;
    boost::asio::read(socket_, boost::asio::dynamic_buffer(all), failure);
    return all;
  }

 private:
  boost::asio::io_context io_;
  tcp::socket socket_{io_};
  beast::error_code failure_;
};

TEST(WebAccess, SchemeOfATokenIsWrittenInAnyCase) {
  Served run;
  for (const char* scheme : {"Bearer", "bearer", "BEARER", "bEaReR"})
    EXPECT_EQ(run.status({.target = "/api/x", .headers = with_token(scheme)}), 200U);
  EXPECT_EQ(run.status({.target = "/api/x", .headers = with_token("Basic")}), 401U);
  EXPECT_EQ(ask(run.port, {.target = "/api/x"})["WWW-Authenticate"], "Bearer");
}

TEST(WebAccess, RequestsOfOtherPagesAreRefusedAlsoIfTheyOnlyLook) {
  Served run;
  const auto looks = [&](Headers headers, const char* target = "/api/x") {
    return run.status({.target = target, .headers = with_token_and(std::move(headers))});
  };
  EXPECT_EQ(looks({{"Origin", "http://localhost"}}), 200U);
  EXPECT_EQ(looks({{"Origin", "http://evil.example"}}), 403U);
  EXPECT_EQ(looks({{"Origin", "null"}}), 403U);
  EXPECT_EQ(looks({{"Sec-Fetch-Site", "same-origin"}}), 200U);
  EXPECT_EQ(looks({{"Sec-Fetch-Site", "none"}}), 200U);
  EXPECT_EQ(looks({{"Sec-Fetch-Site", "cross-site"}}), 403U);
  EXPECT_EQ(looks({{"Sec-Fetch-Site", "same-site"}}), 403U);  // another port
  // A link elsewhere may lead to the page, which holds nothing of the run.
  const Headers link = {{"Sec-Fetch-Site", "cross-site"}, {"Sec-Fetch-Mode", "navigate"}};
  EXPECT_EQ(looks(link, "/"), 200U);
  EXPECT_EQ(looks(link, "/api/x"), 403U);
  EXPECT_EQ(looks({{"Sec-Fetch-Site", "cross-site"}, {"Sec-Fetch-Mode", "no-cors"}}, "/"),
            403U);
}

TEST(WebAccess, OnlyNamesOfThisMachineAreAnswered) {
  WebOptions options;
  options.hosts = {"ground.example.org"};
  Served run(kTokens, options);
  const auto named = [&](const char* host) {
    return run.status({.target = "/api/x", .host = host, .headers = with_token()});
  };
  for (const char* own :
       {"localhost", "LocalHost:81", "127.0.0.1:8080", "10.1.2.3", "[2001:db8::1]:80",
        "ground.example.org", "Ground.Example.Org:8080"})
    EXPECT_EQ(named(own), 200U) << own;
  for (const char* other : {"evil.example", "ground.example.org.evil.example",
                            "127.0.0.1.evil.example", "", "[evil.example]"})
    EXPECT_EQ(named(other), 403U) << other;
  // Without tokens no name but those that only this machine has.
  Served open(nullptr, options);
  EXPECT_EQ(open.status({.target = "/api/x"}), 200U);
  for (const char* other : {"ground.example.org", "10.1.2.3"})
    EXPECT_EQ(open.status({.target = "/api/x", .host = other}), 403U) << other;
}

TEST(WebAccess, LoginAndFeedSayTheirMethods) {
  Served run;
  const auto login = ask(run.port, {.target = "/login"});
  EXPECT_EQ(login.result_int(), 405U);
  EXPECT_EQ(login["Allow"], "POST");
  EXPECT_EQ(run.status({.target = "/live", .headers = with_token()}), 426U);
  const auto feed = ask(
      run.port, {.method = http::verb::put, .target = "/live", .headers = with_token()});
  EXPECT_EQ(feed.result_int(), 405U);
  EXPECT_EQ(feed["Allow"], "GET");
}

TEST(WebLimits, BodiesBeforeLoginAreSmall) {
  Served run;
  const std::string large(70'000, 'x');
  EXPECT_EQ(run.status({.method = http::verb::post, .target = "/login", .body = large}),
            413U);
  EXPECT_EQ(run.status({.method = http::verb::post, .target = "/api/x", .body = large}),
            413U);
  EXPECT_EQ(run.status({.method = http::verb::post,
                        .target = "/api/x",
                        .headers = {{"Authorization", "Bearer wrong-wrong-wrong-"}},
                        .body = large}),
            413U);
  const auto taken = ask(run.port, {.method = http::verb::post,
                                    .target = "/api/x",
                                    .headers = with_token(),
                                    .body = large});
  EXPECT_EQ(taken.result_int(), 200U);
  EXPECT_EQ(taken.body(), "70000");
  // Chunks do not say how long it will be.
  Raw chunks(run.port);
  std::string request =
      "POST /login HTTP/1.1\r\nHost: localhost\r\n"
      "Transfer-Encoding: chunked\r\n\r\n";
  for (int k = 0; k < 8; ++k) request += "4000\r\n" + std::string(0x4000, 'x') + "\r\n";
  chunks.say(request);
  EXPECT_NE(chunks.rest().find("413 "), std::string::npos);
}

TEST(WebLimits, WhatIsNoRequestIsRefused) {
  Served run;
  Raw nonsense(run.port);
  nonsense.say("\xff\xfe\x80 nonsense\r\n\r\n");
  EXPECT_NE(nonsense.rest().find("400 "), std::string::npos);
  Raw large(run.port);
  large.say("GET / HTTP/1.1\r\nHost: localhost\r\nX: " + std::string(20'000, 'x') +
            "\r\n\r\n");
  EXPECT_NE(large.rest().find("431 "), std::string::npos);
}

TEST(WebLimits, WhoIsSlowIsClosed) {
  WebOptions options;
  options.patience = {100ms, 100ms, 100ms, 200ms, 200ms};
  Served run(kTokens, options);
  Raw silent(run.port), header(run.port), body(run.port), idle(run.port);
  header.say("GET / HTTP/1.1\r\nHost: local");
  body.say("POST /login HTTP/1.1\r\nHost: localhost\r\nContent-Length: 100\r\n\r\n{");
  idle.say("GET / HTTP/1.1\r\nHost: localhost\r\n\r\n");
  for (Raw* each : {&silent, &header, &body}) EXPECT_EQ(each->rest(), "");
  EXPECT_NE(idle.rest().find("200 OK"), std::string::npos);
  // A connection may be seen to be closed before the server has counted it.
  for (int k = 0; k < 1000 && run.statistics().slow_connections < 4; ++k)
    std::this_thread::sleep_for(5ms);
  EXPECT_EQ(run.statistics().slow_connections, 4U);
  EXPECT_EQ(run.status({}), 200U);
}

TEST(WebLimits, AWatcherThatDoesNotReadIsClosed) {
  WebOptions options;
  options.patience.message = 200ms;
  Served run(kTokens, options);
  LiveClient deaf(run.port, with_token());
  ASSERT_TRUE(deaf.is_open());
  while (run.listener.joined_ == 0) std::this_thread::sleep_for(1ms);
  const auto bytes = std::make_shared<const std::vector<std::byte>>(32 << 20);
  run.server->post([&] { run.server->send(run.listener.joined_, bytes); });
  while (run.listener.left_ == 0) std::this_thread::sleep_for(5ms);
  EXPECT_EQ(run.statistics().slow_connections, 1U);
  EXPECT_EQ(run.statistics().waiting_bytes, 0U);
}

TEST(WebLimits, ManyIdleConnectionsKeepNobodyOut) {
  WebOptions options;
  options.connections = {.in_all = 20, .per_address = 10};
  Served run(kTokens, options);
  std::vector<std::unique_ptr<Raw>> idle;
  for (int k = 0; k < 200; ++k) idle.push_back(std::make_unique<Raw>(run.port));
  EXPECT_EQ(run.status({}), 200U);
  const WebStatistics met = run.statistics();
  EXPECT_LE(met.connections, 10U);
  EXPECT_GE(met.evicted_connections, 190U);
  EXPECT_EQ(met.refused_connections, 0U);
}

TEST(WebLimits, WhoWatchesIsNotClosedForNewcomers) {
  WebOptions options;
  options.connections = {.in_all = 20, .per_address = 2};
  Served run(kTokens, options);
  LiveClient one(run.port, with_token()), two(run.port, with_token());
  ASSERT_TRUE(one.is_open() && two.is_open());
  while (run.listener.joined_ < 2) std::this_thread::sleep_for(1ms);
  EXPECT_EQ(Raw(run.port).rest(), "");
  EXPECT_EQ(run.statistics().refused_connections, 1U);
  EXPECT_EQ(run.listener.left_, 0);
}

TEST(WebLimits, WrongTokensAreCountedAndWaitButRightOnesDoNot) {
  Served run;
  const Asked wrong{.target = "/api/x",
                    .headers = {{"Authorization", "Bearer wrong-wrong-wrong-"}}};
  // Those that are free, then one of a quarter of a second and one of half of one.
  const auto begin = std::chrono::steady_clock::now();
  for (int k = 0; k < 7; ++k) EXPECT_EQ(run.status(wrong), 401U);
  EXPECT_GE(std::chrono::steady_clock::now() - begin, 750ms);
  EXPECT_EQ(run.statistics().wrong_tokens, 7U);
  // While one waits for a second, others are answered.
  auto waits = std::async(std::launch::async, [&] {
    return run.status({.method = http::verb::post,
                       .target = "/login",
                       .body = R"({"token":"wrong-wrong-wrong-"})"});
  });
  while (run.statistics().wrong_tokens < 8) std::this_thread::sleep_for(1ms);
  EXPECT_EQ(run.status({.target = "/api/x", .headers = with_token()}), 200U);
  EXPECT_EQ(waits.wait_for(0ms), std::future_status::timeout);
  EXPECT_EQ(waits.get(), 403U);
  // A right login in spite of an old cookie.
  EXPECT_EQ(run.status({.method = http::verb::post,
                        .target = "/login",
                        .headers = {{"Cookie", "skein_token=old-old-old-old-old"}},
                        .body = R"({"token":"viewer-viewer-viewer"})"}),
            204U);
  // The page itself is answered at once, whatever is in a cookie.
  EXPECT_EQ(run.status({.headers = {{"Cookie", "skein_token=old-old-old-old-old"}}}),
            200U);
  EXPECT_EQ(run.statistics().wrong_tokens, 8U);
}

}  // namespace
}  // namespace skein::hmi::web_limits_test
