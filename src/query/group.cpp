// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "fcl_prob/group.h"

#include <map>
#include <string>

#include "fcl_prob/certificate.h"
#include "fcl_prob/exceptions.h"
#include "query/groups_query.h"

namespace fcl_prob {
namespace {

using Objects = std::vector<const fcl::CollisionObjectd*>;
using Poses = std::vector<fcl::Transform3d>;

/// A geometry that is in the group many times, as a link at many waypoints, is prepared once.
detail::PreparedGeometries prepared(const GroupQuery::Geometries& geometries,
                                    const std::string& group) {
  std::map<const fcl::CollisionGeometryd*, std::shared_ptr<const detail::PreparedGeometry>> known;
  detail::PreparedGeometries all;
  for (const auto& geometry : geometries) {
    auto& one = known[geometry.get()];
    if (!one) {
      one = std::make_shared<const detail::PreparedGeometry>(
          geometry, "member " + std::to_string(all.size()) + " of " + group);
    }
    all.push_back(one);
  }
  return all;
}

/// What one group of collision objects is made of.
struct SplitObjects {
  SplitObjects(const Objects& objects, const std::string& group) {
    for (const fcl::CollisionObjectd* object : objects) {
      if (object == nullptr) throw InvalidGeometry("an object of " + group + " is null");
      geometries.push_back(object->collisionGeometry());
      poses.push_back(object->getTransform());
    }
  }

  GroupQuery::Geometries geometries;
  Poses poses;
};

}  // namespace

struct GroupQuery::Implementation {
  detail::GroupsQuery groups;
};

GroupQuery::GroupQuery(const Geometries& group_a, const Geometries& group_b)
    : implementation_(
          new Implementation{{prepared(group_a, "group A"), prepared(group_b, "group B")}}) {}

GroupQuery::~GroupQuery() = default;
GroupQuery::GroupQuery(GroupQuery&&) noexcept = default;
GroupQuery& GroupQuery::operator=(GroupQuery&&) noexcept = default;

double GroupQuery::collisionProbability(const std::vector<fcl::Transform3d>& poses_a,
                                        const std::vector<fcl::Transform3d>& poses_b,
                                        const GaussianDisplacement& displacement,
                                        const ProbabilityRequest& request,
                                        ProbabilityResult& result) const {
  result = implementation_->groups.answer(poses_a, poses_b, displacement, request);
  return result.probability();
}

double GroupQuery::certifiedProbability(const Poses& poses_a, const Poses& poses_b,
                                        const GaussianDisplacement& displacement,
                                        const ProbabilityRequest& request,
                                        std::ostream& certificate,
                                        ProbabilityResult& result) const {
  result = implementation_->groups.certified(poses_a, poses_b, displacement, request, certificate);
  return result.probability();
}

MotionGradient GroupQuery::motionGradient(const std::vector<fcl::Transform3d>& poses_a,
                                          const std::vector<fcl::Transform3d>& poses_b,
                                          const GaussianDisplacement& displacement,
                                          const MemberVelocities& velocities,
                                          const MotionGradientRequest& request) const {
  return implementation_->groups.gradient(poses_a, poses_b, displacement, velocities, request);
}

double collisionProbability(const GroupQuery& query, const std::vector<fcl::Transform3d>& poses_a,
                            const std::vector<fcl::Transform3d>& poses_b,
                            const GaussianMixture& displacement, const ProbabilityRequest& request,
                            ProbabilityResult& result) {
  result = query.implementation_->groups.answer(poses_a, poses_b, displacement, request);
  return result.probability();
}

double collisionProbability(const GroupQuery& query, const std::vector<fcl::Transform3d>& poses_a,
                            const std::vector<fcl::Transform3d>& poses_b,
                            const TruncatedGaussian& displacement,
                            const ProbabilityRequest& request, ProbabilityResult& result) {
  result = query.implementation_->groups.answer(poses_a, poses_b, displacement, request);
  return result.probability();
}

double collisionProbability(const Objects& group_a, const Objects& group_b,
                            const GaussianDisplacement& displacement,
                            const ProbabilityRequest& request, ProbabilityResult& result) {
  const SplitObjects a(group_a, "group A"), b(group_b, "group B");
  return GroupQuery(a.geometries, b.geometries)
      .collisionProbability(a.poses, b.poses, displacement, request, result);
}

double certifiedProbability(const Objects& group_a, const Objects& group_b,
                            const GaussianDisplacement& displacement,
                            const ProbabilityRequest& request, std::ostream& certificate,
                            ProbabilityResult& result) {
  const SplitObjects a(group_a, "group A"), b(group_b, "group B");
  return GroupQuery(a.geometries, b.geometries)
      .certifiedProbability(a.poses, b.poses, displacement, request, certificate, result);
}

}  // namespace fcl_prob
