// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// At which waypoints a robot collides with itself, told.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "fcl_prob/self_collision.h"

namespace fcl_prob::cli {

/// Two bodies of the robot that touch.
struct TouchingBodies {
  std::size_t waypoint = 0;   ///< the first at which they do
  std::size_t waypoints = 0;  ///< at how many they do
  std::string first;
  std::string second;
};

/// Every pair once, in the order in which they first touch.
std::vector<TouchingBodies> selfCollisionsOf(const SelfCollision& self,
                                             const std::vector<Eigen::VectorXd>& waypoints);

nlohmann::ordered_json jsonOf(const std::vector<TouchingBodies>& touching);

/// A line a pair; nothing where nothing touches.
std::string textOf(const std::vector<TouchingBodies>& touching);

/// Of P that a robot whose joints have errors touches itself.
nlohmann::ordered_json touchesItselfJson(const ProbabilityResult& result);
std::string touchesItselfText(const ProbabilityResult& result);

}  // namespace fcl_prob::cli
