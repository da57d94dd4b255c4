// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <thread>
#include <vector>

#include "skein/base/result.h"
#include "skein/link/flight_model/flight_state.h"
#include "skein/link/flight_model/state_follower.h"
#include "skein/link/process/kept_program.h"
#include "skein/link/transport/endpoints.h"
#include "skein/role/flight_model.h"

namespace skein::flight_model {

/// What a program speaks, without any I/O. Called by the thread of the link.
class Protocol {
 public:
  virtual ~Protocol() = default;

  /// Takes in a datagram. @returns  the state that is complete with it.
  virtual std::optional<FlightState> read(std::span<const std::byte> datagram) = 0;
  /// The datagrams by which it is asked to say something; sent when it is silent.
  virtual std::vector<std::string> ask() = 0;
  /// The datagrams that set the controls.
  /// @param begin  the first since it was silent.
  virtual std::vector<std::string> write(const FlightControls& controls, bool begin) = 0;
};

std::unique_ptr<Protocol> flightgear();
std::unique_ptr<Protocol> x_plane();

struct FlightModelOptions {
  std::string name;  ///< of the vehicle, for people
  /// Where states come in; none: they come back from `out`.
  std::optional<transport::EndpointAddress> in;
  transport::EndpointAddress out;             ///< where controls go
  std::chrono::milliseconds contact{60'000};  ///< that open() waits for the first state
  /// States before this time of the program's clock are passed over [s].
  double settling = 0;
  bool sends_wind = false;
  /// Files for the program, which are written before it starts: place and content.
  std::vector<std::pair<std::string, std::string>> files;
};

/// The link to a flight model in another program: UDP in a thread of its own, of which
/// the simulation takes the newest state.
class FlightModelLink final : public FlightModel, private transport::ChannelListener {
 public:
  /// @param program  none: somebody else starts it.
  FlightModelLink(FlightModelOptions options, const geo::LocalFrame& frame,
                  std::unique_ptr<Protocol> protocol,
                  std::optional<process::KeptProgram> program);
  /// Ends the thread, and its program, in order if that ends within a moment.
  ~FlightModelLink() override;

  Result<void> open() override;
  void receive(Time now, std::vector<VehicleReport>& out) override;
  void send(const Actuators& actuators, const Vec3& wind_N) override;

  /// Where it waits, with the ports that it has got; after open().
  const std::vector<std::string>& places() const { return places_; }

 private:
  using Clock = std::chrono::steady_clock;
  struct Arrived {
    FlightState state;
    Clock::time_point came;
  };

  void opened(transport::ChannelId channel, transport::EndpointId endpoint,
              const std::string& name) override;
  void received(transport::ChannelId channel, std::span<const std::byte> bytes) override;
  void closed(transport::ChannelId channel, const std::string& why) override;
  void run();
  void ask();
  void send_controls(const FlightControls& controls);
  void send_all(const std::vector<std::string>& datagrams);
  Result<void> start_program();
  Result<void> wait_for_contact();
  bool look_at_program(std::vector<VehicleReport>& out);

  FlightModelOptions options_;
  StateFollower follower_;
  std::unique_ptr<Protocol> protocol_;
  std::optional<process::KeptProgram> program_;
  std::vector<std::string> places_;

  // Of the thread.
  transport::Endpoints endpoints_;
  transport::ChannelId out_channel_ = 0;  // 0: none
  std::optional<Clock::time_point> heard_, asked_;
  bool begun_ = false;  // controls have been sent since it was silent

  // Of both.
  std::mutex mutex_;
  std::condition_variable arrived_;
  std::optional<Arrived> newest_;
  std::optional<FlightControls> controls_;
  std::atomic<bool> stop_ = false;
  std::thread thread_;
};

}  // namespace skein::flight_model
