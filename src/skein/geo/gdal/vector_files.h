// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace skein::geo {

/// The ending of a name in small letters, with its full stop: ".geojson" of "A.GeoJSON".
std::string small_ending(const std::filesystem::path& path);

/// Whether a path ends like that of a vector dataset which can be read, in letters of any
/// size.
bool is_vector_name(const std::filesystem::path& path);

/// What GDAL opens for a file: itself; for a zip archive the archive as a folder if
/// datasets lie at its top, else each dataset in its folders, in the order of their
/// names. What macOS and other systems add to archives (`__MACOSX`, names that begin with
/// a full stop) is passed over. A `GdalGuard` must be held.
std::vector<std::string> vector_datasets(const std::string& file);

/// Whether a file of GeoJSON or Esri's JSON says of itself that the server cut it off
/// (`"exceededTransferLimit": true`). Files above 500 MB are not looked at. A `GdalGuard`
/// must be held.
bool says_cut_off(const std::string& dataset);

}  // namespace skein::geo
