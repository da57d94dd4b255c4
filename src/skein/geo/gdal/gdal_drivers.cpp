// SPDX-License-Identifier: Apache-2.0
#include "skein/geo/gdal/gdal_drivers.h"

#include <cpl_conv.h>
#include <cpl_error.h>
#include <cpl_http.h>
#include <gdal_frmts.h>
#include <ogrsf_frmts.h>

namespace skein::geo {
namespace {

// Maps and rasters may name places of the network: coordinate systems, styles, other
// files. Whoever wrote them would choose whom this machine asks.
CPLHTTPResult* refuse_to_fetch(const char* url, CSLConstList, GDALProgressFunc, void*,
                               CPLHTTPFetchWriteFunc, void*, void*) {
  const char* const why = "nothing is fetched from the network";
  CPLError(CE_Failure, CPLE_NotSupported, "%s: %s", url, why);
  // None at all would mean that GDAL's own fetcher is to try.
  auto* failed = static_cast<CPLHTTPResult*>(CPLCalloc(1, sizeof(CPLHTTPResult)));
  failed->nStatus = 1;
  failed->pszErrBuf = CPLStrdup(why);
  return failed;
}

void stay_off_the_network() {
  CPLHTTPSetFetchCallback(refuse_to_fetch, nullptr);
  CPLSetConfigOption("CPL_VSIL_CURL_ALLOWED_FILENAME", "none");
}

}  // namespace

// As docs/environment.md says. Those that guess a format by its name come last, as GDAL
// has it.
void register_drivers() {
  stay_off_the_network();
  GDALRegister_GTiff();
  GDALRegister_HFA();
  GDALRegister_AIGrid();
  GDALRegister_AAIGrid();
  GDALRegister_DTED();
  GDALRegister_SRTMHGT();
  GDALRegister_netCDF();
  GDALRegister_GRIB();
  GDALRegister_LCP();
  GDALRegister_USGSDEM();
  RegisterOGRShape();
  RegisterOGRGML();
  RegisterOGRGPX();
  RegisterOGRLIBKML();
  RegisterOGRKML();
  RegisterOGRGeoJSON();
  RegisterOGRGeoJSONSeq();
  RegisterOGRESRIJSON();
  RegisterOGRGeoPackage();
  RegisterOGRFlatGeobuf();
  RegisterOGROpenFileGDB();
  GDALRegister_ENVI();
  GDALRegister_EHdr();
}

}  // namespace skein::geo
