#include "skein/record/content_hash.h"

#include <bit>
#include <cmath>
#include <limits>
#include <span>

namespace skein::record {
namespace {

// First word of each record, so that records of different kinds never look alike.
enum : std::uint64_t {
  kEntity = 1,
  kTruth,
  kEstimate,
  kReading,
  kMessage,
  kPerimeter,
  kEvent,
  kCrossing,
  kObject,
  kDetection,
  kFootprint,
  kRanges,
  kZone,
};

}  // namespace

void ContentHash::put(double number) {
  if (std::isnan(number)) number = std::numeric_limits<double>::quiet_NaN();
  if (number == 0) number = 0;  // -0 counts as 0
  put(std::bit_cast<std::uint64_t>(number));
}

void ContentHash::put(const Vec2& v) {
  put(v.x());
  put(v.y());
}

void ContentHash::put(const Vec3& v) {
  put(v.x());
  put(v.y());
  put(v.z());
}

void ContentHash::put(std::string_view text) {
  put(std::uint64_t{text.size()});
  for (std::size_t i = 0; i < text.size(); i += 8) {
    std::uint64_t word = 0;
    for (std::size_t k = i; k < std::min(i + 8, text.size()); ++k)
      word = word << 8 | static_cast<unsigned char>(text[k]);
    put(word);
  }
}

void ContentHash::put(const NavEstimate& estimate) {
  put(estimate.time);
  put(estimate.p_N);
  put(estimate.v_N);
  put(estimate.heading);
  put(estimate.roll);
  put(estimate.pitch);
  put(estimate.wind_N);
  put(estimate.position_sd);
}

void ContentHash::put(const FireReading& reading) {
  put(reading.time);
  put(reading.aircraft);
  put(reading.point);
  put(reading.point_sd);
  put(reading.inside);
}

void ContentHash::put(const AircraftReport& report) {
  put(report.nav);
  put(report.limits.airspeed);
  put(report.limits.turn_radius);
  put(report.limits.climb_rate);
  put(std::uint64_t{report.task_number});
  put(report.task_done);
  put(report.obeys);
  put(std::uint64_t{report.zone_changes});
}

void ContentHash::put(const ZoneChange& change) {
  put(std::uint64_t{change.number});
  put(change.on);
  put(std::string_view(change.zone.name));
  put(std::uint64_t{change.zone.area.index()});
  if (const auto* disc = std::get_if<Disc>(&change.zone.area)) {
    put(disc->centre);
    put(disc->radius);
  } else {
    put(std::get<geo::Ring>(change.zone.area));
  }
  put(change.zone.floor_msl);
  put(change.zone.ceiling_msl);
  put(change.zone.from);
  put(change.zone.until);
}

void ContentHash::put(const TeamPosition& position) {
  put(position.aircraft);
  put(position.nav);
}

void ContentHash::put(const std::vector<Vec2>& points) {
  put(std::uint64_t{points.size()});
  for (const Vec2& point : points) put(point);
}

void ContentHash::put(const Task& task) {
  put(std::uint64_t{task.number});
  put(std::uint64_t{task.what.index()});
  if (const auto* loiter = std::get_if<Loiter>(&task.what)) put(loiter->centre);
  if (const auto* fly_to = std::get_if<FlyTo>(&task.what)) put(fly_to->point);
  if (const auto* course = std::get_if<FlyCourse>(&task.what)) put(course->course);
  if (const auto* edge = std::get_if<FollowEdge>(&task.what)) {
    put(edge->clockwise);
    put(edge->start);
    put(edge->tangent);
  }
  if (const auto* line = std::get_if<FollowLine>(&task.what)) put(line->points);
  if (const auto* route = std::get_if<FlyRoute>(&task.what)) {
    put(route->points);
    put(static_cast<std::uint64_t>(route->laps));
    for (const EntityId id : route->tell) put(id);
  }
  if (const auto* follow = std::get_if<FollowLeader>(&task.what)) {
    put(follow->leader);
    put(follow->offset);
  }
}

void ContentHash::begin(std::uint64_t kind) {
  buffer_.clear();
  put(kind);
}

void ContentHash::end() {
  hasher_.add(std::as_bytes(std::span(buffer_)));
}

void ContentHash::entity(EntityId id, const std::string& name, const std::string& kind) {
  begin(kEntity);
  put(id);
  put(std::string_view(name));
  put(std::string_view(kind));
  end();
}

void ContentHash::truth(Time time, EntityId id, const VehicleState& state) {
  begin(kTruth);
  put(time);
  put(id);
  put(state.p_N);
  put(state.v_N);
  put(state.airspeed);
  for (double c : {state.q_NB.w(), state.q_NB.x(), state.q_NB.y(), state.q_NB.z()})
    put(c);
  put(state.w_NB_B);
  put(state.energy.charge);
  end();
}

void ContentHash::estimate(EntityId id, const NavEstimate& estimate,
                           const AutopilotStatus& status) {
  begin(kEstimate);
  put(id);
  put(estimate);
  put(status.cross_track);
  put(status.time_error);
  put(static_cast<std::uint64_t>(status.mode));
  put(static_cast<std::uint64_t>(status.trigger));
  put(static_cast<std::uint64_t>(status.reaction));
  put(status.charge);
  put(status.reserve);
  put(status.endurance.has_value());
  put(status.endurance.value_or(0));
  end();
}

void ContentHash::reading(const FireReading& reading) {
  begin(kReading);
  put(reading);
  end();
}

void ContentHash::message(const Message& message, Time arrived, bool lost) {
  begin(kMessage);
  put(message.from);
  put(message.to);
  put(message.number);
  put(message.sent);
  put(static_cast<std::uint64_t>(message.size_bytes));
  put(arrived);
  put(lost);
  put(std::uint64_t{message.content.index()});
  std::visit([this](const auto& content) { put(content); }, message.content);
  end();
}

void ContentHash::perimeter(Time time, const geo::Region& truth, EntityId believer,
                            const BoundaryEstimate& belief) {
  begin(kPerimeter);
  put(time);
  put(believer);
  put(std::uint64_t{truth.size()});
  for (const geo::Ring& ring : truth) {
    put(std::uint64_t{ring.size()});
    for (const Vec2& point : ring) put(point);
  }
  put(belief.time);
  put(std::uint64_t{belief.rings.size()});
  for (const auto& ring : belief.rings) {
    put(std::uint64_t{ring.size()});
    for (const BoundaryPoint& point : ring) {
      put(point.position);
      put(point.normal);
      put(point.sigma);
      put(point.sigma_growth);
      put(point.rate);
    }
  }
  end();
}

void ContentHash::event(const Event& event) {
  begin(kEvent);
  put(event.time);
  put(event.entity);
  put(std::string_view(event.kind));
  put(std::string_view(event.text));
  end();
}

void ContentHash::crossing(const Crossing& crossing) {
  begin(kCrossing);
  put(crossing.time);
  put(crossing.aircraft);
  put(crossing.point);
  put(crossing.track);
  put(crossing.point_sd);
  put(crossing.entered);
  end();
}

void ContentHash::zone(Time time, const ZoneChange& change) {
  begin(kZone);
  put(time);
  put(change);
  end();
}

void ContentHash::object(const GroundObject& object) {
  begin(kObject);
  put(std::uint64_t{object.id});
  put(std::string_view(object.name));
  put(object.position);
  put(object.velocity);
  end();
}

void ContentHash::detection(const Detection& detection) {
  begin(kDetection);
  put(detection.time);
  put(detection.aircraft);
  put(std::uint64_t{detection.sensor});
  put(std::uint64_t{detection.object});
  put(detection.point);
  put(detection.point_sd);
  end();
}

void ContentHash::footprint(const Footprint& footprint) {
  begin(kFootprint);
  put(footprint.time);
  put(footprint.aircraft);
  put(std::uint64_t{footprint.sensor});
  for (const Vec2& corner : footprint.corners) put(corner);
  end();
}

void ContentHash::ranges(const RangeScan& scan) {
  begin(kRanges);
  put(scan.time);
  put(scan.aircraft);
  put(std::uint64_t{scan.sensor});
  put(std::uint64_t{scan.beams.size()});
  for (const RangeSample& beam : scan.beams) {
    put(beam.beam_B);
    put(beam.range);
  }
  end();
}

}  // namespace skein::record
