// SPDX-License-Identifier: Apache-2.0
#include "app/serve/record_thinner.h"

#include <algorithm>

#include "skein/data/describe/wire.h"

namespace skein::serve {
namespace {

// Room of a kind in a page [bytes of the wire form]; rounded places compress to a third
// of that or less.
constexpr std::size_t kRoom = 400'000;
constexpr std::size_t kMuchRoom = 1'200'000;
// Subjects that are so many that even one record of each is too much are not thinned on.
constexpr double kLongest = 1e6;  // [s]

// The room of a record's kind; nothing: all of them stay.
struct RoomFinder {
  using Room = std::optional<std::size_t>;

  Room operator()(const PerimeterRecord&) const { return kMuchRoom; }
  Room operator()(const ForecastRecord&) const { return kMuchRoom; }
  Room operator()(const TrafficMotion&) const { return kMuchRoom; }
  Room operator()(const TrafficBeliefRecord&) const { return kMuchRoom; }
  Room operator()(const EntityRecord&) const { return {}; }
  Room operator()(const GroundObject&) const { return {}; }
  Room operator()(const AirTraffic&) const { return {}; }
  Room operator()(const ZoneRecord&) const { return {}; }
  Room operator()(const MissionRecord&) const { return {}; }
  Room operator()(const MessageRecord&) const { return {}; }
  Room operator()(const RecommendationRecord&) const { return {}; }
  Room operator()(const AlertRecord& r) const {
    if (r.value.level == 0) return {};
    return kRoom;
  }
  template <class Other>
  Room operator()(const Other&) const {
    return kRoom;
  }
};

// What happens again and again happens to somebody.
struct SubjectFinder {
  hmi::RecordKey operator()(const FireReading& r) const { return key(r.aircraft.value); }
  hmi::RecordKey operator()(const Crossing& r) const { return key(r.aircraft.value); }
  hmi::RecordKey operator()(const Detection& r) const {
    return key(r.aircraft.value, r.object);
  }
  hmi::RecordKey operator()(const Event& r) const {
    return key(r.entity.value, 0, std::string(r.kind.name()));
  }
  template <class Other>
  hmi::RecordKey operator()(const Other&) const {
    return key(0);
  }
  hmi::RecordKey key(std::uint64_t a, std::uint64_t b = 0, std::string name = {}) const {
    return {kind, a, b, std::move(name)};
  }
  std::size_t kind;
};

hmi::RecordKey subject_of(const Record& record) {
  if (auto key = hmi::key_of(record)) return *std::move(key);
  return std::visit(SubjectFinder{record.index()}, record);
}

}  // namespace

void RecordThinner::take(Time time, Record record) {
  const auto room = std::visit(RoomFinder{}, record);
  Candidate candidate{++count_, time, {}, 0, std::move(record)};
  if (!room) {
    all_stay_.push_back(std::move(candidate));
    return;
  }
  candidate.subject = subject_of(candidate.record);
  candidate.bytes = wire::coded_size(candidate.record);
  Kind& kind = kinds_[candidate.record.index()];
  keep_or_leave_out(kind, std::move(candidate));
  while (static_cast<double>(kind.bytes) > share_ * static_cast<double>(*room) &&
         kind.spacing.seconds() < kLongest)
    thin(kind);
}

void RecordThinner::keep_or_leave_out(Kind& kind, Candidate candidate) {
  const auto last = kind.last.find(candidate.subject);
  if (last != kind.last.end() && candidate.time - last->second < kind.spacing) {
    hmi::RecordKey subject = candidate.subject;
    kind.left_out.insert_or_assign(std::move(subject), std::move(candidate));
    return;
  }
  kind.last.insert_or_assign(candidate.subject, candidate.time);
  kind.bytes += candidate.bytes;
  kind.kept.push_back(std::move(candidate));
}

void RecordThinner::thin(Kind& kind) {
  kind.spacing = kind.spacing > Time() ? kind.spacing * 2 : Time::from_seconds(1);
  std::vector<Candidate> before = std::exchange(kind.kept, {});
  auto left_out = std::exchange(kind.left_out, {});
  kind.last.clear();
  kind.bytes = 0;
  for (Candidate& each : before) keep_or_leave_out(kind, std::move(each));
  for (auto& [subject, each] : left_out) {
    Candidate& newest = kind.left_out.try_emplace(subject, each).first->second;
    if (newest.number < each.number) newest = std::move(each);
  }
}

std::vector<RecordThinner::Kept> RecordThinner::finish() {
  std::vector<Candidate> all = std::move(all_stay_);
  for (auto& [index, kind] : kinds_) {
    for (Candidate& each : kind.kept) all.push_back(std::move(each));
    for (auto& [subject, each] : kind.left_out)
      if (each.time > kind.last.at(subject)) all.push_back(std::move(each));
  }
  std::sort(all.begin(), all.end(),
            [](const Candidate& a, const Candidate& b) { return a.number < b.number; });
  std::vector<Kept> out;
  out.reserve(all.size());
  for (Candidate& each : all) out.push_back({each.time, std::move(each.record)});
  return out;
}

Time RecordThinner::spacing(const Record& like) const {
  const auto kind = kinds_.find(like.index());
  return kind == kinds_.end() ? Time() : kind->second.spacing;
}

}  // namespace skein::serve
