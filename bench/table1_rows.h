// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// The rows of Table I: one method on one benchmark scene each.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cli/prepared_scene.h"

namespace fcl_prob::cli {

/// What a row's number is.
enum class RowKind {
  upper_bound,    ///< certified to be at least P
  interval,       ///< the middle of a certified interval
  estimate,       ///< with a standard error
  approximation,  ///< on either side of P, no error known
};

std::string toString(RowKind kind);

/// One line of the table. What a method does not have is not set.
struct Table1Row {
  std::string method;
  RowKind kind = RowKind::upper_bound;
  std::optional<double> root_error;   ///< BVE of the root, over the volume that the mesh encloses
  std::optional<double> hull_error;   ///< the same over the volume of its convex hull
  std::optional<double> level_error;  ///< BVE of level kBveLevel
  std::optional<double> leaf_error;   ///< BVE of all leaves, where those are convex parts
  std::optional<double> value;        ///< probability, or bound clipped at 1
  std::optional<double> raw_sum;
  std::optional<double> minimum;  ///< bound by min(parent, sum)
  std::optional<double> time_ms;
  std::optional<double> minimum_time_ms;
  std::string published_as;  ///< row of the paper's table
  std::string remark;
};

/// The level of a tree whose volumes are added for the BVE besides the root's: the first that has
/// 64 nodes, if the tree is balanced.
inline constexpr int kBveLevel = 6;

/// The bounding volumes in the order of the paper's table, FCL's others in between.
const std::vector<std::string>& volumesOfTable1();

/// Two meshes of a scene, and what the rows are measured with.
class Table1Scene {
 public:
  /// \param scene  of two meshes
  explicit Table1Scene(const PreparedScene& scene);

  /// GeneralPCD over trees of one bounding volume.
  Table1Row volumeRow(const std::string& volume) const;

  /// The same over trees of convex parts, the paper's own setting, for every bounding volume; then
  /// convex hulls of fewer and of more parts, and Hunter's and Bonferroni's bounds.
  std::vector<Table1Row> partsRows() const;

  /// The mean over frames of the world that are turned at random, as the paper averages its AABBs.
  /// The root's BVE, which needs no tree, is over at least kBveFrames of them.
  Table1Row frameRow(std::size_t frames, std::uint64_t seed) const;
  static constexpr std::size_t kBveFrames = 10'000;

  /// Du Toit and Burdick, Park et al., each for the whole objects and over trees of spheres; and
  /// enlargement by the confidence ellipsoid.
  std::vector<Table1Row> priorRows() const;

  /// 10,000 calls of fcl::collide.
  Table1Row monteCarloRow(std::uint64_t seed) const;

  /// The library's own answers.
  Table1Row intervalRow(double relative_tolerance) const;
  Table1Row estimateRow(double relative_tolerance, std::uint64_t seed) const;

 private:
  struct MeshPair;
  struct TreeBounds;
  struct PartsPair;

  MeshPair meshes() const;
  TreeBounds boundByTrees(const std::string& volume, const MeshPair& pair) const;
  Table1Row rowOf(const std::string& name, const TreeBounds& bounds,
                  const std::string& published_as = "") const;
  PartsPair parts(std::size_t count) const;
  Table1Row partsRow(const std::string& volume, const PartsPair& parts) const;
  Table1Row partsBoundsRow(const PartsPair& parts) const;
  Table1Row queryRow(const std::string& name, const ProbabilityRequest& request,
                     RowKind kind) const;
  double meanBoxVolume(std::size_t frames, std::uint64_t seed) const;

  const PreparedScene& scene_;
  double enclosed_volume_;
  double hull_volume_;
};

}  // namespace fcl_prob::cli
