// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

#include "app/serve/serve_options.h"
#include "app/serve/task_preview.h"
#include "skein/assemble/world/build.h"
#include "skein/base/result.h"
#include "skein/geo/local_frame.h"
#include "skein/layer/hmi/serve/live_feed.h"
#include "skein/record/store/record_stream.h"
#include "skein/scenario/scenario.h"

namespace skein::serve {

/// What there is to know of a run that does not change.
struct RunFacts {
  std::string description;  ///< JSON, as /api/run has it but for who asks
  assemble::TerrainPatch terrain;
  Time duration;
  double speed = 0;          ///< that it is to have; 0: as fast as it can
  bool recorded = false;     ///< it is over, and is shown again
  std::string name;          ///< of the run
  std::int64_t start_s = 0;  ///< since 1970 [s]
  geo::Geodetic origin;
  /// The kinds of tasks that the page may give.
  std::shared_ptr<const TaskForms> task_forms;
  /// Flies tasks ahead for the page; empty: nobody does.
  std::function<std::unique_ptr<TaskPreviewer>(TaskPreviewer::Answer)> previewer = {};
};

/// @param version  of the program.
/// @param kinds  that the scenario was read with; outlive the page.
RunFacts facts_of(const scenario::Scenario& scenario, const assemble::KindRegistry& kinds,
                  const assemble::Build& ready, const std::string& version);
/// Of a run that is shown again.
/// @param terrain  as it was stored.
RunFacts facts_of(const scenario::Scenario& scenario,
                  const record::RecordStream& recorded, assemble::TerrainPatch terrain);

/// The operator's page of a run, and all that it needs: a server with a thread of its
/// own, the feed of what happens, and what there is to know of the run.
class RunPage {
 public:
  /// Fails: kNotFound or kBadInput for the files of the options, kUnavailable for the
  ///        port.
  static Result<std::unique_ptr<RunPage>> open(const ServeOptions& options,
                                               const RunFacts& facts);
  ~RunPage();

  /// Where a browser finds it.
  std::string place() const;

  /// The listener of the run's records, whose console is to take commands too.
  hmi::LiveFeed& feed() { return *feed_; }

 private:
  RunPage() = default;
  hmi::HttpAnswer answer(const hmi::HttpRequest& request) const;
  nlohmann::ordered_json health(const hmi::Access& access) const;
  bool is_known(std::string_view path) const;

  std::string description_;  // JSON, but for whom it is said to
  std::shared_ptr<const std::string> terrain_;
  std::optional<geo::LocalFrame> frame_;
  std::int64_t start_s_ = 0;
  std::unique_ptr<hmi::LiveHub> hub_;
  std::unique_ptr<hmi::LiveFeed> feed_;
  std::unique_ptr<TaskPreviewer> previewer_;
  std::unique_ptr<hmi::WebServer> server_;
};

}  // namespace skein::serve
