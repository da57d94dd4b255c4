// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "skein/base/result.h"
#include "skein/campaign/monitoring/monitoring_study.h"
#include "skein/scenario/document.h"

namespace skein::campaign {

/// What is varied on purpose: every variant is a set of changes to the scenario.
struct Axis {
  std::string name;
  std::vector<Variant> variants;
};

/// A key of the scenario whose value every run draws by its seed.
struct DrawnKey {
  std::string key;
  std::vector<double> between;     ///< two numbers: evenly between them
  std::vector<std::string> among;  ///< values: each as likely as the others
};

/// Which of its runs a figure shows besides their mean.
enum class Extreme { kNone, kLeast, kMost };

/// A figure of the runs' summaries that the report is about.
struct CampaignFigure {
  std::string figure;   ///< its name in summary.json
  std::string heading;  ///< of its column, with unit; empty: the name
  int digits = 1;       ///< behind the point
  Extreme extreme = Extreme::kNone;
};

/// A campaign as its file has it: one scenario, flown in every combination of the axes'
/// variants, several seeds each (docs/campaigns.md).
struct CampaignFile {
  std::string name;
  std::vector<std::string> about;      ///< paragraphs
  std::string scenario;                ///< file, absolute
  std::vector<std::string> overrides;  ///< of every run, before all others
  int first_seed = 1;
  int seeds = 5;
  std::vector<Axis> axes;  ///< three at most
  std::vector<DrawnKey> draws;
  std::vector<CampaignFigure> figures;
  scenario::Source source = {};  ///< what it was read from; no key
};

/// The keys of a campaign's file.
const scenario::Document& campaign_document();

/// Fails: kBadInput with every problem that the file has.
Result<CampaignFile> read_campaign(const std::filesystem::path& path);

/// The same of a text; relative paths in it start in `folder`.
Result<CampaignFile> read_campaign_text(std::string_view text, const std::string& name,
                                        const std::filesystem::path& folder);

}  // namespace skein::campaign
