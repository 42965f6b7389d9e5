// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "cli/prepared_scene.h"

#include "cli/stopwatch.h"

namespace fcl_prob::cli {

PreparedScene::PreparedScene(const Scene& scene, const std::string& bounding_volume)
    : PreparedScene(loadObject(scene.a), loadObject(scene.b), scene.displacement, bounding_volume) {
}

PreparedScene::PreparedScene(LoadedObject a, LoadedObject b,
                             const GaussianDisplacement& displacement,
                             const std::string& bounding_volume)
    : a_(std::move(a)), b_(std::move(b)), displacement_(displacement) {
  const Stopwatch watch;
  query_ = std::make_unique<PreparedQuery>(buildGeometry(a_, bounding_volume),
                                           buildGeometry(b_, bounding_volume));
  build_ms_ = watch.milliseconds();
}

TimedResult PreparedScene::query(const ProbabilityRequest& request) const {
  TimedResult timed;
  const Stopwatch watch;
  query_->collisionProbability(a_.pose, b_.pose, displacement_, request, timed.result);
  timed.time_ms = watch.milliseconds();
  return timed;
}

NominalAnswer PreparedScene::nominal() const {
  constexpr const char* kVolume = "obbrss";
  return nominalAnswer(buildGeometry(a_, kVolume), a_.pose, buildGeometry(b_, kVolume), b_.pose,
                       displacement_.mean());
}

bool stoppedByLimit(ProbabilityStatus status) {
  switch (status) {
    case ProbabilityStatus::time_limit:
    case ProbabilityStatus::cell_limit:
    case ProbabilityStatus::memory_limit:
    case ProbabilityStatus::resolution_limit:
    case ProbabilityStatus::cancelled:
      return true;
    default:
      return false;
  }
}

}  // namespace fcl_prob::cli
