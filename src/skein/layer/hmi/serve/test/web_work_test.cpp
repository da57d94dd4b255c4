// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <future>
#include <memory>
#include <mutex>
#include <new>
#include <thread>
#include <vector>

#include "skein/layer/hmi/serve/test/live_client.h"
#include "skein/layer/hmi/serve/web_server.h"

// Answers that take long are made beside the server's thread, few at a time.
namespace skein::hmi::web_work_test {
namespace {

// Work that lasts until it is let go.
class Gate {
 public:
  void wait() {
    std::unique_lock lock(mutex_);
    ++entered_;
    changed_.notify_all();
    changed_.wait(lock, [this] { return open_; });
  }
  void wait_for(int entered) {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [&] { return entered_ >= entered; });
  }
  void set(bool open) {
    const std::lock_guard lock(mutex_);
    open_ = open;
    changed_.notify_all();
  }

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  int entered_ = 0;
  bool open_ = false;
};

struct Worker final : WebListener {
  HttpAnswer answer(const HttpRequest& request) override {
    HttpAnswer answer;
    answer.body = std::make_shared<const std::string>("now");
    if (request.path == "/api/slow")
      answer.work = [this, body = std::string(request.body)] {
        gate.wait();
        HttpAnswer made;
        made.body = std::make_shared<const std::string>(body + ", later");
        return made;
      };
    if (request.path == "/api/huge")
      answer.work = []() -> HttpAnswer { throw std::bad_alloc(); };
    return answer;
  }
  void joined(ClientNumber, const Access&, std::string_view) override {}
  void said(ClientNumber, std::string_view, bool) override {}
  void left(ClientNumber) override {}

  Gate gate;
};

struct Served {
  Served() {
    WebOptions options;
    options.port = 0;
    options.access =
        AccessTable::parse(
            "operator-operator-1 operator Anna\noperator-operator-2 operator Bert\n"
            "operator-operator-3 operator Cora\n",
            "tokens")
            .value();
    auto opened = WebServer::open(options, worker);
    EXPECT_TRUE(opened) << opened.error().text();
    server = std::move(opened).value();
    server->start();
    const std::string place = server->place();
    port = static_cast<std::uint16_t>(std::stoi(place.substr(place.rfind(':') + 1)));
  }

  auto ask_as(char who, const std::string& path, const std::string& body = "") const {
    return ask(
        port,
        {.method = http::verb::post,
         .target = path,
         .headers = {{"Authorization", std::string("Bearer operator-operator-") + who}},
         .body = body});
  }
  auto begin_as(char who, const std::string& body) const {
    return std::async(std::launch::async,
                      [=, this] { return ask_as(who, "/api/slow", body); });
  }

  Worker worker;
  std::unique_ptr<WebServer> server;
  std::uint16_t port = 0;
};

TEST(WebWork, HoldsNobodyElseUp) {
  Served run;
  auto slow = run.begin_as('1', "first");
  run.worker.gate.wait_for(1);
  for (int k = 0; k < 20; ++k)
    EXPECT_EQ(run.ask_as('1', "/api/quick").body(), "now") << "while work is under way";
  run.worker.gate.set(true);
  const auto made = slow.get();
  EXPECT_EQ(made.result_int(), 200U);
  EXPECT_EQ(made.body(), "first, later");
}

TEST(WebWork, IsOneAtATimeOfEachClientAndTwoInAll) {
  Served run;
  for (int round = 1; round <= 3; ++round) {
    run.worker.gate.set(false);
    auto first = run.begin_as('1', "a");
    run.worker.gate.wait_for(2 * round - 1);
    const auto again = run.ask_as('1', "/api/slow");
    EXPECT_EQ(again.result_int(), 503U) << "its first is under way";
    EXPECT_EQ(again["Retry-After"], "2");
    EXPECT_EQ(again["Content-Type"], "application/json");
    auto second = run.begin_as('2', "b");
    run.worker.gate.wait_for(2 * round);
    EXPECT_EQ(run.ask_as('3', "/api/slow").result_int(), 503U) << "two are under way";
    run.worker.gate.set(true);
    EXPECT_EQ(first.get().body(), "a, later");
    EXPECT_EQ(second.get().body(), "b, later");
  }
}

TEST(WebWork, ThatFailsIsAnswered) {
  Served run;
  EXPECT_EQ(run.ask_as('1', "/api/huge").result_int(), 500U);
  run.worker.gate.set(true);
  EXPECT_EQ(run.ask_as('1', "/api/slow", "then").body(), "then, later");
}

// Who asked has gone, or the server ends: whatever is under way ends by itself.
TEST(WebWork, MayOutliveWhoAskedAndEndsWithTheServer) {
  Served run;
  {
    boost::asio::io_context io;
    beast::tcp_stream stream(io);
    stream.connect(tcp::endpoint(boost::asio::ip::make_address("127.0.0.1"), run.port));
    http::request<http::string_body> request(http::verb::post, "/api/slow", 11);
    request.set(http::field::host, "localhost");
    request.set(http::field::authorization, "Bearer operator-operator-1");
    request.prepare_payload();
    http::write(stream, request);
    run.worker.gate.wait_for(1);
  }
  EXPECT_EQ(run.ask_as('2', "/api/quick").body(), "now");
  std::thread opens([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    run.worker.gate.set(true);
  });
  run.server.reset();
  opens.join();
}

}  // namespace
}  // namespace skein::hmi::web_work_test
