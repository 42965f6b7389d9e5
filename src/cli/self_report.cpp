// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "cli/self_report.h"

#include <map>

#include "cli/json_values.h"
#include "cli/number_text.h"

namespace fcl_prob::cli {

std::vector<TouchingBodies> selfCollisionsOf(const SelfCollision& self,
                                             const std::vector<Eigen::VectorXd>& waypoints) {
  std::vector<TouchingBodies> touching;
  std::map<std::pair<std::size_t, std::size_t>, std::size_t> known;
  const auto& bodies = self.robot().bodies();
  for (std::size_t i = 0; i < waypoints.size(); ++i) {
    for (const BodyPair& pair : self.collisions(waypoints[i])) {
      const auto [entry, is_new] = known.try_emplace({pair.first, pair.second}, touching.size());
      if (is_new) touching.push_back({i, 0, bodies[pair.first].name(), bodies[pair.second].name()});
      ++touching[entry->second].waypoints;
    }
  }
  return touching;
}

nlohmann::ordered_json jsonOf(const std::vector<TouchingBodies>& touching) {
  nlohmann::ordered_json json = nlohmann::ordered_json::array();
  for (const TouchingBodies& pair : touching) {
    json.push_back({{"bodies", {pair.first, pair.second}},
                    {"first_waypoint", pair.waypoint},
                    {"waypoints", pair.waypoints}});
  }
  return json;
}

std::string textOf(const std::vector<TouchingBodies>& touching) {
  std::string text;
  for (const TouchingBodies& pair : touching) {
    text += "the robot collides with itself: " + pair.first + " and " + pair.second + " at " +
            std::to_string(pair.waypoints) + " waypoints, first at " +
            std::to_string(pair.waypoint) + "\n";
  }
  return text;
}

nlohmann::ordered_json touchesItselfJson(const ProbabilityResult& result) {
  return {{"estimate", orNull(result.estimate)},
          {"standard_error", orNull(result.standard_error)},
          {"confidence_interval", orNull(result.confidence_interval)},
          {"samples", result.statistics.samples},
          {"hits", result.statistics.hits},
          {"status", toString(result.status)}};
}

std::string touchesItselfText(const ProbabilityResult& result) {
  return "P that it touches itself: " + numberText(result.estimate.value(), 4) +
         ", confidence interval " + intervalText(result.confidence_interval.value()) + ", " +
         std::to_string(result.statistics.samples) + " samples\n";
}

}  // namespace fcl_prob::cli
