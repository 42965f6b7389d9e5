// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "bench/table2_bounds.h"

#include "bench/uniforms.h"
#include "fcl_prob/convex_pcd.h"
#include "fcl_prob/part_tree.h"
#include "fcl_prob/parts_bounds.h"
#include "geometry/mesh_visitor.h"

namespace fcl_prob::cli {
namespace {

/// Of the paper's models; ours are cut into no more, so that the bounds end.
constexpr std::size_t kMostPartsOfMesh = 8;

constexpr double kConfidenceOfPaths = 0.99;  // δ of the paper

// Frames that AABBs are averaged over (the paper: 100): each takes as long as the row of AABBs.
constexpr int kFrames = 8;

/// A body and an obstacle, by their numbers, where they are.
struct PlacedPair {
  std::size_t body;
  const fcl::Transform3d& body_pose;
  std::size_t index;
  const Obstacle& obstacle;

  GaussianDisplacement displacement() const {
    return std::get<GaussianDisplacement>(obstacle.displacement).reversed();
  }
};

/// Something of all bodies and of all obstacles of a scene, in their frames.
template <typename One>
struct OfScene {
  std::vector<One> bodies;
  std::vector<One> obstacles;

  template <typename Make>
  OfScene(const Table2Scene& scene, const Make& make) {
    for (const RobotBody& body : scene.robot().bodies()) {
      bodies.push_back(make(body.geometry));
    }
    for (const Obstacle& obstacle : scene.obstacles()) {
      obstacles.push_back(make(obstacle.geometry));
    }
  }

  template <typename Other, typename Make>
  OfScene(const OfScene<Other>& others, const Make& make) {
    for (const Other& other : others.bodies) bodies.push_back(make(other));
    for (const Other& other : others.obstacles) obstacles.push_back(make(other));
  }
};

using SceneParts = OfScene<ConvexParts>;
using SceneTrees = OfScene<PartTree>;
using SceneBalls = OfScene<detail::Ball>;

SceneParts partsOf(const Table2Scene& scene, PartsStore& store) {
  DecompositionRequest request;
  request.max_parts = kMostPartsOfMesh;
  request.pieces = 4 * kMostPartsOfMesh;
  return SceneParts(scene, [&](const auto& mesh) { return store.of(mesh, request); });
}

std::shared_ptr<const SceneTrees> treesOf(const SceneParts& parts, PartVolume volume) {
  return std::make_shared<const SceneTrees>(
      parts, [volume](const ConvexParts& of_one) { return PartTree(of_one, volume); });
}

/// What balls say of a pair, where that hardly matters.
class BallBound {
 public:
  explicit BallBound(const Table2Scene& scene)
      : balls_(std::make_shared<const SceneBalls>(scene, [](const auto& geometry) {
          return detail::ballAround({geometry, "a geometry"});
        })) {
    share_ = (1.0 - kConfidenceOfPaths) /
             static_cast<double>(balls_->bodies.size() * balls_->obstacles.size());
  }

  /// What a pair may have of 1 - δ.
  double share() const { return share_; }

  std::optional<double> kept(const PlacedPair& pair) const {
    const double upper = farContactUpper(balls_->bodies[pair.body].placed(pair.body_pose),
                                         balls_->obstacles[pair.index].placed(pair.obstacle.pose),
                                         pair.obstacle.displacement);
    return upper < share_ ? std::make_optional(upper) : std::nullopt;
  }

 private:
  std::shared_ptr<const SceneBalls> balls_;
  double share_;
};

/// Of a pair that is not far. Once it is at least `enough`, anything that is.
using PairUpper = std::function<double(const PlacedPair& pair, double enough)>;

/// Adds up what is said of every body and obstacle.
class SumRow {
 public:
  SumRow(BallBound balls, PairUpper upper) : balls_(std::move(balls)), upper_(std::move(upper)) {}

  double operator()(const Table2State& state, double enough) const {
    const auto poses = state.query.robot().poses(state.values);
    double sum = 0.0;
    for (std::size_t j = 0; j < state.query.obstacles().size(); ++j) {
      for (std::size_t i = 0; i < poses.size(); ++i) {
        const PlacedPair pair{i, poses[i], j, state.query.obstacles()[j]};
        const std::optional<double> kept = balls_.kept(pair);
        sum += kept ? *kept : upper_(pair, enough);
        if (sum >= enough) return sum;
      }
    }
    return sum;
  }

 private:
  BallBound balls_;
  PairUpper upper_;
};

/// The paper's sum.
PairUpper overTrees(std::shared_ptr<const SceneTrees> trees, double share,
                    GeneralPcdVariant variant = GeneralPcdVariant::sum) {
  return [trees = std::move(trees), share, variant](const PlacedPair& pair, double enough) {
    const PartTree& a = trees->bodies[pair.body];
    const PartTree& b = trees->obstacles[pair.index];
    GeneralPcdRequest request;
    request.confidence = kConfidenceOfPaths;
    request.variant = variant;
    request.stop_at_one = enough <= 1.0;
    const std::size_t parts_of_a = (a.nodeCount() + 1) / 2;
    const std::size_t parts_of_b = (b.nodeCount() + 1) / 2;
    request.negligible = share / static_cast<double>(parts_of_a * parts_of_b);
    return generalPcd(a, pair.body_pose, b, pair.obstacle.pose, pair.displacement(), request)
        .raw_sum;
  };
}

/// Boxes around parts along the axes of a frame.
struct TurnedBoxes {
  fcl::Transform3d back;  ///< from the frame to that of the parts
  OfScene<std::vector<ConvexBody>> boxes;

  TurnedBoxes(const SceneParts& parts, const Eigen::Matrix3d& turn)
      : back(fcl::Transform3d(turn.transpose())), boxes(parts, [&turn](const ConvexParts& of_one) {
          std::vector<ConvexBody> all;
          for (std::size_t i = 0; i < of_one.size(); ++i) {
            fcl::AABBd box;
            for (const Eigen::Vector3d& v : of_one.polytope(i).vertices) box += turn * v;
            all.emplace_back(box);
          }
          return all;
        }) {}

  double sumOf(const PlacedPair& pair) const {
    double sum = 0.0;
    for (const ConvexBody& a : boxes.bodies[pair.body]) {
      for (const ConvexBody& b : boxes.obstacles[pair.index]) {
        sum +=
            convexPcd(a, pair.body_pose * back, b, pair.obstacle.pose * back, pair.displacement())
                .least;
      }
    }
    return sum;
  }
};

/// The mean over frames that are turned at random, as the paper averages its AABBs.
PairUpper overFrames(const SceneParts& parts) {
  auto frames = std::make_shared<std::vector<TurnedBoxes>>();
  for (int i = 0; i < kFrames; ++i) frames->emplace_back(parts, randomRotation(1, i));
  return [frames = std::move(frames)](const PlacedPair& pair, double) {
    double sum = 0.0;
    for (const TurnedBoxes& frame : *frames) sum += frame.sumOf(pair);
    return sum / kFrames;
  };
}

/// Where the sum over hulls is not small.
PairUpper byHunter(std::shared_ptr<const SceneParts> parts, PairUpper sum, double share) {
  return [parts = std::move(parts), sum = std::move(sum), share](const PlacedPair& pair,
                                                                 double enough) {
    const double of_hulls = sum(pair, enough);
    if (of_hulls < share) return of_hulls;
    return partsBounds(parts->bodies[pair.body], pair.body_pose, parts->obstacles[pair.index],
                       pair.obstacle.pose, pair.displacement())
        .any.upper;
  };
}

}  // namespace

std::vector<Table2Method> table2Bounds(const Table2Scene& scene, PartsStore& store) {
  const auto parts = std::make_shared<const SceneParts>(partsOf(scene, store));
  const BallBound balls(scene);
  const auto sum = [&](PartVolume volume) {
    return overTrees(treesOf(*parts, volume), balls.share());
  };
  const auto hulls = treesOf(*parts, PartVolume::convex);
  const PairUpper sum_of_hulls = overTrees(hulls, balls.share());
  const auto boundOnly = [&](const std::string& name, PairUpper upper, int repetitions = 1) {
    return Table2Method{
        name, "", SumRow(balls, std::move(upper)), Table2Answer::upper_bound, false, repetitions};
  };
  return {{"spheres, printed sum", "sphere", SumRow(balls, sum(PartVolume::sphere))},
          {"AABBs, printed sum", "aabb", SumRow(balls, sum(PartVolume::aabb))},
          boundOnly("AABBs, sum, " + std::to_string(kFrames) + " turned frames", overFrames(*parts),
                    kFrames),
          boundOnly("kIOS, printed sum", sum(PartVolume::kios)),
          {"OBBs, printed sum", "obb", SumRow(balls, sum(PartVolume::obb))},
          {"26-DOPs, printed sum", "kdop26", SumRow(balls, sum(PartVolume::kdop26))},
          {"hulls, printed sum", "convex", SumRow(balls, sum_of_hulls)},
          boundOnly("hulls, minimum", overTrees(hulls, balls.share(), GeneralPcdVariant::minimum)),
          boundOnly("hulls, Hunter's bound", byHunter(parts, sum_of_hulls, balls.share()))};
}

}  // namespace fcl_prob::cli
