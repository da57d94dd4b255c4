// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "skein/base/result.h"
#include "skein/geo/local_frame.h"
#include "skein/geo/vec.h"
#include "skein/scenario/node.h"

namespace skein::scenario {

/// What a named feature of a map file is used as.
enum class FeatureUse { kPoint, kLine, kArea };

/// Reads the points of a feature of a map file into the plane of a frame.
/// @param name  of the feature; empty: the only one of its use in the file.
/// Fails: kNotFound, kBadInput when the file cannot be read, has no such feature or
///        several, or it is of another use.
using FeatureReader = std::function<Result<std::vector<Vec2>>(
    const std::string& file, const std::string& name, FeatureUse use,
    const geo::LocalFrame& frame)>;

/// Features that have been read, by file, name, use and origin of the frame.
using FeatureMemory =
    std::map<std::tuple<std::string, std::string, FeatureUse, double, double, double>,
             Result<std::vector<Vec2>>>;

/// A reader that reads each feature once; `memory` is its own.
FeatureReader remembering(FeatureReader reader, std::shared_ptr<FeatureMemory> memory);

/// Places that people have, besides local metres: latitude and longitude, or features of
/// map files.
struct Places {
  std::optional<geo::LocalFrame> frame;  ///< none: the file's origin is not valid
  FeatureReader features;                ///< empty: there are no features
};

/// The local frame of a tree: at its `origin`, with the defaults where it says nothing;
/// none when that is not valid.
std::optional<geo::LocalFrame> frame_of(const Node& root,
                                        const geo::Geodetic& default_origin);

}  // namespace skein::scenario
