// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "app/plan/arguments.h"
#include "app/plan/input.h"
#include "skein/data/airspace/airspace.h"
#include "skein/exchange/table/document.h"

namespace skein::app {

/// A document with what all plans have in common: title, frame, zones, obstacles.
exchange::Document document_of(const std::string& title, const ReadSetting& setting,
                               bool has_altitude, const Airspace& airspace);

/// Adds the facts that all plans have: times, lengths, airspeed, turn radius, wind.
void add_facts(exchange::Document& document, const ReadSetting& setting);

/// Adds flights that have elements as "aircraft 1"... ("flight" if there is one only),
/// and marks where each starts.
void add_flights(exchange::Document& document, const std::vector<FlightPlan>& plans);

/// Says why there is no plan; with --json as a document with the members of `about`.
/// @returns `status`.
int say_no_plan(const std::string& outcome, const std::string& reason,
                const nlohmann::ordered_json& about, const PlanOutput& output,
                int status);

}  // namespace skein::app
