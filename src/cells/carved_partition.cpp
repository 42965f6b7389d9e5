// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "cells/carved_partition.h"

#include <algorithm>
#include <optional>
#include <string>

#include "cells/carving_engine.h"

namespace fcl_prob::detail {
namespace {

// Masses of cells are not computed to more digits than a tolerance of this needs.
constexpr double kLeastTolerance = 1e-4;

// Planes of polygons may be off by this share of a tolerance, and of one for decisions, in standard
// deviations.
constexpr double kShareOfTolerance = 0.05;
constexpr double kToleranceOfDecision = 1e-3;

double mostLossOf(const ProbabilityRequest& request) {
  const double tolerance = request.threshold ? kToleranceOfDecision : request.relative_tolerance;
  return std::min(WhitenedPolygons::kMostLoss, kShareOfTolerance * tolerance);
}

// Nothing where there are none to be had.
std::optional<std::string> polygonNote(const FatMembers& obstacles, const PartitionObject& mesh,
                                       bool mesh_is_a) {
  const WhitenedPolygons::Held held = obstacles.pieces().held();
  if (held.polygons == 0) return std::nullopt;
  return std::string("object ") + (mesh_is_a ? "A" : "B") + ": of its " +
         std::to_string(mesh.tree->triangles.size()) + " triangles " +
         std::to_string(held.triangles) + " in " + std::to_string(held.polygons) +
         " convex polygons";
}

std::string convexNote(const PartitionObject& body, const FatMembers& obstacles, bool fan_is_a) {
  const std::string name = fan_is_a ? "A" : "B";
  const std::size_t triangles = body.tree->triangles.size();
  const std::string faces = std::to_string(obstacles.faceCount());
  const bool alone = obstacles.count() == 1;
  const std::string left_out = triangles == 0
                                   ? ""
                                   : std::string(", no tree of ") + (alone ? "its " : "their ") +
                                         std::to_string(triangles) + " triangles";
  const auto& parts = body.tree->parts;
  const auto nearly = std::count_if(parts.begin(), parts.end(),
                                    [](const PieceTree::Part& part) { return !part.fan; });
  if (nearly > 0) {
    return std::to_string(nearly) + " of " + std::to_string(parts.size()) + " members of " + name +
           " nearly convex, the others convex: taken between two polytopes, of " + faces +
           " faces together" + left_out;
  }
  if (alone) return "object " + name + " is convex: one piece of " + faces + " faces" + left_out;
  return "the " + std::to_string(obstacles.count()) + " members of " + name +
         " are convex: a piece each, of " + faces + " faces together" + left_out;
}

}  // namespace

bool mayBeCarved(const QueryScene& scene, const ProbabilityRequest& request) {
  if (request.method == ProbabilityMethod::estimate || request.gradient) return false;
  if (!request.threshold && request.relative_tolerance < kLeastTolerance) return false;
  return !request.hasBand() && scene.wholeBody();
}

bool carve(const QueryScene& scene, const ProbabilityRequest& request, Budget& budget,
           ProbabilityResult& result) {
  if (!scene.wholeBody()) return false;
  const WholeBody& whole = *scene.wholeBody();
  const auto& [body, mesh, fan_is_a] = whole;
  if (FatMembers::leastMemory(body, mesh) > request.max_memory / 2) return false;
  FatMembers obstacles(scene.pair(), body, mesh, fan_is_a, scene.whitening().matrix(),
                       mostLossOf(request));
  if (!obstacles.usable()) return false;
  for (int member = 0; member < obstacles.count(); ++member) {
    if (mayHoldPart(whole, obstacles.partOf(member), obstacles.of(member))) return false;
  }
  CarvingEngine engine(obstacles, scene.solids(), request, budget, result.statistics);
  result.method = ProbabilityMethod::interval;
  result.status = engine.run();
  if (obstacles.failed()) return false;
  const Bounds interval = engine.interval();
  result.lower = interval.lower;
  result.upper = interval.upper;
  if (result.status == ProbabilityStatus::resolution_limit) return false;
  result.plan.push_back(convexNote(body, obstacles, fan_is_a));
  result.plan.push_back("partition of the displacement space along the C-obstacles' own planes: " +
                        std::to_string(result.statistics.cells) + " cells, " +
                        std::to_string(result.statistics.leaf_pairs) + " C-obstacles");
  if (const auto note = polygonNote(obstacles, mesh, !fan_is_a)) result.plan.push_back(*note);
  if (scene.solids()) result.plan.push_back("containment decided once for every free cell");
  return true;
}

}  // namespace fcl_prob::detail
