// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "skein/base/result.h"
#include "skein/layer/environment/raster/date_time.h"
#include "skein/layer/environment/recorded/attributes.h"
#include "skein/layer/environment/recorded/perimeter_file.h"

namespace skein::environment {

/// The times of the features of one layer, as dated_perimeters() finds them; none for
/// features that have none.
/// @param layer  features of one layer of one file: they share their attributes.
/// Fails: kBadInput when the attribute that has the times holds something else.
Result<std::vector<std::optional<DateTime>>> times_of_layer(
    std::span<const VectorFeature> layer, const PerimeterFileOptions& options,
    Assumptions& assumed);

/// What a user may do about a feature without a time, and its attributes.
std::string time_hint(const VectorFeature& feature);

/// The names that tables and files of Skein itself have for times, the best first.
std::span<const std::string_view> time_names();

/// Whether numbers under that name are plain seconds whatever their size.
bool is_plain_seconds(const std::string& name);

}  // namespace skein::environment
