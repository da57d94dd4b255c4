// SPDX-License-Identifier: Apache-2.0
#include "skein/geo/gdal/gdal_guard.h"

#include <cpl_error.h>
#include <ogr_srs_api.h>

#include <mutex>
#include <shared_mutex>

#include "skein/geo/gdal/gdal_drivers.h"

namespace skein::geo {
namespace {

// Held, shared, by every thread that has a guard; alone, while a process is copied.
std::shared_mutex in_use;
thread_local int guards = 0;
bool in_service = false;  // this process is such a copy and has one thread

// What GDAL and PROJ keep for a thread they free at its end, with locks of their own: no
// process may be copied meanwhile. Objects of a thread die in the reverse order of their
// making, so theirs is made between these two.
struct AfterTheirEnd {
  ~AfterTheirEnd() {
    if (!in_service) in_use.unlock_shared();
  }
};
struct BeforeTheirEnd {
  BeforeTheirEnd() {
    CPLPushErrorHandler(CPLQuietErrorHandler);
    OGRSpatialReferenceH any = OSRNewSpatialReference(nullptr);
    OSRSetWellKnownGeogCS(any, "WGS84");  // makes theirs
    OSRDestroySpatialReference(any);
    CPLPopErrorHandler();
  }
  ~BeforeTheirEnd() {
    if (!in_service) in_use.lock_shared();
  }
};

void enclose_end_of_thread() {
  static thread_local const AfterTheirEnd after;
  static thread_local const BeforeTheirEnd before;
}

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
  enclose_end_of_thread();
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
