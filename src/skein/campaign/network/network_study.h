// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "skein/base/result.h"
#include "skein/campaign/monitoring/monitoring_study.h"

namespace skein::campaign {

/// Experiments with the radio medium alone.
enum class NetworkExperiment {
  kGrid,    ///< nodes on a grid send to their neighbours, [Selecky18] 6.4.3
  kCell,    ///< stations in reach of each other always have something to send
  kHidden,  ///< two that do not hear each other send to one between them
};

/// Which networks are simulated: every number of nodes, with every profile, with basic
/// access and with RTS/CTS, for every seed.
struct NetworkStudy {
  NetworkExperiment experiment = NetworkExperiment::kGrid;
  std::vector<std::uint32_t> nodes;
  std::vector<std::string> profiles;  ///< of radios: names or files
  int first_seed = 1;
  int seeds = 3;
  double duration = 0;  ///< of each case [s]
};

/// The experiment with its own networks: those of the reference, and larger ones.
NetworkStudy default_network_study(NetworkExperiment experiment);

/// What happens before this does not count [s]: queues that are still empty.
double warm_up_of(NetworkExperiment experiment);

/// One network of a study.
struct NetworkStudyCase {
  std::uint32_t nodes = 0;
  std::string profile;
  bool rts = false;
  std::uint64_t seed = 0;
};

struct NetworkStudyPlan {
  StudyPlan plan;
  std::vector<NetworkStudyCase> cases;  ///< one for each item of the plan

  const NetworkStudyCase& of(const StudyCell& cell) const {
    return cases[cell.items.front()];
  }
};

/// All cases of the study. Items have no scenario but its seed; their text is the
/// caller's to give.
/// Fails: kBadInput when nodes or profiles are named twice, there are fewer than two
///        nodes or more than 2500, or the case ends before its warm-up does.
Result<NetworkStudyPlan> plan_network_study(const NetworkStudy& study);

/// Names of the figures of a case, as runs.csv has them.
namespace network_figure {
inline constexpr const char* kDelayMean = "delay_mean_ms";
inline constexpr const char* kDelayP95 = "delay_p95_ms";
inline constexpr const char* kLoss = "loss_percent";
inline constexpr const char* kGoodput = "goodput_kbps";
inline constexpr const char* kCollisions = "collision_ratio";
inline constexpr const char* kCpu = "cpu_s";
inline constexpr const char* kSimulated = "simulated_s";
/// Of Bianchi's model: messages repeated for ever, and as the profile says.
inline constexpr const char* kBianchiGoodput = "bianchi_goodput_kbps";
inline constexpr const char* kBianchiFiniteGoodput = "bianchi_finite_goodput_kbps";
inline constexpr const char* kBianchiCollisions = "bianchi_collision_ratio";
}  // namespace network_figure

}  // namespace skein::campaign
