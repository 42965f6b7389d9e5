// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "oracle.h"

#include <cmath>

#include "containment_ray.h"
#include "unbounded_contact.h"

namespace oracle {

namespace {

std::vector<Part> partsOf(const std::vector<Placed>& placed, Contact contact) {
  std::vector<Part> parts;
  for (const Placed& one : placed) parts.emplace_back(*one.geometry, one.pose, contact);
  return parts;
}

/// A, displaced, relative to B.
struct Offset {
  LongVector offset;
  LongVector error;  ///< of a point of b - a - offset
  WideVector wide_offset;
  WideVector wide_error;
};

/// Corners of two pieces of parts.
class PairCorners : public Corners {
 public:
  PairCorners(const Part& a, const Part& b, const Displacement& displacement, Effort& effort)
      : a_(a), b_(b), displacement_(displacement), effort_(effort) {}

  void choose(int piece_a, int piece_b) {
    piece_a_ = piece_a;
    piece_b_ = piece_b;
  }

  ExactVector exactA(int i) const override {
    effort_.exact += i == 0 ? 1 : 0;
    return a_.exactCorner(piece_a_, i) + displacement_.exact();
  }
  ExactVector exactB(int i) const override { return b_.exactCorner(piece_b_, i); }
  WideVector wideA(int i) const override { return a_.wideCorner(piece_a_, i); }
  WideVector wideB(int i) const override { return b_.wideCorner(piece_b_, i); }

 private:
  const Part& a_;
  const Part& b_;
  const Displacement& displacement_;
  Effort& effort_;
  int piece_a_ = 0;
  int piece_b_ = 0;
};

Offset offsetOf(const Part& a, const Part& b, const Displacement& displacement) {
  Offset result;
  result.wide_offset = a.reference() + displacement.rounded() - b.reference();
  result.offset = toLong(result.wide_offset);
  // The sums of three rounded numbers, and of 237 bits what cancels.
  Long largest = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const Wide sum = abs(a.reference()[k]) + abs(displacement.rounded()[k]) + abs(b.reference()[k]);
    largest = std::max(largest, sum.convert_to<Long>());
  }
  const LongVector size = a.extent() + b.extent() + result.offset.cwiseAbs();
  result.error = a.error() + b.error() + std::ldexp(1.0L, -61) * size +
                 LongVector::Constant(std::ldexp(largest, -225));
  const Wide wide_error =
      a.wideError() + b.wideError() + ldexp(Wide(largest) + Wide(size.maxCoeff()), -225);
  result.wide_error = {wide_error, wide_error, wide_error};
  return result;
}

bool clear(const PieceBox& a, const PieceBox& b, const Offset& offset) {
  for (int k = 0; k < 3; ++k) {
    const Long margin = 2 * offset.error[k];
    if (b.lo[k] - a.hi[k] - offset.offset[k] > margin) return true;
    if (b.hi[k] - a.lo[k] - offset.offset[k] < -margin) return true;
  }
  return false;
}

/// FCL passes over what is free beside an octree of several cells, and a mesh of several triangles
/// beside any.
bool isPassedOver(const Part& part, const Part& other) {
  if (!part.isOccupied()) return true;
  const bool descends =
      other.isDividedOctree() || (other.isOctree() && part.isMesh() && part.pieceCount() > 1);
  return descends && part.isFree();
}

/// Whether one of the connected parts of `inner`, of which the surface is clear of the mesh
/// `outer`, is within it. `sign` is that of the displacement of `inner` against `outer`.
Verdict isWithin(const Part& inner, const Part& outer, const Displacement& displacement,
                 const Offset& offset, double sign, std::size_t& exact_questions) {
  Query query;
  query.error = offset.error;
  const LongVector shift = static_cast<Long>(sign) * offset.offset;
  const auto exactShift = [&] { return scaled(Rational(sign), displacement.exact()); };
  if (inner.representatives().empty() && inner.pieceCount() > 0) {
    query.point = shift;
    query.exact = [&] { return inner.exactVertex(0) + exactShift(); };
    return isFilledAt(outer, query, exact_questions);
  }
  Verdict result = Verdict::apart;
  for (int vertex : inner.representatives()) {
    query.point = inner.vertex(vertex) + shift;
    query.exact = [&, vertex] { return inner.exactVertex(vertex) + exactShift(); };
    const Verdict verdict = isFilledAt(outer, query, exact_questions);
    if (verdict == Verdict::touching) return verdict;
    if (verdict == Verdict::undecided) result = verdict;
  }
  return result;
}

Verdict either(Verdict first, Verdict second) {
  if (first == Verdict::touching || second == Verdict::touching) return Verdict::touching;
  return first == Verdict::undecided ? first : second;
}

}  // namespace

Displacement::Displacement(const Eigen::Vector3d& exact)
    : rounded_(converted<Wide>(exact)), exact_([exact] { return converted<Rational>(exact); }) {}

Displacement::Displacement(const ExactVector& exact)
    : rounded_(toWide(exact)), exact_([exact] { return exact; }) {}

Scene::Scene(const Placed& a, const Placed& b, Contact contact)
    : Scene(std::vector<Placed>{a}, std::vector<Placed>{b}, contact) {}

Scene::Scene(const std::vector<Placed>& a, const std::vector<Placed>& b, Contact contact)
    : a_(partsOf(a, contact)), b_(partsOf(b, contact)) {}

Verdict Scene::touches(const Displacement& displacement) const {
  Verdict result = Verdict::apart;
  for (const Part& a : a_) {
    for (const Part& b : b_) {
      result = either(result, touches(a, b, displacement));
      if (result == Verdict::touching) return result;
    }
  }
  return result;
}

Verdict Scene::touches(const Part& a, const Part& b, const Displacement& displacement) const {
  if (isPassedOver(a, b) || isPassedOver(b, a)) return Verdict::apart;
  if (a.isUnbounded() && b.isUnbounded()) {
    return unboundedMeet(a.unbounded(), b.unbounded(), displacement);
  }
  if (b.isUnbounded()) return meetsUnbounded(a, displacement, 1.0, b.unbounded());
  if (a.isUnbounded()) return meetsUnbounded(b, displacement, -1.0, a.unbounded());
  const Verdict surfaces = surfacesTouch(a, b, displacement);
  if (surfaces == Verdict::touching || !(a.isSolidMesh() || b.isSolidMesh())) return surfaces;
  const Offset offset = offsetOf(a, b, displacement);
  Verdict within = Verdict::apart;
  if (b.isSolidMesh()) within = isWithin(a, b, displacement, offset, 1.0, effort_.exact);
  if (a.isSolidMesh() && within != Verdict::touching) {
    within = either(within, isWithin(b, a, displacement, offset, -1.0, effort_.exact));
  }
  // Within and perhaps touching is touching; perhaps touching and not within is not known.
  return either(surfaces, within);
}

Verdict Scene::surfacesTouch(const Part& a, const Part& b, const Displacement& displacement) const {
  if (a.nodes().empty() || b.nodes().empty()) return Verdict::apart;
  const Offset offset = offsetOf(a, b, displacement);
  ConvexPair pair;
  pair.offset = offset.offset;
  pair.error = offset.error;
  pair.wide_offset = offset.wide_offset;
  pair.wide_error = offset.wide_error;
  PairCorners corners(a, b, displacement, effort_);
  pair.corners = &corners;
  Verdict result = Verdict::apart;
  std::vector<std::pair<int, int>> stack{{0, 0}};
  while (!stack.empty()) {
    const auto [i, j] = stack.back();
    stack.pop_back();
    const PieceNode& of_a = a.nodes()[static_cast<std::size_t>(i)];
    const PieceNode& of_b = b.nodes()[static_cast<std::size_t>(j)];
    if (clear(of_a.box, of_b.box, offset)) continue;
    if (of_a.piece < 0 || of_b.piece < 0) {
      const bool open_a = of_b.piece >= 0 ||
                          (of_a.piece < 0 &&
                           (of_a.box.hi - of_a.box.lo).sum() >= (of_b.box.hi - of_b.box.lo).sum());
      for (const int child : {0, 1}) {
        const PieceNode& opened = open_a ? of_a : of_b;
        const int next = child == 0 ? opened.left : opened.right;
        stack.emplace_back(open_a ? next : i, open_a ? j : next);
      }
      continue;
    }
    ++effort_.pairs;
    pair.a = a.piece(of_a.piece);
    pair.b = b.piece(of_b.piece);
    corners.choose(of_a.piece, of_b.piece);
    const Verdict verdict = meet(pair);
    if (verdict == Verdict::touching) return verdict;
    if (verdict == Verdict::undecided) result = verdict;
  }
  return result;
}

}  // namespace oracle
