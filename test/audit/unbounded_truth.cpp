// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "unbounded_truth.h"

#include <boost/math/special_functions/erf.hpp>

#include "placed_set.h"

namespace fcl_prob_audit {
namespace {

/// A half-space or plane in the world: normal·x <= offset, or = offset.
struct Flat {
  Vec<Exact> normal;
  Exact offset;
  bool is_plane;
};

/// Placed as fcl::transform does it.
Flat flatOf(const Member& member) {
  const Vec<Exact> n = turned(member.pose, toVec<Exact>(member.shape.normal));
  const Exact offset = Exact(member.shape.offset) + n.dot(toVec<Exact>(member.pose.translation()));
  return {n, offset, member.shape.kind == Kind::plane};
}

/// How far a round shape reaches from its origin along a direction of its own frame.
Exact reachOf(const Shape& shape, const Vec<Exact>& n) {
  const Exact across = sqrt(Exact(n.x * n.x + n.y * n.y));
  const Exact length = sqrt(n.dot(n));
  const Exact radius(shape.sizes[0]), half = Exact(shape.sizes[1]) / 2;
  switch (shape.kind) {
    case Kind::sphere:
      return radius * length;
    case Kind::ellipsoid: {
      const Vec<Exact> scaled{n.x * radius, n.y * Exact(shape.sizes[1]),
                              n.z * Exact(shape.sizes[2])};
      return sqrt(scaled.dot(scaled));
    }
    case Kind::capsule:
      return radius * length + half * Exact(abs(n.z));
    case Kind::cylinder:
      return radius * across + half * Exact(abs(n.z));
    default:  // a cone, its tip towards z
      return std::max(Exact(half * n.z), Exact(radius * across - half * n.z));
  }
}

bool isRound(Kind kind) {
  return kind == Kind::sphere || kind == Kind::ellipsoid || kind == Kind::capsule ||
         kind == Kind::cylinder || kind == Kind::cone;
}

/// What the pieces of a member reach along a direction of the world.
std::vector<Span<Exact>> extentsOf(const Member& member, const Vec<Exact>& n) {
  std::vector<Span<Exact>> spans;
  if (isRound(member.shape.kind)) {
    const auto column = [&](int k) { return toVec<Exact>(member.pose.linear().col(k)).dot(n); };
    const Vec<Exact> local{column(0), column(1), column(2)};
    const Exact middle = n.dot(toVec<Exact>(member.pose.translation()));
    spans.push_back(
        {middle - reachOf(member.shape, local * Exact(-1)), middle + reachOf(member.shape, local)});
    return spans;
  }
  PlacedSet<Exact> set;
  addMember(member, false, set);
  for (const Piece<Exact>& piece : set.pieces) spans.push_back(extentAlong(piece, n));
  return spans;
}

bool allUnbounded(const std::vector<Member>& members, bool expected) {
  for (const Member& member : members) {
    if (member.shape.isUnbounded() != expected) return false;
  }
  return true;
}

/// Displacements along the normal (of the bounded one, if `sign` is 1) at which the two touch.
std::vector<Span<Exact>> touching(const Flat& flat, const Member& member, int sign) {
  const Exact far("1e400");
  std::vector<Span<Exact>> spans;
  for (const Span<Exact>& extent : extentsOf(member, flat.normal)) {
    const Exact first = flat.is_plane ? Exact(flat.offset - extent.hi) : Exact(-far);
    const Exact last = flat.offset - extent.lo;
    spans.push_back(sign > 0 ? Span<Exact>{first, last} : Span<Exact>{-last, -first});
  }
  return spans;
}

}  // namespace

Exact normalMass(const Span<Exact>& span) {
  if (span.hi < span.lo) return 0;
  // On the side of the tail, where nothing cancels.
  if (span.lo + span.hi < 0) return normalMass({-span.hi, -span.lo});
  const Exact root = sqrt(Exact(2));
  const auto tail = [&](const Exact& x) -> Exact {
    if (x > 10'000) return 0;
    if (x < -10'000) return 2;
    return boost::math::erfc(Exact(x / root));
  };
  return (tail(span.lo) - tail(span.hi)) / 2;
}

Exact massOfSpan(const Span<Exact>& span, const Exact& mean, const Exact& deviation) {
  if (deviation == 0) return span.lo <= mean && mean <= span.hi ? 1 : 0;
  return normalMass({(span.lo - mean) / deviation, (span.hi - mean) / deviation});
}

std::optional<Exact> unboundedProbability(const TruthQuestion& question, const Normal& normal,
                                          const std::array<Exact, 3>& shift) {
  const bool first = allUnbounded(question.a, true) && allUnbounded(question.b, false);
  const bool second = allUnbounded(question.a, false) && allUnbounded(question.b, true);
  if (first == second) return std::nullopt;
  const std::vector<Member>& flats = first ? question.a : question.b;
  const std::vector<Member>& others = first ? question.b : question.a;
  if (flats.size() != 1) return std::nullopt;
  const Flat flat = flatOf(flats[0]);
  std::vector<Span<Exact>> spans;
  for (const Member& member : others) {
    if (!member.shape.isOccupied()) continue;
    const auto more = touching(flat, member, first ? -1 : 1);
    spans.insert(spans.end(), more.begin(), more.end());
  }
  Exact variance = 0;
  for (int k = 0; k < normal.rank; ++k) {
    const Exact part = flat.normal.dot(toVec<Exact>(normal.axes.col(k))) * Exact(normal.sigma[k]);
    variance += part * part;
  }
  const Exact mean =
      flat.normal.dot(toVec<Exact>(normal.mean) + Vec<Exact>{shift[0], shift[1], shift[2]});
  const Exact deviation = sqrt(variance);
  Exact mass = 0;
  for (const Span<Exact>& span : united(std::move(spans))) {
    mass += massOfSpan(span, mean, deviation);
  }
  return mass;
}

}  // namespace fcl_prob_audit
