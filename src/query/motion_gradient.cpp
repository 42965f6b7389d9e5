// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "query/motion_gradient.h"

#include <string>

#include "base/number_text.h"
#include "fcl_prob/exceptions.h"

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
  if (request.contact == ContactMeaning::contained) {
    throw InvalidRequest("contact = contained: not of gradients of motions");
  }
  if (request.lines < 2) {
    throw InvalidRequest("a gradient takes 2 lines at least, not " + std::to_string(request.lines));
  }
  if (request.threads < 1) throw InvalidRequest("threads must be 1 at least");
  if (request.time_limit && !(*request.time_limit > 0.0)) {
    throw InvalidRequest("time_limit must be above 0, is " + numberText(*request.time_limit));
  }
}

LimitedLines::LimitedLines(const MotionGradientRequest& request) : request_(request) {
  limits_.time_limit = request.time_limit;
  limits_.on_progress = request.on_progress;
}

LineDraws LimitedLines::draws() {
  LineDraws draws{request_.lines, request_.seed, request_.threads, {}};
  if (!limits_.time_limit && !limits_.on_progress) return draws;
  draws.go_on = [this](std::size_t drawn) { return goOn(drawn); };
  return draws;
}

bool LimitedLines::goOn(std::size_t drawn) {
  const double fraction = static_cast<double>(drawn) / static_cast<double>(request_.lines);
  interruption_ = budget_.look({0.0, 1.0}, fraction);
  return !interruption_;
}

MotionGradient gradientFrom(const MeanAndError& flux, ProbabilityStatus status) {
  const Eigen::Index parameters = flux.mean.size() - 1;
  MotionGradient result;
  result.probability = flux.mean[0];
  result.standard_error = flux.standard_error[0];
  result.gradient = flux.mean.tail(parameters);
  result.gradient_standard_error = flux.standard_error.tail(parameters);
  result.lines = flux.lines;
  result.status = status;
  return result;
}

MotionGradient withoutGradient(Eigen::Index parameters) {
  MotionGradient result;
  result.gradient = result.gradient_standard_error = Eigen::VectorXd::Zero(parameters);
  result.status = ProbabilityStatus::exact;
  return result;
}

}  // namespace detail
}  // namespace fcl_prob
