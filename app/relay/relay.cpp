// SPDX-License-Identifier: Apache-2.0
// skein relay: a bad connection between two real ends.
#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <memory>
#include <string>
#include <vector>

#include "app/common/command_options.h"
#include "app/common/commands.h"
#include "app/common/common.h"
#include "app/common/number_range.h"
#include "app/common/output.h"
#include "app/relay/relay_statistics.h"
#include "skein/assemble/relay/relay_order.h"
#include "skein/assemble/relay/relay_profile.h"
#include "skein/layer/hmi/line_input.h"
#include "skein/link/relay/relay.h"

namespace skein::app {
namespace {

using assemble::RelayOrder;

constexpr std::chrono::milliseconds kRelayTurn{50};    // between looks for orders
constexpr Time kEvery = Time::from_ns(1'000'000'000);  // between rows of statistics

constexpr const char* kRelayExamples = R"(
While it runs it takes lines from standard input: KEY VALUE [to-a|to-b] with a key of a
profile (skein keys relay), outage SECONDS [to-a|to-b], reset, stats. End b is the target,
end a whoever calls. Without a host only programs of this machine may call.

Examples:
  skein relay --listen udpin:14560 --to 127.0.0.1:14550 --set loss=0.1,delay_s=0.2
  skein relay --listen udpin:14560 --to 10.0.0.2:14550 --profile bad.yaml --stats bad.csv
  skein relay --listen tcpin:5770 --to 127.0.0.1:5760 --set rate_bps=57600,delay_s=0.5)";

struct RelayArguments {
  std::string listen, to;
  std::filesystem::path profile, stats;
  std::vector<std::string> overrides;
  double duration = 0;  // [s]; 0: until it is interrupted
  double idle = 60;     // [s]
  std::uint64_t seed = 1;
};

// `loss=0.1,delay_s=0.2`: parts between commas that are in no brackets.
std::vector<std::string> parts_of(const std::vector<std::string>& texts) {
  std::vector<std::string> parts;
  for (const std::string& text : texts) {
    int depth = 0;
    parts.emplace_back();
    for (const char c : text) {
      if (c == '[' || c == '{') ++depth;
      if (c == ']' || c == '}') --depth;
      if (c == ',' && depth == 0)
        parts.emplace_back();
      else
        parts.back() += c;
    }
  }
  return parts;
}

// The target by the protocol of who listens: HOST:PORT, udpout:HOST:PORT, tcp:HOST:PORT.
Result<transport::NetworkPlace> target_of(const std::string& text, bool tcp) {
  const bool has_kind = text.starts_with("udpout:") || text.starts_with("tcp:");
  auto address =
      transport::parse_endpoint(has_kind ? text : (tcp ? "tcp:" : "udpout:") + text);
  if (!address) return address.error();
  if (const auto* client = std::get_if<transport::UdpClient>(&address.value());
      client && !tcp)
    return client->to;
  if (const auto* client = std::get_if<transport::TcpClient>(&address.value());
      client && tcp)
    return client->to;
  return Error{ErrorCode::kBadInput, text, "a relay does not change the protocol.",
               "Listen at udpin for udpout, at tcpin for tcp."};
}

Result<relay::RelayOptions> options_of(const RelayArguments& given) {
  const auto listen = transport::parse_endpoint(given.listen);
  if (!listen) return listen.error();
  relay::RelayOptions options;
  options.listen = listen.value();
  const bool tcp = std::holds_alternative<transport::TcpServer>(options.listen);
  auto to = target_of(given.to, tcp);
  if (!to) return to.error();
  options.to = std::move(to).value();
  const auto profile =
      assemble::load_relay_profile(given.profile, parts_of(given.overrides));
  if (!profile) return profile.error();
  if (tcp) {
    if (auto good = assemble::check_for_streams(profile.value()); !good)
      return good.error();
  }
  options.plan = assemble::plan_of(profile.value());
  options.seed = given.seed;
  options.idle = Time::from_seconds(given.idle);
  return options;
}

// Does what a line asks for; what is wrong with it is said, and nothing changes.
void obey(const std::string& line, bool tcp, relay::Relay& relay) {
  const auto order = assemble::parse_relay_order(line);
  if (!order) return complain("{}\n", order.error().text());
  const RelayOrder& what = order.value();
  switch (what.kind) {
    case RelayOrder::Kind::kChange:
      if (const auto key = assemble::packet_key_of(what.change); tcp && key)
        return complain("{}: a TCP connection would break.\n", *key);
      relay.change(what.directions, what.change);
      break;
    case RelayOrder::Kind::kOutage:
      relay.cut(what.directions, what.length);
      break;
    case RelayOrder::Kind::kReset:
      relay.reset();
      break;
    case RelayOrder::Kind::kStatistics:
      print("{}", relay_table(relay.report()));
      put_out_now("");
      return;
  }
  complain("{:.3f} s: {}\n", relay.now().seconds(), line);
}

// Where orders come from; negative: nowhere. Asked before a socket could take its number.
int input_of_orders() {
  // In the background of a terminal reading fails then, instead of stopping the program.
  std::signal(SIGTTIN, SIG_IGN);
  return ::fcntl(STDIN_FILENO, F_GETFD) < 0 ? -1 : STDIN_FILENO;
}

int relay_command(const RelayArguments& given, const std::atomic<bool>& stop) {
  hmi::LineInput orders(input_of_orders());
  const auto options = options_of(given);
  if (!options) return say_error(options.error());
  const bool tcp = std::holds_alternative<transport::TcpServer>(options.value().listen);
  auto opened = relay::Relay::open(
      options.value(), [](const std::string& news) { complain("{}\n", news); });
  if (!opened) return say_error(opened.error());
  relay::Relay& relay = *opened.value();
  RelayStatisticsFile statistics;
  if (!given.stats.empty()) {
    if (auto good = statistics.open(given.stats); !good) return say_error(good.error());
  }
  complain("waiting at {}\n", relay.place());

  Time next_row = kEvery, written = Time::from_ns(-1);
  while (!stop && (given.duration <= 0 || relay.now().seconds() < given.duration)) {
    relay.run_for(kRelayTurn);
    for (const std::string& line : orders.take()) obey(line, tcp, relay);
    if (relay.now() < next_row) continue;
    next_row += kEvery;
    written = relay.now();
    if (auto good = statistics.write(relay); !good) return say_error(good.error());
  }
  if (relay.now() > written)
    if (auto good = statistics.write(relay); !good) return say_error(good.error());
  print("{}", relay_table(relay.report()));
  return kDone;
}

}  // namespace

Command add_relay(CLI::App& program, const std::atomic<bool>& stop) {
  auto* command = program.add_subcommand(
      "relay", "Stand between two ends of a connection and make it a bad one.");
  const auto given = std::make_shared<RelayArguments>();
  command
      ->add_option("--listen", given->listen,
                   "Where end a calls: udpin:[HOST:]PORT or tcpin:[HOST:]PORT.")
      ->required();
  command->add_option("--to", given->to, "End b by the same protocol: HOST:PORT.")
      ->required();
  command->add_option("--profile", given->profile,
                      "What the connection does over time (YAML).");
  command
      ->add_option("--set", given->overrides,
                   "Changes a key of the profile: loss=0.1,to_b.delay_s=0.2; may be "
                   "repeated.")
      ->take_all()
      ->allow_extra_args(false);
  command->add_option("--seed", given->seed, "Of all random numbers; default 1.")
      ->check(seed_number());
  command->add_option("--for", given->duration, "End after so many seconds.")
      ->check(number_in(0.1, 4e6));
  command->add_option("--stats", given->stats,
                      "A row a second for each session and direction (CSV).");
  command
      ->add_option("--idle", given->idle,
                   "Seconds of silence after which a UDP session ends.")
      ->capture_default_str()
      ->check(number_in(0.1, 86400));
  command->footer(kRelayExamples);
  return {command, [given, &stop] { return relay_command(*given, stop); }};
}

}  // namespace skein::app
