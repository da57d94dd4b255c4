// SPDX-License-Identifier: Apache-2.0
// skein net: the radio medium alone, as a network simulator.
#include <fmt/format.h>

#include <chrono>
#include <ctime>
#include <memory>
#include <optional>
#include <utility>

#include "app/common/command_options.h"
#include "app/common/commands.h"
#include "app/common/common.h"
#include "app/common/number_range.h"
#include "app/common/output.h"
#include "app/net/experiment/network_run.h"
#include "skein/assemble/radio/radio_file.h"
#include "skein/base/output_file.h"
#include "skein/exchange/network/network_results.h"
#include "skein/exchange/network/network_tables.h"

namespace skein::app {
namespace {

namespace fs = std::filesystem;

constexpr const char* kNetExamples = R"(
Nodes: columns node, time_s, x_m, y_m, z_m[, power_dbm], or an ns-2 movement file.
Traffic: message, time_s, from, to (a node or *), bytes. docs/network.md has the columns of
what is written, and what radios there are.

Examples:
  skein net --nodes nodes.csv --traffic traffic.csv --profile wifi-dsss-2 \
      --duration 60 --out messages.csv --report network.html
  skein net --nodes nodes.csv --saturate 0,1,1000,5 --saturate 2,1,1000,5 \
      --profile mine.yaml --duration 30 --seed 2 --trace frames.csv --out messages.csv)";

struct NetArguments {
  std::string nodes, traffic, profile, trace, out, report;
  std::vector<std::string> flows, plugins;
  double duration = 0;  // [s]
  std::uint64_t seed = 1;
};

// Commands of Tcl and its comments; a table begins with the names of its columns.
bool is_ns2_movement(std::string_view text) {
  const std::size_t first = text.find_first_not_of(" \t\r\n");
  if (first == std::string_view::npos) return false;
  const std::string_view begin = text.substr(first);
  return begin.starts_with('$') || begin.starts_with('#') || begin.starts_with("set ");
}

// What is written may be no other file of the command.
Result<void> check_distinct(const NetArguments& given) {
  std::vector<fs::path> others;
  for (const std::string& file : {given.nodes, given.traffic, given.profile})
    if (fs::exists(file)) others.emplace_back(file);
  for (const std::string& file : {given.out, given.trace, given.report}) {
    std::error_code none;
    if (file.empty() || (fs::exists(file, none) && !fs::is_regular_file(file, none)))
      continue;
    // Absolute first: what does not exist yet stays relative else.
    const auto place = [&](const fs::path& path) {
      return fs::weakly_canonical(fs::absolute(path, none), none);
    };
    for (const fs::path& other : others)
      if (place(file) == place(other))
        return Error{ErrorCode::kBadInput, file,
                     "is read or written under another option too.",
                     "Give --out, --trace and --report files of their own."};
    others.emplace_back(file);
  }
  return {};
}

Result<NetworkCase> read_case(const NetArguments& given) {
  NetworkCase network;
  std::string text;
  if (auto good = read_text(given.nodes, text); !good) return good.error();
  auto good = is_ns2_movement(text)
                  ? exchange::read_ns2_movement(text, given.nodes, network)
                  : exchange::read_network_nodes(text, given.nodes, network);
  if (!good) return good.error();
  if (!given.traffic.empty()) {
    if (good = read_text(given.traffic, text); !good) return good.error();
    good = exchange::read_network_traffic(text, given.traffic, network);
    if (!good) return good.error();
  }
  for (const std::string& flow : given.flows) {
    auto parsed = exchange::parse_saturated_flow(flow, network);
    if (!parsed) return parsed.error();
    network.flows.push_back(parsed.value());
  }
  if (given.traffic.empty() && network.flows.empty())
    return Error{ErrorCode::kBadInput, "", "nothing is sent.",
                 "Give --traffic FILE or --saturate FROM,TO,BYTES,DEPTH."};
  network.duration = Time::from_seconds(given.duration);
  return network;
}

// Goes on step by step, says how far it is, and ends early when asked to.
void run_to_end(experiment::NetworkRun& run, const NetworkCase& network,
                const std::atomic<bool>& stop) {
  using std::chrono::steady_clock;
  auto reported = steady_clock::now();
  constexpr std::int64_t kParts = 1000;
  for (std::int64_t part = 1; part <= kParts && !stop; ++part) {
    run.advance(Time::from_ns(network.duration.ns() / kParts * part));
    if (steady_clock::now() - reported < std::chrono::seconds(5)) continue;
    reported = steady_clock::now();
    complain("{:.1f} of {:.6g} s\n", run.now().seconds(), network.duration.seconds());
  }
  if (!stop) run.advance(network.duration);
}

// Of Skein and of plugins; without these other kinds, which take 30 ms, are not needed.
std::optional<assemble::RadioParts> radio_parts_of(
    const std::vector<std::string>& plugins) {
  if (plugins.empty()) return assemble::own_radio_parts();
  const auto kinds = load_kinds(plugins);
  if (!kinds) return std::nullopt;
  return kinds->kinds();
}

int net_command(const NetArguments& given, const std::atomic<bool>& stop) {
  if (auto good = check_distinct(given); !good) return say_error(good.error());
  auto read = read_case(given);
  if (!read) return say_error(read.error());
  NetworkCase& network = read.value();
  const auto parts = radio_parts_of(given.plugins);
  if (!parts) return kBadUsage;
  const auto radio = assemble::load_radio(given.profile, fs::current_path(), *parts);
  if (!radio) return say_error(radio.error());
  const auto propagation = assemble::make_propagation(radio.value(), given.seed);
  if (!propagation) return say_error(propagation.error());
  const auto antenna = assemble::make_antenna(*parts, radio.value().antenna);
  if (!antenna) return say_error(antenna.error());

  for (const std::string& file : {given.out, given.report})
    if (!file.empty())
      if (auto good = check_writable(file); !good) return say_error(good.error());
  OutputStream trace;
  if (!given.trace.empty()) {
    auto opened = OutputStream::open(given.trace);
    if (!opened) return say_error(opened.error());
    trace = std::move(opened).value();
    trace.write(exchange::network_trace_header());
    if (auto good = trace.flush(); !good) return say_error(good.error());
  }
  const std::clock_t began = std::clock();
  communication::NodeAntennas antennas;
  if (antenna.value()) antennas.of.assign(network.nodes.size(), antenna.value());
  experiment::NetworkRun run(network, radio.value().radio, *propagation.value(),
                             given.seed, std::move(antennas));
  if (trace.is_open())
    run.on_transmission = [&](const TransmissionRecord& transmission) {
      trace.write(exchange::network_trace_row(network, transmission));
    };
  run_to_end(run, network, stop);
  const double cpu =
      static_cast<double>(std::clock() - began) / static_cast<double>(CLOCKS_PER_SEC);
  const bool whole = run.done();
  if (!whole) network.duration = run.now();

  if (auto good = trace.flush(); !good) return say_error(good.error());
  const NetworkResult& result = run.result();
  if (auto good = write_file(given.out, exchange::network_messages_csv(network, result));
      !good)
    return say_error(good.error());
  if (!given.report.empty()) {
    const std::string title =
        fmt::format("{} nodes, radio {}", network.nodes.size(), radio.value().name);
    if (auto good =
            write_file(given.report, exchange::network_page(title, network, result));
        !good)
      return say_error(good.error());
  }
  print("{}", exchange::network_summary_text(exchange::summarize(network, result)));
  print("simulated   {:.6g} s in {:.3f} CPU s{}\n", network.duration.seconds(), cpu,
        whole ? "" : ", then interrupted");
  return whole ? kDone : kInterrupted;
}

}  // namespace

Command add_net(CLI::App& program, const std::atomic<bool>& stop) {
  auto* command = program.add_subcommand(
      "net", "Simulate a radio network: who hears what, and when.");
  const auto given = std::make_shared<NetArguments>();
  command->add_option("--nodes", given->nodes, "Where the nodes are (CSV, ns-2).")
      ->required();
  command->add_option("--traffic", given->traffic, "What is sent, and when (CSV).");
  command
      ->add_option("--saturate", given->flows,
                   "A node that always has something to send: "
                   "FROM,TO,BYTES,DEPTH[,START_S]; may be repeated.")
      ->take_all();
  command
      ->add_option("--profile", given->profile,
                   "The radio: a name (skein list radio-profile) or a file (.yaml).")
      ->required();
  command->add_option("--duration", given->duration, "How long [s].")
      ->required()
      ->check(CLI::Range(1e-6, 4e6));
  command->add_option("--seed", given->seed, "Of all random numbers; default 1.")
      ->check(seed_number());
  command->add_option("--trace", given->trace,
                      "Every start of a frame is written there.");
  command->add_option("--out", given->out, "What became of each message (CSV).")
      ->required();
  command->add_option("--report", given->report, "A page with figures (HTML).");
  add_plugin_option(*command, given->plugins);
  command->footer(kNetExamples);
  return {command, [given, &stop] { return net_command(*given, stop); }};
}

}  // namespace skein::app
