// SPDX-License-Identifier: Apache-2.0
#include "skein/link/physics/started_port.h"

#include <string_view>
#include <utility>

namespace skein::physics {

Result<void> StartedPort::open() {
  constexpr std::string_view kLink = "{link}";
  const std::string link = link_();
  for (std::string& argument : plan_.arguments)
    for (std::size_t at = argument.find(kLink); at != std::string::npos;
         at = argument.find(kLink, at + link.size()))
      argument.replace(at, kLink.size(), link);
  program_ = DrivingProgram(process::KeptProgram(plan_, restart_));
  if (auto started = program_.start(); !started) return started;
  return port_->open();
}

void StartedPort::receive(Time now, std::vector<VehicleReport>& out) {
  program_.look(events_);
  for (OutsideEvent& event : events_) out.emplace_back(std::move(event));
  events_.clear();
  port_->receive(now, out);
}

}  // namespace skein::physics
