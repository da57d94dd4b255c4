#pragma once

#include <string>

namespace skein::geo {

/// While it lives, what GDAL has to say on this thread is collected here instead of being
/// written to standard error. The first one made in the program registers GDAL's drivers.
/// Guards may nest; each must die on the thread that made it, in reverse order.
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

}  // namespace skein::geo
