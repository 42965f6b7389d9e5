// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "fcl_prob/certificate.h"

#include <string>

#include "fcl_prob/exceptions.h"
#include "query/certificate_writer.h"
#include "query/member_group.h"
#include "query/partition.h"

namespace fcl_prob {
namespace {

using Objects = std::vector<const fcl::CollisionObjectd*>;

/// One side of the question, ready to be placed.
struct Side {
  Side(const Objects& objects, const std::string& name) : group(prepared(objects, name), name) {
    for (const auto* object : objects) poses.push_back(object->getTransform());
    group.validate(poses);
    if (group.anyUnbounded()) {
      throw UnsupportedGeometry("no certificate of " + name + ": a half-space or plane is in it");
    }
  }

  static detail::PreparedGeometries prepared(const Objects& objects, const std::string& name) {
    detail::PreparedGeometries all;
    for (const auto* object : objects) {
      all.push_back(std::make_shared<const detail::PreparedGeometry>(
          object->collisionGeometry(), "member " + std::to_string(all.size()) + " of " + name));
    }
    return all;
  }

  std::vector<const fcl::CollisionGeometryd*> geometries() const {
    std::vector<const fcl::CollisionGeometryd*> all;
    for (const std::size_t i : group.bounded()) all.push_back(&group.members()[i]->geometry());
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

}  // namespace

double certifiedProbability(const Objects& group_a, const Objects& group_b,
                            const GaussianDisplacement& displacement,
                            const ProbabilityRequest& asked, std::ostream& certificate,
                            ProbabilityResult& result) {
  requireCertifiable(asked);
  const Side side_a(group_a, "group A"), side_b(group_b, "group B");
  const detail::PartitionObject a = side_a.group.placed(side_a.poses, asked.contact);
  const detail::PartitionObject b = side_b.group.placed(side_b.poses, asked.contact);
  const detail::CertifiedObject certified_a{a, side_a.geometries()};
  const detail::CertifiedObject certified_b{b, side_b.geometries()};
  detail::requireCertifiable(certified_a, "group A");
  detail::requireCertifiable(certified_b, "group B");
  ProbabilityRequest request = asked;
  request.method = ProbabilityMethod::interval;
  detail::CertificateWriter writer(certificate, certified_a, certified_b, asked.contact);
  ProbabilityResult answer = detail::partitionProbability(a, b, displacement, request, nullptr);
  writer.finish({*answer.lower, *answer.upper});
  answer.plan.emplace_back("certificate written: boxes only, on one thread");
  result = std::move(answer);
  return result.probability();
}

}  // namespace fcl_prob
