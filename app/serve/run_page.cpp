// SPDX-License-Identifier: Apache-2.0
#include "app/serve/run_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <random>

#include "app/serve/drawing_files.h"
#include "app/serve/fire_files.h"
#include "app/serve/query.h"
#include "app/serve/resident_memory.h"
#include "app/serve/task_forms.h"
#include "app/serve/terrain_bytes.h"
#include "skein/assemble/world/aircraft_builder.h"
#include "skein/data/describe/json.h"
#include "skein/layer/hmi/serve/page_files.h"
#include "skein/layer/hmi/serve/token_file.h"
#include "skein/scenario/utc.h"

namespace skein::serve {
namespace {

using Json = nlohmann::ordered_json;

constexpr double kHalfSize = 6000;  // of the ground that is shown [m]
constexpr double kExtent = 4000;    // that is seen at first [m]

Json place(const Vec2& p) {
  return {{"north_m", p.x()}, {"east_m", p.y()}};
}

Json describe_aircraft(const std::string& name, const scenario::AircraftGroup& group) {
  return {{"name", name},
          {"kind", group.plant.kind},
          {"vehicle", group.vehicle.kind},
          {"hovers", group.plant.kind == "multirotor"},
          {"joins_later", group.join > Time()}};
}

Json describe_run(const scenario::Scenario& scenario, const TaskForms& forms) {
  Json run;
  run["protocol"] = 1;
  run["name"] = scenario.name;
  run["seed"] = scenario.seed;
  run["replay"] = false;
  run["start_utc"] = scenario.start_utc;
  run["origin"] = {{"latitude_deg", scenario.origin.latitude_deg},
                   {"longitude_deg", scenario.origin.longitude_deg},
                   {"height_m", scenario.origin.height_m}};
  run["missions"] = Json::array();
  for (const scenario::Choice& mission : scenario.missions)
    run["missions"].push_back({{"kind", mission.kind}});
  run["aircraft"] = Json::array();
  const auto names = assemble::aircraft_names(scenario);
  for (std::size_t g = 0; g < names.size(); ++g)
    for (const std::string& name : names[g])
      run["aircraft"].push_back(describe_aircraft(name, scenario.aircraft[g]));
  run["task_kinds"] = task_forms(forms);
  return run;
}

// Tells a page whether the server that it finds again is that of the same run.
std::uint64_t random_mark() {
  std::random_device device;
  return (std::uint64_t{device()} << 32) | device();
}

// Where pictures of the ground come from: scheme, host and port of their address.
Result<std::string> origin_of(const std::string& imagery) {
  if (imagery.empty()) return std::string();
  const std::size_t scheme = imagery.find("://");
  const bool is_web =
      imagery.substr(0, 8) == "https://" || imagery.substr(0, 7) == "http://";
  const bool is_plain = std::all_of(imagery.begin(), imagery.end(), [](char c) {
    constexpr std::string_view kParts = ";,'\"<>\\";
    return c > ' ' && c <= '~' && kParts.find(c) == std::string_view::npos;
  });
  if (!is_web || !is_plain || imagery.find("{z}") == std::string::npos)
    return Error{ErrorCode::kBadInput, imagery,
                 "the address of pictures begins with http:// or https:// and has {z}, "
                 "{x} and {y} in it.",
                 ""};
  return imagery.substr(0, imagery.find('/', scheme + 3));
}

Result<hmi::WebOptions> web_options(const ServeOptions& options) {
  hmi::WebOptions web;
  web.address = options.address;
  web.port = options.port;
  web.protocols = {std::string(hmi::LiveHub::kProtocol)};
  for (const std::string_view name : hmi::foxglove::kProtocols) {
    web.protocols.emplace_back(name);
    web.guest_protocols.emplace_back(name);
  }
  web.guest_origins = options.viewer_origins;
  web.hosts = options.hosts;
  web.certificate_file = options.certificate_file;
  web.key_file = options.key_file.empty() ? options.certificate_file : options.key_file;
  auto origin = origin_of(options.imagery);
  if (!origin) return origin.error();
  web.imagery_origin = std::move(origin).value();
  if (options.tokens_file.empty()) return web;
  auto table = hmi::read_token_file(options.tokens_file);
  if (!table) return table.error();
  web.access = std::move(table).value();
  return web;
}

hmi::HttpAnswer with_body(std::string type, std::shared_ptr<const std::string> body) {
  hmi::HttpAnswer answer;
  answer.type = std::move(type);
  answer.body = std::move(body);
  return answer;
}

hmi::HttpAnswer with_json(const Json& value) {
  return with_body("application/json",
                   std::make_shared<const std::string>(json::line_of(value) + "\n"));
}

hmi::HttpAnswer nothing() {
  hmi::HttpAnswer answer = with_json({{"error", "there is nothing of this name."}});
  answer.status = 404;
  return answer;
}

void name_run(const scenario::Scenario& scenario, RunFacts& facts) {
  facts.name = scenario.name;
  facts.start_s = scenario::parse_utc(scenario.start_utc).value_or(0);
  facts.origin = scenario.origin;
}

hmi::foxglove::Facts viewer_facts(const RunFacts& facts, const std::string& session,
                                  const std::optional<geo::LocalFrame>& frame) {
  return {"Skein: " + facts.name, session, facts.start_s, frame};
}

}  // namespace

RunFacts facts_of(const scenario::Scenario& scenario, const assemble::KindRegistry& kinds,
                  const assemble::Build& ready, const std::string& version) {
  const std::shared_ptr<const TaskForms>& forms = kinds.kinds().task.forms();
  Json run = describe_run(scenario, *forms);
  run["version"] = version;
  run["duration_s"] = ready.options.duration.seconds();
  run["centre"] = place(ready.map_centre);
  run["extent_m"] = kExtent;
  RunFacts facts;
  facts.task_forms = forms;
  facts.description = json::line_of(run);
  facts.terrain =
      assemble::sample_terrain(*ready.world.terrain, ready.map_centre, kHalfSize);
  facts.duration = ready.options.duration;
  facts.speed = ready.options.speed;
  facts.previewer = [scenario, &kinds](TaskPreviewer::Answer answer) {
    return std::make_unique<TaskPreviewer>(scenario, kinds, std::move(answer));
  };
  name_run(scenario, facts);
  return facts;
}

RunFacts facts_of(const scenario::Scenario& scenario,
                  const record::RecordStream& recorded, assemble::TerrainPatch terrain) {
  Json run = describe_run(scenario, message_task_forms());
  run["version"] = recorded.info().version;
  run["duration_s"] = recorded.end().seconds();
  run["replay"] = true;
  const double half = terrain.spacing * (terrain.rows - 1) / 2;
  run["centre"] = place(terrain.low + Vec2::Constant(half));
  run["extent_m"] = kExtent;
  RunFacts facts;
  facts.description = json::line_of(run);
  facts.terrain = std::move(terrain);
  facts.duration = recorded.end();
  facts.speed = 1;
  facts.recorded = true;
  name_run(scenario, facts);
  return facts;
}

Result<std::unique_ptr<RunPage>> RunPage::open(const ServeOptions& options,
                                               const RunFacts& facts) {
  auto web = web_options(options);
  if (!web) return web.error();
  std::unique_ptr<RunPage> page(new RunPage);
  Json run = Json::parse(facts.description);
  run["imagery"] = options.imagery;
  const std::string mark = fmt::format("{:016x}", random_mark());
  run["run"] = mark;
  page->description_ = json::line_of(run);
  if (auto frame = geo::LocalFrame::at(facts.origin)) page->frame_ = frame.value();
  page->start_s_ = facts.start_s;
  page->terrain_ = std::make_shared<const std::string>(terrain_bytes(facts.terrain));
  page->hub_ = std::make_unique<hmi::LiveHub>(
      [page = page.get()](const hmi::HttpRequest& request) {
        return page->answer(request);
      },
      viewer_facts(facts, mark, page->frame_), facts.task_forms);
  page->feed_ = std::make_unique<hmi::LiveFeed>(*page->hub_, facts.duration, facts.speed,
                                                facts.recorded);
  auto server = hmi::WebServer::open(web.value(), *page->hub_);
  if (!server) return server.error();
  page->server_ = std::move(server).value();
  page->hub_->attach(*page->server_);
  if (facts.previewer) {
    page->previewer_ = facts.previewer(
        [hub = page->hub_.get()](hmi::ClientNumber client, const TaskPreview& preview) {
          hub->reply(client, preview);
        });
    page->feed_->set_previewer(
        [previewer = page->previewer_.get()](
            hmi::ClientNumber client, std::uint32_t number, hmi::PreviewOrder order) {
          previewer->ask(client, number, std::move(order));
        });
  }
  page->server_->start();
  return page;
}

RunPage::~RunPage() {
  // What flies ahead answers by the server.
  previewer_.reset();
}

std::string RunPage::place() const {
  return server_->place();
}

Json RunPage::health(const hmi::Access& access) const {
  const RunClock clock = feed_->clock();
  const hmi::FeedSizes held = feed_->sizes();
  const hmi::WebStatistics web = server_->statistics();
  Json health = {{"status", "ok"},
                 {"time_s", clock.time.seconds()},
                 {"duration_s", clock.duration.seconds()},
                 {"speed", clock.speed},
                 {"wanted_speed", clock.wanted_speed},
                 {"paused", clock.paused},
                 {"over", clock.over},
                 {"misses", clock.misses},
                 {"clients", hub_->clients()},
                 {"memory",
                  {{"resident_bytes", resident_bytes()},
                   {"state_records", held.state_records},
                   {"waiting_records", held.waiting_records},
                   {"metric_samples", held.metric_samples},
                   {"waiting_requests", hub_->waiting_requests()},
                   {"unsent_bytes", web.waiting_bytes}}},
                 {"connections",
                  {{"now", web.connections},
                   {"refused", web.refused_connections},
                   {"evicted", web.evicted_connections},
                   {"slow", web.slow_connections}}}};
  // For those who steer: viewers need not know of somebody's guesses.
  const bool is_viewer = access.role == AccessRole::kViewer;
  health["wrong_tokens"] = is_viewer ? Json(nullptr) : Json(web.wrong_tokens);
  return health;
}

bool RunPage::is_known(std::string_view path) const {
  return path == "/api/run" || path == "/api/terrain" || path == "/api/health" ||
         is_fire_file(path) || hmi::page_file(path);
}

hmi::HttpAnswer RunPage::answer(const hmi::HttpRequest& request) const {
  if (request.path == kDrawingsPath && frame_) return drawings_of(request, *frame_);
  const bool is_read = request.method == "GET" || request.method == "HEAD";
  if (!is_read && is_known(request.path)) {
    hmi::HttpAnswer answer =
        with_json({{"error", "only GET and HEAD are answered here."}});
    answer.status = 405;
    answer.allow = "GET, HEAD";
    return answer;
  }
  if (!is_read) return nothing();
  if (request.path.starts_with("/api/") && is_known(request.path))
    if (auto refused = refused_query(request.query, {})) return *std::move(refused);
  if (request.path == "/api/run") {
    Json run = Json::parse(description_);
    run["you"] = {{"role", name_of(request.access.role)}, {"name", request.access.name}};
    return with_json(run);
  }
  if (request.path == "/api/terrain")
    return with_body("application/octet-stream", terrain_);
  if (request.path == "/api/health") return with_json(health(request.access));
  if (frame_)
    if (auto file = fire_file(request.path, feed_->fire(), *frame_, start_s_))
      return *std::move(file);
  if (auto file = hmi::page_file(request.path)) return *std::move(file);
  return nothing();
}

}  // namespace skein::serve
