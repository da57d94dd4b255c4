// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "skein/role/path_planner.h"

namespace skein::solve::test {

/// A scene of planning/scenes.json of the shared data.
struct Scene {
  std::string name;
  Airspace airspace;
  PathQuery query;  ///< its airspace is that of the scene once `link` was called
  void link() { query.airspace = &airspace; }
};

inline std::string scenes_file() {
  return std::string(SKEIN_SHARED_DATA) + "/planning/scenes.json";
}

/// Empty where the file is missing. The file counts x east, y north, angles from east
/// counter-clockwise.
inline std::vector<Scene> read_scenes(const std::string& file) {
  std::vector<Scene> scenes;
  if (!std::filesystem::exists(file)) return scenes;
  std::ifstream in(file);
  const auto json = nlohmann::json::parse(in);
  const auto state = [](const std::vector<double>& v) {
    return FlightState{Vec3(v[1], v[0], -100), geo::kPi / 2 - v[2]};
  };
  for (const auto& s : json["scenes"]) {
    Scene scene;
    scene.name = s["name"].get<std::string>();
    for (const auto& c : s["circles"]) {
      const auto v = c.get<std::vector<double>>();
      scene.airspace.zones.push_back({Disc{Vec2(v[1], v[0]), v[2]}});
    }
    scene.query.start = state(s["start"].get<std::vector<double>>());
    scene.query.goal = state(s["goal"].get<std::vector<double>>());
    scene.query.limits.airspeed = 20;
    scene.query.limits.turn_radius = s["turn_radius"].get<double>();
    scene.query.south_west = Vec2(0, 0);
    scene.query.north_east = Vec2::Constant(s["size"].get<double>());
    scenes.push_back(scene);
  }
  for (Scene& scene : scenes) scene.link();
  return scenes;
}

}  // namespace skein::solve::test
