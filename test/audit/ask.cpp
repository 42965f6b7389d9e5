// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "ask.h"

#include <cxxabi.h>
#include <chrono>
#include <iomanip>
#include <sstream>

#include "fcl_prob/fcl_prob.h"

namespace fcl_prob_audit {
namespace {

using namespace fcl_prob;

std::vector<std::shared_ptr<const fcl::CollisionGeometryd>> geometriesOf(
    const std::vector<Member>& members, std::vector<fcl::Transform3d>& poses) {
  std::vector<std::shared_ptr<const fcl::CollisionGeometryd>> result;
  for (const Member& member : members) {
    result.push_back(makeGeometry(member.shape));
    poses.push_back(member.pose);
  }
  return result;
}

void askPair(const Scene& scene, const ProbabilityRequest& request, ProbabilityResult& result) {
  const PreparedQuery query(makeGeometry(scene.a.at(0).shape), makeGeometry(scene.b.at(0).shape));
  const fcl::Transform3d &pose_a = scene.a[0].pose, &pose_b = scene.b[0].pose;
  const GaussianDisplacement first = makeDisplacement(scene.displacements.at(0));
  if (scene.truncation) {
    const TruncatedGaussian truncated(first, *scene.truncation);
    collisionProbability(query, pose_a, pose_b, truncated, request, result);
  } else if (scene.isMixture()) {
    std::vector<GaussianMixture::Component> components;
    for (std::size_t i = 0; i < scene.weights.size(); ++i) {
      components.push_back({scene.weights[i], makeDisplacement(scene.displacements[i])});
    }
    const GaussianMixture mixture(components);
    collisionProbability(query, pose_a, pose_b, mixture, request, result);
  } else {
    query.collisionProbability(pose_a, pose_b, first, request, result);
  }
}

void askGroup(const Scene& scene, const ProbabilityRequest& request, ProbabilityResult& result) {
  std::vector<fcl::Transform3d> poses_a, poses_b;
  const auto a = geometriesOf(scene.a, poses_a), b = geometriesOf(scene.b, poses_b);
  GroupQuery(a, b).collisionProbability(
      poses_a, poses_b, makeDisplacement(scene.displacements.at(0)), request, result);
}

}  // namespace

std::string nameOfException(const std::exception& exception, bool& documented) {
  documented = dynamic_cast<const Exception*>(&exception) != nullptr;
  int status = 0;
  char* const readable = abi::__cxa_demangle(typeid(exception).name(), nullptr, nullptr, &status);
  const std::string name = status == 0 ? readable : typeid(exception).name();
  std::free(readable);
  return name + ": " + exception.what();
}

Answer ask(const Scene& scene) {
  Answer answer;
  ProbabilityRequest request = scene.request;
  bool stopped = false;
  if (scene.cancel_after) {
    request.on_progress = [&](const ProbabilityProgress&) {
      answer.calls_after_stop += stopped;
      stopped = ++answer.progress_calls > *scene.cancel_after;
      return !stopped;
    };
  }
  const auto begin = std::chrono::steady_clock::now();
  guarded(answer, [&] {
    ProbabilityResult result;
    if (scene.question == Question::group) {
      askGroup(scene, request, result);
    } else {
      askPair(scene, request, result);
    }
    answer.result = std::move(result);
  });
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - begin;
  answer.seconds = elapsed.count();
  return answer;
}

std::string textOf(const ProbabilityResult& result) {
  std::ostringstream out;
  out << std::setprecision(17) << toString(result.method) << " " << toString(result.status) << " ["
      << result.lower.value_or(-1.0) << ", " << result.upper.value_or(-1.0) << "]";
  if (result.estimate) {
    out << " estimate " << *result.estimate << " +- " << result.standard_error.value_or(-1.0);
  }
  const Eigen::IOFormat row(17, Eigen::DontAlignCols, ", ", ", ");
  if (result.gradient_lower && result.gradient_upper) {
    out << " gradient in [" << result.gradient_lower->transpose().format(row) << "] to ["
        << result.gradient_upper->transpose().format(row) << "]";
  }
  out << " cells " << result.statistics.cells;
  return out.str();
}

}  // namespace fcl_prob_audit
