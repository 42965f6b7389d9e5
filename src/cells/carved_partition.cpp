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

const char* whyNotCarved(const QueryScene& scene, const ProbabilityRequest& request) {
  if (request.method == ProbabilityMethod::estimate) return "";
  if (request.gradient) return "masses of cells along planes have no gradient";
  if (!request.threshold && request.relative_tolerance < kLeastTolerance) {
    return "masses of cells along planes are known to 1e-4";
  }
  if (request.hasBand()) return "planes are of shapes without bands";
  return scene.wholeBody() ? nullptr : kNoWholeBody;
}

Climbed carve(const QueryScene& scene, const ProbabilityRequest& request, Budget& budget,
              ProbabilityResult& result) {
  const WholeBody& whole = *scene.wholeBody();
  const auto& [body, mesh, fan_is_a] = whole;
  if (FatMembers::leastMemory(body, mesh) > request.max_memory / 2) {
    return {false, "no memory for C-obstacles of whole objects"};
  }
  FatMembers obstacles(scene.pair(), body, mesh, fan_is_a, scene.whitening().matrix(),
                       mostLossOf(request));
  if (!obstacles.usable()) return {false, "the convex object is too thin for its planes"};
  for (int member = 0; member < obstacles.count(); ++member) {
    if (mayHoldPart(whole, obstacles.partOf(member), obstacles.of(member))) {
      return {false, "one surface may be within the convex object and not touch it"};
    }
  }
  CarvingEngine engine(obstacles, scene.solids(), request, budget, result.statistics);
  result.method = ProbabilityMethod::interval;
  result.status = engine.run();
  if (obstacles.failed()) return {false, "a triangle is too thin for its planes"};
  const Bounds interval = engine.interval();
  result.lower = interval.lower;
  result.upper = interval.upper;
  std::vector<std::string> notes{
      "partition of the displacement space along the C-obstacles' own planes, " +
          std::to_string(result.statistics.cells) + " cells, " +
          std::to_string(result.statistics.leaf_pairs) + " C-obstacles",
      convexNote(body, obstacles, fan_is_a)};
  if (result.status == ProbabilityStatus::resolution_limit) {
    return {false, notes[0] + "; what is left open is rounding"};
  }
  if (auto note = polygonNote(obstacles, mesh, !fan_is_a)) notes.push_back(std::move(*note));
  if (scene.solids()) notes.emplace_back("containment decided once for every free cell");
  return {true, noteOf(notes)};
}

}  // namespace fcl_prob::detail
