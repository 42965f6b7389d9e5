// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "planning/motion_descent.h"

#include <algorithm>
#include <cmath>
#include <nlopt.hpp>
#include <stdexcept>

#include "fcl_prob/motion_planning.h"
#include "robot/waypoint_steps.h"

namespace fcl_prob::detail {
namespace {

using Waypoints = std::vector<Eigen::VectorXd>;

// The path is divided into so many edges at least.
constexpr double kLeastEdges = 8.0;

// Of the threshold: what the estimate is to come to, and below which it is no longer told apart.
constexpr double kAim = 0.8;
constexpr double kNoDifference = 1e-3;

// More lines are drawn where those before leave open whether P is below the aim, their standard
// error being more than this share of it, up to what a step may take.
constexpr std::size_t kLines = 512;
constexpr std::size_t kMostLines = 16 * kLines;
constexpr double kTold = 0.25;

constexpr int kMostDescentSteps = 30;
constexpr double kLittleDescent = 1e-3;

class MotionDescent {
 public:
  MotionDescent(const RobotQuery& query, const Waypoints& path, const DescentRequest& request)
      : query_(query),
        request_(request),
        path_(divided(path)),
        steps_(stepsBetween(path_, request.largest_step)) {}

  std::optional<Waypoints> run() {
    if (path_.size() < 3 || request_.moving.empty()) return std::nullopt;
    const auto count = static_cast<unsigned>(variables());
    nlopt::opt optimiser(nlopt::LD_MMA, count);
    setLimits(optimiser);
    optimiser.set_min_objective(&MotionDescent::length, this);
    optimiser.add_inequality_constraint(&MotionDescent::excess, this, 0.0);
    optimiser.set_maxeval(kMostDescentSteps);
    optimiser.set_ftol_rel(kLittleDescent);
    std::vector<double> x(count);
    write(path_, x);
    try {
      double least = 0.0;
      optimiser.optimize(x, least);
    } catch (const nlopt::forced_stop&) {
    } catch (const nlopt::roundoff_limited&) {
    } catch (const std::runtime_error&) {  // of the optimiser: what was found so far counts
    }
    return best_;
  }

 private:
  Waypoints divided(const Waypoints& path) const {
    const double longest = jointLength(path) / kLeastEdges;
    if (!(longest > 0.0)) return path;
    Waypoints finer{path.front()};
    for (std::size_t i = 1; i < path.size(); ++i) {
      const Eigen::VectorXd along = path[i] - path[i - 1];
      const double pieces = std::max(1.0, std::ceil(along.norm() / longest - 1e-9));
      for (double k = 1.0; k < pieces; k += 1.0) finer.push_back(path[i - 1] + k / pieces * along);
      finer.push_back(path[i]);
    }
    return finer;
  }

  std::size_t variables() const { return (path_.size() - 2) * request_.moving.size(); }

  void setLimits(nlopt::opt& optimiser) const {
    std::vector<double> lower, upper;
    for (std::size_t i = 1; i + 1 < path_.size(); ++i) {
      for (const Eigen::Index joint : request_.moving) {
        const RobotJoint& limits = query_.robot().joints()[static_cast<std::size_t>(joint)];
        lower.push_back(limits.lower);
        upper.push_back(limits.upper);
      }
    }
    optimiser.set_lower_bounds(lower);
    optimiser.set_upper_bounds(upper);
  }

  void write(const Waypoints& path, std::vector<double>& x) const {
    auto next = x.begin();
    for (std::size_t i = 1; i + 1 < path.size(); ++i) {
      for (const Eigen::Index joint : request_.moving) *next++ = path[i][joint];
    }
  }

  Waypoints pathOf(const std::vector<double>& x) const {
    Waypoints path = path_;
    auto next = x.begin();
    for (std::size_t i = 1; i + 1 < path.size(); ++i) {
      for (const Eigen::Index joint : request_.moving) path[i][joint] = *next++;
    }
    return path;
  }

  void writeGradient(const Waypoints& slopes, std::vector<double>& gradient) const {
    if (!gradient.empty()) write(slopes, gradient);
  }

  /// The sum of the squares of the edges.
  static double length(const std::vector<double>& x, std::vector<double>& gradient, void* data) {
    const auto& self = *static_cast<const MotionDescent*>(data);
    const Waypoints path = self.pathOf(x);
    Waypoints slopes(path.size(), Eigen::VectorXd::Zero(path[0].size()));
    double sum = 0.0;
    for (std::size_t i = 0; i + 1 < path.size(); ++i) {
      const Eigen::VectorXd edge = path[i + 1] - path[i];
      sum += edge.squaredNorm();
      slopes[i] -= 2.0 * edge;
      slopes[i + 1] += 2.0 * edge;
    }
    self.writeGradient(slopes, gradient);
    return sum;
  }

  /// The logarithm of P over what it is to come to; nothing allows more than 0.
  static double excess(const std::vector<double>& x, std::vector<double>& gradient, void* data) {
    auto& self = *static_cast<MotionDescent*>(data);
    if (self.request_.go_on && !self.request_.go_on()) throw nlopt::forced_stop();
    const Waypoints path = self.pathOf(x);
    Waypoints states;
    for (const WaypointStep& step : self.steps_) {
      states.push_back(path[step.from]);
      if (step.fraction == 0.0) continue;
      states.back() += step.fraction * (path[step.from + 1] - path[step.from]);
    }
    const double aim = kAim * self.request_.threshold;
    const JointGradient found = self.gradientAt(states, aim);
    const double p = found.probability + kNoDifference * aim;
    self.note(path, p);
    Waypoints slopes(path.size(), Eigen::VectorXd::Zero(path[0].size()));
    for (std::size_t k = 0; k < self.steps_.size(); ++k) {
      const WaypointStep& step = self.steps_[k];
      const Eigen::VectorXd slope = found.gradient.col(static_cast<Eigen::Index>(k)) / p;
      slopes[step.from] += (1.0 - step.fraction) * slope;
      if (step.fraction > 0.0) slopes[step.from + 1] += step.fraction * slope;
    }
    self.writeGradient(slopes, gradient);
    return std::log(p / aim);
  }

  JointGradient gradientAt(const Waypoints& states, double aim) const {
    MotionGradientRequest lines;
    lines.lines = kLines;
    lines.seed = request_.seed;
    if (request_.go_on) {
      lines.on_progress = [this](const ProbabilityProgress&) { return request_.go_on(); };
    }
    for (;; lines.lines *= 4) {
      const JointGradient found = query_.gradient(states, lines);
      // What is known of few lines is nothing to go by.
      if (found.status == ProbabilityStatus::cancelled) throw nlopt::forced_stop();
      const bool is_open = std::fabs(found.probability - aim) < found.standard_error;
      const bool is_told = !is_open || found.standard_error <= kTold * aim;
      if (is_told || lines.lines >= kMostLines) return found;
    }
  }

  /// The shortest path that came to what was aimed at.
  void note(const Waypoints& path, double probability) {
    if (probability > kAim * request_.threshold) return;
    if (best_ && jointLength(*best_) <= jointLength(path)) return;
    best_ = path;
  }

  const RobotQuery& query_;
  const DescentRequest& request_;
  Waypoints path_;
  std::vector<WaypointStep> steps_;  ///< as many of each edge as at first
  std::optional<Waypoints> best_;
};

}  // namespace

std::optional<Waypoints> descended(const RobotQuery& query, const Waypoints& path,
                                   const DescentRequest& request) {
  return MotionDescent(query, path, request).run();
}

}  // namespace fcl_prob::detail
