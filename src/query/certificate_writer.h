// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// What a partition claims, as somebody else can check it: verify/FORMAT.md.
#pragma once

#include <array>
#include <iosfwd>
#include <map>
#include <string>
#include <vector>

#include "cells/claim_observer.h"
#include "fcl_prob/probability_request.h"
#include "scene/partition_object.h"

namespace fcl_prob::detail {

/// An object, the geometry of each of its parts, and what messages call it.
struct CertifiedObject {
  PartitionObject placed;
  std::vector<const fcl::CollisionGeometryd*> geometries;
  std::string name;
};

/// Told, as long as it lives, what the queries of this thread claim. Claims of cells that are not
/// divided any more are written by finish().
class CertificateWriter : public ClaimObserver {
 public:
  /// Keeps references to all arguments.
  /// \throws UnsupportedGeometry naming a part that is no mesh, polytope, sphere, capsule or
  /// octree.
  CertificateWriter(std::ostream& out, const CertifiedObject& a, const CertifiedObject& b,
                    ContactMeaning contact);
  ~CertificateWriter() override { claim_observer = nullptr; }
  CertificateWriter(const CertificateWriter&) = delete;
  CertificateWriter& operator=(const CertificateWriter&) = delete;

  /// \throws InvalidRequest for a displacement of which the cells leave an axis out
  void frame(const Whitening& whitening, const GaussianDisplacement& displacement) override;
  void claim(const Claim& claim) override;
  void divided(const Cell& cell) override;
  bool needsAll() const override { return true; }
  void excuse(const Cell& /*cell*/, const Eigen::Vector3d& /*m*/, double /*from*/,
              double /*to*/) override {}

  /// \param bounds  that the query tells
  void finish(const Bounds& bounds);

 private:
  /// What is claimed of one cell: its sets without contact, and those with.
  struct CellClaims {
    std::vector<Claim> free;
    std::vector<Claim> contact;
  };
  using Corners = std::array<double, 6>;  ///< lowest, highest; zeros behind

  /// The numbers that the file gives to what the tree of an object has in another order.
  struct Numbers {
    std::vector<int> of_vertex;
    std::vector<int> of_piece;
    int vertices = 0;  ///< written
    int pieces = 0;    ///< written
  };

  /// A part, and the letter of its object.
  struct NamedPart {
    const char* object;
    const PlacedPart& placed;
  };

  Numbers writeObject(const CertifiedObject& object, const char* name);
  void writeMesh(const PieceTree& tree, const PieceTree::Part& part,
                 const fcl::CollisionGeometryd& geometry, const NamedPart& named, Numbers& numbers);
  void writePart(const NamedPart& named, const std::vector<Eigen::Vector3d>& vertices,
                 const std::vector<Eigen::Vector3i>& triangles, bool convex, double radius = 0.0);
  void writeCaps(const CertifiedObject& object, const char* name, Numbers& numbers);
  Corners cornersOf(const Cell& cell) const;
  void writeCell(const Corners& corners, const CellClaims& claims);
  void writePlane(const CellPlane& plane, double sign);
  void writeWitness(const Claim& claim);

  std::ostream& out_;
  const CertifiedObject& a_;
  const CertifiedObject& b_;
  ContactMeaning contact_;
  int rank_ = 0;
  Numbers of_a_;
  Numbers of_b_;
  std::size_t cells_ = 0;  ///< written
  std::map<Corners, CellClaims> open_;
};

}  // namespace fcl_prob::detail
