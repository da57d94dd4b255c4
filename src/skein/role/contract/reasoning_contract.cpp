// SPDX-License-Identifier: Apache-2.0
// Agents, estimators of the perimeter and monitoring strategies.
#include <cmath>

#include "skein/role/agent.h"
#include "skein/role/contract/checks.h"
#include "skein/role/monitoring_strategy.h"
#include "skein/role/perimeter_estimator.h"

namespace skein::contract {
namespace {

bool command_is_finite(const AutopilotCommand& command) {
  const auto* circle = std::get_if<Circle>(&command.guidance);
  const auto* course = std::get_if<HoldCourse>(&command.guidance);
  const auto* place = std::get_if<HoldPosition>(&command.guidance);
  return std::isfinite(command.altitude_msl) &&
         std::isfinite(command.airspeed.value_or(0)) &&
         (!circle || (circle->centre.allFinite() && std::isfinite(circle->radius))) &&
         (!course || std::isfinite(course->course)) &&
         (!place || place->point.allFinite());
}

// What the team may send at any time.
Message some_message(RandomStream& random, Time now) {
  Message message;
  message.from = EntityId{static_cast<std::uint32_t>(random.uniform() * 3)};
  message.to = EntityId{1};
  message.sent = now;
  message.number = static_cast<std::uint64_t>(now.ns());
  const auto number = static_cast<std::uint32_t>(1 + now.seconds());
  switch (static_cast<int>(random.uniform() * 5)) {
    case 0:
      message.content = FireReading{now, EntityId{1}, place_within(random, 800), 3,
                                    random.uniform() < 0.5};
      break;
    case 1:
      message.content = Task{number, FlyTo{place_within(random, 800)}};
      break;
    case 2:
      message.content = Task{number, FlyCourse{random.uniform(0, 6)}};
      break;
    case 3:
      message.content = TeamPosition{EntityId{2}, {}};
      break;
    default:
      message.content = Heartbeat{};
  }
  return message;
}

// How much of everything an agent has said.
std::vector<std::size_t> amounts(const AgentOutput& out) {
  return {out.outbox.size(), out.events.size(), out.records.size(),
          out.command ? std::size_t{1} : 0};
}

}  // namespace

Violations agent_violations(const Make<Agent>& make, const NavEstimate* nav) {
  constexpr double kStep = 0.5;  // [s]
  Checks checks;
  const auto agent = make(), twin = make();
  RandomStream random = draws(31);
  NavEstimate own = nav != nullptr ? *nav : NavEstimate();
  for (int i = 0; i < 200; ++i) {
    AgentInput in;
    in.now = own.time = Time::from_seconds(kStep * i);
    in.nav = nav != nullptr ? &own : nullptr;
    const std::vector<SensorSample> samples = {
        FireSample{in.now, 0, own.p_N.head<2>().norm() < 500}};
    const std::vector<Message> inbox(i % 3 == 0 ? 1 : 0, some_message(random, in.now));
    if (nav != nullptr) in.samples = samples;
    in.inbox = inbox;
    AgentOutput out, other;
    const EventLabel before = EventLabel::named("before");
    out.events.push_back({in.now, EntityId{7}, before, "said by somebody else"});
    other.events = out.events;
    agent->step(in, out);
    twin->step(in, other);
    checks.expect(!out.events.empty() && out.events.front().kind == before,
                  "step() removes what is in the output already");
    checks.expect(!out.command || nav != nullptr, "it commands, but has no vehicle");
    checks.expect(!out.command || command_is_finite(*out.command),
                  "a command is not finite");
    checks.expect(amounts(out) == amounts(other), "two equal ones do not act alike");
    own.p_N += kStep * own.v_N;
  }
  return checks.take();
}

namespace {

bool same(const BoundaryEstimate& a, const BoundaryEstimate& b) {
  if (a.time != b.time || a.rings.size() != b.rings.size()) return false;
  for (std::size_t r = 0; r < a.rings.size(); ++r) {
    if (a.rings[r].size() != b.rings[r].size()) return false;
    for (std::size_t k = 0; k < a.rings[r].size(); ++k)
      if (a.rings[r][k].position != b.rings[r][k].position ||
          a.rings[r][k].sigma != b.rings[r][k].sigma)
        return false;
  }
  return true;
}

void check_boundary(const BoundaryEstimate& boundary, Time now, Checks& checks) {
  checks.expect(boundary.time == now, "boundary() is not of the time of predict()");
  for (const auto& ring : boundary.rings) {
    checks.expect(ring.size() >= 3, "a ring of boundary() has fewer than three points");
    for (const BoundaryPoint& point : ring) {
      checks.expect(point.position.allFinite() && std::isfinite(point.rate) &&
                        std::isfinite(point.sigma_growth) && point.major_axis.allFinite(),
                    "boundary() is not finite");
      checks.expect(std::abs(point.normal.norm() - 1) < 1e-6,
                    "boundary() has normals that are not of length 1");
      checks.expect(std::isfinite(point.sigma) && point.sigma >= 0,
                    "boundary() has a sigma that is no standard deviation");
    }
  }
}

// Readings of one aircraft that goes out and in through a disc that grows as the prior
// says; now and then one that cannot be.
struct Observer {
  const PerimeterPrior& prior;
  RandomStream random = draws(32);
  FireReading last = {};

  void look(int step, const std::vector<PerimeterEstimator*>& estimators) {
    const Time now = Time::from_seconds(step);
    const double edge = prior.radius + prior.rate * now.seconds();
    const double distance = edge + 60 * math::sin(0.3 * step);
    const bool wrong = random.uniform() < 0.02;
    FireReading reading{now, EntityId{1},
                        prior.origin + distance * geo::unit(0.05 * step), 3,
                        (distance < edge) != wrong};
    if (step % 23 == 22)
      reading.point = prior.origin + Vec2(3e4, -2e4), reading.inside = true;
    const bool crossed = step > 0 && reading.inside != last.inside;
    const Crossing crossing{
        now, EntityId{1},   (reading.point + last.point) / 2, reading.point - last.point,
        3,   reading.inside};
    for (PerimeterEstimator* each : estimators) {
      each->predict(now);
      if (crossed)
        each->observe(crossing);
      else
        each->observe(reading);
    }
    last = reading;
  }
};

}  // namespace

Violations estimator_violations(const Make<PerimeterEstimator>& make,
                                const PerimeterPrior& prior) {
  constexpr int kSteps = 60, kCloned = 30, kAsked = 6;
  Checks checks;
  const auto estimator = make(), twin = make();
  std::unique_ptr<PerimeterEstimator> clone;
  Observer observer{prior};
  int observations = 0;
  for (int step = 0; step < kSteps; ++step) {
    std::vector<PerimeterEstimator*> all = {estimator.get(), twin.get()};
    if (clone) all.push_back(clone.get());
    observer.look(step, all);
    if (step % kAsked == 0) {
      const BoundaryEstimate boundary = estimator->boundary();
      check_boundary(boundary, Time::from_seconds(step), checks);
      checks.expect(same(boundary, twin->boundary()),
                    "two equal ones do not believe alike");
      checks.expect(!clone || same(boundary, clone->boundary()),
                    "clone() believes something else after the same observations");
    }
    const EstimatorHealth health = estimator->health();
    checks.expect(health.observations >= observations && health.outliers >= 0 &&
                      health.outliers <= health.observations,
                  "health() counts backwards, or more outliers than observations");
    observations = health.observations;
    if (step == kCloned) clone = estimator->clone();
  }
  const BoundaryEstimate before = estimator->boundary();
  Observer{prior, draws(33)}.look(kSteps, {clone.get()});
  checks.expect(same(before, estimator->boundary()),
                "what a clone observes changes the original");
  const auto ahead = estimator->outlook();
  for (const int minutes : {10, 60}) {
    const Time later = Time::from_seconds(kSteps + 60.0 * minutes);
    ahead->predict(later);
    check_boundary(ahead->boundary(), later, checks);
  }
  checks.expect(same(before, estimator->boundary()),
                "looking ahead changes the original");
  return checks.take();
}

namespace {

BoundaryEstimate some_boundary(RandomStream& random, Time now) {
  constexpr int kPoints = 60;
  const double phase = random.uniform(0, 6);
  BoundaryEstimate boundary;
  boundary.time = now;
  boundary.rings.resize(1);
  for (int k = 0; k < kPoints; ++k) {
    const double bearing = 2 * geo::kPi * k / kPoints;
    BoundaryPoint point;
    point.normal = geo::unit(bearing);
    point.position = (500 + 80 * math::sin(3 * bearing + phase)) * point.normal;
    point.sigma = random.uniform(1, 150);
    point.sigma_growth = random.uniform(0, 1);
    point.rate = random.uniform(0, 3);
    boundary.rings[0].push_back(point);
  }
  return boundary;
}

std::vector<AircraftStatus> some_team(RandomStream& random, int count) {
  std::vector<AircraftStatus> team;
  for (int k = 0; k < count; ++k) {
    AircraftStatus status;
    status.id = EntityId{static_cast<std::uint32_t>(k + 1)};
    status.nav.p_N << place_within(random, 900), -150;
    status.nav.heading = random.uniform(-3, 3);
    status.nav.v_N << 20 * geo::unit(status.nav.heading), 0;
    if (random.uniform() < 0.8) status.inside = status.nav.p_N.head<2>().norm() < 500;
    team.push_back(status);
  }
  return team;
}

bool ordered(const std::vector<Assignment>& orders,
             const std::vector<AircraftStatus>& team) {
  std::size_t next = 0;
  for (const Assignment& order : orders) {
    while (next < team.size() && team[next].id != order.aircraft) ++next;
    if (next == team.size()) return false;
    ++next;
  }
  return true;
}

bool apart(const std::vector<Assignment>& orders) {
  for (std::size_t a = 0; a < orders.size(); ++a)
    for (std::size_t b = 0; b < a; ++b) {
      const auto* one = std::get_if<FlyTo>(&orders[a].what);
      const auto* other = std::get_if<FlyTo>(&orders[b].what);
      if (one != nullptr && other != nullptr && one->point == other->point) return false;
    }
  return true;
}

bool alike(const std::vector<Assignment>& a, const std::vector<Assignment>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](const Assignment& x, const Assignment& y) {
                      return x.aircraft == y.aircraft && x.what.index() == y.what.index();
                    });
}

}  // namespace

Violations strategy_violations(const Make<MonitoringStrategy>& make) {
  Checks checks;
  RandomStream random = draws(34);
  for (int run = 0; run < 12; ++run) {
    const auto strategy = make(), twin = make();
    std::vector<AircraftStatus> team = some_team(random, run % 6);
    std::uint32_t number = 0;
    for (int second = 0; second < 20; ++second) {
      MonitoringSituation situation;
      situation.now = Time::from_seconds(60 + second);
      const BoundaryEstimate boundary = some_boundary(random, situation.now);
      situation.boundary = &boundary;
      situation.aircraft = team;
      const std::vector<Assignment> orders = strategy->assign(situation);
      checks.expect(ordered(orders, team),
                    "orders are not at most one each, in the order of the aircraft");
      checks.expect(apart(orders), "two aircraft are sent to the same point");
      checks.expect(alike(orders, twin->assign(situation)),
                    "two equal ones do not order alike");
      for (AircraftStatus& each : team) {
        each.nav.p_N += each.nav.v_N;
        each.task_done = random.uniform() < 0.3;
        for (const Assignment& order : orders)
          if (order.aircraft == each.id) each.task = {++number, order.what};
      }
    }
  }
  return checks.take();
}

}  // namespace skein::contract
