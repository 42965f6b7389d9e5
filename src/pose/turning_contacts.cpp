// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "pose/turning_contacts.h"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <vector>

#include "base/random_words.h"
#include "base/symmetric_axes.h"
#include "gaussian/normal_density.h"
#include "lines/line_crossings.h"

namespace fcl_prob::detail {
namespace {

constexpr std::uint64_t kStreamOfContacts = 0x7475726e;
constexpr std::uint64_t kLines = 64;
constexpr std::size_t kEnoughContacts = 6;

// One over the mean of |n·u| for a unit vector u of random direction, by its dimension.
constexpr double kCrofton[] = {0.0, 1.0, 1.5707963267948966, 2.0};

struct Contact {
  Eigen::Vector3d point;   ///< of A, not displaced, world frame
  Eigen::Vector3d normal;  ///< per metre, in deviations
  double weight;
};

std::vector<Contact> contactsOf(const PartitionObject& a, const PartitionObject& b,
                                const GaussianDisplacement& displacement, std::uint64_t seed) {
  const Whitening whitening(displacement, std::max({a.tree->radius(), b.tree->radius(), 1e-150}));
  const WhitenedPair pair = whiten(a, b, whitening);
  const Eigen::Vector3d origin = a.parts[0].pose * a.tree->parts[0].origin;
  const int rank = whitening.rank();
  LineCrossings crossings(pair);
  std::vector<Contact> contacts;
  for (std::uint64_t i = 0; i < kLines; ++i) {
    Eigen::Vector3d u = standardNormalFrom(randomWords({seed, kStreamOfContacts}, i, 0));
    Eigen::Vector3d y = standardNormalFrom(randomWords({seed, kStreamOfContacts}, i, 1));
    for (int k = rank; k < 3; ++k) u[k] = y[k] = 0.0;
    u.normalize();
    y -= y.dot(u) * u;
    for (const LineStretch& stretch : crossings.on(y, u)) {
      for (const LineEnd* end : {&stretch.from, &stretch.to}) {
        const double across = end->normal.head(rank).norm();
        if (!(across > 0.0)) continue;
        contacts.push_back({origin + whitening.inverse() * crossings.touchingPointOfA(*end),
                            whitening.matrix().transpose() * end->normal / across,
                            kCrofton[rank] * normalDensity(end->at) / kLines});
      }
    }
  }
  return contacts;
}

// Least squares of what turning about it moves contacts along their normals.
Eigen::Vector3d centreOf(const std::vector<Contact>& contacts, const Eigen::MatrixXd& turns) {
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  double sum = 0.0;
  for (const Contact& contact : contacts) {
    middle += contact.weight * contact.point;
    sum += contact.weight;
  }
  middle /= sum;
  Eigen::Matrix3d squares = Eigen::Matrix3d::Zero();
  Eigen::Vector3d product = Eigen::Vector3d::Zero();
  for (const Contact& contact : contacts) {
    for (Eigen::Index j = 0; j < turns.cols(); ++j) {
      // n·(turn × x) = (n × turn)·x
      const Eigen::Vector3d across = contact.normal.cross(Eigen::Vector3d(turns.col(j)));
      squares += contact.weight * across * across.transpose();
      product += contact.weight * across * across.dot(contact.point - middle);
    }
  }
  squares += 0.02 * squares.trace() * Eigen::Matrix3d::Identity();
  const Eigen::Vector3d off = squares.ldlt().solve(product);
  return off.allFinite() ? Eigen::Vector3d(middle + off) : middle;
}

}  // namespace

std::optional<TurningContacts> turningContacts(const PartitionObject& a, const PartitionObject& b,
                                               const GaussianDisplacement& displacement,
                                               const Eigen::MatrixXd& turns, std::uint64_t seed) {
  if (displacement.rank() == 0) return std::nullopt;
  const std::vector<Contact> contacts = contactsOf(a, b, displacement, seed);
  double sum = 0.0;
  for (const Contact& contact : contacts) sum += contact.weight;
  if (contacts.size() < kEnoughContacts || !(sum > 1e-12)) return std::nullopt;
  TurningContacts result;
  result.pushed = 0.0;
  for (const Contact& contact : contacts) result.pushed += contact.weight * contact.normal.norm();
  result.centre = centreOf(contacts, turns);
  Eigen::MatrixXd moved(turns.cols(), static_cast<Eigen::Index>(contacts.size()));
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    for (Eigen::Index j = 0; j < turns.cols(); ++j) {
      const Eigen::Vector3d turn = turns.col(j);
      moved(j, static_cast<Eigen::Index>(i)) =
          contacts[i].weight *
          contacts[i].normal.dot(turn.cross(contacts[i].point - result.centre));
    }
  }
  const auto principal = symmetricAxes(Eigen::MatrixXd(moved * moved.transpose()));
  result.axes = principal.eigenvectors().rowwise().reverse();
  result.moved = (result.axes.transpose() * moved).cwiseAbs().rowwise().sum();
  return result;
}

}  // namespace fcl_prob::detail
