// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Sums of segments: boxes, and the C-obstacles of boxes.
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <vector>

#include "convex/face_set.h"

namespace fcl_prob::detail {

/// The set { centre + Σ t_i g_i : |t_i| <= 1 } of at most kMaxGenerators generators g_i.
///
/// A box has three generators, half its edges. The C-obstacle of two boxes is the zonotope of their
/// six, whose faces lie in the 15 pairs of parallel planes that the separating-axis test knows:
/// three face normals of each box and nine cross products of edges. Where axes of the boxes are
/// parallel, as those of two AABBs, generators merge and 3 pairs are left.
class Zonotope {
 public:
  static constexpr int kMaxGenerators = 12;

  Zonotope() = default;
  explicit Zonotope(const Eigen::Vector3d& centre) : centre_(centre) {}

  /// Which generator a segment has become part of, and whether as it is (1) or turned around (-1);
  /// none (-1) of a segment without length.
  struct Place {
    int generator = -1;
    double sign = 1.0;
  };

  /// Adds a segment [-generator, generator]; one parallel to an earlier one (to 1e-14) is merged
  /// with it.
  Place addGenerator(const Eigen::Vector3d& generator);

  const Eigen::Vector3d& centre() const { return centre_; }
  void translate(const Eigen::Vector3d& by) { centre_ += by; }
  int generatorCount() const { return count_; }
  const Eigen::Vector3d& generator(int i) const { return generators_[i]; }

  /// The points centre ± g_1 ± ... that it is the hull of: of few generators, all are corners.
  std::vector<Eigen::Vector3d> corners() const;

  /// The image under a linear map. (Keeps the generators apart even if the map makes two parallel.)
  Zonotope mapped(const Eigen::Matrix3d& map) const;

  /// max of direction·x over the zonotope.
  double support(const Eigen::Vector3d& direction) const;
  Eigen::Vector3d supportPoint(const Eigen::Vector3d& direction) const;

  /// Writes the 2·n(n−1)/2 parallelograms of the boundary; coplanar ones tile their face. Returns
  /// how far the zonotope may reach out of them because of ties (beyond rounding; nearly always 0),
  /// or nothing if rounding spoilt the surface (which has not been seen; `faces` is then unusable).
  /// \param signs  if given, set to what each vertex is a sum of: bit i for the generator i as it
  /// is
  std::optional<double> faces(FaceSet& faces, std::vector<unsigned>* signs = nullptr) const;

 private:
  using Generators = std::array<Eigen::Vector3d, kMaxGenerators>;

  int vertexIndex(unsigned signs, std::array<int, 1u << kMaxGenerators>& indices, FaceSet& faces,
                  std::vector<unsigned>* signs_of_all) const;
  std::optional<double> facesPerturbed(int attempt, FaceSet& faces,
                                       std::vector<unsigned>* signs) const;
  static double defectOf(const Generators& generators, int count, int i, int j, unsigned upper);
  double lengthUnit() const;

  Eigen::Vector3d centre_ = Eigen::Vector3d::Zero();
  Generators generators_;
  int count_ = 0;
};

/// A zonotope swept by a ball: box, rectangle or point with rounded or sharp edges. Own frame,
/// metres.
struct RoundedZonotope {
  Zonotope core;
  double radius = 0.0;
};

}  // namespace fcl_prob::detail
