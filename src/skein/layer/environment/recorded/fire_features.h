// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "skein/layer/environment/recorded/perimeter_file.h"
#include "skein/layer/environment/recorded/vector_layer.h"

namespace skein::environment {

/// Of all features of a source those that are perimeters of one fire, with their times,
/// as agencies publish them: which attribute has the time, what numbers and dates in it
/// mean, which incident, which features are perimeters at all. What is not written in the
/// source is assumed, and every assumption is a line of `warnings`.
///
/// The time of a feature is found by layer, since layers have attributes of their own:
/// 1. the attribute `time_field`; or
/// 2. the first known name (docs/environment.md) with values, whether it has the prefix
///    `poly_` or `attr_`, or is cut to ten letters as in a shapefile; or
/// 3. the attribute of dates that differ most; or
/// 4. a date within the feature's name, its layer's or its file's.
/// A date without a time of day is completed by an attribute of the time of day if there
/// is one.
///
/// Fails: kBadInput: no time, an attribute that holds no time, seconds and dates mixed,
///        several incidents and none asked for, or one that there is not.
Result<RawSeries> dated_perimeters(std::vector<VectorFeature> features,
                                   const std::string& place,
                                   const PerimeterFileOptions& options,
                                   std::vector<std::string>& warnings);

/// The error of a perimeter whose time is of another kind than those before it.
Error mixed_times(const std::string& place);

}  // namespace skein::environment
