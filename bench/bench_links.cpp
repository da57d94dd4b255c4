// SPDX-License-Identifier: Apache-2.0
// Links in real time, over sockets of this machine: how long it takes from a vehicle's
// telemetry to its report at the others, beside a bare answer to it over the same
// sockets, and what it costs to show 250 vehicles to a ground station.
//
//   build/release/bench_links [SECONDS]
#include <fmt/core.h>
#include <time.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cstdlib>
#include <map>
#include <string>
#include <thread>
#include <vector>

#include "skein/base/math.h"
#include "skein/link/vehicle_links/test/stand_ins.h"
#include "skein/link/vehicle_links/vehicle_links.h"

namespace {

using namespace skein;
using namespace skein::vehicle_links;
using Clock = std::chrono::steady_clock;

constexpr std::uint8_t kReal = 50;
constexpr std::uint8_t kShown = 250;

double seconds(clockid_t clock) {
  timespec t{};
  clock_gettime(clock, &t);
  return static_cast<double>(t.tv_sec) + static_cast<double>(t.tv_nsec) * 1e-9;
}

geo::LocalFrame frame() {
  return geo::LocalFrame::at({47.0, 8.0, 0}).value();
}

// Where the k-th of `count` is: in a square of 2 km.
Vec2 place(std::size_t k, std::size_t count) {
  const auto side = static_cast<std::size_t>(std::ceil(std::sqrt(double(count))));
  const double step = 2000.0 / static_cast<double>(side);
  return {step * static_cast<double>(k / side), step * static_cast<double>(k % side)};
}

std::string name_of(std::size_t k) {
  return fmt::format("v-{}", k + 1);
}

struct Quantiles {
  std::size_t count = 0;
  double median = 0, most = 0, largest = 0;  // [ms]; `most` is that of 99 %
};

// What was heard, from when it was said.
template <class NumberOf>
Quantiles quantiles(const StandIns& vehicles, NumberOf number_of) {
  std::vector<double> ms;
  for (const StandIns::Heard& each : vehicles.heard) {
    const auto sent = vehicles.sent_at(number_of(each.what), each.what.altitude);
    ms.push_back(std::chrono::duration<double, std::milli>(each.at - sent).count());
  }
  std::sort(ms.begin(), ms.end());
  if (ms.empty()) return {};
  const auto at = [&](double q) {
    return ms[static_cast<std::size_t>(q * static_cast<double>(ms.size() - 1))];
  };
  return {ms.size(), at(0.5), at(0.99), ms.back()};
}

// Answers each position with a report about its sender.
class Echo final : public transport::ChannelListener {
 public:
  Echo() {
    if (!endpoints_.open(transport::UdpServer{})) std::abort();
  }
  std::string place() const { return endpoints_.places().front(); }
  void run(const std::atomic<bool>& stop) {
    while (!stop) endpoints_.run_for(std::chrono::milliseconds(10));
  }

 private:
  void opened(transport::ChannelId, transport::EndpointId, const std::string&) override {}
  void closed(transport::ChannelId, const std::string&) override {}
  void received(transport::ChannelId channel, std::span<const std::byte> bytes) override {
    mavlink::FrameParser().read(bytes, [&](const mavlink::Frame& frame) {
      if (frame.id() != mavlink::kFacts<mavlink::GlobalPositionInt>.id) return;
      mavlink::AdsbVehicle report;
      report.ICAO_address = frame.system();
      report.altitude = mavlink::unpack<mavlink::GlobalPositionInt>(frame.payload()).alt;
      endpoints_.send(channel, writer_.write(report));
    });
  }
  transport::Endpoints endpoints_{*this};
  mavlink::FrameWriter writer_{245, 191};
};

// What this machine takes for nothing but an answer, busy as it is.
void measure_echo(int duration) {
  Echo echo;
  std::atomic<bool> stop = false;
  std::thread thread([&] { echo.run(stop); });
  StandIns vehicles(frame(), echo.place());
  for (std::uint8_t k = 0; k < kReal; ++k)
    vehicles.add(static_cast<std::uint8_t>(k + 1), place(k, kReal));
  vehicles.run(std::chrono::seconds(duration));
  stop = true;
  thread.join();
  const Quantiles all = quantiles(
      vehicles, [](const mavlink::AdsbVehicle& m) { return m.ICAO_address - 1; });
  fmt::print(
      "a bare answer, {} vehicles at 10 Hz, {} s:\n"
      "  {} answers, median {:.2f} ms, 99 % {:.2f} ms, largest {:.2f} ms\n",
      kReal, duration, all.count, all.median, all.most, all.largest);
}

// Of 50 vehicles that send 10 positions a second, each is told of the 49 others.
bool measure_latency(int duration, double rate) {
  VehicleLinks links(frame());
  std::map<std::uint32_t, std::size_t> by_address;
  for (std::uint8_t k = 0; k < kReal; ++k) {
    LinkedVehicle vehicle;
    vehicle.endpoint.address = transport::UdpServer{};
    vehicle.client.system = static_cast<std::uint8_t>(k + 1);
    vehicle.client.hovers = true;
    vehicle.name = name_of(k);
    vehicle.traffic = TrafficOptions{.rate = rate};
    if (!links.add(vehicle)) return false;
    by_address[icao_address(vehicle.name)] = k;
  }
  const auto places = links.start();
  if (!places) return false;
  StandIns vehicles(frame(), places.value().front());
  for (std::uint8_t k = 0; k < kReal; ++k)
    vehicles.add(static_cast<std::uint8_t>(k + 1), place(k, kReal));
  vehicles.run(std::chrono::seconds(5));  // until all telemetry is set up
  // No memory is moved while it is measured.
  vehicles.heard.resize(static_cast<std::size_t>(rate * (duration + 1)) * kReal * kReal);
  vehicles.heard.clear();
  const double before = seconds(CLOCK_PROCESS_CPUTIME_ID);
  const double own = seconds(CLOCK_THREAD_CPUTIME_ID);
  vehicles.run(std::chrono::seconds(duration));
  const double cpu = seconds(CLOCK_PROCESS_CPUTIME_ID) - before -
                     (seconds(CLOCK_THREAD_CPUTIME_ID) - own);
  const Quantiles all = quantiles(vehicles, [&](const mavlink::AdsbVehicle& m) {
    return by_address.at(m.ICAO_address);
  });
  fmt::print(
      "telemetry in to report out, {} vehicles at 10 Hz, each told of {} at up to "
      "{} Hz, {} s:\n"
      "  {} reports, median {:.2f} ms, 99 % {:.2f} ms, largest {:.2f} ms; thread "
      "of the links {:.1f} % of a core\n",
      kReal, kReal - 1, rate, duration, all.count, all.median, all.most, all.largest,
      100 * cpu / duration);
  return all.count > 0 && all.most < 5;
}

// A ground station that takes the telemetry that is sent without being asked for, and
// notes when each vehicle's positions come.
class Station final : public transport::ChannelListener {
 public:
  explicit Station(const std::string& server) {
    const std::string at = "udpout" + server.substr(server.find(':'));
    if (!endpoints_.open(transport::parse_endpoint(at).value())) std::abort();
  }
  void run(const std::atomic<bool>& stop) {
    while (!stop) {
      if (Clock::now() >= due_) {
        due_ = Clock::now() + std::chrono::seconds(1);
        mavlink::Heartbeat heartbeat;
        heartbeat.type = 6;
        heartbeat.autopilot = 8;
        heartbeat.mavlink_version = 3;
        endpoints_.send(channel_, writer_.write(heartbeat));
      }
      endpoints_.run_for(std::chrono::milliseconds(20));
    }
    cpu = seconds(CLOCK_THREAD_CPUTIME_ID);
  }
  std::atomic<bool> counts = false;
  std::uint64_t frames = 0, bytes_in = 0;
  /// From one position of a vehicle to its next [s].
  std::vector<double> gaps;
  double cpu = 0;

 private:
  void opened(transport::ChannelId channel, transport::EndpointId,
              const std::string&) override {
    channel_ = channel;
  }
  void closed(transport::ChannelId, const std::string&) override {}
  void received(transport::ChannelId, std::span<const std::byte> bytes) override {
    const Clock::time_point now = Clock::now();
    parser_.read(bytes, [&](const mavlink::Frame& frame) {
      if (!counts) return;
      ++frames;
      bytes_in += frame.bytes.size();
      if (frame.id() != mavlink::kFacts<mavlink::GlobalPositionInt>.id) return;
      Clock::time_point& last = last_[frame.system()];
      if (last != Clock::time_point())
        gaps.push_back(std::chrono::duration<double>(now - last).count());
      last = now;
    });
  }

  transport::ChannelId channel_ = 0;
  transport::Endpoints endpoints_{*this};
  mavlink::FrameWriter writer_{255, 190};
  mavlink::FrameParser parser_;
  Clock::time_point due_;
  std::array<Clock::time_point, 256> last_{};
};

// 250 simulated vehicles, whose run goes at 10 Hz in real time.
bool measure_load(int duration) {
  constexpr std::chrono::milliseconds kStep{100};
  VehicleLinks links(frame());
  for (int k = 0; k < kShown; ++k) {
    vehicle_services::VehicleServerOptions vehicle;
    vehicle.name = name_of(static_cast<std::size_t>(k));
    vehicle.index = static_cast<std::uint32_t>(k);
    links.show(vehicle);
  }
  links.add_station({transport::UdpServer{}, false});
  const auto places = links.start();
  if (!places) return false;
  Station station(places.value().front());
  std::atomic<bool> stop = false;
  std::thread thread([&] { station.run(stop); });
  const auto step = [&](int k) {
    const Time now = Time::from_seconds(0.1 * k);
    for (std::size_t v = 0; v < kShown; ++v) {
      vehicle_services::VehicleSnapshot snapshot;
      snapshot.motion.time = now;
      const Vec2 at = place(v, kShown);
      snapshot.motion.p_N = {at.x() + k, at.y(), -100};
      snapshot.motion.v_N = {10, 0, 0};
      snapshot.condition.position = snapshot.condition.armed = true;
      snapshot.condition.on_ground = false;
      links.update(v, snapshot);
    }
    links.set_simulated(now);
  };
  int late = 0, steps = 0;
  double before = 0, own = 0, begin_station = 0;
  const int warm_up = 50;
  const Clock::time_point begin = Clock::now();
  const int end = warm_up + 10 * duration;
  for (int k = 0; k < end; ++k) {
    std::this_thread::sleep_until(begin + kStep * k);
    if (k == warm_up) {
      station.counts = true;
      before = seconds(CLOCK_PROCESS_CPUTIME_ID);
      own = seconds(CLOCK_THREAD_CPUTIME_ID);
    }
    step(k);
    if (k < warm_up) continue;
    ++steps;
    late += Clock::now() > begin + kStep * (k + 1) ? 1 : 0;
  }
  station.counts = false;
  const double all = seconds(CLOCK_PROCESS_CPUTIME_ID) - before;
  const double simulation = seconds(CLOCK_THREAD_CPUTIME_ID) - own;
  clockid_t clock{};
  pthread_getcpuclockid(thread.native_handle(), &clock);
  begin_station = seconds(clock);
  stop = true;
  thread.join();
  const double receiving = begin_station * duration / (duration + 5.0);
  const double cpu = all - simulation - receiving;
  std::vector<double>& gaps = station.gaps;
  std::sort(gaps.begin(), gaps.end());
  if (gaps.empty()) return false;
  // A position is missed when it comes more than half a period late.
  const double period = gaps[gaps.size() / 2];
  const auto missed = static_cast<double>(
      gaps.end() - std::upper_bound(gaps.begin(), gaps.end(), 1.5 * period));
  const double share = missed / static_cast<double>(gaps.size());
  fmt::print(
      "{} simulated vehicles, updates at 10 Hz, one ground station, {} s:\n"
      "  {:.0f} frames/s, {:.0f} kB/s; thread of the links {:.1f} % of a core, "
      "updates {:.1f} %\n"
      "  {} steps, {} late; {} positions at {:.0f} Hz, {:.3f} % missed, largest "
      "gap {:.0f} ms\n",
      kShown, duration, static_cast<double>(station.frames) / duration,
      static_cast<double>(station.bytes_in) / 1000 / duration, 100 * cpu / duration,
      100 * simulation / duration, steps, late, gaps.size(), 1 / period, 100 * share,
      1000 * gaps.back());
  return share < 0.001 && late == 0 && cpu < duration;
}

}  // namespace

int main(int count, char** arguments) {
  const int duration = count > 1 ? std::max(std::atoi(arguments[1]), 1) : 20;
  measure_echo(duration);
  bool good = measure_latency(duration, TrafficOptions{}.rate);
  good &= measure_latency(duration, 10);
  good &= measure_load(duration);
  fmt::print("{}\n", good ? "good" : "not good enough");
  return good ? 0 : 1;
}
