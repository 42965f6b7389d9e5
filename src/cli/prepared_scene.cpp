// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "cli/prepared_scene.h"

#include <algorithm>
#include <future>

#include "base/decision.h"
#include "base/stopwatch.h"
#include "base/until_no.h"
#include "fcl_prob/group.h"
#include "io/import_notes.h"

namespace fcl_prob::cli {
namespace {

/// The volumes whose trees fcl::distance can walk, and the narrowest of them.
constexpr const char* kMeasuring = "obbrss";

const TriangleMesh& requiredMesh(const LoadedObject& object) {
  const auto* mesh = std::get_if<TriangleMesh>(&object.shape);
  if (mesh == nullptr) {
    throw InvalidRequest("--bv: sphere, kdop26 and convex are for two meshes only");
  }
  return *mesh;
}

/// The tree over a mesh, built on another thread; not valid without a mesh.
std::future<Geometry> treeBeside(const std::optional<TriangleMesh>& mesh,
                                 const std::string& bounding_volume) {
  if (!mesh) return {};
  return std::async(std::launch::async, [&] { return buildTree(*mesh, bounding_volume); });
}

}  // namespace

PreparedScene::PreparedScene(const Scene& scene, const std::string& bounding_volume, PartsUse parts)
    : PreparedScene(loadObject(scene.a), loadObject(scene.b), scene.displacement, bounding_volume,
                    parts, scene.pose_error) {}

PreparedScene::PreparedScene(LoadedObject a, LoadedObject b,
                             const GaussianDisplacement& displacement,
                             const std::string& bounding_volume, PartsUse parts,
                             const std::optional<PoseError>& pose_error)
    : a_(std::move(a)),
      b_(std::move(b)),
      displacement_(displacement),
      pose_error_(pose_error),
      use_of_parts_(parts) {
  const detail::Stopwatch watch;
  std::future<Geometry> possible_a, possible_b;
  if (a_.possible || b_.possible) {
    if (pose_error || parts != PartsUse::none || isOwnVolume(bounding_volume)) {
      throw InvalidRequest("a reconstructed cloud: not for parts, own volumes and errors of poses");
    }
    possible_a = treeBeside(a_.possible, bounding_volume);
    possible_b = treeBeside(b_.possible, bounding_volume);
  }
  const auto build = [&] {
    geometry_a_ = buildGeometry(a_, bounding_volume);
    geometry_b_ = buildGeometry(b_, bounding_volume);
    measures_distance_ = bounding_volume == kMeasuring;
  };
  if (pose_error) {
    if (parts != PartsUse::none || isOwnVolume(bounding_volume)) {
      throw InvalidRequest(
          "--leaves parts, methods with parts and --bv sphere, kdop26 and convex are not for "
          "errors "
          "of poses");
    }
    build();
    pose_query_ = std::make_unique<PreparedPoseQuery>(geometry_a_, geometry_b_);
  } else if (parts != PartsUse::none) {
    parts_ = std::make_unique<PartsScene>(a_, b_, displacement_, bounding_volume);
  } else if (isOwnVolume(bounding_volume)) {
    own_trees_ = makeTreePair(bounding_volume, requiredMesh(a_), requiredMesh(b_));
  } else {
    build();
    query_ = std::make_unique<PreparedQuery>(geometry_a_, geometry_b_);
  }
  if (a_.possible || b_.possible) {
    possible_query_ =
        std::make_unique<PreparedQuery>(possible_a.valid() ? possible_a.get() : geometry_a_,
                                        possible_b.valid() ? possible_b.get() : geometry_b_);
  }
  build_ms_ = watch.milliseconds();
}

std::vector<std::string> PreparedScene::importNotes(const ProbabilityRequest& request,
                                                    const ProbabilityResult& result) const {
  std::vector<std::string> notes;
  const double probability = result.upper ? *result.upper : result.estimate.value_or(1.0);
  for (const auto& [name, object] : {std::pair("A", &a_), std::pair("B", &b_)}) {
    const auto* mesh = std::get_if<TriangleMesh>(&object->shape);
    if (mesh == nullptr) continue;
    notes.insert(notes.end(), mesh->notes.begin(), mesh->notes.end());
    const auto note = detail::precisionNote(
        std::string("the file of ") + name + " is", mesh->coordinate_error,
        detail::leastDeviation(displacement_), request.toleranceAt(probability));
    if (note) notes.push_back(*note);
  }
  return notes;
}

TimedResult PreparedScene::query(const ProbabilityRequest& request) const {
  TimedResult timed;
  const detail::Stopwatch watch;
  if (pose_query_) {
    pose_query_->collisionProbability(a_.pose, b_.pose, *pose_error_, request, timed.result);
  } else if (parts_) {
    timed.result = parts_->answer(use_of_parts_, request);
  } else if (own_trees_) {
    timed.result = boundByOwnTrees(request);
  } else {
    timed.result = betweenTwo(request);
  }
  timed.time_ms = watch.milliseconds();
  addImportNotes(request, timed.result);
  return timed;
}

void PreparedScene::addImportNotes(const ProbabilityRequest& request,
                                   ProbabilityResult& result) const {
  for (std::string& note : importNotes(request, result)) result.plan.push_back(std::move(note));
}

TimedResult PreparedScene::certified(const ProbabilityRequest& request,
                                     std::ostream& certificate) const {
  if (!query_ || possible_query_) {
    throw InvalidRequest(
        "no certificate with parts, --bv sphere, kdop26 and convex, errors of poses or "
        "reconstructed clouds");
  }
  TimedResult timed;
  const detail::Stopwatch watch;
  GroupQuery({geometry_a_}, {geometry_b_})
      .certifiedProbability({a_.pose}, {b_.pose}, displacement_, request, certificate,
                            timed.result);
  timed.time_ms = watch.milliseconds();
  addImportNotes(request, timed.result);
  return timed;
}

ProbabilityResult PreparedScene::betweenTwo(const ProbabilityRequest& request) const {
  ProbabilityResult result;
  if (!possible_query_) {
    query_->collisionProbability(a_.pose, b_.pose, displacement_, request, result);
    return result;
  }
  ProbabilityRequest of_one = detail::ofOneCall(request);
  of_one.gradient = false;
  query_->collisionProbability(a_.pose, b_.pose, displacement_, of_one, result);
  if (!result.lower || !result.upper || result.estimate) {
    throw InvalidRequest("a reconstructed cloud is for methods auto and interval");
  }
  if (a_.possible_is_solid || b_.possible_is_solid) of_one.contact = ContactMeaning::solid;
  ProbabilityResult possible;
  possible_query_->collisionProbability(a_.pose, b_.pose, displacement_, of_one, possible);
  if (stoppedByLimit(possible.status)) result.status = possible.status;
  result.upper = std::max(*result.lower, *possible.upper);
  result.statistics.cells += possible.statistics.cells;
  result.decision = detail::decisionOf({*result.lower, *result.upper}, request);
  const auto of_both = detail::satisfied({*result.lower, *result.upper}, request);
  if (of_both == ProbabilityStatus::decided) {
    result.status = *of_both;
  } else if (!of_both && !stoppedByLimit(result.status)) {
    // Each of the two is as narrow as asked for, or decided: what is between them was not seen.
    result.status = ProbabilityStatus::band_limit;
  }
  result.plan.push_back(
      "lower bound by the surface that was seen, upper bound by what may be there");
  return result;
}

ProbabilityResult PreparedScene::boundByOwnTrees(const ProbabilityRequest& request) const {
  const GeneralPcdRequest pcd_request =
      pcdRequestOf(request, "--bv: sphere, kdop26 and convex are for --method general-pcd only");
  validateRequest(request);
  return resultOf(own_trees_(a_.pose, b_.pose, displacement_, pcd_request), request);
}

NominalAnswer PreparedScene::nominal() const {
  const Geometry a = measures_distance_ ? geometry_a_ : buildGeometry(a_, kMeasuring);
  const Geometry b = measures_distance_ ? geometry_b_ : buildGeometry(b_, kMeasuring);
  const fcl::Transform3d pose =
      pose_error_ ? displacedPose(a_.pose, pose_error_->convention(), pose_error_->mean())
                  : a_.pose;
  const Eigen::Vector3d mean = pose_error_ ? Eigen::Vector3d::Zero() : displacement_.mean();
  return nominalAnswer(a, pose, b, b_.pose, mean);
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
