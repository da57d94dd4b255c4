// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "skein/base/service_process.h"

namespace skein::geo {

/// While it lives, what GDAL has to say on this thread is collected here instead of being
/// written to standard error. The first one made in the program registers the drivers
/// that are of use here (gdal_drivers.h). Guards may nest; each must die on the thread
/// that made it, in reverse order. Whoever uses GDAL holds one.
class GdalGuard {
 public:
  GdalGuard();
  ~GdalGuard();
  GdalGuard(const GdalGuard&) = delete;
  GdalGuard& operator=(const GdalGuard&) = delete;

  /// The last failure GDAL reported, or "no reason given".
  const std::string& failure() const { return failure_; }
  bool failed() const { return failed_; }

 private:
  friend struct GdalGuardAccess;
  std::string failure_ = "no reason given";
  bool failed_ = false;
};

/// A process in which `answer` may use GDAL on files that nobody vouches for. Waits until
/// no other thread holds a guard, so that GDAL's locks are free in the copy; this thread
/// must hold none.
/// Fails: as ServiceProcess::start.
Result<ServiceProcess> start_gdal_service(const ServiceProcess::Answer& answer);

}  // namespace skein::geo
