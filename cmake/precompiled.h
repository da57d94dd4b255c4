// SPDX-License-Identifier: Apache-2.0
#pragma once

// What most source files include, compiled once for all of them
// (cmake/precompiled.cmake). No file counts on it: each includes what it uses.

#include <fmt/format.h>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <numbers>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>
