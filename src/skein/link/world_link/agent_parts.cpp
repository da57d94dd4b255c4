// SPDX-License-Identifier: Apache-2.0
#include "skein/link/world_link/agent_parts.h"

#include <algorithm>
#include <array>
#include <string_view>

namespace skein::world_link {
namespace {

// Events that the world makes by itself of the state that it is told.
bool made_in_world(const Event& event) {
  switch (event.kind.kind()) {
    case EventKind::kJoined:
    case EventKind::kLeft:
    case EventKind::kMode:
    case EventKind::kFailsafe:
    case EventKind::kRefused:
    case EventKind::kLanded:
    case EventKind::kTookOff:
    case EventKind::kSensorLost:
    case EventKind::kSensorBack:
    case EventKind::kSensorSwitched:
    case EventKind::kWorldJoined:
    case EventKind::kWorldLost:
    case EventKind::kWorldBack:
    case EventKind::kWorldRestarted:
    case EventKind::kWorldRefused:
    case EventKind::kSeparationLost:
    case EventKind::kSeparationRestored:
    case EventKind::kSeparationNotRestored:
      return true;
    default:
      return false;
  }
}

}  // namespace

void WorldRadio::deliver(Time now, RadioNews& news) {
  arrived_.clear();
  client_.receive(now, arrived_);
  for (Message& message : arrived_) news.ended.push_back({std::move(message)});
}

EventKind ConnectedAgent::event_of(SessionChange::Kind kind) {
  switch (kind) {
    case SessionChange::Kind::kUp:
      return std::exchange(joined_, true) ? EventKind::kWorldBack
                                          : EventKind::kWorldJoined;
    case SessionChange::Kind::kDown:
      return EventKind::kWorldLost;
    case SessionChange::Kind::kRestarted:
      return EventKind::kWorldRestarted;
    case SessionChange::Kind::kRefused:
      break;
  }
  return EventKind::kWorldRefused;
}

void ConnectedAgent::step(const AgentInput& in, AgentOutput& out) {
  agent_->step(in, out);
  if (out.region_of_interest) client_.say(in.now, *out.region_of_interest);
  for (SessionChange& change : client_.take_changes())
    out.events.push_back({in.now, self_, event_of(change.kind), std::move(change.text)});
}

// Of the entity itself; what is of others or of nobody stays here.
struct WorldFeed::Listener {
  WorldFeed& feed;

  RemoteState& state() const {
    return feed.state_ ? *feed.state_ : feed.state_.emplace();
  }
  void operator()(const TruthRecord& record) const {
    if (record.id != feed.self_) return;
    state().truth = record.state;
    state().truth_time = record.time;
  }
  void operator()(const EstimateRecord& record) const {
    if (record.id != feed.self_) return;
    state().nav = record.nav;
    state().status = record.status;
    state().refused = record.status.refused;
    state().status.refused = state().status.held = {};
  }
  void operator()(const Event& event) const {
    if (event.entity != feed.self_) return;
    if (event.kind == EventKind::kAccident) state().lost = true;
    if (!made_in_world(event)) feed.said_.emplace_back(event);
  }
  void operator()(const FireReading& reading) const { feed.said_.emplace_back(reading); }
  void operator()(const Crossing& crossing) const { feed.said_.emplace_back(crossing); }
  void operator()(const PluginRecord& record) const { feed.said_.emplace_back(record); }
  void operator()(const PlannerRecord& record) const {
    feed.said_.emplace_back(record.value);
  }
  void operator()(const MissionProgressRecord& record) const {
    feed.said_.emplace_back(record.value);
  }
  void operator()(const ConflictRecord& record) const {
    feed.said_.emplace_back(record.value);
  }
  void operator()(const TeamLeadRecord& record) const {
    feed.said_.emplace_back(record.value);
  }
  void operator()(const TeamAllocationRecord& record) const {
    feed.said_.emplace_back(record.value);
  }
  void operator()(const ObjectBeliefRecord& record) const {
    feed.said_.emplace_back(record.value);
  }
  void operator()(const TrafficBeliefRecord& record) const {
    feed.said_.emplace_back(record.value);
  }
  void operator()(const AlertRecord& record) const {
    if (record.id == feed.self_) feed.said_.emplace_back(record.value);
  }
  void operator()(const BandRecord& record) const {
    if (record.id == feed.self_) feed.said_.emplace_back(record.value);
  }
  void operator()(const RecommendationRecord& record) const {
    if (record.id == feed.self_) feed.said_.emplace_back(record.value);
  }
  template <class Other>
  void operator()(const Other&) const {}
};

void WorldFeed::record(const Record& record) {
  std::visit(Listener{*this}, record);
}

Result<void> WorldFeed::step_done(Time time) {
  for (EntitySaying& saying : said_) client_.say(time, std::move(saying));
  said_.clear();
  if (state_) client_.say(time, *state_);
  return {};
}

std::vector<CommandRecord> WorldConsole::commands() {
  std::vector<CommandRecord> all = console_.commands();
  for (Command& command : client_.take_commands())
    all.push_back({Time(), "world", std::move(command)});
  return all;
}

}  // namespace skein::world_link
