// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "skein/scenario/kind_table.h"

namespace skein::scenario::test {

enum class Method { kEuler, kHeun };

struct Layer {
  double height = 10;
  double speed = 1;
  friend bool operator==(const Layer&, const Layer&) = default;
};

/// One member for everything that Fields can describe.
struct FakeOptions {
  double airspeed = 20;
  double bank = 0.5;  // no number of degrees with few digits gives it
  Time timeout = Time::from_seconds(2.5);
  double delay = 0.1;
  int harmonics = 5;
  bool robust = true;
  std::string label = "plain";
  std::string colour = "red";
  Method method = Method::kHeun;
  Vec2 drift = Vec2(0.25, -1);
  std::string map;
  std::vector<double> gains = {1, 2.5};
  std::vector<Vec2> points;
  std::vector<Layer> layers = {{100, 3}};
  std::optional<double> limit;
  std::optional<Layer> extra;
  std::vector<double> courses = {0.1};
  friend bool operator==(const FakeOptions&, const FakeOptions&) = default;
};

Fields<FakeOptions> fake_fields();

/// Kinds for all roles of a scenario, its defaults among them: FakeOptions belong to the
/// estimator "joint" and the plant "kinematic", the estimator "qkf" has one key, the rest
/// have none.
KindTable fake_kinds();

struct QkfOptions {
  double gain = 1;
};

}  // namespace skein::scenario::test
