// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>

#include "skein/data/team/task_kinds.h"

// What is to be known of each kind of task beside its description. A kind of one's own
// has such functions beside its struct, where argument-dependent lookup finds them; one
// that has not is right whatever its values are, or takes place at its first place.

namespace skein {

// What is wrong with the values, for people; empty when they say something to fly.
std::string check_task(const Loiter& task);
std::string check_task(const FlyTo& task);
std::string check_task(const FollowEdge& task);
std::string check_task(const FollowLine& task);
std::string check_task(const FlyCourse& task);
std::string check_task(const FlyRoute& task);
std::string check_task(const FollowLeader& task);
std::string check_task(const FlyTour& task);
std::string check_task(const Hold& task);
std::string check_task(const Survey& task);
std::string check_task(const Patrol& task);
std::string check_task(const Orbit& task);
std::string check_task(const Measure& task);
std::string check_task(const Rendezvous& task);
std::string check_task(const Relay& task);
std::string check_task(const FlyPlan& task);
std::string check_task(const ReturnHome& task);
std::string check_task(const LandAt& task);

// Where it takes place, and what it takes of an aircraft.
TaskNeeds needs_of_task(const Loiter& task);
TaskNeeds needs_of_task(const FlyTo& task);
TaskNeeds needs_of_task(const FollowEdge& task);
TaskNeeds needs_of_task(const FollowLine& task);
TaskNeeds needs_of_task(const FlyCourse& task);
TaskNeeds needs_of_task(const FlyRoute& task);
TaskNeeds needs_of_task(const FollowLeader& task);
TaskNeeds needs_of_task(const FlyTour& task);
TaskNeeds needs_of_task(const Hold& task);
TaskNeeds needs_of_task(const Survey& task);
TaskNeeds needs_of_task(const Patrol& task);
TaskNeeds needs_of_task(const Orbit& task);
TaskNeeds needs_of_task(const Measure& task);
TaskNeeds needs_of_task(const Rendezvous& task);
TaskNeeds needs_of_task(const Relay& task);
TaskNeeds needs_of_task(const FlyPlan& task);
TaskNeeds needs_of_task(const ReturnHome& task);
TaskNeeds needs_of_task(const LandAt& task);

/// What is wrong with a place, for people; empty when it is one.
std::string place_error(const Vec2& place);

/// What is wrong with a time that a task takes, for people; empty: nothing.
std::string duration_error(double seconds);

/// What is wrong with points, for people; empty when there are `min` of them at least.
/// @param needs  what is said where there are fewer.
std::string points_error(std::span<const Vec2> points, std::size_t min,
                         const char* needs);

/// Of a task about one point.
/// @param stay  how long it takes there [s].
TaskNeeds needs_at(const Vec2& point, double stay = 0);

/// Of a task without an end.
TaskNeeds endless(TaskNeeds needs);

}  // namespace skein
