#include "skein/geo/gdal/gdal_guard.h"

#include <cpl_error.h>
#include <gdal.h>

#include <mutex>

namespace skein::geo {

struct GdalGuardAccess {
  static void CPL_STDCALL collect(CPLErr severity, CPLErrorNum, const char* message) {
    if (severity < CE_Failure) return;
    auto& guard = *static_cast<GdalGuard*>(CPLGetErrorHandlerUserData());
    guard.failure_ = message;
    guard.failed_ = true;
  }
};

GdalGuard::GdalGuard() {
  CPLPushErrorHandlerEx(&GdalGuardAccess::collect, this);
  static std::once_flag registered;
  std::call_once(registered, [] { GDALAllRegister(); });
}

GdalGuard::~GdalGuard() {
  CPLPopErrorHandler();
  CPLErrorReset();
}

}  // namespace skein::geo
