// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace skein::geo {

/// Registers GDAL's drivers for the formats that terrain, wind, fires and maps come in,
/// and no others: each is code that reads files which nobody vouches for, and several
/// fetch other files or addresses that a file names.
void register_drivers();

}  // namespace skein::geo
