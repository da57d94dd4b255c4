#include "skein/geo/gdal/gdal_guard.h"

#include <cpl_error.h>

#include <mutex>
#include <shared_mutex>

#include "skein/geo/gdal/gdal_drivers.h"

namespace skein::geo {
namespace {

// Held, shared, by every thread that has a guard; alone, while a process is copied.
std::shared_mutex in_use;
thread_local int guards = 0;
bool in_service = false;  // this process is such a copy and has one thread

}  // namespace

struct GdalGuardAccess {
  static void CPL_STDCALL collect(CPLErr severity, CPLErrorNum, const char* message) {
    if (severity < CE_Failure) return;
    auto& guard = *static_cast<GdalGuard*>(CPLGetErrorHandlerUserData());
    guard.failure_ = message;
    guard.failed_ = true;
  }
};

GdalGuard::GdalGuard() {
  if (guards++ == 0 && !in_service) in_use.lock_shared();
  CPLPushErrorHandlerEx(&GdalGuardAccess::collect, this);
  static std::once_flag registered;
  std::call_once(registered, register_drivers);
}

GdalGuard::~GdalGuard() {
  CPLPopErrorHandler();
  CPLErrorReset();
  if (--guards == 0 && !in_service) in_use.unlock_shared();
}

Result<ServiceProcess> start_gdal_service(const ServiceProcess::Answer& answer) {
  SKEIN_CHECK(guards == 0, guards);
  { const GdalGuard registers_drivers; }  // once, not in every copy
  const std::lock_guard alone(in_use);
  return ServiceProcess::start([&answer](const ServiceMessage& request) {
    in_service = true;
    return answer(request);
  });
}

}  // namespace skein::geo
