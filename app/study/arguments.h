// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace skein::app {

/// How aircraft keep apart in the study `avoidance`.
struct AvoidanceArguments {
  std::string method = "auto";
  std::string plant = "path";
  double loss = 0, delay = 0;      ///< of messages; [s]
  double range = 0;                ///< of radio and traffic sensors [m]; 0: their own
  std::string tracks = "perfect";  ///< of intruders
  std::string room = "moving";     ///< of intruders, that is kept free
  std::string deal = "sum";        ///< that two agree on
  std::string turbulence = "none";
  std::string separation = "team";  ///< by name
  std::vector<double> wind;  ///< speed [m/s] and direction [deg] that it comes from
};

struct StudyArguments {
  std::filesystem::path out;  ///< empty = runs/study-NAME[-EXPERIMENT]
  std::optional<int> seeds;   ///< none: the study's own number
  int first_seed = 1;
  int threads = 2;
  std::vector<std::string> cases, estimators, strategies;  ///< empty = all
  std::vector<std::string> overrides;
  std::vector<std::string> plugins, trusted;
  std::string cases_file, updates_file;  ///< estimators: CSV in, CSV on standard output
  std::string data;                      ///< bridge: folder of the recorded fire
  std::vector<std::string> gains;        ///< tuning: files of gains
  int search = 0;                        ///< tuning: gains to try; 0 = no search
  std::string experiment;             ///< network: grid, cell, hidden, mixed or obstacle
  std::vector<std::uint32_t> nodes;   ///< network: empty = the experiment's own
  std::vector<std::string> profiles;  ///< network: empty = the experiment's own
  std::optional<double> duration;     ///< network: of each case [s]
  AvoidanceArguments avoidance;
  bool records = false;  ///< avoidance: keep those of all cases
};

}  // namespace skein::app
