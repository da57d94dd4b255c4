// SPDX-License-Identifier: Apache-2.0
#include "skein/link/vehicle_links/refused_orders.h"

#include <fmt/format.h>

#include <utility>

#include "skein/base/log.h"

namespace skein::vehicle_links {
namespace {

const Time kReportPeriod = Time::from_seconds(60);
constexpr std::size_t kMaxReported = 1000;  // while nobody takes them

}  // namespace

void RefusedOrders::add(const std::string& peer, RefusedOrder order, Time now) {
  ++count_;
  const auto [due, first] = due_.try_emplace(std::pair(order.shown, order.vehicle), now);
  if (!first && now < due->second) return;
  due->second = now + kReportPeriod;
  order.text = fmt::format(
      "{}: a command is refused, since it is not signed ({} so far); see "
      "links.ground_stations.unsigned",
      peer, count_);
  log_warning("{}", order.text);
  const std::lock_guard lock(mutex_);
  if (reported_.size() < kMaxReported) reported_.push_back(std::move(order));
}

std::vector<RefusedOrder> RefusedOrders::take() {
  const std::lock_guard lock(mutex_);
  return std::exchange(reported_, {});
}

}  // namespace skein::vehicle_links
