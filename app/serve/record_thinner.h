// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "skein/data/event/record.h"
#include "skein/layer/hmi/serve/live_state.h"

namespace skein::serve {

/// Keeps records within a bounded size, however long their run is.
///
/// A kind that needs more than its room is thinned: of each subject (a mission's belief,
/// an aircraft's readings) records are then at least some time apart, which doubles until
/// they fit. The last of each subject stays. What there is, orders, missions, zones and
/// the ends of alerts all stay.
class RecordThinner {
 public:
  struct Kept {
    Time time;
    Record record;
  };

  /// @param share  of the room of a whole page, above 0, up to 1.
  explicit RecordThinner(double share) : share_(share) {}

  /// In order of time.
  void take(Time time, Record record);

  /// All that is kept, in order of time. Ends the gathering.
  std::vector<Kept> finish();

  /// The time between records of a subject that the kind of a record was given; 0: all
  /// were kept.
  Time spacing(const Record& like) const;

 private:
  struct Candidate {
    std::uint64_t number = 0;  // of all records: those of one time keep their order
    Time time;
    hmi::RecordKey subject;
    std::size_t bytes = 0;
    Record record;
  };
  struct Kind {
    Time spacing;
    std::size_t bytes = 0;
    std::vector<Candidate> kept;
    std::map<hmi::RecordKey, Time> last;
    std::map<hmi::RecordKey, Candidate> left_out;  // the newest of each subject
  };

  void keep_or_leave_out(Kind& kind, Candidate candidate);
  void thin(Kind& kind);

  double share_;
  std::uint64_t count_ = 0;
  std::vector<Candidate> all_stay_;
  std::map<std::size_t, Kind> kinds_;  // by the place of their alternative in Record
};

}  // namespace skein::serve
