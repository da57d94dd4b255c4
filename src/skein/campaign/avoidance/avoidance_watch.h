// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <set>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "skein/campaign/avoidance/avoidance_study.h"
#include "skein/record/figures/separation_meter.h"
#include "skein/record/figures/traffic_path.h"
#include "skein/role/operator_console.h"
#include "skein/role/recorder.h"

namespace skein::campaign {

/// Watches a run of a case: how near aircraft come by the truth, when each arrives, what
/// is said. Who has arrived is taken out of the run.
class AvoidanceWatch final : public Recorder, public OperatorConsole {
 public:
  /// The aircraft of the case are those of the run, in their order.
  AvoidanceWatch(const AvoidanceCase& flown, const Separation& separation);

  void record(const Record& record) override;

  void show(const RunProgress&) override {}
  bool stop_requested() const override { return false; }
  std::vector<CommandRecord> commands() override;

  /// Adds what avoidance_csv() prints.
  void add_figures(std::map<std::string, double>& figures);

 private:
  struct Flying {
    AvoidanceAircraft aircraft;
    std::string name;
    Vec3 last = Vec3::Zero();
    Time last_time;
    double arrived = -1;  // [s]
    double climbed = 0;   // up and down [m]
    bool seen = false;
  };
  void take(const TruthRecord& truth);
  void place_traffic(Time time);
  void take(const MessageRecord& message);
  void take(const ConflictRecord& conflict);
  bool arrives(Flying& flying, Time time, const Vec3& p_N);

  Vec2 wind_;
  record::SeparationMeter meter_;
  std::vector<Flying> flying_;
  std::map<EntityId, std::size_t> indices_;  // of flying_
  std::size_t named_ = 0;                    // entities so far
  std::map<std::uint32_t, record::TrafficPath> traffic_;
  Time traffic_placed_;
  std::vector<CommandRecord> commands_;
  std::set<std::tuple<std::uint32_t, Time, std::size_t>> said_;  // sender, when, what
  double messages_ = 0, bytes_ = 0, conflicts_ = 0, deals_ = 0;
  double least_fixed_ = 1e9;
};

}  // namespace skein::campaign
