// SPDX-License-Identifier: Apache-2.0
#include "app/serve/run_page.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <yaml-cpp/yaml.h>
#include <algorithm>
#include <atomic>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>
#include <set>
#include <thread>

#include "app/serve/replay_player.h"
#include "app/serve/task_forms.h"
#include "skein/assemble/kinds/kinds_of.h"
#include "skein/assemble/world/run.h"
#include "skein/data/command/command_text.h"
#include "skein/data/describe/json.h"
#include "skein/layer/hmi/serve/test/live_client.h"
#include "skein/record/store/fan_out.h"
#include "skein/record/store/run_recorder.h"
#include "skein/scenario/scenario_file.h"

namespace skein::serve::run_page_test {
namespace {

using hmi::LiveClient;
using Json = nlohmann::json;

constexpr const char* kScenario =
    "name: watched\n"
    "duration_s: 600\n"
    "seed: 5\n"
    "aircraft: [{name: scout, count: 2}]\n"
    "missions: [{kind: perimeter, name: fire}]\n";

scenario::Scenario read(const std::string& text = kScenario) {
  auto outcome = scenario::read_scenario_text(text, "test", ".", assemble::kind_table());
  EXPECT_TRUE(outcome.scenario);
  return *outcome.scenario;
}

std::uint16_t port_of(const RunPage& page) {
  const std::string place = page.place();
  return static_cast<std::uint16_t>(std::stoi(place.substr(place.rfind(':') + 1)));
}

ServeOptions any_port() {
  ServeOptions options;
  options.port = 0;
  return options;
}

class Silent final : public OperatorConsole {
 public:
  explicit Silent(const std::atomic<bool>& stop) : stop_(stop) {}
  void show(const RunProgress&) override {}
  bool stop_requested() const override { return stop_; }

 private:
  const std::atomic<bool>& stop_;
};

// Watches all that there is, by Foxglove's protocol, until the run is over.
bool watches_to_the_end(LiveClient& viewer) {
  bool over = false;
  while (viewer.is_open() && !over) {
    const std::string message = viewer.read();
    if (!viewer.read_text()) {
      over = message.find("\"over\":true") != std::string::npos;
      continue;
    }
    const Json said = Json::parse(message);
    if (said["op"] != "advertise") continue;
    Json all = Json::array();
    for (const Json& channel : said["channels"])
      all.push_back({{"id", channel["id"]}, {"channelId", channel["id"]}});
    viewer.say(Json{{"op", "subscribe"}, {"subscriptions", all}}.dump());
  }
  return over;
}

// Asks what a task would become, and watches until the run is over.
bool asks_and_watches(LiveClient& client) {
  client.say(R"({"number": 1, "preview": {"kind": "task", "aircraft": "scout-1",)"
             R"( "what": {"kind": "fly_to", "north_m": 900, "east_m": 0}}})");
  return client.wait_for<RunClock>([](const RunClock& clock) { return clock.over; })
      .has_value();
}

// The run with `watchers` clients, every fourth by Foxglove's protocol, recorded in a
// folder; its summary.
record::RunSummary run_watched(const std::filesystem::path& folder, int watchers) {
  const scenario::Scenario scenario = read();
  const assemble::KindRegistry kinds;
  auto built = assemble::build(scenario, kinds);
  EXPECT_TRUE(built) << built.error().text();
  assemble::Build& ready = built.value();
  ready.options.speed = 0;
  auto page = RunPage::open(any_port(), facts_of(scenario, kinds, ready, "test"));
  EXPECT_TRUE(page) << page.error().text();
  hmi::LiveFeed& feed = page.value()->feed();
  record::RunRecorderOptions options;
  options.overwrite = true;
  options.on_metrics = [&feed](const MetricSample& sample) { feed.show(sample); };
  auto recorder = record::RunRecorder::create(
      folder, {"test", scenario.seed, scenario.name, "", scenario.start_utc}, options);
  EXPECT_TRUE(recorder) << recorder.error().text();
  std::vector<std::unique_ptr<LiveClient>> clients;
  std::vector<std::thread> readers;
  std::atomic<int> told = 0;
  for (int k = 0; k < watchers; ++k) {
    const bool is_viewer = k % 4 == 3;
    clients.push_back(std::make_unique<LiveClient>(
        port_of(*page.value()), std::vector<std::pair<std::string, std::string>>(),
        is_viewer ? "foxglove.websocket.v1" : "skein.live.v1"));
    readers.emplace_back([client = clients.back().get(), is_viewer, &told] {
      told += is_viewer ? watches_to_the_end(*client) : asks_and_watches(*client);
    });
  }
  record::FanOut all({recorder.value().get(), &feed});
  const std::atomic<bool> stop = false;
  Silent silent(stop);
  hmi::LiveConsole console(silent, feed);
  EXPECT_TRUE(assemble::run_linked(ready, &all, console));
  auto closed = recorder.value()->close();
  EXPECT_TRUE(closed) << closed.error().text();
  feed.finish();
  for (std::thread& reader : readers) reader.join();
  EXPECT_EQ(told, watchers);
  return closed ? std::move(closed).value() : record::RunSummary();
}

std::filesystem::path folder_for(const char* name) {
  return std::filesystem::temp_directory_path() /
         (std::string("skein-run-page-") + name + "-" + std::to_string(::getpid()));
}

TEST(RunPage, SaysWhatThereIsToKnowOfTheRun) {
  const scenario::Scenario scenario = read();
  const assemble::KindRegistry kinds;
  const auto built = assemble::build(scenario, kinds);
  ASSERT_TRUE(built);
  const auto page =
      RunPage::open(any_port(), facts_of(scenario, kinds, built.value(), "1.2.3"));
  ASSERT_TRUE(page) << page.error().text();
  const std::uint16_t port = port_of(*page.value());
  const Json run = Json::parse(hmi::ask(port, {.target = "/api/run"}).body());
  EXPECT_EQ(run["name"], "watched");
  EXPECT_EQ(run["version"], "1.2.3");
  EXPECT_EQ(run["duration_s"], 600);
  EXPECT_EQ(run["you"]["role"], "instructor");
  ASSERT_EQ(run["aircraft"].size(), 2U);
  EXPECT_EQ(run["aircraft"][1]["name"], "scout-2");
  const std::string terrain = hmi::ask(port, {.target = "/api/terrain"}).body();
  std::uint32_t rows = 0;
  ASSERT_GE(terrain.size(), 32U);
  std::memcpy(&rows, terrain.data(), sizeof rows);
  EXPECT_EQ(terrain.size(), 32 + 4 * static_cast<std::size_t>(rows) * rows);
  EXPECT_EQ(hmi::ask(port, {.target = "/api/health"}).result_int(), 200U);
  EXPECT_EQ(hmi::ask(port, {.target = "/"}).result_int(), 200U);
  EXPECT_EQ(hmi::ask(port, {.target = "/../etc/passwd"}).result_int(), 404U);
  for (const char* known :
       {"/", "/api/run", "/api/terrain", "/api/health", "/api/fire.kml"}) {
    const auto other = hmi::ask(port, {.method = hmi::http::verb::put, .target = known});
    EXPECT_EQ(other.result_int(), 405U) << known;
    EXPECT_EQ(other["Allow"], "GET, HEAD") << known;
  }
  EXPECT_EQ(hmi::ask(port, {.target = "/api/drawings"})["Allow"], "POST");
  EXPECT_EQ(
      hmi::ask(port, {.method = hmi::http::verb::put, .target = "/nothing"}).result_int(),
      404U);
}

TEST(RunPage, HealthSaysWhatTheServerHoldsAndHasMetWith) {
  const auto folder = folder_for("tokens");
  std::filesystem::create_directories(folder);
  const std::string tokens = (folder / "tokens").string();
  std::ofstream(tokens)
      << "viewer-viewer-viewer viewer\noperator-operator-1 operator \xff\n";
  std::filesystem::permissions(tokens, std::filesystem::perms(0600));
  const scenario::Scenario scenario = read();
  const assemble::KindRegistry kinds;
  const auto built = assemble::build(scenario, kinds);
  ASSERT_TRUE(built);
  ServeOptions options = any_port();
  options.tokens_file = tokens;
  const auto page =
      RunPage::open(options, facts_of(scenario, kinds, built.value(), "test"));
  ASSERT_TRUE(page) << page.error().text();
  const auto asks = [&](const char* what, const char* token) {
    return hmi::ask(
        port_of(*page.value()),
        {.target = what, .headers = {{"Authorization", std::string("Bearer ") + token}}});
  };
  EXPECT_EQ(asks("/api/health", "wrong-wrong-wrong-1").result_int(), 401U);
  const Json health = Json::parse(asks("/api/health", "operator-operator-1").body());
  EXPECT_EQ(health["wrong_tokens"], 1);
  EXPECT_GT(health["memory"]["resident_bytes"], 1'000'000);
  EXPECT_EQ(health["connections"]["refused"], 0);
  EXPECT_GE(health["connections"]["now"], 1);
  EXPECT_TRUE(
      Json::parse(asks("/api/health", "viewer-viewer-viewer").body())["wrong_tokens"]
          .is_null());
  // A name that is no text is one by now.
  EXPECT_EQ(Json::parse(asks("/api/run", "operator-operator-1").body())["you"]["name"],
            "\uFFFD");
  std::filesystem::remove_all(folder);
}

TEST(RunPage, AnswersWhatItsDescriptionForProgramsSays) {
  const YAML::Node described = YAML::LoadFile(SKEIN_SOURCE_DIR "/docs/openapi.yaml");
  const scenario::Scenario scenario = read();
  const assemble::KindRegistry kinds;
  auto built = assemble::build(scenario, kinds);
  ASSERT_TRUE(built) << built.error().text();
  auto page = RunPage::open(any_port(), facts_of(scenario, kinds, built.value(), "test"));
  ASSERT_TRUE(page) << page.error().text();
  std::set<std::string> paths;
  for (const auto& path : described["paths"]) {
    const std::string target = path.first.as<std::string>();
    paths.insert(target);
    if (!path.second["get"] || target.find('{') != std::string::npos) continue;
    const auto answer = hmi::ask(port_of(*page.value()), {.target = target});
    EXPECT_EQ(answer.result_int(), 200U) << target;
    const auto odd = hmi::ask(port_of(*page.value()), {.target = target + "?units=feet"});
    EXPECT_EQ(odd.result_int(), 400U) << target;
    EXPECT_NE(odd.body().find("units"), std::string::npos) << odd.body();
    const auto content = *path.second["get"]["responses"]["200"]["content"].begin();
    EXPECT_EQ(answer[hmi::http::field::content_type], content.first.as<std::string>());
    if (!content.second["schema"]["$ref"]) continue;
    const std::string schema = content.second["schema"]["$ref"].as<std::string>();
    std::set<std::string> required, said;
    for (const auto& name : described["components"]["schemas"]
                                     [schema.substr(schema.rfind('/') + 1)]["required"])
      required.insert(name.as<std::string>());
    const Json body = Json::parse(answer.body());
    for (const auto& [key, value] : body.items()) said.insert(key);
    EXPECT_EQ(said, required) << target;
  }
  EXPECT_EQ(paths,
            (std::set<std::string>{"/api/drawings", "/api/fire.{format}", "/api/health",
                                   "/api/run", "/api/terrain", "/login"}));
  // Of a run that has not begun.
  for (const auto& format :
       described["paths"]["/api/fire.{format}"]["get"]["parameters"][0]["schema"]["enum"])
    for (const auto& [query, status] :
         {std::pair("", 404U), std::pair("?at_s=600", 400U)})
      EXPECT_EQ(hmi::ask(port_of(*page.value()),
                         {.target = "/api/fire." + format.as<std::string>() + query})
                    .result_int(),
                status);
  const Json health =
      Json::parse(hmi::ask(port_of(*page.value()), {.target = "/api/health"}).body());
  EXPECT_EQ(health["duration_s"], 600);  // before the first step too
}

TEST(RunPage, RunIsTheSameWithAndWithoutThoseWhoWatch) {
  const auto folder = folder_for("hash");
  const record::RunSummary alone = run_watched(folder, 0);
  const record::RunSummary watched = run_watched(folder, 20);
  EXPECT_FALSE(alone.content_hash.empty());
  EXPECT_EQ(alone.content_hash, watched.content_hash);
  std::filesystem::remove_all(folder);
}

TEST(RunPage, BadPlacesAndFilesAreRefused) {
  ServeOptions options;
  EXPECT_TRUE(read_place("0", options));
  EXPECT_TRUE(read_place("[::1]:81", options));
  EXPECT_EQ(options.address, "::1");
  EXPECT_EQ(options.port, 81);
  for (const char* bad : {"", "x", "70000", "1.2.3.4:", ":80", "[::1:80", "80x"})
    EXPECT_FALSE(read_place(bad, options)) << bad;

  const scenario::Scenario scenario = read();
  const assemble::KindRegistry kinds;
  const auto built = assemble::build(scenario, kinds);
  const RunFacts facts = facts_of(scenario, kinds, built.value(), "test");
  ServeOptions open = any_port();
  open.address = "0.0.0.0";
  const auto page = RunPage::open(open, facts);
  ASSERT_FALSE(page);
  EXPECT_NE(page.error().text().find("--tokens"), std::string::npos);
  open = any_port();
  open.tokens_file = "/nowhere/tokens";
  EXPECT_FALSE(RunPage::open(open, facts));
  open = any_port();
  open.imagery = "https://tiles.example/{z}'; script-src *";
  EXPECT_FALSE(RunPage::open(open, facts));
  open = any_port();
  open.certificate_file = "/nowhere/certificate.pem";
  EXPECT_FALSE(RunPage::open(open, facts));
}

TEST(RunPage, SaysWhatATaskWouldBecomeBeforeItIsGiven) {
  const scenario::Scenario scenario = read();
  const assemble::KindRegistry kinds;
  auto built = assemble::build(scenario, kinds);
  ASSERT_TRUE(built) << built.error().text();
  built.value().options.speed = 5;
  auto page = RunPage::open(any_port(), facts_of(scenario, kinds, built.value(), "test"));
  ASSERT_TRUE(page) << page.error().text();
  std::atomic<bool> stop = false;
  std::thread run([&] {
    Silent silent(stop);
    hmi::LiveConsole console(silent, page.value()->feed());
    EXPECT_TRUE(assemble::run_linked(built.value(), &page.value()->feed(), console));
  });
  LiveClient client(port_of(*page.value()));
  ASSERT_TRUE(client.wait_for<FleetFrame>(
      [](const FleetFrame& fleet) { return fleet.vehicles.size() == 2; }));
  client.say(R"({"number": 3, "preview": {"kind": "task", "aircraft": "scout-1",)"
             R"( "what": {"kind": "fly_to", "north_m": 900, "east_m": 0}}})");
  const auto preview = client.wait_for<TaskPreview>();
  ASSERT_TRUE(preview);
  EXPECT_EQ(preview->number, 3u);
  EXPECT_EQ(preview->problem, "");
  EXPECT_TRUE(preview->done);
  EXPECT_GT(preview->path.points.size(), 5u);
  client.say(R"({"number": 4, "preview": {"kind": "task", "aircraft": "nobody",)"
             R"( "what": {"kind": "hold"}}})");
  const auto refused = client.wait_for_reply(4);
  ASSERT_TRUE(refused);
  EXPECT_EQ(refused->state, RequestState::kRefused);
  client.say(R"({"number": 5, "preview": {"kind": "pause", "paused": true}})");
  const auto no_task = client.wait_for_reply(5);
  ASSERT_TRUE(no_task);
  EXPECT_EQ(no_task->state, RequestState::kRefused);
  stop = true;
  run.join();
}

// What is seen when a recorded run is shown again, at a time that is gone to.
TEST(Replay, ShowsTheRunAtAnyTime) {
  const auto folder = folder_for("replay");
  run_watched(folder, 0);
  auto recorded = record::RecordStream::open(folder);
  ASSERT_TRUE(recorded) << recorded.error().text();
  EXPECT_EQ(recorded.value().end(), Time::from_seconds(600));
  auto page = RunPage::open(any_port(), facts_of(read(), recorded.value(), {}));
  ASSERT_TRUE(page) << page.error().text();
  std::atomic<bool> stop = false;
  std::thread player(
      [&] { EXPECT_TRUE(play_again(recorded.value(), page.value()->feed(), 1, stop)); });
  LiveClient client(port_of(*page.value()));
  client.say(R"({"number":1,"line":"pause"})");
  EXPECT_TRUE(client.wait_for_reply(1));
  for (const double time : {500.0, 200.0}) {
    client.say(R"({"number":2,"seek_s":)" + std::to_string(time) + "}");
    EXPECT_EQ(client.wait_for_reply(2)->state, RequestState::kAccepted);
    const auto frame = client.wait_for<FleetFrame>([time](const FleetFrame& each) {
      return std::abs(each.time.seconds() - time) < 1;
    });
    ASSERT_TRUE(frame) << time;
    EXPECT_EQ(frame->vehicles.size(), 2U);
  }
  const Json health =
      Json::parse(hmi::ask(port_of(*page.value()), {.target = "/api/health"}).body());
  EXPECT_EQ(health["paused"], true);
  EXPECT_EQ(health["clients"], 1);
  EXPECT_NEAR(health["time_s"].get<double>(), 200, 1);
  // It goes on at its own pace; the way to another time is no speed.
  client.say(R"({"number":4,"line":"resume"})");
  EXPECT_TRUE(client.wait_for_reply(4));
  const auto begun = client.wait_for<RunClock>(
      [](const RunClock& each) { return each.time.seconds() > 200.5; });
  ASSERT_TRUE(begun);
  client.say(R"({"number":5,"seek_s":500})");
  double fastest = 0;
  const auto gone_on = client.wait_for<RunClock>([&fastest](const RunClock& each) {
    fastest = std::max(fastest, each.speed);
    return each.time.seconds() > 501.5;
  });
  ASSERT_TRUE(gone_on);
  EXPECT_GT(gone_on->speed, 0.3);
  EXPECT_LT(fastest, 3);
  client.say(R"({"number":3,"line":"task scout-1 hold"})");
  EXPECT_EQ(client.wait_for_reply(3)->state, RequestState::kRefused);
  stop = true;
  player.join();
  std::filesystem::remove_all(folder);
}

// A form that follows from a task's description asks for what its command takes.
TEST(TaskForms, FilledInWithDefaultsMakeCommands) {
  const auto forms = task_forms(message_task_forms());
  EXPECT_GE(forms.size(), 17U);
  for (const auto& form : forms) {
    Json what = {{"kind", form["kind"]}}, others = Json::array();
    for (const auto& field : form["fields"]) {
      const std::string name = field["name"], type = field["type"];
      if (type == "place") {
        what[json::joined(name, "north_m")] = 100;
        what[json::joined(name, "east_m")] = 200;
      } else if (type == "places") {
        what[name] = {{0, 0}, {0, 500}, {500, 500}};
      } else if (type == "aircraft" || type == "aircraft_list") {
        others.push_back("scout-" + std::to_string(others.size() + 2));  // as pages do
      } else {
        what[name] = field["default"];
      }
    }
    const Json command = {
        {"kind", "task"}, {"aircraft", "scout-1"}, {"what", what}, {"others", others}};
    const auto parsed = parse_command(command.dump());
    EXPECT_TRUE(parsed) << command.dump() << "\n" << parsed.error().text();
  }
}

}  // namespace
}  // namespace skein::serve::run_page_test
