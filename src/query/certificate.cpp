// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "fcl_prob/certificate.h"

#include <string>

#include "fcl_prob/exceptions.h"
#include "query/certified_answer.h"
#include "query/partition.h"

namespace fcl_prob {
namespace {

using Objects = std::vector<const fcl::CollisionObjectd*>;

/// One side of the question, ready to be placed.
struct Side {
  Side(const Objects& objects, const std::string& name) : group(prepared(objects, name), name) {
    for (const auto* object : objects) poses.push_back(object->getTransform());
    group.validate(poses);
  }

  static detail::PreparedGeometries prepared(const Objects& objects, const std::string& name) {
    detail::PreparedGeometries all;
    for (const auto* object : objects) {
      all.push_back(std::make_shared<const detail::PreparedGeometry>(
          object->collisionGeometry(), "member " + std::to_string(all.size()) + " of " + name));
    }
    return all;
  }

  detail::MemberGroup group;
  std::vector<fcl::Transform3d> poses;
};

void requireCertifiable(const ProbabilityRequest& request) {
  validateRequest(request);
  if (request.method != ProbabilityMethod::automatic &&
      request.method != ProbabilityMethod::interval) {
    throw InvalidRequest("no certificate by method " + toString(request.method));
  }
  if (request.hasBand()) throw InvalidRequest("no certificate with bands");
  if (request.gradient) throw InvalidRequest("no certificate of a gradient");
}

// The geometries of a group's bounded members, of which all must have certificates.
std::vector<const fcl::CollisionGeometryd*> geometriesOf(const detail::MemberGroup& group) {
  if (group.anyUnbounded()) {
    throw UnsupportedGeometry("no certificate with a half-space or plane");
  }
  std::vector<const fcl::CollisionGeometryd*> all;
  for (const std::size_t i : group.bounded()) all.push_back(&group.members()[i]->geometry());
  return all;
}

}  // namespace

ProbabilityResult detail::certifiedAnswer(const PlacedMembers& members_a,
                                          const PlacedMembers& members_b,
                                          const GaussianDisplacement& displacement,
                                          const ProbabilityRequest& asked, std::ostream& out) {
  requireCertifiable(asked);
  const PartitionObject a = members_a.group.placed(members_a.poses, asked.contact);
  const PartitionObject b = members_b.group.placed(members_b.poses, asked.contact);
  const CertifiedObject certified_a{a, geometriesOf(members_a.group), members_a.name};
  const CertifiedObject certified_b{b, geometriesOf(members_b.group), members_b.name};
  ProbabilityRequest request = asked;
  request.method = ProbabilityMethod::interval;
  CertificateWriter writer(out, certified_a, certified_b, asked.contact);
  ProbabilityResult answer = partitionProbability(a, b, displacement, request, nullptr);
  writer.finish({*answer.lower, *answer.upper});
  answer.plan.emplace_back("certificate written: boxes only, on one thread");
  return answer;
}

double certifiedProbability(const Objects& group_a, const Objects& group_b,
                            const GaussianDisplacement& displacement,
                            const ProbabilityRequest& request, std::ostream& certificate,
                            ProbabilityResult& result) {
  const Side a(group_a, "group A"), b(group_b, "group B");
  result = detail::certifiedAnswer({a.group, a.poses, "group A"}, {b.group, b.poses, "group B"},
                                   displacement, request, certificate);
  return result.probability();
}

}  // namespace fcl_prob
