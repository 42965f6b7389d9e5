// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Batches: every waypoint is the answer of a single query, and the path's bounds are theirs.
#include <sstream>

#include "ask.h"
#include "checks.h"
#include "fcl_prob/fcl_prob.h"
#include "soundness.h"

namespace fcl_prob_audit {

using namespace fcl_prob;

namespace {

BatchResult askBatch(const Scene& scene) {
  const PreparedQuery query(makeGeometry(scene.a.at(0).shape), makeGeometry(scene.b.at(0).shape));
  std::vector<Waypoint> waypoints;
  for (const Displacement& displacement : scene.displacements) {
    waypoints.push_back({scene.a[0].pose, scene.b[0].pose, makeDisplacement(displacement)});
  }
  BatchRequest request;
  request.query = scene.request;
  request.query.threads = 2;
  return collisionProbabilities(query, waypoints, request);
}

Scene waypointOf(const Scene& scene, std::size_t i) {
  Scene single = scene;
  single.question = Question::pair;
  single.displacements = {scene.displacements[i]};
  return single;
}

void comparePath(const Scene& scene, const BatchResult& batch, std::vector<Violation>& found) {
  double largest = 0.0, sum = 0.0;
  for (std::size_t i = 0; i < batch.waypoints.size(); ++i) {
    const Answer single = ask(waypointOf(scene, i));
    checkSound(waypointOf(scene, i), single, found);
    if (!single || !batch.waypoints[i]) continue;
    const ProbabilityResult& expected = *single.result;
    const ProbabilityResult& is = *batch.waypoints[i];
    if (is.lower != expected.lower || is.upper != expected.upper || is.status != expected.status) {
      found.push_back({"waypoint as by itself", textOf(is) + ", by itself " + textOf(expected)});
    }
    largest = std::max(largest, expected.lower.value_or(0.0));
    sum += expected.upper.value_or(1.0);
  }
  std::ostringstream out;
  out.precision(17);
  out << "[" << batch.path.lower << ", " << batch.path.upper << "], largest lower " << largest
      << ", sum of upper " << sum;
  if (batch.path.lower > largest || batch.path.upper < largest ||
      batch.path.upper < std::min(1.0, sum * (1 - 1e-12)) || batch.path.upper > 1.0) {
    found.push_back({"path", out.str()});
  }
}

}  // namespace

void checkBatch(const Scene& scene, Tally& tally, std::vector<Violation>& found) {
  FamilyTally& family = tally.families[scene.family];
  Answer answer;
  guarded(answer, [&] {
    const BatchResult batch = askBatch(scene);
    ++family.answered;
    ++tally.checks["batch"];
    family.non_trivial += batch.path.lower > 1e-3 && batch.path.upper < 0.999;
    comparePath(scene, batch, found);
  });
  if (!answer.foreign_exception.empty()) found.push_back({"exception", answer.foreign_exception});
  if (answer.refusal.empty()) return;
  ++family.refused;
  ++tally.refusals[scene.family + ": " + answer.refusal.substr(0, 70)];
}

}  // namespace fcl_prob_audit
