// SPDX-License-Identifier: Apache-2.0
#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <optional>
#include <thread>

#include "app/common/commands.h"
#include "app/common/common.h"
#include "app/common/output.h"
#include "app/common/run_order.h"
#include "app/common/version.h"
#include "app/serve/pack_run.h"
#include "app/serve/run_page.h"
#include "skein/assemble/kinds/kinds_of.h"
#include "skein/assemble/world/build.h"
#include "skein/assemble/world/read_command.h"
#include "skein/assemble/world/run.h"
#include "skein/base/log.h"
#include "skein/base/output_file.h"
#include "skein/layer/hmi/terminal_console.h"
#include "skein/link/modem/modem_link.h"
#include "skein/link/vehicle_links/vehicle_feed.h"
#include "skein/record/figures/mission/mission_figure_text.h"
#include "skein/record/report/report.h"
#include "skein/record/store/fan_out.h"
#include "skein/record/store/replay.h"
#include "skein/record/store/run_recorder.h"
#include "skein/record/store/sqlite.h"
#include "skein/scenario/scenario_file.h"

namespace skein::app {
namespace {

namespace fs = std::filesystem;

// fast = 0, real = 1, or a factor; nothing when it is none of these.
std::optional<double> parse_speed(const std::string& text) {
  if (text == "fast" || text.empty()) return 0.0;
  if (text == "real") return 1.0;
  double factor = 0;
  const auto [end, error] =
      std::from_chars(text.data(), text.data() + text.size(), factor);
  if (error != std::errc() || end != text.data() + text.size() || !(factor > 0) ||
      factor > 1e9)
    return std::nullopt;
  return factor;
}

// The first of runs/NAME, runs/NAME-2, ... that does not exist; made, so that nobody else
// takes it.
fs::path free_folder(const std::string& name) {
  const fs::path base = fs::path("runs") / folder_name(name);
  fs::path folder = base;
  std::error_code error;  // a place that cannot be made fails when it is written
  fs::create_directories(base.parent_path(), error);
  for (int k = 2; !fs::create_directory(folder, error) && !error; ++k)
    folder = base.string() + fmt::format("-{}", k);
  return folder;
}

// Metrics are computed behind the simulation: what they throw may come out only now.
Result<record::RunSummary> close(record::RunRecorder& recorder, bool interrupted) {
  try {
    return recorder.close(interrupted);
  } catch (const std::bad_alloc&) {
    return Error{ErrorCode::kUnavailable, "", "not enough memory.",
                 "The records end early."};
  } catch (const std::exception& error) {
    return internal_error(error.what());
  }
}

void print_table(const record::RunSummary& summary) {
  static constexpr std::pair<const char*, const char*> kRows[] = {
      {"perf_mean_m", "Perf, mean over the allocation phase [m]"},
      {"boundary_rms_mean_m", "distance of boundaries, RMS, mean [m]"},
      {"boundary_hausdorff_mean_m", "the same, largest, mean [m]"},
      {"sigma_mean_m", "stated sigma, mean [m]"},
      {"iou_mean", "intersection over union, mean"},
      {"coverage_95_mean", "share of boundary in its 95 % band, mean"},
      {"nees_mean", "NEES, mean (1 = consistent)"},
      {"over_confident_s", "belief contradicted by its crossings for [s]"},
      {"aircraft", "aircraft"},
      {"observations", "observations"},
      {"crossings", "crossings"},
      {"messages_lost", "messages lost"},
      {"messages_forged", "messages that attackers sent in others' names"},
      {"messages_forged_accepted", "and that were taken for theirs"},
      {"aircraft_landed", "aircraft that have landed"},
      {"accidents", "accidents"},
      {"failsafes", "failsafes"},
      {"outside_programs_ended", "ends of programs of aircraft elsewhere"},
      {"outside_programs_gone", "of these not there in the end"},
      {"cross_track_rms_m", "distance to the path flown, RMS [m]"},
      {"position_error_rms_m", "error of own position, RMS [m]"},
      {"min_charge", "lowest charge left, of 1"},
      {"objects_found", "objects found"},
      {"detections", "detections of objects"},
      {"team_tasks_done", "tasks done by a team that leads itself"},
      {"team_masters", "who led it, one after the other"},
      {"simulated_s", "simulated time [s]"},
      {"real_time_factor", "speed, times real time"}};
  for (const auto& [name, text] : kRows)
    if (const auto value = summary.number(name))
      print("  {:<44}{:>12.4g}\n", text, *value);
  for (const auto& [name, value] : summary.numbers)
    if (const auto text = record::mission_number_text(name))
      print("  {:<44}{:>12.4g}\n", *text, value);
}

// The part of a version that says whether runs are the same: "0.1.0" of "0.1.0+g3e85".
std::string_view release_of(std::string_view version) {
  return version.substr(0, version.find('+'));
}

// Reads what the run of `folder` is done again from, if this version can do it.
std::optional<record::RecordedRun> read_replayed(const fs::path& folder) {
  auto recorded = record::read_recorded(folder);
  if (!recorded) {
    say_error(recorded.error());
    return std::nullopt;
  }
  const std::string& version = recorded.value().version;
  if (release_of(version) != release_of(kVersion)) {
    complain(
        "{}: was recorded by Skein {}; that version does it again (this is {}). "
        "`report`, "
        "`replay` and `export` read it.\n",
        folder.string(), version.empty() ? "of unknown version" : version, kVersion);
    return std::nullopt;
  }
  return std::move(recorded).value();
}

std::optional<RunOrder> order_of(const RunArguments& arguments) {
  std::vector<std::string> overrides = arguments.overrides;
  if (!arguments.seed.empty()) overrides.push_back("seed=" + arguments.seed);
  const bool again = !arguments.replay.empty();
  if (!again && arguments.scenario.empty()) {
    complain("which scenario? Give a scenario file, or --replay FOLDER.\n");
    return std::nullopt;
  }
  if (again)
    if (auto good = check_run_folder(arguments.replay); !good) {
      say_error(good.error());
      return std::nullopt;
    }
  std::optional<record::RecordedRun> recorded;
  if (again) {
    recorded = read_replayed(arguments.replay);
    if (!recorded) return std::nullopt;
  }
  auto kinds = load_kinds(arguments.plugins, arguments.trusted);
  if (!kinds) return std::nullopt;
  auto scenario = load_scenario(
      again ? arguments.replay / "scenario.yaml" : fs::path(arguments.scenario),
      overrides, arguments.plugins, *kinds);
  if (!scenario) return std::nullopt;
  return RunOrder{*std::move(kinds), *std::move(scenario), std::move(recorded)};
}

// The commands of a recorded run in place of the scenario's, which are among them.
// One that was interrupted ends where it did, which is not behind the scenario's end.
void replay(const record::RecordedRun& recorded, simulation::RunOptions& options) {
  options.commands = recorded.commands;
  options.clock_by_command = false;
  if (recorded.interrupted)
    options.duration = std::min(options.duration, *recorded.interrupted);
}

Result<std::unique_ptr<record::RunRecorder>> open_records(
    const scenario::Scenario& scenario, const std::string& text, const fs::path& folder,
    bool overwrite, serve::RunPage* page) {
  record::RunRecorderOptions options;
  options.perimeter_period = scenario.record.perimeter_period;
  options.messages = scenario.record.messages;
  options.overwrite = overwrite;
  if (page)
    options.on_metrics = [page](const MetricSample& sample) {
      page->feed().show(sample);
    };
  auto created = record::RunRecorder::create(
      folder, {kVersion, scenario.seed, scenario.name, text, scenario.start_utc},
      options);
  if (!created) return created;
  if (auto written = write_file(folder / "scenario.yaml", text); !written)
    return written.error();
  return created;
}

// Aircraft elsewhere fly by the wall clock, but those in lock-step. A run that is done
// again needs no clock.
Result<void> set_clock(assemble::Build& ready, double speed,
                       const RunArguments& arguments, bool again) {
  // Who watches sees it in real time, unless asked otherwise.
  ready.options.speed = arguments.serve && arguments.speed.empty() ? 1 : speed;
  ready.options.real_time_only = ready.mixed;
  if (!ready.mixed || again) return {};
  if (!arguments.speed.empty() && speed != 1)
    return Error{ErrorCode::kBadInput, "--speed " + arguments.speed,
                 "an aircraft of the scenario is not simulated: it flies in real time, "
                 "and so must the run.",
                 "Leave --speed out, or give --speed real."};
  ready.options.speed = 1;
  return {};
}

// What the run's modem did.
void set_figures(const modem::ModemStatistics& modem, record::RunRecorder& recorder) {
  const auto set = [&recorder](const char* name, auto value) {
    recorder.set_figure(name, static_cast<double>(value));
  };
  set("modem_sent", modem.sent);
  set("modem_sent_bytes", modem.sent_bytes);
  set("modem_injected", modem.injected);
  set("modem_heard", modem.heard);
  set("modem_heard_bytes", modem.heard_bytes);
  set("modem_duplicates", modem.duplicates);
  set("modem_unknown", modem.unknown);
  set("modem_unauthentic", modem.unauthentic);
  set("modem_clashes", modem.clashes);
  set("modem_damaged", modem.damaged);
  set("modem_unreachable", modem.unreachable);
  set("modem_unsent", modem.unsent);
  set("modem_too_long", modem.too_long);
  set("modem_put_full", modem.put_full);
  set("modem_take_full", modem.take_full);
  set("modem_queue_full", modem.dropped.full);
  set("modem_expired", modem.dropped.expired);
  set("modem_delay_mean_s", modem.mean_delay());
  set("modem_delay_most_s", modem.delay_most.seconds());
}

// The page that the arguments ask for; null: none.
Result<std::unique_ptr<serve::RunPage>> open_page(const RunArguments& arguments,
                                                  const scenario::Scenario& scenario,
                                                  const assemble::KindRegistry& kinds,
                                                  const assemble::Build& ready) {
  if (!arguments.serve) return std::unique_ptr<serve::RunPage>();
  serve::ServeOptions options = arguments.page;
  if (!arguments.serve->empty())
    if (auto read = serve::read_place(*arguments.serve, options); !read)
      return read.error();
  return serve::RunPage::open(options, serve::facts_of(scenario, kinds, ready, kVersion));
}

Result<simulation::RunOutcome> run_with_page(assemble::Build& ready,
                                             record::RunRecorder& recorder,
                                             OperatorConsole& console,
                                             serve::RunPage& page) {
  record::FanOut all({&recorder, &page.feed()});
  hmi::LiveConsole steered(console, page.feed());
  return assemble::run_linked(ready, &all, steered);
}

// After the run the page stays until somebody asks for the end.
void keep_serving(serve::RunPage& page, const std::atomic<bool>& stop) {
  page.feed().finish();
  if (!stop) complain("The run is over; its page stays until Ctrl-C.\n");
  while (!stop) {
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    page.feed().take_commands();
  }
}

// Runs to the end; whether it was interrupted.
Result<bool> simulate(assemble::Build& ready, record::RunRecorder& recorder,
                      const geo::LocalFrame& frame, const TaskForms& forms,
                      const RunArguments& arguments, serve::RunPage* page,
                      const std::atomic<bool>& stop) {
  hmi::TerminalConsole console(stop, stderr, arguments.commands ? STDIN_FILENO : -1);
  console.read_with(
      [&](std::string_view line) { return assemble::read_command(line, frame, forms); });
  const auto outcome = page ? run_with_page(ready, recorder, console, *page)
                            : assemble::run_linked(ready, &recorder, console);
  if (!outcome) return outcome.error();
  recorder.set_figure("deadline_misses",
                      static_cast<double>(outcome.value().deadline_misses));
  if (ready.modem && ready.modem->is_open())
    set_figures(ready.modem->statistics(), recorder);
  return outcome.value().end == simulation::RunOutcome::End::kStopped;
}

// Says whether a run that was done again is the same; the exit status.
int compare(const record::RecordedRun& recorded, const record::RunSummary& summary) {
  if (!recorded.content_hash) {
    complain("The recorded run was cut off and has no content hash to compare with.\n");
    return kDone;
  }
  if (*recorded.content_hash == summary.content_hash) {
    complain("The same content hash as the recorded run: {}\n", summary.content_hash);
    return kDone;
  }
  complain(
      "Not the same content hash: {} was recorded by {}, {} now by {}. Is it the same "
      "build?\n",
      *recorded.content_hash, recorded.version, summary.content_hash, kVersion);
  return kFailed;
}

// Prints the end of a run and writes its report; the exit status.
int finish(const RunArguments& arguments, const fs::path& folder,
           const record::RunSummary& summary, bool interrupted) {
  std::string written =
      (folder / "run.sqlite").string() + "  summary.json  scenario.yaml";
  if (arguments.report) {
    const std::vector<fs::path> runs = {folder};
    if (auto report =
            record::write_report(runs, folder / "report.html", serve::report_map);
        !report) {
      say_error(report.error());
      return kFailed;
    }
    written += "  report.html";
  }
  if (arguments.json) {
    std::string text;
    if (auto read = read_text(folder / "summary.json", text); !read)
      return say_error(read.error());
    put_out(text + "\n");
  } else {
    print("{}{}\n", summary.name, interrupted ? " (interrupted)" : "");
    print_table(summary);
    print("Written: {}\n", written);
  }
  return interrupted ? kInterrupted : kDone;
}

// Whether a program that moved or flew an aircraft was gone when the run ended: then
// nothing of that aircraft counts, and the run has failed.
bool misses_programs(const record::RunSummary& summary) {
  const auto gone = summary.number("outside_programs_gone");
  if (!gone || *gone == 0) return false;
  complain(
      "Programs of {:.0f} aircraft ended by themselves and were not there in the end: "
      "see "
      "the events autopilot-ended and flight-model-ended.\n",
      *gone);
  return true;
}

// Makes what shall be run.
Result<assemble::Build> build_order(const RunOrder& order) {
  if (order.agent)
    return assemble::build_agent(order.scenario, order.kinds, *order.agent);
  if (order.recorded)
    return assemble::build(order.scenario, order.kinds, order.recorded->reports);
  return assemble::build(order.scenario, order.kinds);
}

// Opens the links to whoever takes part from outside, and says where servers wait.
Result<void> start_links(assemble::Build& ready) {
  const auto places = assemble::open_links(ready);
  if (!places) return places.error();
  for (const std::string& place : places.value()) complain("waiting at {}\n", place);
  return {};
}

}  // namespace

int run_command(const RunArguments& arguments, const std::atomic<bool>& stop) {
  const auto order = order_of(arguments);
  return order ? run_order(*order, arguments, stop) : kBadUsage;
}

int run_order(const RunOrder& order, const RunArguments& arguments,
              const std::atomic<bool>& stop) {
  const auto speed = parse_speed(arguments.speed);
  if (!speed) {
    complain("--speed {}: must be fast, real or a factor above 0.\n", arguments.speed);
    return kBadUsage;
  }
  const scenario::Scenario& scenario = order.scenario;
  // From now on an interrupt ends the run, whose report is still made.
  record::stop_reading_when(nullptr);

  const auto frame = geo::LocalFrame::at(scenario.origin);
  if (!frame) return say_error(frame.error());
  const bool again = order.recorded.has_value();
  auto built = build_order(order);
  if (!built) return say_error(built.error());
  assemble::Build& ready = built.value();
  for (const std::string& warning : ready.warnings) log_warning("{}", warning);
  if (!again)  // before anything is written
    if (auto allowed = assemble::check_consent(ready); !allowed)
      return say_error(allowed.error());
  if (auto set = set_clock(ready, *speed, arguments, again); !set) {
    say_error(set.error());
    return kBadUsage;
  }
  ready.options.threads = arguments.threads;
  if (order.recorded) {
    replay(*order.recorded, ready.options);
    ready.feed.reset();  // what ground stations asked for is among the commands
  }

  const auto page =
      open_page(arguments, scenario, order.kinds, ready);  // outlives its recorder
  if (!page) return say_error(page.error());
  const fs::path folder =
      arguments.out.empty() ? free_folder(scenario.name) : arguments.out;
  auto opened =
      open_records(scenario, scenario::write_scenario(scenario, order.kinds.table()),
                   folder, arguments.overwrite, page.value().get());
  if (!opened) return say_error(opened.error());
  record::RunRecorder& recorder = *opened.value();
  const auto patch =
      assemble::sample_terrain(*ready.world.terrain, ready.map_centre, 4000);
  recorder.store_terrain(patch.rows, patch.rows, patch.low, patch.spacing, patch.heights);

  if (!again)
    if (auto started = start_links(ready); !started) return say_error(started.error());
  // Only a run that begins has a page.
  if (page.value()) complain("The page: {}\n", page.value()->place());
  const auto simulated =
      simulate(ready, recorder, frame.value(), order.kinds.table().task_forms(),
               arguments, page.value().get(), stop);
  const bool interrupted =
      simulated ? simulated.value() || (order.recorded && order.recorded->interrupted)
                : true;
  const auto closed = close(recorder, interrupted);
  if (!simulated || !closed) {
    say_error(simulated ? closed.error() : simulated.error());
    complain("Records until shortly before: {}\nReplay: skein run {} --seed {}\n",
             folder.string(), shell_quoted((folder / "scenario.yaml").string()),
             scenario.seed);
    return kFailed;
  }
  int status = finish(arguments, folder, closed.value(), simulated.value());
  if (!again && misses_programs(closed.value()) && status == kDone) status = kFailed;
  if (page.value()) keep_serving(*page.value(), stop);
  return status == kDone && order.recorded ? compare(*order.recorded, closed.value())
                                           : status;
}

int run_unrecorded(const RunOrder& order, const std::atomic<bool>& stop) {
  auto built = build_order(order);
  if (!built) return say_error(built.error());
  assemble::Build& ready = built.value();
  ready.options.speed = 1;
  ready.options.real_time_only = true;
  if (auto started = start_links(ready); !started) return say_error(started.error());
  hmi::TerminalConsole console(stop, stderr, -1);
  const auto outcome = assemble::run_linked(ready, nullptr, console);
  return outcome ? kDone : say_error(outcome.error());
}

}  // namespace skein::app
