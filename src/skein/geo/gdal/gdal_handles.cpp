// SPDX-License-Identifier: Apache-2.0
#include "skein/geo/gdal/gdal_handles.h"

#include <gdal.h>
#include <ogr_srs_api.h>

#include "skein/geo/gdal/gdal_guard.h"

namespace skein::geo {
namespace {

struct DestroyReference {
  void operator()(void* reference) const {
    OSRDestroySpatialReference(static_cast<OGRSpatialReferenceH>(reference));
  }
};
using Reference = std::unique_ptr<void, DestroyReference>;

// Coordinates in the order x, y whatever the system's authority says.
Reference easting_first(OGRSpatialReferenceH system) {
  OSRSetAxisMappingStrategy(system, OAMS_TRADITIONAL_GIS_ORDER);
  return Reference(system);
}

Reference degrees() {
  OGRSpatialReferenceH system = OSRNewSpatialReference(nullptr);
  OSRSetWellKnownGeogCS(system, "WGS84");
  return easting_first(system);
}

}  // namespace

void CloseDataset::operator()(void* dataset) const {
  const GdalGuard guard;
  GDALClose(dataset);
}
void DestroyTransform::operator()(void* transform) const {
  const GdalGuard guard;  // it closes the data base of PROJ
  OCTDestroyCoordinateTransformation(
      static_cast<OGRCoordinateTransformationH>(transform));
}

namespace {

GdalDataset open_with(const std::string& name, DataKind kind,
                      const char* const* allowed_drivers) {
  const unsigned flags = kind == DataKind::kRaster ? GDAL_OF_RASTER : GDAL_OF_VECTOR;
  // What a text that looks like a date means is not for GDAL to guess (9/5/21 would be
  // May 2009). Drivers without the option say so in a warning, which nobody reads.
  const char* const texts[] = {"DATE_AS_STRING=YES", nullptr};
  return GdalDataset(
      GDALOpenEx(name.c_str(), flags | GDAL_OF_READONLY | GDAL_OF_VERBOSE_ERROR,
                 allowed_drivers, kind == DataKind::kVector ? texts : nullptr, nullptr));
}

}  // namespace

GdalDataset open_dataset(const std::string& name, DataKind kind) {
  return open_with(name, kind, nullptr);
}

GdalDataset open_sent_dataset(const std::string& name) {
  const char* const drivers[] = {"GeoJSON", "ESRIJSON", "LIBKML", "KML", nullptr};
  return open_with(name, DataKind::kVector, drivers);
}

GdalTransform transform_to_degrees(void* system) {
  return GdalTransform(OCTNewCoordinateTransformation(
      easting_first(OSRClone(system)).get(), degrees().get()));
}

GdalTransform transform_from_degrees(void* system) {
  return GdalTransform(OCTNewCoordinateTransformation(
      degrees().get(), easting_first(OSRClone(system)).get()));
}

}  // namespace skein::geo
