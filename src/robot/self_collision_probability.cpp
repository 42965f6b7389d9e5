// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// How likely a robot touches itself, by counting over errors of its joints.
#include "base/budget.h"
#include "base/refuse_band.h"
#include "base/until_no.h"
#include "fcl_prob/exceptions.h"
#include "fcl_prob/random_configuration.h"
#include "fcl_prob/self_collision.h"
#include "pose/sampled_configuration.h"
#include "sampling/counting_run.h"

namespace fcl_prob {
namespace {

class SelfCollisionRun : public detail::CountingRun {
 public:
  SelfCollisionRun(const SelfCollision& self, const RandomJoints& joints,
                   const ProbabilityRequest& request)
      : CountingRun(request), self_(self), joints_(joints), seed_(request.seed) {}

 private:
  bool collides(std::size_t index) const override {
    const Eigen::VectorXd z = detail::standardNormals({seed_}, index, joints_.dimension());
    return self_.collidesAt(joints_.at(z).poses_a);
  }

  const SelfCollision& self_;
  const RandomJoints& joints_;
  std::uint64_t seed_;
};

}  // namespace

ProbabilityResult SelfCollision::probability(const Eigen::VectorXd& values,
                                             const Eigen::MatrixXd& joint_covariance,
                                             const ProbabilityRequest& request) const {
  validateRequest(request);
  detail::refuseBand(request, "robots");
  const bool counts = request.method == ProbabilityMethod::automatic ||
                      request.method == ProbabilityMethod::monte_carlo;
  if (!counts || request.contact != ContactMeaning::fcl || request.gradient) {
    throw InvalidRequest(
        "a robot against itself is counted: method auto or monte-carlo, contact fcl, no gradient");
  }
  robot().requireWithinLimits(values);
  const auto kinematics = [this](const Eigen::VectorXd& drawn) { return robot().poses(drawn); };
  const RandomJoints joints(values, joint_covariance, kinematics, {}, GaussianDisplacement());
  const ProbabilityRequest of_call = detail::ofOneCall(request);
  detail::Budget budget(of_call);
  ProbabilityResult result = SelfCollisionRun(*this, joints, of_call).result(budget);
  result.method = ProbabilityMethod::monte_carlo;
  result.plan.push_back(
      std::to_string(pairs().size()) +
      " pairs of bodies, counted over errors of the joints; nothing is certified");
  return result;
}

}  // namespace fcl_prob
