// SPDX-License-Identifier: Apache-2.0
// MAVLink handed on between sockets and serial lines, and recorded.
#include <fmt/format.h>

#include <chrono>
#include <optional>

#include "app/common/commands.h"
#include "app/common/common.h"
#include "app/common/output.h"
#include "skein/link/router/forwarder.h"

namespace skein::app {
namespace {

using Clock = std::chrono::steady_clock;
using router::ChannelHealth;
using router::Forwarder;

constexpr std::chrono::milliseconds kTurn{100};  // between looks for an interrupt

std::int64_t unix_us() {
  return std::chrono::duration_cast<std::chrono::microseconds>(
             std::chrono::system_clock::now().time_since_epoch())
      .count();
}

std::string systems_text(const ChannelHealth& health) {
  std::string text;
  for (const std::uint8_t system : health.systems)
    text += fmt::format("{}{}", text.empty() ? "" : ",", system);
  return text.empty() ? "-" : text;
}

void print_health(const Forwarder& forwarder) {
  print("{:>9} {:>7} {:>7} {:>9} {:>7}  {:<12} {}\n", "in", "lost", "bad", "out",
        "dropped", "systems", "link");
  for (const ChannelHealth& health : forwarder.health())
    print("{:>9} {:>6.1f}% {:>7} {:>9} {:>7}  {:<12} {}{}\n", health.in.frames,
          100 * health.loss, health.in.bad_crc, health.out, health.dropped,
          systems_text(health), health.name, health.open ? "" : " (closed)");
  put_out_now("");
}

Result<void> open_all(const LinkArguments& arguments, Forwarder& forwarder) {
  for (const std::string& text : arguments.endpoints) {
    const auto address = transport::parse_endpoint(text);
    if (!address) return address.error();
    if (auto opened = forwarder.endpoints().open(address.value()); !opened)
      return opened.error();
  }
  if (arguments.tlog.empty()) return {};
  // A pipe or a device takes it as it comes.
  if (std::filesystem::is_regular_file(arguments.tlog) && !arguments.overwrite)
    return Error{ErrorCode::kBadInput, arguments.tlog.string(), "exists already.",
                 "Give another name, or --overwrite."};
  auto tlog = mavlink::TlogWriter::create(arguments.tlog);
  if (!tlog) return tlog.error();
  forwarder.record_to(std::move(tlog.value()));
  return {};
}

std::chrono::duration<double> seconds(double value) {
  return std::chrono::duration<double>(value);
}

}  // namespace

int link_command(const LinkArguments& arguments, const std::atomic<bool>& stop) {
  Forwarder forwarder(unix_us, [](const std::string& news) { complain("{}\n", news); });
  forwarder.hand_on_unsigned_orders(arguments.unsigned_orders);
  if (const auto opened = open_all(arguments, forwarder); !opened)
    return say_error(opened.error());
  for (const std::string& place : forwarder.endpoints().places())
    complain("waiting at {}\n", place);

  const Clock::time_point begin = Clock::now();
  Clock::time_point shown = begin;
  const auto ended = [&] {
    return arguments.duration > 0 && Clock::now() - begin >= seconds(arguments.duration);
  };
  while (!stop && !ended()) {
    forwarder.endpoints().run_for(kTurn);
    if (Clock::now() - shown < seconds(arguments.every)) continue;
    shown = Clock::now();
    print_health(forwarder);
    if (const auto flushed = forwarder.flush(); !flushed)
      return say_error(flushed.error());
  }
  print_health(forwarder);
  if (forwarder.refused_orders() > 0)
    print("commands without a signature that were not handed on: {}\n",
          forwarder.refused_orders());
  if (const auto flushed = forwarder.flush(); !flushed) return say_error(flushed.error());
  return kDone;
}

}  // namespace skein::app
