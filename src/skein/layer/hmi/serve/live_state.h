// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <compare>
#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "skein/data/event/live.h"

namespace skein::hmi {

/// What stands for a record's subject: a later record with the same key replaces it.
struct RecordKey {
  std::size_t kind = 0;  ///< the place of its alternative in Record
  std::uint64_t a = 0, b = 0;
  std::string name = {};
  auto operator<=>(const RecordKey&) const = default;
};

/// The key of a record that says how something is from now on; nothing for one that says
/// what has happened.
std::optional<RecordKey> key_of(const Record& record);

/// Whether a record is shown to those who watch: not the motions of vehicles, which go
/// as frames, nor messages but orders.
bool is_streamed(const Record& record);

/// The same without what only the truth knows; nothing: all of it is the truth.
std::optional<Record> without_truth(const Record& record);

/// What somebody who comes late needs to know of a run: how everything is, and the last
/// of what has happened. Grows with entities, not with time: of subjects that come again
/// and again (tasks of a team, tracks, zones) those are kept that were heard of last.
class LiveState {
 public:
  /// Subjects of one kind of record that are kept at most.
  static constexpr std::size_t kMaxSubjects = 20'000;
  /// Entities, objects and traffic that are kept at most.
  static constexpr std::size_t kMaxThings = 100'000;

  void take(const Record& record);
  /// Records that are kept.
  std::size_t size() const;

  Time now() const { return now_; }
  FleetFrame fleet() const;
  TruthFrame truth() const;

  /// Calls `visit(const Record&)` for each record that is kept: what there is first, then
  /// how it is, then what has happened, in order.
  template <class Visit>
  void for_each(Visit&& visit) const {
    for (const Record& record : things_) visit(record);
    for (const auto& [key, current] : current_) visit(current.record);
    for (const auto& [kind, records] : recent_)
      for (const Record& record : records) visit(record);
  }

 private:
  struct Seen {
    EstimateRecord estimate;
    std::optional<TruePlace> truth;
    std::optional<Time> heard;  // by a ground station
    std::uint32_t task_number = 0;
    TaskState task_state = TaskState::kNone;
    double task_share = 0;
    std::optional<double> task_time_to_go;
    bool known = false;
  };
  struct Current {
    Record record;
    std::uint64_t heard = 0;  // order of what was taken
  };
  Seen& seen(EntityId id);
  void keep(RecordKey key, const Record& record);
  void drop_oldest(std::size_t kind);
  void take_message(const MessageRecord& message);

  Time now_;
  std::vector<Record> things_;  // entities, objects, traffic
  std::set<EntityId> stations_;
  std::map<RecordKey, Current> current_;
  std::map<std::size_t, std::size_t> subjects_;  // of current_, by kind
  std::uint64_t heard_ = 0;
  std::map<std::size_t, std::deque<Record>> recent_;  // by kind
  std::vector<Seen> seen_;                            // by number
};

}  // namespace skein::hmi
