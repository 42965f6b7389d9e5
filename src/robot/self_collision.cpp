// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "fcl_prob/self_collision.h"

#include <fcl/narrowphase/collision.h>

#include <algorithm>
#include <map>
#include <set>

#include "fcl_prob/exceptions.h"
#include "fcl_prob/monte_carlo.h"
#include "robot/body_balls.h"

namespace fcl_prob {
namespace {

using detail::Ball;

/// Which pairs of links are no matter of self-collision.
class TouchingLinks {
 public:
  TouchingLinks(const Robot& robot, const std::vector<LinkPair>& allowed) : robot_(robot) {
    const auto& links = robot.links();
    for (std::size_t i = 0; i < links.size(); ++i) {
      index_[links[i].name] = i;
      const RobotLink& link = links[i];
      rigid_.push_back(
          link.parent < 0 || link.moves ? i : rigid_[static_cast<std::size_t>(link.parent)]);
    }
    for (const LinkPair& pair : allowed) allowed_.insert(ordered(of(pair.first), of(pair.second)));
  }

  bool mayTouch(const RobotBody& x, const RobotBody& y) const {
    const std::size_t a = of(x.link), b = of(y.link);
    if (rigid_[a] == rigid_[b]) return true;
    if (!x.object.empty() || !y.object.empty()) return namesAsTouched(x, y) || namesAsTouched(y, x);
    const auto& links = robot_.links();
    if (links[a].parent == static_cast<int>(b) || links[b].parent == static_cast<int>(a)) {
      return true;
    }
    return allowed_.count(ordered(a, b)) > 0;
  }

 private:
  using Indices = std::pair<std::size_t, std::size_t>;

  static Indices ordered(std::size_t a, std::size_t b) { return std::minmax(a, b); }

  std::size_t of(const std::string& link) const {
    const auto found = index_.find(link);
    if (found == index_.end()) throw InvalidRequest(robot_.name() + " has no link " + link);
    return found->second;
  }

  bool namesAsTouched(const RobotBody& object, const RobotBody& other) const {
    if (object.object.empty() || !other.object.empty()) return false;
    for (const AttachedObject& attached : robot_.attached()) {
      const auto& links = attached.touch_links;
      if (attached.name == object.object) {
        return std::find(links.begin(), links.end(), other.link) != links.end();
      }
    }
    return false;
  }

  const Robot& robot_;
  std::map<std::string, std::size_t> index_;
  std::vector<std::size_t> rigid_;  ///< the first link that each one is fixed to
  std::set<Indices> allowed_;
};

/// Balls contain their bodies; widened once more by what comparing them rounds.
bool areApart(const Ball& x, const Ball& y) {
  const double size = x.centre.norm() + y.centre.norm() + x.radius + y.radius;
  return (x.centre - y.centre).norm() > x.radius + y.radius + 1e-12 * size;
}

}  // namespace

struct SelfCollision::Implementation {
  Implementation(const Robot& the_robot, const std::vector<LinkPair>& allowed) : robot(the_robot) {
    const auto& bodies = robot.bodies();
    for (const RobotBody& body : bodies) {
      balls.push_back(detail::ballAround({body.geometry, "a body of " + body.name()}));
    }
    const TouchingLinks touching(robot, allowed);
    for (std::size_t i = 0; i < bodies.size(); ++i) {
      for (std::size_t j = i + 1; j < bodies.size(); ++j) {
        if (touching.mayTouch(bodies[i], bodies[j])) continue;
        requireSupported(bodies[i], bodies[j]);
        pairs.push_back({i, j});
      }
    }
  }

  static void requireSupported(const RobotBody& x, const RobotBody& y) {
    if (fclSupportsPair(*x.geometry, *y.geometry)) return;
    throw UnsupportedGeometry("fcl::collide does not support a body of " + x.name() +
                              " with one of " + y.name());
  }

  /// Calls `found` with each pair that touches, until it returns false.
  template <typename Found>
  void look(const std::vector<fcl::Transform3d>& poses, const Found& found) const {
    std::vector<Ball> placed;
    for (std::size_t i = 0; i < poses.size(); ++i) placed.push_back(balls[i].placed(poses[i]));
    const auto& bodies = robot.bodies();
    for (const BodyPair& pair : pairs) {
      const std::size_t i = pair.first, j = pair.second;
      if (areApart(placed[i], placed[j])) continue;
      fcl::CollisionResultd result;
      fcl::collide(bodies[i].geometry.get(), poses[i], bodies[j].geometry.get(), poses[j],
                   fcl::CollisionRequestd(), result);
      if (result.isCollision() && !found(pair)) return;
    }
  }

  Robot robot;
  std::vector<BodyPair> pairs;
  std::vector<Ball> balls;  ///< of the bodies, in their frames
};

SelfCollision::SelfCollision(const Robot& robot, const std::vector<LinkPair>& allowed)
    : implementation_(std::make_shared<const Implementation>(robot, allowed)) {}

const Robot& SelfCollision::robot() const { return implementation_->robot; }
const std::vector<BodyPair>& SelfCollision::pairs() const { return implementation_->pairs; }

bool SelfCollision::collides(const Eigen::VectorXd& values) const {
  robot().requireWithinLimits(values);
  return collidesAt(robot().poses(values));
}

bool SelfCollision::collidesAt(const std::vector<fcl::Transform3d>& poses) const {
  bool any = false;
  implementation_->look(poses, [&any](const BodyPair&) {
    any = true;
    return false;
  });
  return any;
}

std::vector<BodyPair> SelfCollision::collisions(const Eigen::VectorXd& values) const {
  robot().requireWithinLimits(values);
  std::vector<BodyPair> touching;
  implementation_->look(robot().poses(values), [&touching](const BodyPair& pair) {
    touching.push_back(pair);
    return true;
  });
  return touching;
}

}  // namespace fcl_prob
