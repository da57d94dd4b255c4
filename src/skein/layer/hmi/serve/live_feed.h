// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <deque>
#include <functional>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "skein/layer/hmi/serve/fire_state.h"
#include "skein/layer/hmi/serve/live_hub.h"
#include "skein/layer/hmi/serve/live_state.h"
#include "skein/role/operator_console.h"
#include "skein/role/recorder.h"

namespace skein::hmi {

/// A task that somebody thinks of giving, and how things are.
struct PreviewOrder {
  std::string aircraft;
  TaskKind what;
  Time time;
  VehicleView now;                       ///< of the aircraft
  std::vector<Zone> zones;               ///< in force
  std::optional<WindCommand> wind = {};  ///< that was commanded last
  /// Height and speed that were commanded for the aircraft.
  std::optional<FlightChangeCommand> flight = {};
};

/// Finds out what an aircraft would do, and answers by LiveHub::reply().
using Previewer = std::function<void(ClientNumber, std::uint32_t number, PreviewOrder)>;

/// What the feed keeps, in numbers of things.
struct FeedSizes {
  std::size_t state_records = 0;    ///< that a newcomer receives
  std::size_t waiting_records = 0;  ///< until the next publication
  std::size_t metric_samples = 0;
};

/// Tells those who watch what a run records, some ten times a second of wall time, and
/// them alone: nothing of what is simulated depends on it.
///
/// Called by the thread of the run. While nobody watches it only keeps the state.
class LiveFeed final : public Recorder {
 public:
  using Moment = std::chrono::steady_clock::time_point;

  /// @param hub       outlives it.
  /// @param duration  of the run.
  /// @param speed     that was asked for; 0: as fast as it can.
  /// @param recorded  the run is only shown again: what steered its clock does not now.
  LiveFeed(LiveHub& hub, Time duration, double speed, bool recorded = false);

  /// Without, nothing is flown ahead. Before anybody watches.
  void set_previewer(Previewer previewer) { previewer_ = std::move(previewer); }

  void record(const Record& record) override;
  Result<void> step_done(Time time) override;

  /// How far the run is.
  void show(const RunProgress& progress);
  /// Metrics of the run, by the truth. By any thread.
  void show(const MetricSample& sample);

  /// What clients have asked for since the last call; their fate is told to them. Other
  /// requests of theirs are refused.
  std::vector<CommandRecord> take_commands();

  /// The same as they are, for a run that is shown again; each is to be answered.
  std::vector<ClientCommand> take_requests();
  void reply(const ClientCommand& request, RequestState state, const std::string& text);

  /// Tells what has gathered, when it is time.
  void pump();

  /// What is believed of fires. By any thread.
  const FireState& fire() const { return fire_; }

  /// How far the run was when it was told last. By any thread.
  RunClock clock() const;
  /// What was kept then. By any thread.
  FeedSizes sizes() const;

  /// Of a run that is shown again: how its clock goes.
  void set_clock(bool paused, double wanted_speed);
  /// Forgets everything: what had happened by another time of a run that is shown again
  /// comes.
  void restart(Time at);

  /// The run is over: tells that, and what is left.
  void finish();

 private:
  struct Request {
    ClientNumber client = 0;
    std::uint32_t number = 0;
    std::string about;  // the aircraft of a task, "zone" of a zone; else empty
    Time given;
  };

  void publish();
  void take_metrics();
  void measure_speed(Moment now);
  SharedBytes batch(bool with_truth, bool state) const;
  void add(LiveItem item);
  void preview(const ClientCommand& asked, const TaskCommand& task);
  bool is_aircraft(const std::string& name) const;
  void take_given(const CommandRecord& given);
  void settle(RequestState state, const std::string& text = {});
  void take_fate(const Event& event);

  LiveHub& hub_;
  bool recorded_;
  LiveState state_;
  FireState fire_;
  std::vector<LiveItem> items_;
  std::deque<MetricSample> metrics_;
  mutable std::mutex lock_;
  std::vector<MetricSample> new_metrics_;  // under the lock
  RunClock reported_clock_;                // under the lock
  FeedSizes reported_sizes_;               // under the lock
  RunClock clock_;
  Moment next_{};
  Moment measured_at_{};  // where the measured speed counts from
  Time measured_from_;
  std::map<EntityId, std::string> names_;
  Previewer previewer_;
  std::optional<WindCommand> wind_;                     // commanded last
  std::map<std::string, FlightChangeCommand> flights_;  // by aircraft
  std::deque<Request> awaited_;     // given to the run, not obeyed yet
  std::optional<Request> current_;  // being obeyed
  std::deque<Request> obeyed_;  // that may still be refused by those whom they concern
};

/// An operator's console to which those who watch a run add their commands.
class LiveConsole final : public OperatorConsole {
 public:
  /// Both outlive it.
  LiveConsole(OperatorConsole& console, LiveFeed& feed)
      : console_(console), feed_(feed) {}

  void show(const RunProgress& progress) override {
    console_.show(progress);
    feed_.show(progress);
  }
  void announce(const Event& event, std::string_view who) override {
    console_.announce(event, who);
  }
  bool stop_requested() const override { return console_.stop_requested(); }
  std::vector<CommandRecord> commands() override {
    std::vector<CommandRecord> all = console_.commands();
    for (CommandRecord& each : feed_.take_commands()) all.push_back(std::move(each));
    return all;
  }

 private:
  OperatorConsole& console_;
  LiveFeed& feed_;
};

}  // namespace skein::hmi
