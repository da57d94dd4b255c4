// SPDX-License-Identifier: Apache-2.0
#include "skein/link/flight_model/flight_model_link.h"

#include <fmt/format.h>

#include <filesystem>
#include <string_view>
#include <utility>

#include "skein/base/log.h"
#include "skein/base/output_file.h"
#include "skein/link/flight_model/flightgear.h"
#include "skein/link/flight_model/x_plane.h"

namespace skein::flight_model {
namespace {

using namespace std::chrono_literals;

constexpr auto kTurn = 100ms;  // at most between two looks at what is to be done
constexpr auto kAsk = 1s;      // of silence, before the program is asked again
constexpr auto kLook = 100ms;  // between looks at the program
constexpr auto kReport = 5s;   // between lines that it is waited for
constexpr auto kOrderly = 1s;  // that a program has to end in order

class FlightGear final : public Protocol {
 public:
  std::optional<FlightState> read(std::span<const std::byte> datagram) override {
    const auto state = parse_flightgear(
        {reinterpret_cast<const char*>(datagram.data()), datagram.size()});
    if (!state) {
      if (!std::exchange(warned_, true))
        log_warning("FlightGear: {}", state.error().text());
      return std::nullopt;
    }
    // Its clock does not run before its flight model does.
    if (state.value().time == 0) return std::nullopt;
    return state.value();
  }
  // What it says and how often follows from how it was started.
  std::vector<std::string> ask() override { return {}; }
  std::vector<std::string> write(const FlightControls& controls, bool) override {
    return {flightgear_line(controls)};
  }

 private:
  bool warned_ = false;
};

class XPlane final : public Protocol {
 public:
  std::optional<FlightState> read(std::span<const std::byte> datagram) override {
    return reader_.read(datagram);
  }
  std::vector<std::string> ask() override { return x_plane_requests(); }
  std::vector<std::string> write(const FlightControls& controls, bool begin) override {
    return x_plane_controls(controls, begin);
  }

 private:
  XPlaneReader reader_;
};

Result<void> write_with_folder(const std::filesystem::path& place,
                               const std::string& content) {
  std::error_code error;  // is said when the file is written
  std::filesystem::create_directories(place.parent_path(), error);
  return write_file(place, content);
}

}  // namespace

std::unique_ptr<Protocol> flightgear() {
  return std::make_unique<FlightGear>();
}
std::unique_ptr<Protocol> x_plane() {
  return std::make_unique<XPlane>();
}

FlightModelLink::FlightModelLink(FlightModelOptions options, const geo::LocalFrame& frame,
                                 std::unique_ptr<Protocol> protocol,
                                 std::optional<process::KeptProgram> program)
    : options_(std::move(options)),
      follower_(frame),
      protocol_(std::move(protocol)),
      program_(std::move(program)),
      endpoints_(*this) {}

FlightModelLink::~FlightModelLink() {
  stop_ = true;
  endpoints_.wake();
  if (thread_.joinable()) thread_.join();
  if (!program_) return;
  const auto begin = Clock::now();
  program_->stop(begin);
  while (program_->runs(Clock::now()) && Clock::now() - begin < kOrderly)
    std::this_thread::sleep_for(20ms);
}

Result<void> FlightModelLink::open() {
  if (options_.in)
    if (auto opened = endpoints_.open(*options_.in); !opened) return opened.error();
  auto out = endpoints_.open(options_.out);
  if (!out) return out.error();
  places_ = endpoints_.places();
  thread_ = std::thread([this] { run(); });
  if (auto started = start_program(); !started) return started;
  return wait_for_contact();
}

Result<void> FlightModelLink::start_program() {
  if (!program_) return {};
  for (const auto& [place, content] : options_.files)
    if (auto written = write_with_folder(place, content); !written) return written;
  return program_->start();
}

// The run begins when the flight model is there, or when nobody can wait for it longer.
Result<void> FlightModelLink::wait_for_contact() {
  const auto until = Clock::now() + options_.contact;
  auto report_due = Clock::now();
  std::vector<VehicleReport> said;
  std::unique_lock lock(mutex_);
  while (!newest_ && Clock::now() < until) {
    if (program_ && look_at_program(said) && !program_->runs(Clock::now()))
      return Error{ErrorCode::kUnavailable, options_.name,
                   std::get<OutsideEvent>(said.front()).text, ""};
    if (Clock::now() >= report_due) {
      log_info("{}: waits for its flight model", options_.name);
      report_due = Clock::now() + kReport;
    }
    arrived_.wait_for(lock, kLook);
  }
  if (!newest_) log_warning("{}: its flight model does not say anything", options_.name);
  return {};
}

// Whether something has become of it, which is appended.
bool FlightModelLink::look_at_program(std::vector<VehicleReport>& out) {
  const auto change = program_->look(Clock::now());
  if (!change) return false;
  out.emplace_back(OutsideEvent{
      change->started ? EventKind::kFlightModelRestarted : EventKind::kFlightModelEnded,
      change->text});
  return true;
}

void FlightModelLink::receive(Time now, std::vector<VehicleReport>& out) {
  if (program_) look_at_program(out);
  std::optional<Arrived> arrived;
  {
    const std::lock_guard lock(mutex_);
    arrived = std::exchange(newest_, std::nullopt);
  }
  if (!arrived) return;
  const auto age =
      std::chrono::duration_cast<std::chrono::nanoseconds>(Clock::now() - arrived->came);
  follower_.take(arrived->state, now - Time::from_ns(age.count()), out);
}

void FlightModelLink::send(const Actuators& actuators, const Vec3& wind_N) {
  FlightControls controls = controls_of(actuators);
  if (options_.sends_wind) controls.wind_N = wind_N;
  {
    const std::lock_guard lock(mutex_);
    controls_ = controls;
  }
  endpoints_.wake();
}

void FlightModelLink::run() {
  while (!stop_) {
    std::optional<FlightControls> controls;
    {
      const std::lock_guard lock(mutex_);
      controls = std::exchange(controls_, std::nullopt);
    }
    ask();
    if (controls) send_controls(*controls);
    endpoints_.run_for(kTurn);
  }
}

// Again each second while nothing comes.
void FlightModelLink::ask() {
  const auto now = Clock::now();
  if (heard_ && now - *heard_ <= kAsk) return;
  if (asked_ && now - *asked_ <= kAsk) return;
  asked_ = now;
  begun_ = false;
  send_all(protocol_->ask());
}

void FlightModelLink::send_controls(const FlightControls& controls) {
  send_all(protocol_->write(controls, heard_ && !std::exchange(begun_, true)));
}

void FlightModelLink::send_all(const std::vector<std::string>& datagrams) {
  for (const std::string& datagram : datagrams)
    endpoints_.send(out_channel_, std::as_bytes(std::span(datagram)));
}

void FlightModelLink::opened(transport::ChannelId channel, transport::EndpointId endpoint,
                             const std::string&) {
  if (endpoint == (options_.in ? 1U : 0U)) out_channel_ = channel;
}

void FlightModelLink::received(transport::ChannelId, std::span<const std::byte> bytes) {
  const auto state = protocol_->read(bytes);
  if (!state || state->time < options_.settling) return;
  heard_ = Clock::now();
  {
    const std::lock_guard lock(mutex_);
    newest_ = Arrived{*state, *heard_};
  }
  arrived_.notify_one();
}

void FlightModelLink::closed(transport::ChannelId, const std::string&) {}

}  // namespace skein::flight_model
