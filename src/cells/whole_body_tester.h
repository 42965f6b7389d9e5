// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Which displacements make convex meshes, taken whole, touch another mesh.
#pragma once

#include <deque>
#include <memory>
#include <vector>

#include "cells/fan_contact.h"
#include "scene/scene.h"

namespace fcl_prob::detail {

class WholeBodyTester {
 public:
  /// Null where no object can be taken whole. Keeps a reference.
  static std::unique_ptr<WholeBodyTester> of(const QueryScene& scene);

  /// Null where the members cannot be taken whole. Keeps a reference to the pair.
  /// \param whole   all of whose members are convex
  /// \param matrix  that of the whitening by which the pair was moved
  static std::unique_ptr<WholeBodyTester> of(const WholeBody& whole, const WhitenedPair& pair,
                                             const Eigen::Matrix3d& matrix);

  /// Whether any member touches the mesh (or, as a solid, holds a part of it) at y, a point of a
  /// cell.
  PointContact at(const Eigen::Vector3d& y);

  /// See FanContact.
  void forget() {
    for (Member& member : members_) member.contact.forget();
  }

 private:
  struct Member {
    explicit Member(WhitenedFan whitened) : fan(std::move(whitened)), contact(fan) {}
    Member(const Member&) = delete;
    Member& operator=(const Member&) = delete;

    WhitenedFan fan;
    FanContact contact;
  };

  /// A node of the tree of the mesh, less y, turned over.
  struct Visit {
    int node;
    Eigen::Vector3d middle;
    Eigen::Vector3d half;
  };

  PointContact memberAt(Member& member, const Eigen::Vector3d& y);
  static Visit visitOf(const Member& member, int node, const Eigen::Vector3d& y);

  std::deque<Member> members_;
  std::vector<Visit> stack_;
};

}  // namespace fcl_prob::detail
