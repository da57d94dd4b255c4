// SPDX-License-Identifier: Apache-2.0
#include "app/serve/replay_player.h"

#include <algorithm>
#include <chrono>
#include <thread>

namespace skein::serve {
namespace {

constexpr auto kPeriod = std::chrono::milliseconds(20);
// As fast as it can, when it is read from a disk.
constexpr double kFast = 1000;
// Of the next step of a run that stands still [s].
constexpr double kStep = 1;

class ReplayPlayer {
 public:
  ReplayPlayer(record::RecordStream& recorded, hmi::LiveFeed& feed, double speed)
      : recorded_(recorded), feed_(feed), speed_(speed) {}

  // Reading that was interrupted is the end that was asked for.
  Result<void> play(const std::atomic<bool>& stop) {
    auto played = play_until(stop);
    if (!played && played.error().code == ErrorCode::kInterrupted) return {};
    return played;
  }

 private:
  Result<void> play_until(const std::atomic<bool>& stop) {
    if (auto done = go_to(0); !done) return done.error();
    auto last = std::chrono::steady_clock::now();
    while (!stop) {
      std::this_thread::sleep_for(kPeriod);
      for (const hmi::ClientCommand& request : feed_.take_requests())
        if (auto done = obey(request); !done) return done.error();
      const auto now = std::chrono::steady_clock::now();
      const double passed = std::chrono::duration<double>(now - last).count();
      last = now;
      if (!paused_)
        if (auto done = advance(now_ + passed * (speed_ > 0 ? speed_ : kFast)); !done)
          return done.error();
    }
    return {};
  }

  Result<void> obey(const hmi::ClientCommand& request) {
    Result<void> done;
    if (const auto* seek = std::get_if<hmi::SeekRequest>(&request.what)) {
      done = go_to(seek->time);
    } else if (std::holds_alternative<hmi::PreviewQuestion>(request.what)) {
      feed_.reply(request, RequestState::kRefused,
                  "this run is recorded: nothing can be flown in it.");
      return {};
    } else {
      const auto& command = std::get<Command>(request.what);
      if (const auto* pause = std::get_if<PauseCommand>(&command)) {
        paused_ = pause->paused;
      } else if (const auto* speed = std::get_if<SpeedCommand>(&command)) {
        speed_ = speed->factor;
      } else if (const auto* step = std::get_if<StepCommand>(&command)) {
        done = advance(now_ + kStep * step->steps);
      } else {
        feed_.reply(request, RequestState::kRefused,
                    "this run is recorded: nothing of it can be changed.");
        return {};
      }
      feed_.set_clock(paused_, speed_);
    }
    feed_.reply(request, RequestState::kAccepted, "");
    return done;
  }

  // All that had happened by then, anew.
  Result<void> go_to(double time) {
    now_ = std::clamp(time, 0.0, recorded_.end().seconds());
    feed_.restart(Time::from_seconds(now_));
    feed_.set_clock(paused_, speed_);
    if (auto done = recorded_.seek(Time::from_seconds(now_)); !done) return done.error();
    return advance(now_);
  }

  Result<void> advance(double time) {
    now_ = std::min(time, recorded_.end().seconds());
    const Time until = Time::from_seconds(now_);
    auto done = recorded_.advance(
        until, {[this](Time, const Record& record) { feed_.record(record); },
                [this](Time, const MetricSample& sample) { feed_.show(sample); }});
    if (!done) return done;
    return feed_.step_done(until);
  }

  record::RecordStream& recorded_;
  hmi::LiveFeed& feed_;
  double speed_;
  double now_ = 0;
  bool paused_ = false;
};

}  // namespace

Result<void> play_again(record::RecordStream& recorded, hmi::LiveFeed& feed, double speed,
                        const std::atomic<bool>& stop) {
  return ReplayPlayer(recorded, feed, speed).play(stop);
}

}  // namespace skein::serve
