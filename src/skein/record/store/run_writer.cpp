// SPDX-License-Identifier: Apache-2.0
#include "skein/record/store/run_writer.h"

#include <utility>

#include "skein/base/log.h"

namespace skein::record {
namespace {

// In ordinary rows, of which a second writes over a million: what waits is soon written.
constexpr std::size_t kBatchWork = 1 << 13;
constexpr std::size_t kMaxPending = 2 * kBatchWork;
constexpr auto kGatherFor = std::chrono::milliseconds(100);
constexpr auto kLongestTransaction = std::chrono::milliseconds(200);

// What is known of them.
MetricSample sample_of(Time time, const std::string& mission,
                       const PerimeterMetrics& metrics) {
  MetricSample sample{time, mission, {}};
  for (const MetricField& field : metric_fields())
    if (const auto& value = metrics.*field.value)
      sample.values.push_back(
          {std::string(field.name) + std::string(field.unit), *value});
  return sample;
}

}  // namespace

RunWriter::RunWriter(RunDatabase database, Time perimeter_period, bool store_messages,
                     std::function<void(const MetricSample&)> on_metrics)
    : database_(std::move(database)),
      perimeter_period_(perimeter_period),
      store_messages_(store_messages),
      on_metrics_(std::move(on_metrics)) {
  pending_.reserve(kBatchWork);
  thread_ = std::thread([this] { work(); });
}

RunWriter::~RunWriter() {
  {
    const std::lock_guard lock(mutex_);
    stop_ = true;
  }
  rows_requested_.notify_one();
  if (thread_.joinable()) thread_.join();
}

void RunWriter::push(Row row, std::size_t work) {
  std::unique_lock lock(mutex_);
  if (pending_work_ >= kMaxPending)
    room_made_.wait(lock, [this] { return pending_work_ < kMaxPending || failed_; });
  if (failed_) return;
  // The writer sleeps until the first row, then until the batch is full or old enough.
  const std::size_t before = std::exchange(pending_work_, pending_work_ + work);
  const bool wake =
      pending_.empty() || (before < kBatchWork && pending_work_ >= kBatchWork);
  pending_.push_back(std::move(row));
  lock.unlock();
  if (wake) rows_requested_.notify_one();
}

Result<void> RunWriter::status() {
  if (!failed_) return {};
  const std::lock_guard lock(mutex_);
  if (bug_) std::rethrow_exception(bug_);
  return failure_;
}

Result<void> RunWriter::finish() {
  {
    const std::lock_guard lock(mutex_);
    stop_ = true;
  }
  rows_requested_.notify_one();
  if (thread_.joinable()) thread_.join();
  return status();
}

void RunWriter::work() {
  std::vector<Row> batch;
  batch.reserve(kBatchWork);
  const auto fail = [this](Result<void> failure, std::exception_ptr bug) {
    const std::lock_guard lock(mutex_);
    failure_ = std::move(failure);
    bug_ = std::move(bug);
    failed_ = true;
    pending_.clear();
    pending_work_ = 0;
    room_made_.notify_all();
  };
  try {
    while (true) {
      bool last = false;
      {
        std::unique_lock lock(mutex_);
        rows_requested_.wait(lock, [this] { return stop_ || !pending_.empty(); });
        rows_requested_.wait_for(lock, kGatherFor,
                                 [this] { return stop_ || pending_work_ >= kBatchWork; });
        batch.swap(pending_);
        pending_work_ = 0;
        last = stop_;
      }
      room_made_.notify_one();
      Result<void> done = write_batch(batch);
      batch.clear();
      if (done.ok() && last) done = write_rest();
      if (!done) return fail(std::move(done), nullptr);
      if (last) return;
    }
  } catch (...) {
    fail({}, std::current_exception());
  }
}

Result<void> RunWriter::write_batch(std::vector<Row>& batch) {
  if (batch.empty()) return {};
  if (auto done = database_.begin(); !done) return done;
  const auto began = transaction_began_ = Clock::now();
  for (std::size_t i = 0; i < batch.size(); ++i) {
    auto done = write(batch[i]);
    if (done.ok() && i % 256 == 255) done = commit_if_due();
    if (!done) {
      // Keep what this transaction holds, if the failure left it whole.
      static_cast<void>(database_.commit());
      return done;
    }
  }
  auto done = database_.commit();
  log_debug("{} rows written in {:.1f} ms", batch.size(),
            std::chrono::duration<double, std::milli>(Clock::now() - began).count());
  return done;
}

Result<void> RunWriter::write_rest() {
  if (auto done = database_.begin(); !done) return done;
  for (const auto& [who, row] : not_stored_)
    if (row)
      if (auto done = store(*row); !done) return done;
  return database_.commit();
}

Result<void> RunWriter::commit_if_due() {
  const auto now = Clock::now();
  if (now - transaction_began_ < kLongestTransaction) return {};
  transaction_began_ = now;
  if (auto done = database_.commit(); !done) return done;
  return database_.begin();
}

Result<void> RunWriter::write(Row& row) {
  if (auto* terrain = std::get_if<std::unique_ptr<TerrainRow>>(&row))
    return database_.write(**terrain);
  auto& record = std::get<Record>(row);
  hash_.add(record);
  return write(record);
}

Result<void> RunWriter::write(Record& record) {
  if (auto* perimeter = std::get_if<PerimeterRecord>(&record)) return write(*perimeter);
  statistics_.take(record);
  if (const auto* forecast = std::get_if<ForecastRecord>(&record))
    return database_.write_forecast(*forecast);
  const auto* message = std::get_if<MessageRecord>(&record);
  if (message)
    if (auto done = write_order(*message); !done) return done;
  if (auto done = write_mission_figures(); !done) return done;
  return message && !store_messages_ ? Result<void>() : database_.write(record);
}

// Those that have become due.
Result<void> RunWriter::write_mission_figures() {
  for (const MissionFigures& row : statistics_.missions().take_series())
    if (auto done = database_.write(row); !done) return done;
  return {};
}

// The order that a message carries has a table of its own.
Result<void> RunWriter::write_order(const MessageRecord& record) {
  const Message& message = record.message;
  const auto* task = std::get_if<Task>(&message.content);
  if (!task) return {};
  return database_.write(TaskRow{message.sent, record.arrived, message.from, message.to,
                                 *task, record.lost});
}

Result<void> RunWriter::write(PerimeterRecord& record) {
  const TrueBoundary truth(record.truth);
  const Believer who{record.believer, record.mission};
  const PerimeterMetrics metrics = statistics_.perimeter(record, truth);
  for (const ForecastScore& score : statistics_.forecasts().take_scores())
    if (auto done = database_.write(score); !done) return done;
  if (auto done = database_.write_metrics(record.time, who, metrics); !done) return done;
  if (on_metrics_) on_metrics_(sample_of(record.time, record.mission, metrics));
  const auto stored = belief_stored_.find(who);
  if (stored == belief_stored_.end() ||
      record.time >= stored->second + perimeter_period_) {
    if (auto done = store(record); !done) return done;
    not_stored_[who].reset();
  } else {
    not_stored_[who] = std::move(record);
  }
  return commit_if_due();
}

Result<void> RunWriter::store(const PerimeterRecord& record) {
  belief_stored_[{record.believer, record.mission}] = record.time;
  if (auto done = database_.write_belief(record); !done) return done;
  const auto [stored, first] = truth_stored_.try_emplace(record.phenomenon, record.time);
  if (!first && stored->second == record.time) return {};  // by another mission
  stored->second = record.time;
  return database_.write_truth(record.time, record.phenomenon, record.truth);
}

}  // namespace skein::record
