// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "query/motion_gradient.h"

#include <string>

#include "fcl_prob/exceptions.h"
#include "gaussian/number_text.h"
#include "montecarlo/sample_loop.h"

namespace fcl_prob {

MemberVelocities rigidMotions(std::size_t members) {
  const auto count = static_cast<Eigen::Index>(members);
  MemberVelocities velocities(members, Eigen::MatrixXd::Zero(6, 6 * count));
  for (Eigen::Index i = 0; i < count; ++i) {
    velocities[static_cast<std::size_t>(i)].middleCols<6>(6 * i).setIdentity();
  }
  return velocities;
}

namespace detail {

void validateVelocities(const MemberVelocities& velocities, std::size_t members) {
  if (velocities.size() != members) {
    throw InvalidRequest("group A has " + std::to_string(members) + " members but " +
                         std::to_string(velocities.size()) + " velocities");
  }
  for (std::size_t i = 0; i < members; ++i) {
    const std::string name = "the velocities of member " + std::to_string(i);
    if (velocities[i].cols() != velocities[0].cols()) {
      throw InvalidRequest(name + " are for " + std::to_string(velocities[i].cols()) +
                           " parameters, those of member 0 for " +
                           std::to_string(velocities[0].cols()));
    }
    if (!velocities[i].allFinite()) throw InvalidRequest(name + " are not finite");
  }
}

void validateGradient(const MotionGradientRequest& request) {
  if (request.lines < 2) {
    throw InvalidRequest("a gradient takes 2 lines at least, not " + std::to_string(request.lines));
  }
  if (request.threads < 1) throw InvalidRequest("threads must be 1 at least");
  if (request.time_limit && !(*request.time_limit > 0.0)) {
    throw InvalidRequest("time_limit must be above 0, is " + numberText(*request.time_limit));
  }
}

LineDraws drawsOf(const MotionGradientRequest& request) {
  LineDraws draws{request.lines, request.seed, request.threads, {}};
  if (!request.time_limit) return draws;
  draws.go_on = [watch = Stopwatch(), limit = *request.time_limit] {
    return watch.seconds() < limit;
  };
  return draws;
}

MotionGradient gradientFrom(const MeanAndError& flux) {
  const Eigen::Index parameters = flux.mean.size() - 1;
  MotionGradient result;
  result.probability = flux.mean[0];
  result.standard_error = flux.standard_error[0];
  result.gradient = flux.mean.tail(parameters);
  result.gradient_standard_error = flux.standard_error.tail(parameters);
  result.lines = flux.lines;
  return result;
}

MotionGradient withoutGradient(Eigen::Index parameters) {
  MotionGradient result;
  result.gradient = result.gradient_standard_error = Eigen::VectorXd::Zero(parameters);
  return result;
}

}  // namespace detail
}  // namespace fcl_prob
