// SPDX-License-Identifier: Apache-2.0
#include "app/relay/relay_statistics.h"

#include <fmt/format.h>

namespace skein::app {
namespace {

using impairment::Direction;
using impairment::kDirections;

const char* direction_name(Direction direction) {
  return direction == Direction::kToB ? "to-b" : "to-a";
}

std::string csv_rows(double time, const relay::SessionReport& session) {
  std::string rows;
  for (const Direction direction : kDirections) {
    const relay::DirectionReport& all = session.directions[index_of(direction)];
    const impairment::ChannelCounts& counts = all.counts;
    rows += fmt::format(
        "{:.3f},{},{},{},{},{},{},{},{},{},{},{},{},{:.6f},{:.6f},{},{},{},{},{}\n", time,
        session.number, session.name, direction_name(direction), counts.packets_in,
        counts.bytes_in, counts.packets_out, counts.bytes_out, counts.lost_by_chance,
        counts.lost_queue_full, counts.lost_in_outage, counts.duplicated,
        counts.reordered, counts.delay_mean(), counts.delay_max.seconds(),
        all.waiting_packets, all.waiting_bytes, all.under_way, all.refused, all.unsent);
  }
  return rows;
}

}  // namespace

std::string relay_table(const relay::RelayReport& report) {
  std::string text = fmt::format(
      "{:<5} {:>9} {:>11} {:>9} {:>11} {:>8} {:>8} {:>8} {:>8} {:>9} {:>10} {:>9} {:>8} "
      "{:>8} {:>8}\n",
      "", "in", "bytes", "out", "bytes", "lost", "full", "outage", "doubled", "reordered",
      "delay[ms]", "max[ms]", "waiting", "refused", "unsent");
  for (const Direction direction : kDirections) {
    const relay::DirectionReport& all = report.directions[index_of(direction)];
    const impairment::ChannelCounts& counts = all.counts;
    text += fmt::format(
        "{:<5} {:>9} {:>11} {:>9} {:>11} {:>8} {:>8} {:>8} {:>8} {:>9} {:>10.1f} "
        "{:>9.1f} {:>8} {:>8} {:>8}\n",
        direction_name(direction), counts.packets_in, counts.bytes_in, counts.packets_out,
        counts.bytes_out, counts.lost_by_chance, counts.lost_queue_full,
        counts.lost_in_outage, counts.duplicated, counts.reordered,
        1e3 * counts.delay_mean(), 1e3 * counts.delay_max.seconds(),
        all.waiting_packets + all.under_way, all.refused, all.unsent);
  }
  text += fmt::format("{} sessions, {} open", report.sessions, report.open);
  if (report.failed > 0)
    text += fmt::format(", {} that the target did not take", report.failed);
  if (report.turned_away > 0) text += fmt::format(", {} turned away", report.turned_away);
  return text + "\n";
}

Result<void> RelayStatisticsFile::open(const std::filesystem::path& file) {
  auto opened = OutputStream::open(file);
  if (!opened) return opened.error();
  out_ = std::move(opened).value();
  out_.write(
      "time_s,session,client,direction,packets_in,bytes_in,packets_out,bytes_out,"
      "lost,queue_full,outage,duplicated,reordered,delay_mean_s,delay_max_s,"
      "waiting_packets,waiting_bytes,under_way,refused,unsent\n");
  return out_.flush();
}

Result<void> RelayStatisticsFile::write(relay::Relay& relay) {
  if (!out_.is_open()) return {};
  const double time = relay.now().seconds();
  for (const relay::SessionReport& session : relay.take_ended())
    out_.write(csv_rows(time, session));
  for (const relay::SessionReport& session : relay.sessions())
    out_.write(csv_rows(time, session));
  return out_.flush();
}

}  // namespace skein::app
