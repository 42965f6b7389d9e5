// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "query/certified_answer.h"

#include "fcl_prob/exceptions.h"
#include "query/certificate_writer.h"
#include "query/partition.h"

namespace fcl_prob::detail {
namespace {

void requireCertifiable(const ProbabilityRequest& request) {
  if (request.method != ProbabilityMethod::automatic &&
      request.method != ProbabilityMethod::interval) {
    throw InvalidRequest("no certificate by method " + toString(request.method));
  }
  if (request.hasBand()) throw InvalidRequest("no certificate with bands");
  if (request.gradient) throw InvalidRequest("no certificate of a gradient");
}

// The bounded members of a group, of which all must have certificates.
CertifiedObject certifiedObject(const PlacedMembers& members, ContactMeaning contact) {
  if (members.group.anyUnbounded()) {
    throw UnsupportedGeometry("no certificate with a half-space or plane");
  }
  CertifiedObject object{members.group.placed(members.poses, contact), {}, members.group.name()};
  if (object.placed.tree->isEmpty()) {
    throw UnsupportedGeometry("no certificate of " + object.name + ": nothing of it is occupied");
  }
  for (const std::size_t i : members.group.bounded()) {
    object.geometries.push_back(&members.group.members()[i]->geometry());
  }
  return object;
}

}  // namespace

ProbabilityResult certifiedAnswer(const PlacedMembers& members_a, const PlacedMembers& members_b,
                                  const GaussianDisplacement& displacement,
                                  const ProbabilityRequest& asked, std::ostream& certificate) {
  requireCertifiable(asked);
  const CertifiedObject a = certifiedObject(members_a, asked.contact);
  const CertifiedObject b = certifiedObject(members_b, asked.contact);
  ProbabilityRequest request = asked;
  request.method = ProbabilityMethod::interval;
  CertificateWriter writer(certificate, a, b, asked.contact);
  ProbabilityResult answer =
      partitionProbability(a.placed, b.placed, displacement, request, nullptr);
  writer.finish({*answer.lower, *answer.upper});
  answer.plan.emplace_back("certificate written: boxes only, on one thread");
  return answer;
}

}  // namespace fcl_prob::detail
