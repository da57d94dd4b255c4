// SPDX-License-Identifier: Apache-2.0
#include "skein/record/store/read_radio.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include "skein/record/figures/radio_sums.h"
#include "skein/record/store/record_table.h"

namespace skein::record {
namespace {

constexpr std::size_t kMaxKinds = 1000;  // of messages
constexpr std::int64_t kMaxHops = 1'000'000;

std::optional<LossCause> loss_cause(const std::string& name) {
  constexpr auto kNames = names_of(static_cast<const LossCause*>(nullptr));
  const auto found = std::find(kNames.begin(), kNames.end(), name);
  if (found == kNames.end()) return std::nullopt;
  return static_cast<LossCause>(found - kNames.begin());
}

// Bands as their column has them: from and to have units in their names.
Result<void> read_messages(Sqlite& database, RadioStatistics& statistics,
                           StoredRun& run) {
  run.message_bin = std::max(10.0, std::ceil(run.duration / 120 / 10) * 10);
  const double needed = std::max(1.0, std::ceil(run.duration / run.message_bin));
  const auto bins = static_cast<std::size_t>(needed);
  run.messages_sent.assign(bins, 0);
  run.messages_lost.assign(bins, 0);
  auto done = for_each_row_of(
      database, "messages",
      "sent_s, cause, hops, forged, copy, size_bytes, CASE content_kind WHEN 'team' THEN "
      "said ELSE content_kind END, from_id",
      "", [&](const Statement& row) {
        const double bin = std::max(0.0, row.seconds(1) / run.message_bin);
        const std::size_t k = std::min(static_cast<std::size_t>(bin), bins - 1);
        const bool forged = row.integer(4) != 0;
        if (!forged) ++run.messages_sent[k];
        const bool copy = row.integer(5) != 0;
        const std::string kind = row.text(7);
        if (!forged && !copy) {
          if (!run.messages_bytes.contains(kind) &&
              run.messages_bytes.size() >= kMaxKinds) {
            row.refuse(7, "a kind of message");
            return;
          }
          auto& bytes = run.messages_bytes.try_emplace(kind, bins).first->second;
          bytes[k] += row.real(6);
        }
        const auto cause = loss_cause(row.text(2));
        if (!cause) {
          row.refuse(2, "the cause of a loss");
          return;
        }
        const bool lost = *cause != LossCause::kNone && *cause != LossCause::kPending;
        if (lost && !forged) ++run.messages_lost[k];
        const auto hops = static_cast<std::uint32_t>(row.whole(3, 0, kMaxHops));
        statistics.message({entity_id(row, 8), kind, copy, *cause, hops, forged});
      });
  return done;
}

}  // namespace

Result<void> read_radio(Sqlite& database, RadioStatistics& statistics, StoredRun& run) {
  if (auto done = read_messages(database, statistics, run); !done) return done;
  RadioSums sums;
  auto done = for_each_record<RadioUseRecord>(database, "ORDER BY time_s, entity_id",
                                              [&](const RadioUseRecord& record) {
                                                statistics.radio(record);
                                                sums.add(record);
                                              });
  if (!done) return done;
  done = for_each_record<LinkUseRecord>(
      database, "", [&](const LinkUseRecord& record) { sums.add(record.use); });
  if (done) sums.finish(run);
  return done;
}

}  // namespace skein::record
