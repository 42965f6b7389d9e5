// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Layers around the C-obstacles of flat nodes, held against corners in long double.
#include "scene/node_layers.h"

#include "catch.h"
#include "convex/slab_kernels.h"
#include "mesh_shapes.h"
#include "random_bodies.h"
#include "scene/band_margin.h"

namespace {

using namespace fcl_prob;
using namespace fcl_prob_test;
using namespace fcl_prob::detail;

using LongVector = Eigen::Matrix<long double, 3, 1>;
using LongMatrix = Eigen::Matrix<long double, 3, 3>;
using Tree = std::shared_ptr<const PieceTree>;

/// One object of one or two meshes at random poses.
struct Meshes {
  Meshes(RandomBodies& random, double size, double reach) {
    const int count = random.integer(1, 2);
    for (int i = 0; i < count; ++i) {
      const TriangleMesh mesh =
          random.integer(0, 1) == 0
              ? bumpyMesh(size, 6 + random.integer(0, 8), 9, random.integer(0, 1000))
              : torusMesh(size, random.uniform(0.1, 0.4) * size, 14, 9);
      models.push_back(makeModel<fcl::OBBRSSd>(mesh));
      parts.push_back(buildPieceTree(*models.back()));
      fcl::Transform3d pose = fcl::Transform3d::Identity();
      pose.linear() = random.rotation();
      pose.translation() = random.uniform(0.0, reach) * random.direction();
      object.parts.push_back({pose, nullptr});
    }
    tree = count == 1 ? parts[0] : joinPieceTrees({parts[0].get(), parts[1].get()});
    object.tree = tree.get();
  }

  /// A corner under a node, in the world, relative to `origin`.
  LongVector cornerUnder(RandomBodies& random, int node, const LongVector& origin) const {
    const PieceTree::Node& at = tree->nodes[node];
    const Eigen::Vector3i& t = tree->triangles[random.integer(at.piece, at.last_piece)];
    const int vertex = t[random.integer(0, 2)];
    std::size_t i = 0;
    while (vertex >= tree->parts[i].vertices.end) ++i;
    const fcl::Transform3d& pose = object.parts[i].pose;
    const LongVector x =
        tree->parts[i].origin.cast<long double>() + tree->vertices[vertex].cast<long double>();
    return pose.linear().cast<long double>() * x + pose.translation().cast<long double>() - origin;
  }

  std::vector<std::shared_ptr<fcl::BVHModel<fcl::OBBRSSd>>> models;
  std::vector<Tree> parts;
  Tree tree;
  PartitionObject object{nullptr, {}};
};

/// Two of them, whitened.
struct LayeredScene {
  explicit LayeredScene(RandomBodies& random)
      : size(random.logUniform(1e-3, 1e3)),
        a(random, size, random.integer(0, 1) * 1e3 * size),
        b(random, size * random.logUniform(0.1, 10.0), 3 * size) {
    Eigen::Vector3d deviations;
    const double least = size * random.logUniform(0.03, 3.0);
    for (int k = 0; k < 3; ++k) deviations[k] = least * random.logUniform(1.0, 1e4);
    if (random.integer(0, 3) == 0) deviations[2] = 0.0;
    const Eigen::Matrix3d axes = random.rotation();
    // Moved until A and B are about in one place.
    mean = b.object.parts[0].pose.translation() - a.object.parts[0].pose.translation() +
           random.uniform(0.0, 3.0) * size * random.direction();
    const GaussianDisplacement displacement(
        mean, axes * deviations.cwiseAbs2().asDiagonal() * axes.transpose());
    whitening = std::make_unique<Whitening>(displacement, size);
    pair = whiten(a.object, b.object, *whitening);
  }

  LongVector displacementBetween(RandomBodies& random, NodePair nodes) const {
    const LongVector of_b = b.cornerUnder(random, nodes.b, mean.cast<long double>());
    return whitening->matrix().cast<long double>() *
           LongVector(of_b - a.cornerUnder(random, nodes.a, LongVector::Zero()));
  }

  double size;
  Meshes a;
  Meshes b;
  Eigen::Vector3d mean;
  std::unique_ptr<Whitening> whitening;
  WhitenedPair pair;
};

double extentAlong(const NodeBox& box, const Eigen::Vector3d& n) {
  return box.highestAlong(n) + box.highestAlong(-n);
}

TEST_CASE("layers of flat nodes hold their C-obstacles, at any scale and however far apart",
          "[slow]") {
  RandomBodies random(4711);
  int near = 0, thin = 0, layers = 0;
  for (int i = 0; i < 300; ++i) {
    const LayeredScene scene(random);
    NodeLayers of(scene.pair);
    for (int j = 0; j < 300; ++j) {
      const NodePair nodes{random.integer(0, static_cast<int>(scene.a.tree->nodes.size()) - 1),
                           random.integer(0, static_cast<int>(scene.b.tree->nodes.size()) - 1)};
      const auto layer = of.of(nodes);
      if (!layer) continue;
      ++layers;
      const NodeBox box = obstacleBox(scene.pair, nodes);
      thin += layer->hi - layer->lo < 0.3 * extentAlong(box, layer->n);
      const LongVector n = layer->n.cast<long double>();
      for (int k = 0; k < 6; ++k) {
        const LongVector y = scene.displacementBetween(random, nodes);
        if (y.cwiseAbs().maxCoeff() > kReach) continue;
        ++near;
        CAPTURE(i, j, nodes.a, nodes.b, layer->n.transpose(), layer->lo, layer->hi);
        REQUIRE(static_cast<double>(n.dot(y) - layer->lo) >= 0.0);
        REQUIRE(static_cast<double>(layer->hi - n.dot(y)) >= 0.0);
      }
    }
  }
  CHECK(near > 100'000);
  CHECK(layers > 40'000);
  CHECK(thin > layers / 4);
}

TEST_CASE("slabs of nodes hold their corners exactly, and are as thin as they are flat") {
  const auto model = makeModel<fcl::OBBRSSd>(bumpyMesh(0.7, 20, 30, 5));
  const Tree tree = buildPieceTree(*model);
  const PieceTree::Part& part = tree->parts[0];
  const std::vector<NodeSlab>& slabs = part.slabs->of(*tree, part);
  REQUIRE(slabs.size() == tree->nodes.size());
  int flat = 0;
  for (std::size_t i = 0; i < slabs.size(); ++i) {
    const NodeSlab& slab = slabs[i];
    const PieceTree::Node& node = tree->nodes[i];
    if (node.isLeaf()) {
      REQUIRE(slab.isFlat());
      CHECK(slab.hi - slab.lo < 1e-6);
    }
    if (!slab.isFlat()) continue;
    ++flat;
    for (int piece = node.piece; piece <= node.last_piece; ++piece) {
      for (const int corner : tree->triangles[piece]) {
        const long double along =
            slab.normal.cast<long double>().dot(tree->vertices[corner].cast<long double>());
        REQUIRE(along >= static_cast<long double>(slab.lo));
        REQUIRE(along <= static_cast<long double>(slab.hi));
      }
    }
  }
  CHECK(flat > static_cast<int>(slabs.size()) / 2);
}

TEST_CASE("nothing is said of layers where shapes have bands") {
  RandomBodies random(8);
  LayeredScene scene(random);
  scene.pair.band = std::make_shared<const BandMargin>(0.1, 0.1, scene.whitening->matrix());
  NodeLayers of(scene.pair);
  for (int node = 0; node < static_cast<int>(scene.a.tree->nodes.size()); ++node) {
    REQUIRE_FALSE(of.of({node, 0}));
  }
}

}  // namespace
