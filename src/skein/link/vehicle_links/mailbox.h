#pragma once

#include <cstddef>
#include <cstdint>
#include <mutex>
#include <utility>
#include <variant>
#include <vector>

#include "skein/data/vehicle_report.h"
#include "skein/data/vehicle_request.h"

namespace skein::vehicle_links {

/// What goes between the thread of the links and the simulation for one vehicle, each way
/// in order. Holds a bounded number: when nobody takes them, the oldest motions go.
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

  // Leaves out motions but the newest half, then whatever is oldest.
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
    if (reports_.size() > kMaxReports)
      reports_.erase(reports_.begin(),
                     reports_.end() - static_cast<std::ptrdiff_t>(kMaxReports / 2));
  }

  std::mutex mutex_;
  std::vector<VehicleReport> reports_;
  std::vector<Request> requests_;
};

}  // namespace skein::vehicle_links
