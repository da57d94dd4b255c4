// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "skein/scenario/places.h"

namespace skein::assemble {

/// The points of a feature of a map file: see scenario::FeatureReader.
Result<std::vector<Vec2>> feature_points(const std::string& file, const std::string& name,
                                         scenario::FeatureUse use,
                                         const geo::LocalFrame& frame);

}  // namespace skein::assemble
