// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <atomic>
#include <thread>

#include "skein/layer/hmi/serve/live_feed.h"
#include "skein/layer/hmi/serve/test/live_client.h"

namespace skein::hmi::live_server_test {
namespace {

constexpr const char* kTokens =
    "viewer-viewer-viewer viewer\n"
    "operator-operator-1 operator Anna\n"
    "operator-operator-2 operator Boris\n"
    "instructor-instructor instructor\n";

// A run that goes on as long as it is watched: its thread records, and obeys.
class ServedRun {
 public:
  explicit ServedRun(const char* tokens = nullptr) {
    WebOptions options;
    options.port = 0;
    options.protocols = {std::string(LiveHub::kProtocol)};
    for (const std::string_view name : foxglove::kProtocols) {
      options.protocols.emplace_back(name);
      options.guest_protocols.emplace_back(name);
    }
    options.guest_origins = {"https://viewer.example"};
    if (tokens) options.access = AccessTable::parse(tokens, "tokens").value();
    auto opened = WebServer::open(options, hub_);
    EXPECT_TRUE(opened) << opened.error().text();
    server_ = std::move(opened).value();
    hub_.attach(*server_);
    server_->start();
    const std::string place = server_->place();
    port_ = static_cast<std::uint16_t>(std::stoi(place.substr(place.rfind(':') + 1)));
    EntityRecord station, aircraft;
    station.kind = "station";
    aircraft.id = EntityId{1};
    aircraft.name = "scout-1";
    aircraft.kind = "aircraft";
    feed_.record(station);
    feed_.record(aircraft);
    thread_ = std::thread([this] { run(); });
  }
  ~ServedRun() {
    ended_ = true;
    thread_.join();
  }

  std::uint16_t port() const { return port_; }
  /// As a recorded run that goes to another time: all that was said is void.
  void restart() { restarts_ = true; }
  /// Bytes that each step says besides.
  void say_much(std::size_t bytes) { much_ = bytes; }

 private:
  void run() {
    for (int step = 0; !ended_; ++step) {
      const Time now = Time::from_seconds(0.1 * step);
      for (const CommandRecord& given : feed_.take_commands()) obey(now, given);
      if (restarts_.exchange(false)) feed_.restart(now);
      TruthRecord truth;
      truth.time = now;
      truth.id = EntityId{1};
      feed_.record(truth);
      EstimateRecord estimate;
      estimate.id = EntityId{1};
      estimate.nav.time = now;
      feed_.record(estimate);
      if (much_ > 0) {
        // Of which only the newest is part of the state.
        PerimeterRecord perimeter;
        perimeter.time = now;
        perimeter.truth = {geo::Ring(much_ / sizeof(Vec2), Vec2::Zero())};
        feed_.record(perimeter);
      }
      EXPECT_TRUE(feed_.step_done(now));
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
  }

  // As the simulation does: it records, and refuses right behind.
  void obey(Time now, const CommandRecord& given) {
    CommandRecord record = given;
    record.time = now;
    feed_.record(record);
    const auto* add = std::get_if<AddCommand>(&given.command);
    if (add && add->aircraft != "scout-1")
      feed_.record(Event{now, EntityId{0}, EventKind::kCommandRefused,
                         "add " + add->aircraft + ": there is no such aircraft."});
    if (std::holds_alternative<TaskCommand>(given.command))
      feed_.record(Event{now, EntityId{1}, EventKind::kTaskRefused, "no fire sensor"});
  }

  LiveHub hub_{
      [](const HttpRequest& request) {
        HttpAnswer answer;
        answer.status = request.path == "/api/run" || request.path == "/" ? 200 : 404;
        answer.body = std::make_shared<const std::string>(name_of(request.access.role));
        return answer;
      },
      {"a run", "session", 0, {}}};
  LiveFeed feed_{hub_, Time::from_seconds(3600), 1};
  std::unique_ptr<WebServer> server_;
  std::uint16_t port_ = 0;
  std::atomic<bool> ended_ = false, restarts_ = false;
  std::atomic<std::size_t> much_ = 0;
  std::thread thread_;
};

std::vector<std::pair<std::string, std::string>> bearer(const char* token) {
  return {{"Authorization", std::string("Bearer ") + token}};
}

// The request with which a WebSocket begins.
Asked upgrade(std::vector<std::pair<std::string, std::string>> headers,
              const char* protocol = "skein.live.v1") {
  headers.insert(headers.end(), {{"Upgrade", "websocket"},
                                 {"Connection", "Upgrade"},
                                 {"Sec-WebSocket-Key", "MDEyMzQ1Njc4OWFiY2RlZg=="},
                                 {"Sec-WebSocket-Version", "13"},
                                 {"Sec-WebSocket-Protocol", protocol}});
  return {.target = "/live", .headers = std::move(headers)};
}

TEST(WebServer, AnswersThisMachineAlone) {
  ServedRun run;
  EXPECT_EQ(ask(run.port(), {}).result_int(), 200U);
  const auto described = ask(run.port(), {.target = "/api/run"});
  EXPECT_EQ(described.result_int(), 200U);
  EXPECT_EQ(described.body(), "instructor");
  EXPECT_EQ(ask(run.port(), {.target = "/nothing"}).result_int(), 404U);
  EXPECT_EQ(ask(run.port(), {.target = "/api/run", .host = "evil.example"}).result_int(),
            403U);
  EXPECT_EQ(ask(run.port(), {.method = http::verb::post,
                             .target = "/api/run",
                             .headers = {{"Origin", "http://evil.example"}}})
                .result_int(),
            403U);
  EXPECT_NE(described["Content-Security-Policy"].find("script-src 'self'"),
            beast::string_view::npos);
}

TEST(WebServer, RefusesWebSocketsOfOtherPagesAndProtocols) {
  ServedRun run;
  EXPECT_EQ(ask(run.port(), upgrade({{"Origin", "http://evil.example"}})).result_int(),
            403U);
  EXPECT_FALSE(LiveClient(run.port(), {{"Origin", "http://evil.example"}}).is_open());
  EXPECT_EQ(ask(run.port(), upgrade({}, "other")).result_int(), 400U);
  EXPECT_FALSE(LiveClient(run.port(), {}, "other").is_open());
  LiveClient own(run.port(), {{"Origin", "http://localhost"}});
  EXPECT_TRUE(own.is_open());
}

TEST(WebServer, TokensSayWhoMaySeeAndGiveCommands) {
  ServedRun run(kTokens);
  EXPECT_EQ(ask(run.port(), {.target = "/api/run"}).result_int(), 401U);
  EXPECT_EQ(ask(run.port(), {.target = "/"}).result_int(), 200U);
  EXPECT_EQ(ask(run.port(), upgrade({})).result_int(), 401U);
  EXPECT_EQ(ask(run.port(), upgrade(bearer("viewer-viewer-viewe"))).result_int(), 401U);
  EXPECT_FALSE(LiveClient(run.port(), bearer("viewer-viewer-viewe")).is_open());

  const auto refused = ask(
      run.port(),
      {.method = http::verb::post, .target = "/login", .body = R"({"token":"wrong"})"});
  EXPECT_EQ(refused.result_int(), 403U);
  const auto done = ask(run.port(), {.method = http::verb::post,
                                     .target = "/login",
                                     .body = R"({"token":"viewer-viewer-viewer"})"});
  EXPECT_EQ(done.result_int(), 204U);
  EXPECT_EQ(std::string(done["Set-Cookie"]),
            "skein_token=viewer-viewer-viewer; Path=/; HttpOnly; SameSite=Strict");
  const auto seen =
      ask(run.port(), {.target = "/api/run",
                       .headers = {{"Cookie", "skein_token=viewer-viewer-viewer"}}});
  EXPECT_EQ(seen.body(), "viewer");

  LiveClient viewer(run.port(), bearer("viewer-viewer-viewer"));
  viewer.say(R"({"number":1,"line":"pause"})");
  EXPECT_EQ(viewer.wait_for_reply(1)->text, "viewers only see.");
  LiveClient anna(run.port(), bearer("operator-operator-1"));
  anna.say(R"({"number":1,"line":"fault scout-1 link"})");
  EXPECT_EQ(anna.wait_for_reply(1)->text, "faults and wind are the instructor's.");
  anna.say(R"({"number":2,"line":"pause"})");
  EXPECT_EQ(anna.wait_for_reply(2)->state, RequestState::kAccepted);
}

TEST(LiveFeed, WhoJoinsIsToldTheFullStateAndThenWhatHappens) {
  ServedRun run;
  LiveClient client(run.port());
  ASSERT_TRUE(client.is_open());
  const auto mark = client.wait_for<SnapshotMark>();
  ASSERT_TRUE(mark && mark->begins);
  const auto first = client.wait_for<FleetFrame>();
  const auto second = client.wait_for<FleetFrame>();
  ASSERT_TRUE(first && second);
  ASSERT_EQ(second->vehicles.size(), 1U);
  EXPECT_GT(second->time, first->time);
  EXPECT_TRUE(client.wait_for<TruthFrame>());
  client.say(R"({"number":1,"truth":false})");
  EXPECT_TRUE(client.wait_for<ClientList>(
      [](const ClientList& list) { return !list.truth_shown; }));
  EXPECT_TRUE(client.wait_for<SnapshotMark>());
  for (int k = 0; k < 5; ++k)
    for (const LiveItem& item : client.hear())
      EXPECT_FALSE(std::holds_alternative<TruthFrame>(item));
}

TEST(LiveFeed, CommandsAreAcceptedOrRefusedWithTheReason) {
  ServedRun run;
  LiveClient client(run.port());
  client.say(R"({"number":1,"command":{"kind":"add","aircraft":"scout-1"}})");
  const auto accepted = client.wait_for_reply(1);
  ASSERT_TRUE(accepted);
  EXPECT_EQ(accepted->state, RequestState::kAccepted) << accepted->text;
  client.say(R"({"number":2,"line":"add scout-9"})");
  const auto refused = client.wait_for_reply(2);
  ASSERT_TRUE(refused);
  EXPECT_EQ(refused->state, RequestState::kRefused);
  EXPECT_EQ(refused->text, "add scout-9: there is no such aircraft.");
  client.say(R"({"number":3,"line":"nonsense"})");
  EXPECT_EQ(client.wait_for_reply(3)->state, RequestState::kRefused);
  // By the aircraft, later.
  client.say(R"({"number":4,"line":"task scout-1 edge 0,0"})");
  const auto later = client.wait_for<RequestReply>([](const RequestReply& reply) {
    return reply.number == 4 && reply.state == RequestState::kRefused;
  });
  ASSERT_TRUE(later);
  EXPECT_EQ(later->text, "no fire sensor");
  client.say(R"({"number":5,"line":"task scout-1 plan file /etc/passwd"})");
  EXPECT_EQ(client.wait_for_reply(5)->text,
            "no files are read for a page: it sends the plan itself.");
}

TEST(LiveFeed, OneHoldsControlAndCanHandItOver) {
  ServedRun run(kTokens);
  LiveClient anna(run.port(), bearer("operator-operator-1"));
  ASSERT_TRUE(anna.wait_for<ClientList>(
      [](const ClientList& list) { return list.holder == list.you; }));
  LiveClient boris(run.port(), bearer("operator-operator-2"));
  const auto list = boris.wait_for<ClientList>();
  ASSERT_TRUE(list);
  boris.say(R"({"number":1,"line":"pause"})");
  EXPECT_EQ(boris.wait_for_reply(1)->text, "Anna holds control.");
  boris.say(R"({"number":2,"hold":true})");
  EXPECT_EQ(boris.wait_for_reply(2)->state, RequestState::kRefused);
  anna.say(R"({"number":1,"hand_over":)" + std::to_string(list->you) + "}");
  EXPECT_EQ(anna.wait_for_reply(1)->state, RequestState::kAccepted);
  boris.say(R"({"number":3,"line":"pause"})");
  EXPECT_EQ(boris.wait_for_reply(3)->state, RequestState::kAccepted);
  // An instructor may take it.
  LiveClient teacher(run.port(), bearer("instructor-instructor"));
  teacher.say(R"({"number":1,"hold":true})");
  EXPECT_EQ(teacher.wait_for_reply(1)->state, RequestState::kAccepted);
}

TEST(LiveFeed, WhoReadsNothingHoldsUpNobodyAndIsToldAllLater) {
  ServedRun run;
  LiveClient slow(run.port());
  ASSERT_TRUE(slow.wait_for<FleetFrame>());
  run.say_much(1 << 20);
  LiveClient quick(run.port());
  // Far more than may wait for a client.
  while (quick.is_open() && quick.bytes_heard() < 6 * LiveHub::kMaxWaiting) quick.hear();
  ASSERT_TRUE(quick.is_open());
  run.say_much(0);
  std::size_t before = slow.bytes_heard();
  EXPECT_TRUE(slow.wait_for<SnapshotMark>());
  // What the system buffers besides is a few megabytes.
  EXPECT_LT(slow.bytes_heard() - before, 2 * LiveHub::kMaxWaiting + (16 << 20));
}

TEST(LiveFeed, WhoSaysTooMuchOrTooOftenIsDisconnected) {
  ServedRun run;
  LiveClient large(run.port());
  large.say(R"({"number":1,"line":")" + std::string(70000, 'x') + "\"}");
  EXPECT_FALSE(large.wait_for_reply(1));
  LiveClient rapid(run.port());
  for (int k = 0; k < 2000 && rapid.is_open(); ++k)
    rapid.say(R"({"number":1,"line":"no such command"})");
  while (rapid.is_open()) rapid.hear();
  LiveClient usual(run.port());
  EXPECT_TRUE(usual.wait_for<FleetFrame>());
}

TEST(LiveFeed, HundredWatchAtOnce) {
  ServedRun run;
  std::vector<std::unique_ptr<LiveClient>> all;
  for (int k = 0; k < 100; ++k) all.push_back(std::make_unique<LiveClient>(run.port()));
  for (const auto& client : all) EXPECT_TRUE(client->wait_for<FleetFrame>());
}

// Waits for a text message that `is_right` accepts; says whether there was one.
template <class Right>
bool reads_text(LiveClient& client, Right is_right) {
  while (client.is_open())
    if (const auto bytes = client.read(); client.read_text() && is_right(bytes))
      return true;
  return false;
}
// Of a subscription.
std::string read_data(LiveClient& client) {
  while (client.is_open())
    if (const auto bytes = client.read(); !client.read_text() && bytes.size() > 13)
      return bytes;
  return {};
}
bool has(const std::string& text, const char* part) {
  return text.find(part) != std::string::npos;
}

TEST(Foxglove, ViewersAreSentWhatTheySubscribeTo) {
  for (const std::string_view protocol : foxglove::kProtocols) {
    ServedRun run;
    LiveClient viewer(run.port(), {}, std::string(protocol));
    ASSERT_TRUE(viewer.is_open());
    EXPECT_TRUE(reads_text(viewer, [](const auto& t) { return has(t, "serverInfo"); }));
    EXPECT_TRUE(reads_text(
        viewer, [](const auto& t) { return has(t, "/aircraft/scout-1/state"); }));
    viewer.say(R"({"op":"subscribe","subscriptions":[{"id":9,"channelId":1}]})");
    for (int k = 0; k < 3; ++k) {
      const std::string data = read_data(viewer);
      ASSERT_GT(data.size(), 13u);
      EXPECT_EQ(data[0], 1);
      EXPECT_EQ(data[1], 9);
      EXPECT_TRUE(has(data, "transforms")) << data;
    }
    viewer.say("nonsense");
    EXPECT_TRUE(reads_text(viewer, [](const auto& t) { return has(t, "status"); }));
  }
}

TEST(Foxglove, ViewersHoldNoControlAndSeeNoTruthThatIsHidden) {
  ServedRun run;
  LiveClient viewer(run.port(), {}, "foxglove.websocket.v1");
  LiveClient page(run.port());
  const auto list = page.wait_for<ClientList>();
  ASSERT_TRUE(list);
  EXPECT_EQ(list->holder, list->you);
  ASSERT_EQ(list->clients.size(), 2u);
  EXPECT_EQ(list->clients[0].role, AccessRole::kViewer);
  run.say_much(1600);  // a true boundary
  viewer.say(R"({"op":"subscribe","subscriptions":[{"id":1,"channelId":3}]})");
  while (!has(read_data(viewer), "true ")) ASSERT_TRUE(viewer.is_open());
  page.say(R"({"number":1,"truth":false})");
  EXPECT_TRUE(reads_text(viewer, [](const auto& t) { return has(t, "unadvertise"); }));
  viewer.say(R"({"op":"subscribe","subscriptions":[{"id":2,"channelId":3}]})");
  // The first is empty: nothing of the other side is kept. Then there is a boundary.
  while (!has(read_data(viewer), "believed")) ASSERT_TRUE(viewer.is_open());
  for (int k = 0; k < 3; ++k) EXPECT_FALSE(has(read_data(viewer), "true "));
}

TEST(Foxglove, ViewersForgetWhatIsVoidAfterAJump) {
  ServedRun run;
  run.say_much(1600);  // a boundary
  LiveClient viewer(run.port(), {}, "foxglove.websocket.v1");
  viewer.say(R"({"op":"subscribe","subscriptions":[{"id":1,"channelId":3}]})");
  while (!has(read_data(viewer), "believed")) ASSERT_TRUE(viewer.is_open());
  run.say_much(0);
  run.restart();
  while (!has(read_data(viewer), "\"entities\":[]")) ASSERT_TRUE(viewer.is_open());
}

TEST(Foxglove, PagesOfOthersOnlyWatchAndOnlyWhereTheUserSaysSo) {
  ServedRun run;
  const auto joins = [&](const char* origin, const char* protocol) {
    return LiveClient(run.port(), {{"Origin", origin}}, protocol).is_open();
  };
  EXPECT_TRUE(joins("https://viewer.example", "foxglove.websocket.v1"));
  EXPECT_FALSE(joins("https://viewer.example", "skein.live.v1"));
  EXPECT_FALSE(joins("https://evil.example", "foxglove.websocket.v1"));
}

}  // namespace
}  // namespace skein::hmi::live_server_test
