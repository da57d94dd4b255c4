#include "skein/record/run_writer.h"

#include <utility>

#include "skein/base/log.h"

namespace skein::record {
namespace {

// In ordinary rows, of which a second writes over a million: what waits is soon written.
constexpr std::size_t kBatchWork = 1 << 13;
constexpr std::size_t kMaxPending = 2 * kBatchWork;
constexpr auto kGatherFor = std::chrono::milliseconds(100);
constexpr auto kLongestTransaction = std::chrono::milliseconds(200);

}  // namespace

RunWriter::RunWriter(RunDatabase database, Time perimeter_period, bool store_messages)
    : database_(std::move(database)),
      perimeter_period_(perimeter_period),
      store_messages_(store_messages) {
  pending_.reserve(kBatchWork);
  thread_ = std::thread([this] { work(); });
}

RunWriter::~RunWriter() {
  {
    const std::lock_guard lock(mutex_);
    stop_ = true;
  }
  rows_wanted_.notify_one();
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
  if (wake) rows_wanted_.notify_one();
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
  rows_wanted_.notify_one();
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
        rows_wanted_.wait(lock, [this] { return stop_ || !pending_.empty(); });
        rows_wanted_.wait_for(lock, kGatherFor,
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
    auto done = std::visit([this](auto& row) { return write(row); }, batch[i]);
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
  for (const auto& [believer, row] : not_stored_)
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

Result<void> RunWriter::write(const EntityRow& row) {
  statistics_.entity(row.id, row.name, row.kind);
  return database_.write(row);
}

Result<void> RunWriter::write(const TruthRow& row) {
  statistics_.truth(row.time, row.id, row.p_N, row.charge);
  return database_.write(row);
}

Result<void> RunWriter::write(const EstimateRow& row) {
  statistics_.estimate(row.estimate.time, row.id, row.estimate.p_N,
                       row.follows ? std::optional(row.cross_track) : std::nullopt);
  statistics_.reserve(row.id, row.reserve);
  return database_.write(row);
}

Result<void> RunWriter::write(const FireReading& row) {
  statistics_.reading();
  return database_.write(row);
}

Result<void> RunWriter::write(const Crossing& row) {
  statistics_.crossing(row);
  return database_.write(row);
}

Result<void> RunWriter::write(const MessageRow& row) {
  statistics_.message(row.lost);
  return store_messages_ ? database_.write(row) : Result<void>();
}

Result<void> RunWriter::write(const Event& row) {
  statistics_.event(row);
  return database_.write(row);
}

Result<void> RunWriter::write(const Detection& row) {
  statistics_.payload().detection(row);
  return database_.write(row);
}

Result<void> RunWriter::write(const Footprint& row) {
  statistics_.payload().footprint();
  return database_.write(row);
}

Result<void> RunWriter::write(const RangeScan& row) {
  statistics_.payload().ranges();
  return database_.write(row);
}

Result<void> RunWriter::write(std::unique_ptr<GroundObject>& row) {
  statistics_.payload().object(*row);
  return database_.write(*row);
}

Result<void> RunWriter::write(std::unique_ptr<TaskRow>& row) {
  return database_.write(*row);
}

Result<void> RunWriter::write(std::unique_ptr<ZoneRow>& row) {
  return database_.write(*row);
}

Result<void> RunWriter::write(std::unique_ptr<TerrainRow>& row) {
  return database_.write(*row);
}

Result<void> RunWriter::write(std::unique_ptr<PerimeterRow>& row) {
  const TrueBoundary truth(row->truth);
  const PerimeterMetrics metrics =
      statistics_.perimeter(row->time, truth, row->believer, row->belief);
  if (auto done = database_.write_metrics(row->time, row->believer, metrics); !done)
    return done;
  const auto stored = belief_stored_.find(row->believer);
  if (stored == belief_stored_.end() || row->time >= stored->second + perimeter_period_) {
    if (auto done = store(*row); !done) return done;
    not_stored_[row->believer] = nullptr;
  } else {
    not_stored_[row->believer] = std::move(row);
  }
  return commit_if_due();
}

Result<void> RunWriter::store(const PerimeterRow& row) {
  belief_stored_[row.believer] = row.time;
  if (auto done = database_.write_belief(row.time, row.believer, row.belief); !done)
    return done;
  if (truth_stored_ == row.time) return {};  // another believer's, of the same time
  truth_stored_ = row.time;
  return database_.write_truth(row.time, row.truth);
}

}  // namespace skein::record
