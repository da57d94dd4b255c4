// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "skein/base/result.h"
#include "skein/base/time.h"
#include "skein/link/impairment/impairment_schedule.h"
#include "skein/scenario/document.h"

namespace skein::assemble {

/// An outage at a given time.
struct RelayOutage {
  Time from, until = Time::from_seconds(4e6);
};

/// What a relay does to a connection, as its file has it; docs/relay.md.
struct RelayProfile {
  std::string name, description;
  impairment::Impairment both;
  impairment::ImpairmentChange to_b, to_a;  ///< what is different one way
  std::vector<RelayOutage> outages;
  double outages_per_hour = 0;
  double outage_mean = 20;  ///< [s]
  std::vector<impairment::TimedChange> changes;
};

/// A profile from a file, or the defaults without one, changed by overrides
/// (`to_b.loss=0.1`).
///
/// Fails: no such file; everything that is wrong with it, in one message of several
///        lines.
Result<RelayProfile> load_relay_profile(const std::filesystem::path& file,
                                        const std::vector<std::string>& overrides);

/// A profile from the text of a file, which messages call `name`.
Result<RelayProfile> read_relay_profile(std::string_view text, const std::string& name);

/// The profile as a file with every key written out; reading that gives the same.
std::string write_relay_profile(const RelayProfile& profile);

impairment::ImpairmentPlan plan_of(const RelayProfile& profile);

/// The key of something that a stream cannot suffer: loss, duplicate or reorder. None
/// where it is 0 or not given.
std::optional<std::string> packet_key_of(const impairment::ImpairmentChange& change);

/// Whether a profile can be that of a stream.
/// Fails: kBadInput, naming the key that says otherwise, such as `changes[2].loss`.
Result<void> check_for_streams(const RelayProfile& profile);

/// What profiles look like, for their JSON Schema and documentation.
const scenario::Document& relay_document();

}  // namespace skein::assemble
