// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// A plan as files that `fcl_prob path` reads, and as text for people.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "fcl_prob/certified_planning.h"
#include "fcl_prob/timed_planning.h"

namespace fcl_prob::cli {

/// What was planned, with the robot's joints by name.
nlohmann::ordered_json planJson(const CertifiedPlan& plan, const Robot& robot);

/// The names of the joints, then a line a waypoint; numbers that read back as the same doubles.
std::string planCsv(const CertifiedPlan& plan, const Robot& robot);

std::string planText(const CertifiedPlan& plan, const Robot& robot);

/// The same of a plan in time: `time`, seconds, comes before the joints.
nlohmann::ordered_json planJson(const TimedPlan& plan, const Robot& robot);
std::string planCsv(const TimedPlan& plan, const Robot& robot);
std::string planText(const TimedPlan& plan, const Robot& robot, double threshold);

}  // namespace fcl_prob::cli
