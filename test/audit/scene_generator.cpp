// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "scene_generator.h"

#include <cmath>
#include <limits>

#include "random_shape.h"

namespace fcl_prob_audit {
namespace {

using fcl_prob::ContactMeaning;
using fcl_prob::ProbabilityMethod;
using fcl_prob::ProbabilityRequest;

class Generator {
 public:
  Generator(unsigned seed, const Family& family, Scene& scene)
      : random_(seed), family_(family), traits_(family.traits), scene_(scene) {}

  void run() {
    grid_ = chance(random_, traits_.on_grid);
    size_b_ = random_.logUniform(0.2, 1.0);
    nested_ = chance(random_, traits_.smaller);
    size_a_ = nested_ ? size_b_ * random_.logUniform(0.02, 0.4) : random_.logUniform(0.2, 1.0);
    scene_.question = family_.question;
    makeDisplacements();
    makeMembers();
    if (scene_.question == Question::manager) makeManager();
    placeAll();
    makeRequest();
    if (family_.limited) makeLimits();
    goFar();
    if (traits_.scale_exponent > 0) {
      scaleScene(scene_, random_.integer(-traits_.scale_exponent, traits_.scale_exponent));
    }
    if (scene_.question == Question::pair && chance(random_, 0.5)) swapSides();
  }

 private:
  void makeDisplacements() {
    const double size = std::max(size_a_, size_b_);
    int count = 1;
    if (family_.mixture || scene_.question == Question::batch) count = random_.integer(1, 8);
    if (scene_.question == Question::manager) count = 2;
    for (int i = 0; i < count; ++i) {
      const bool again = family_.mixture && i > 0 && chance(random_, 0.3);
      scene_.displacements.push_back(again ? scene_.displacements.back()
                                           : randomDisplacement(random_, traits_, size));
    }
    if (family_.truncated) scene_.truncation = random_.logUniform(0.2, 6.0);
    if (!family_.mixture) return;
    double sum = 0.0;
    for (int i = 0; i < count; ++i) {
      scene_.weights.push_back(chance(random_, 0.1) ? 0.0 : random_.uniform(0.05, 1.0));
      sum += scene_.weights.back();
    }
    if (sum == 0.0) scene_.weights[0] = sum = 1.0;
    for (double& weight : scene_.weights) weight /= sum;
  }

  Member newMember(const std::vector<Kind>& kinds, double size) {
    Member member;
    member.shape = randomShape(random_, traits_, anyOf(random_, kinds), size);
    if (!grid_) member.pose.linear() = randomOrientation(random_, traits_);
    return member;
  }

  /// Some of them with the shape of one before, or in its place, too.
  std::vector<Member> newGroup(const std::vector<Kind>& kinds, double size, int count) {
    std::vector<Member> group;
    for (int i = 0; i < count; ++i) {
      if (i > 0 && chance(random_, 0.3)) {
        group.push_back(group.back());
        if (chance(random_, 0.5)) group.back().pose.linear() = random_.rotation();
      } else {
        group.push_back(newMember(kinds, size));
      }
    }
    return group;
  }

  void makeMembers() {
    const bool several = scene_.question == Question::group;
    const bool managed = scene_.question == Question::manager;
    scene_.a = newGroup(traits_.kinds_a, size_a_, several ? random_.integer(1, 3) : 1);
    scene_.b = newGroup(traits_.kinds_b, size_b_,
                        managed   ? random_.integer(2, 6)
                        : several ? random_.integer(1, 3)
                                  : 1);
    if (several && chance(random_, 0.15)) {
      scene_.b.push_back(newMember({Kind::halfspace, Kind::plane}, size_b_));
    }
  }

  void makeManager() {
    ManagerQuestion& manager = scene_.manager;
    manager.kind = static_cast<ManagerKind>(random_.integer(0, kManagers - 1));
    manager.within = chance(random_, 0.3);
    manager.culling_probability = chance(random_, 0.5) ? 1e-12 : random_.logUniform(1e-12, 0.3);
    for (int i = 0; i < static_cast<int>(scene_.b.size()); ++i) {
      if (chance(random_, 0.1)) manager.registered_twice.push_back(i);
    }
    // FCL 0.7 itself reads an unset iterator where the boxes in its trees or tables are infinite.
    const bool takes_infinite = manager.kind <= ManagerKind::interval_tree;
    for (Member& member : scene_.b) {
      if (member.shape.isUnbounded() && !takes_infinite) manager.kind = ManagerKind::naive;
    }
  }

  /// In deviations: near enough for any P, sometimes far out.
  double whitenedLength() {
    const double kind = random_.uniform(0, 1);
    if (kind < 0.45) return random_.uniform(0.0, 1.5);
    if (kind < 0.75) return random_.uniform(1.0, 4.0);
    if (kind < 0.95) return random_.uniform(3.0, 12.0);
    return random_.uniform(10.0, 45.0);
  }

  /// What has to be added to A so that a point of it is on one of B at a displacement of a chosen
  /// whitened length.
  Vector3d placement(const Member& a, const Member& b, const Displacement& displacement) {
    const bool middle = nested_ && chance(random_, 0.7);
    const Vector3d on_a = middle ? middleOf(random_, a.shape) : pointOf(random_, a.shape);
    const Vector3d on_b = middle ? middleOf(random_, b.shape) : pointOf(random_, b.shape);
    const auto normal = makeDisplacement(displacement);
    Vector3d y = Vector3d::Zero();
    for (int k = 0; k < normal.rank(); ++k) y[k] = random_.normal();
    if (y.norm() > 0.0) y *= whitenedLength() / y.norm();
    const Vector3d moved =
        normal.mean() + normal.axes() * normal.standardDeviations().cwiseProduct(y);
    return b.pose * on_b - a.pose * on_a - moved;
  }

  Vector3d rounded(const Vector3d& v) const {
    if (grid_) return (v * 16.0).array().round() / 16.0;
    const bool fine = traits_.thin > 0.0 || traits_.mesh.thin > 0.0 || traits_.condition > 1.0 ||
                      traits_.least_ratio < 1e-3;
    return fine ? v : snapped(v);
  }

  void placeAll() {
    const Displacement& displacement = scene_.displacements[0];
    if (scene_.question == Question::manager) {
      // Relative to A, so the other way round.
      for (Member& b : scene_.b)
        b.pose.translation() -= rounded(placement(scene_.a[0], b, displacement));
      return;
    }
    for (Member& b : scene_.b) b.pose.translation() = rounded(size_b_ * random_.direction());
    for (Member& a : scene_.a) {
      const Member& b = anyOf(random_, scene_.b);
      a.pose.translation() += rounded(placement(a, b, displacement));
    }
  }

  void goFar() {
    if (traits_.far_exponent == 0) return;
    const double distance = std::exp2(random_.uniform(10.0, traits_.far_exponent));
    const Vector3d by = distance * random_.direction();
    for (auto* group : {&scene_.a, &scene_.b}) {
      for (Member& member : *group) member.pose.translation() += by;
    }
  }

  void swapSides() {
    std::swap(scene_.a, scene_.b);
    for (Displacement& displacement : scene_.displacements) displacement.mean *= -1.0;
  }

  void makeRequest() {
    ProbabilityRequest& request = scene_.request;
    request.method = anyOf(random_, traits_.methods);
    if (chance(random_, traits_.solid)) request.contact = ContactMeaning::solid;
    request.gradient = chance(random_, traits_.gradient);
    request.relative_tolerance = anyOf(random_, std::vector<double>{0.3, 0.1, 0.03});
    request.absolute_tolerance = anyOf(random_, std::vector<double>{0.0, 1e-6, 1e-9});
    request.max_cells = anyOf(random_, std::vector<std::size_t>{50, 150, 400});
    request.samples = 200;
    request.seed = static_cast<std::uint64_t>(random_.integer(1, 1000));
    if (request.method == ProbabilityMethod::estimate) request.max_cells = 4000;
    if (chance(random_, traits_.threshold)) {
      request.threshold =
          chance(random_, 0.5) ? random_.logUniform(1e-6, 1.0) : random_.uniform(0.0, 1.0);
    }
  }

  void makeLimits() {
    ProbabilityRequest& request = scene_.request;
    constexpr std::size_t kMost = std::numeric_limits<std::size_t>::max();
    const auto size = [&](const std::vector<std::size_t>& choices) {
      return anyOf(random_, choices);
    };
    request.relative_tolerance = anyOf(random_, std::vector<double>{0.1, 1e-3, 1e-12});
    request.absolute_tolerance = anyOf(random_, std::vector<double>{0.0, 1e-12, 1.0});
    request.max_cells = size({1, 2, 5, 20, 100, 500});
    request.max_memory = size({1, 1000, 30'000, std::size_t{1} << 30, kMost});
    request.samples = size({1, 2, 10, 100, 500});
    request.confidence = anyOf(random_, std::vector<double>{0.5, 0.9, 0.999999});
    request.threads = static_cast<unsigned>(random_.integer(1, 3));
    if (chance(random_, 0.4)) {
      request.time_limit = anyOf(random_, std::vector<double>{1e-9, 1e-4, 3e-3});
      request.samples = size({1, 100, 100'000'000, kMost / 2, kMost});
    }
    if (chance(random_, 0.3)) scene_.cancel_after = random_.integer(0, 5);
  }

  RandomBodies random_;
  const Family& family_;
  const Traits& traits_;
  Scene& scene_;
  double size_a_ = 1.0, size_b_ = 1.0;
  bool grid_ = false, nested_ = false;
};

/// splitmix64 (Steele, Lea, Flood 2014).
std::uint64_t mixed(std::uint64_t x) {
  x += 0x9e3779b97f4a7c15ull;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ull;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebull;
  return x ^ (x >> 31);
}

}  // namespace

Scene generate(std::uint64_t seed, std::uint64_t index, const Family& family) {
  Scene scene;
  scene.family = family.name;
  scene.seed = seed;
  scene.index = index;
  std::uint64_t hash = mixed(mixed(seed) ^ index);
  for (const char c : family.name) hash = mixed(hash ^ static_cast<unsigned char>(c));
  Generator(static_cast<unsigned>(hash), family, scene).run();
  return scene;
}

Scene generate(std::uint64_t seed, std::uint64_t index) {
  return generate(seed, index, families()[index % families().size()]);
}

}  // namespace fcl_prob_audit
