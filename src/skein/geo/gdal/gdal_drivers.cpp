// SPDX-License-Identifier: Apache-2.0
#include "skein/geo/gdal/gdal_drivers.h"

#include <gdal_frmts.h>
#include <ogrsf_frmts.h>

namespace skein::geo {

// As docs/environment.md says. Those that guess a format by its name come last, as GDAL
// has it.
void register_drivers() {
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
