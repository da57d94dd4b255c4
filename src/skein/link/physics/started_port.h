// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "skein/link/physics/driving_program.h"
#include "skein/role/vehicle_port.h"

namespace skein::physics {

/// The port of a vehicle whose program, with a plant of its own, is started with the run.
class StartedPort final : public VehiclePort {
 public:
  /// @param program  "{link}" in its arguments becomes `link`, asked for when it starts.
  StartedPort(std::unique_ptr<VehiclePort> port, process::Program program, bool restart,
              std::function<std::string()> link)
      : port_(std::move(port)),
        plan_(std::move(program)),
        restart_(restart),
        link_(std::move(link)) {}

  Result<void> open() override;
  void receive(Time now, std::vector<VehicleReport>& out) override;
  void send(std::uint32_t number, const VehicleRequest& request) override {
    port_->send(number, request);
  }

 private:
  std::unique_ptr<VehiclePort> port_;
  process::Program plan_;
  bool restart_;
  std::function<std::string()> link_;
  DrivingProgram program_;
  std::vector<OutsideEvent> events_;
};

}  // namespace skein::physics
