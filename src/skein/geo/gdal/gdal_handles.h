// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>

namespace skein::geo {

struct CloseDataset {
  void operator()(void* dataset) const;
};
struct DestroyTransform {
  void operator()(void* transform) const;
};

/// A GDALDatasetH and an OGRCoordinateTransformationH, freed with their owner.
using GdalDataset = std::unique_ptr<void, CloseDataset>;
using GdalTransform = std::unique_ptr<void, DestroyTransform>;

enum class DataKind { kRaster, kVector };

/// Opens a file, or what GDAL takes for a name, for reading. Null when that fails; a
/// `GdalGuard` that the caller holds has the reason.
GdalDataset open_dataset(const std::string& name, DataKind kind);

/// The same for what somebody sent: GeoJSON and KML only, whatever it looks like.
GdalDataset open_sent_dataset(const std::string& name);

/// Transforms between a coordinate reference system (an OGRSpatialReferenceH, not null)
/// and WGS 84 degrees, x being the longitude. Null when there is none; a `GdalGuard` that
/// the caller holds has the reason.
GdalTransform transform_to_degrees(void* system);
GdalTransform transform_from_degrees(void* system);

}  // namespace skein::geo
