// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "cli/parts_scene.h"

#include <map>

#include "base/decision.h"
#include "base/refuse_band.h"
#include "cli/number_text.h"
#include "cli/tree_pair.h"
#include "fcl_prob/exceptions.h"

namespace fcl_prob::cli {

PartVolume partVolumeFromString(const std::string& bounding_volume) {
  static const std::map<std::string, PartVolume> volumes{
      {"sphere", PartVolume::sphere}, {"aabb", PartVolume::aabb},
      {"obb", PartVolume::obb},       {"rss", PartVolume::rss},
      {"obbrss", PartVolume::obbrss}, {"kios", PartVolume::kios},
      {"kdop16", PartVolume::kdop16}, {"kdop18", PartVolume::kdop18},
      {"kdop24", PartVolume::kdop24}, {"kdop26", PartVolume::kdop26},
      {"convex", PartVolume::convex}};
  const auto volume = volumes.find(bounding_volume);
  if (volume == volumes.end()) {
    throw InvalidRequest("unknown bounding volume '" + bounding_volume + "'");
  }
  return volume->second;
}

PartsScene::Object::Object(const LoadedObject& object, PartVolume volume) : pose(object.pose) {
  if (const auto* mesh = std::get_if<TriangleMesh>(&object.shape)) {
    const ConvexParts parts(*mesh);
    for (std::size_t i = 0; i < parts.size(); ++i) bodies.push_back(parts.body(i));
    tree.emplace(parts, volume);
    covers_solid = parts.coversSolid();
  } else {
    bodies.emplace_back(*std::get<PrimitiveShape>(object.shape));
  }
}

PartsScene::PartsScene(const LoadedObject& a, const LoadedObject& b,
                       const GaussianDisplacement& displacement, const std::string& bounding_volume)
    : displacement_(displacement),
      a_(a, partVolumeFromString(bounding_volume)),
      b_(b, partVolumeFromString(bounding_volume)) {}

ProbabilityResult PartsScene::answer(PartsUse use, const ProbabilityRequest& request) const {
  validateRequest(request);
  detail::refuseBand(request, "sums over convex parts");
  if (request.contact == ContactMeaning::solid && !(a_.covers_solid && b_.covers_solid)) {
    throw UnsupportedGeometry(std::string("the parts of ") + (a_.covers_solid ? "B" : "A") +
                              " are proven to cover its surface, but no solid inside");
  }
  return use == PartsUse::bounds ? bothSides(request) : sum(request);
}

ProbabilityResult PartsScene::sum(const ProbabilityRequest& request) const {
  const GeneralPcdRequest pcd_request = pcdRequestOf(
      request, "--leaves: parts are for --method general-pcd and general-pcd-min only");
  if (!a_.tree || !b_.tree) throw UnsupportedGeometry("trees over parts are for two meshes");
  ProbabilityResult result = resultOf(
      generalPcd(*a_.tree, a_.pose, *b_.tree, b_.pose, displacement_, pcd_request), request);
  result.plan.push_back("GeneralPCD over trees of " + std::to_string(a_.bodies.size()) + " and " +
                        std::to_string(b_.bodies.size()) + " convex parts");
  return result;
}

ProbabilityResult PartsScene::bothSides(const ProbabilityRequest& request) const {
  PartsBoundsRequest bounds_request;
  bounds_request.negligible =
      1e-3 * std::min(request.absolute_tolerance, request.threshold.value_or(1.0));
  const PartsBoundsResult parts =
      partsBounds(a_.bodies, a_.pose, b_.bodies, b_.pose, displacement_, bounds_request);
  GeneralPcdResult added;
  added.upper = parts.any.upper;
  added.raw_sum = parts.sum;
  added.leaf_pairs = parts.pairs;
  ProbabilityResult result = resultOf(added, request);
  result.plan.push_back("Hunter's bound on the sum over " + std::to_string(parts.pairs) +
                        " pairs of convex parts, with " + std::to_string(parts.intersections) +
                        " intersections");
  if (!a_.tree && !b_.tree) {
    result.lower = parts.any.lower;
    result.decision = detail::decisionOf({*result.lower, *result.upper}, request);
  } else {
    result.plan.push_back("the parts themselves touch with a probability of at least " +
                          numberText(parts.any.lower, 6) + " (Bonferroni)");
  }
  return result;
}

}  // namespace fcl_prob::cli
