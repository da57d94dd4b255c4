// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <mutex>
#include <utility>
#include <variant>
#include <vector>

#include "skein/data/vehicle/vehicle_report.h"
#include "skein/data/vehicle/vehicle_request.h"

namespace skein::vehicle_links {

/// What goes between the thread of the links and the simulation for one vehicle, each way
/// in order. Holds a bounded number: when nobody takes them, the oldest motions go, then
/// the oldest of all but changes of the link and answers, which somebody waits for.
class Mailbox {
 public:
  struct Request {
    std::uint32_t number = 0;
    VehicleRequest what;
  };

  /// From the links.
  void put(std::vector<VehicleReport> reports) {
    if (reports.empty()) return;
    const std::lock_guard lock(mutex_);
    for (VehicleReport& report : reports) reports_.push_back(std::move(report));
    if (reports_.size() > kMaxReports) thin();
  }
  /// To the simulation.
  std::vector<VehicleReport> take_reports() {
    const std::lock_guard lock(mutex_);
    return std::exchange(reports_, {});
  }
  /// From the simulation.
  void put(Request request) {
    const std::lock_guard lock(mutex_);
    if (requests_.size() < kMaxRequests) requests_.push_back(std::move(request));
  }
  /// To the links.
  std::vector<Request> take_requests() {
    const std::lock_guard lock(mutex_);
    return std::exchange(requests_, {});
  }

 private:
  static constexpr std::size_t kMaxReports = 2000;
  static constexpr std::size_t kMaxRequests = 200;

  static bool is_vital(const VehicleReport& report) {
    return std::holds_alternative<LinkChange>(report) ||
           std::holds_alternative<RequestAnswer>(report);
  }

  // Leaves out motions but the newest half, then the oldest that nobody waits for, and
  // only of a flood of the others the oldest of these.
  void thin() {
    std::size_t motions = 0;
    for (const VehicleReport& report : reports_)
      motions += std::holds_alternative<VehicleMotion>(report) ? 1 : 0;
    std::size_t surplus = motions / 2;
    std::erase_if(reports_, [&](const VehicleReport& report) {
      if (surplus == 0 || !std::holds_alternative<VehicleMotion>(report)) return false;
      --surplus;
      return true;
    });
    drop(false);
    drop(true);
  }

  // While there are too many: half of them, the oldest first.
  void drop(bool vital) {
    if (reports_.size() <= kMaxReports) return;
    std::size_t excess = reports_.size() - kMaxReports / 2;
    std::erase_if(reports_, [&](const VehicleReport& report) {
      if (excess == 0 || is_vital(report) != vital) return false;
      --excess;
      return true;
    });
  }

  std::mutex mutex_;
  std::vector<VehicleReport> reports_;
  std::vector<Request> requests_;
};

}  // namespace skein::vehicle_links
