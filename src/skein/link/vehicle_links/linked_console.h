// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <utility>
#include <vector>

#include "skein/link/vehicle_links/vehicle_feed.h"
#include "skein/role/operator_console.h"

namespace skein::vehicle_links {

/// An operator's console to which the commands of ground stations are added.
class LinkedConsole final : public OperatorConsole {
 public:
  /// Both outlive it.
  LinkedConsole(OperatorConsole& console, VehicleFeed& feed)
      : console_(console), feed_(feed) {}

  void show(const RunProgress& progress) override { console_.show(progress); }
  bool stop_requested() const override { return console_.stop_requested(); }
  std::vector<CommandRecord> commands() override {
    std::vector<CommandRecord> all = console_.commands();
    for (CommandRecord& each : feed_.commands()) all.push_back(std::move(each));
    return all;
  }

 private:
  OperatorConsole& console_;
  VehicleFeed& feed_;
};

}  // namespace skein::vehicle_links
