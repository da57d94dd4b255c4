// SPDX-License-Identifier: Apache-2.0
#include "skein/campaign/avoidance/avoidance_watch.h"

#include <algorithm>
#include <cmath>

namespace skein::campaign {
namespace {

constexpr std::uint32_t kFirstIntruder = 1U << 30;
constexpr double kCostOfClimb = 0.05;  // as manoeuvres count it [s/m]
constexpr double kReached = 150;       // who passes its goal so near has arrived [m]

}  // namespace

AvoidanceWatch::AvoidanceWatch(const AvoidanceCase& flown, const Separation& separation)
    : wind_(flown.wind), meter_(separation) {
  for (const AvoidanceAircraft& each : flown.aircraft) {
    Flying flying;
    flying.aircraft = each;
    flying_.push_back(flying);
  }
}

void AvoidanceWatch::record(const Record& record) {
  if (const auto* entity = std::get_if<EntityRecord>(&record)) {
    if (entity->kind == "aircraft" && named_ < flying_.size()) {
      indices_[entity->id] = named_;
      flying_[named_++].name = entity->name;
    }
  } else if (const auto* truth = std::get_if<TruthRecord>(&record)) {
    take(*truth);
  } else if (const auto* message = std::get_if<MessageRecord>(&record)) {
    take(*message);
  } else if (const auto* conflict = std::get_if<ConflictRecord>(&record)) {
    take(*conflict);
  } else if (const auto* motion = std::get_if<TrafficMotion>(&record)) {
    traffic_[motion->traffic].add(*motion);
  }
}

// Intruders are to the meter as aircraft with numbers that no entity has.
void AvoidanceWatch::place_traffic(Time time) {
  if (time == traffic_placed_) return;
  traffic_placed_ = time;
  for (const auto& [id, path] : traffic_)
    if (const TrafficMotion* motion = path.at(time))
      meter_.place(time, EntityId{kFirstIntruder + id}, motion->at(time));
}

void AvoidanceWatch::take(const TruthRecord& truth) {
  const auto found = indices_.find(truth.id);
  if (found == indices_.end()) return;
  Flying& flying = flying_[found->second];
  if (flying.arrived >= 0) return;
  if (arrives(flying, truth.time, truth.state.p_N)) {
    commands_.push_back({Time(), "study", RemoveCommand{flying.name}});
    return;
  }
  place_traffic(truth.time);
  meter_.place(truth.time, truth.id, truth.state.p_N, truth.state.on_ground);
}

// Whether it has passed abeam of its goal, close to it.
bool AvoidanceWatch::arrives(Flying& flying, Time time, const Vec3& p_N) {
  const Vec2 goal = flying.aircraft.goal.head<2>();
  const Vec2 along = (goal - flying.aircraft.start.head<2>()).normalized();
  const double before = (flying.last.head<2>() - goal).dot(along);
  const double now = (p_N.head<2>() - goal).dot(along);
  const bool passes =
      flying.seen && before < 0 && now >= 0 && (p_N.head<2>() - goal).norm() < kReached;
  if (passes) {
    const double share = -before / (now - before);
    flying.arrived = flying.last_time.seconds() +
                     share * (time.seconds() - flying.last_time.seconds());
  }
  if (flying.seen) flying.climbed += std::abs(p_N.z() - flying.last.z());
  flying.seen = true;
  flying.last = p_N;
  flying.last_time = time;
  return passes;
}

void AvoidanceWatch::take(const MessageRecord& record) {
  const Message& message = record.message;
  // What goes to everyone is one message on the air.
  if (!said_.insert({message.from.value, message.sent, message.content.index()}).second)
    return;
  if (!indices_.contains(message.from) ||
      std::holds_alternative<AircraftReport>(message.content))
    return;
  messages_ += 1;
  bytes_ += record.size_bytes;
}

void AvoidanceWatch::take(const ConflictRecord& conflict) {
  conflicts_ += 1;
  const ConflictReport& report = conflict.value;
  if (report.method == SeparationMethod::kNegotiated) deals_ += 0.5;
  if (report.method == SeparationMethod::kNone) return;
  // Seen so late that it could not have been fixed earlier, it does not count.
  least_fixed_ = std::min(least_fixed_, report.fixed_before);
}

std::vector<CommandRecord> AvoidanceWatch::commands() {
  return std::exchange(commands_, {});
}

void AvoidanceWatch::add_figures(std::map<std::string, double>& figures) {
  meter_.finish();
  double arrived = 0, extra = 0, percent = 0, worst = 0, worst_time = 0, cost = 0;
  for (const Flying& flying : flying_) {
    if (flying.arrived < 0) continue;
    const double nominal = undisturbed_time(flying.aircraft, wind_);
    arrived += 1;
    extra += flying.arrived - nominal;
    percent += 100 * (flying.arrived - nominal) / nominal;
    worst = std::max(worst, 100 * (flying.arrived - nominal) / nominal);
    worst_time = std::max(worst_time, flying.arrived - nominal);
    const double needed = std::abs(flying.aircraft.goal.z() - flying.aircraft.start.z());
    cost += std::abs(flying.arrived - nominal) +
            kCostOfClimb * std::max(0.0, flying.climbed - needed);
  }
  figures["min_ratio"] = meter_.min_ratio();
  figures["min_horizontal_m"] = meter_.min_horizontal();
  figures["violations"] = static_cast<double>(meter_.violations());
  figures["nmac"] = static_cast<double>(meter_.near_collisions());
  figures["lowc"] = static_cast<double>(meter_.well_clear_lost());
  figures["arrived"] = arrived;
  if (arrived > 0) {
    figures["extra_time_s"] = extra / arrived;
    figures["extra_percent"] = percent / arrived;
    figures["worst_extra_percent"] = worst;
    figures["worst_extra_time_s"] = worst_time;
    figures["cost_s"] = cost / arrived;
  }
  figures["avoidance_messages"] = messages_;
  figures["avoidance_bytes"] = bytes_;
  figures["conflicts"] = conflicts_;
  figures["deals"] = deals_;
  if (least_fixed_ < 1e9) figures["least_fixed_before_s"] = least_fixed_;
}

}  // namespace skein::campaign
