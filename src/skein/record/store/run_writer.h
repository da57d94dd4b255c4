// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <functional>
#include <map>
#include <mutex>
#include <optional>
#include <thread>
#include <vector>

#include "skein/data/event/live.h"
#include "skein/record/figures/statistics.h"
#include "skein/record/store/content_hash.h"
#include "skein/record/store/rows.h"
#include "skein/record/store/run_database.h"

namespace skein::record {

/// Takes rows from one thread and writes them to a database on a thread of its own, where
/// records are also counted into the content hash and the statistics.
///
/// Rows gather for a tenth of a second or until there are many; then they are written as
/// one transaction. Transactions that take long are split, so that each is committed
/// within half a second of its rows being given.
class RunWriter {
 public:
  /// @param store_messages  else they are only counted.
  /// @param on_metrics      told of all metrics, by the writer's thread; may be empty.
  RunWriter(RunDatabase database, Time perimeter_period, bool store_messages,
            std::function<void(const MetricSample&)> on_metrics);
  ~RunWriter();

  /// Queues a row. Waits when the queue is full; drops the row after a failure.
  /// @param work  the time that it takes to write, in units of an ordinary row.
  void push(Row row, std::size_t work = 1);

  /// The first failure, if there was one. Fails: what the database said; a Bug that
  /// happened on the writing thread is thrown here.
  Result<void> status();

  /// Writes everything that was given and ends the thread. Returns as status().
  Result<void> finish();

  /// After finish() only.
  const RunStatistics& statistics() const { return statistics_; }
  const ContentHash& hash() const { return hash_; }
  RunDatabase& database() { return database_; }

 private:
  using Clock = std::chrono::steady_clock;

  void work();
  Result<void> write_batch(std::vector<Row>& batch);
  Result<void> write_rest();
  Result<void> commit_if_due();

  Result<void> write(Row& row);
  Result<void> write(Record& record);
  Result<void> write_order(const MessageRecord& record);
  Result<void> write_mission_figures();
  Result<void> write(PerimeterRecord& record);
  Result<void> store(const PerimeterRecord& record);

  // Of the writing thread.
  RunDatabase database_;
  ContentHash hash_;
  RunStatistics statistics_;
  Time perimeter_period_;
  bool store_messages_;
  std::function<void(const MetricSample&)> on_metrics_;
  Clock::time_point transaction_began_;
  std::map<std::uint32_t, Time> truth_stored_;  // of each phenomenon
  std::map<Believer, Time> belief_stored_;
  std::map<Believer, std::optional<PerimeterRecord>> not_stored_;  // newest of each

  // Shared, under the mutex.
  std::mutex mutex_;
  std::condition_variable rows_requested_, room_made_;
  std::vector<Row> pending_;
  std::size_t pending_work_ = 0;
  bool stop_ = false;
  Result<void> failure_;
  std::exception_ptr bug_;
  std::atomic<bool> failed_ = false;  // also read without the mutex

  std::thread thread_;
};

}  // namespace skein::record
