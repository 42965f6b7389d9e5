// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "query_invariants.h"

#include <cmath>
#include <random>
#include <sstream>

#include "fcl_prob/collision_probability.h"
#include "fcl_prob/exceptions.h"
#include "fcl_prob/monte_carlo.h"
#include "fuzz_tally.h"
#include "geometry/displaced_collider.h"
#include "geometry/mesh_visitor.h"

using namespace fcl_prob;

namespace fcl_prob_fuzz {
namespace {

constexpr int kSamples = 24;

void requireProbability(double value, const char* name) {
  require(value >= 0.0 && value <= 1.0,
          std::string(name) + " is no probability: " + std::to_string(value));
}

void requireFinite(const std::optional<Eigen::Vector3d>& vector, const char* name) {
  require(!vector || vector->allFinite(), std::string(name) + " is not finite");
}

void requireOrdered(const std::optional<Eigen::Vector3d>& least,
                    const std::optional<Eigen::Vector3d>& most) {
  if (least && most) require((least->array() <= most->array()).all(), "gradient bounds cross");
}

std::string boundsText(const ProbabilityResult& result) {
  std::ostringstream out;
  out.precision(17);
  out << toString(result.method) << " [" << result.lower.value_or(-1.0) << ", "
      << result.upper.value_or(-1.0) << "]";
  return out.str();
}

/// Logarithm of a bound (Chernoff's) of the probability of a share of hits as far from p as this.
double logChance(double share, double p) {
  const auto term = [](double x, double y) { return x > 0.0 ? x * std::log(x / y) : 0.0; };
  return -kSamples * (term(share, p) + term(1.0 - share, 1.0 - p));
}

bool isMesh(const Geometry& geometry) { return geometry->getObjectType() == fcl::OT_BVH; }

/// Pairs for which FCL has a test of its own rather than an iteration to a tolerance.
bool fclIsReliable(const PairScene& scene) {
  const auto type_a = scene.a->getNodeType();
  const auto type_b = scene.b->getNodeType();
  if (!fclSupportsPair(*scene.a, *scene.b)) return false;
  return (isMesh(scene.a) && isMesh(scene.b)) ||
         (type_a == fcl::GEOM_BOX && type_b == fcl::GEOM_BOX) ||
         (type_a == fcl::GEOM_SPHERE && type_b == fcl::GEOM_SPHERE);
}

/// What a displacement and some around it say; nothing if they differ.
std::optional<bool> robustlyCollides(const detail::DisplacedCollider& collider,
                                     const Eigen::Vector3d& displacement, double margin) {
  const bool collides = collider.collides(displacement);
  for (int axis = 0; axis < 3; ++axis) {
    for (const double step : {-margin, margin}) {
      const Eigen::Vector3d moved = displacement + step * Eigen::Vector3d::Unit(axis);
      if (collider.collides(moved) != collides) return std::nullopt;
    }
  }
  return collides;
}

}  // namespace

std::optional<ProbabilityResult> answerOf(const PairScene& scene) {
  try {
    ProbabilityResult result;
    collisionProbability(scene.a.get(), scene.pose_a, scene.b.get(), scene.pose_b,
                         scene.displacement, scene.request, result);
    return result;
  } catch (const UnsupportedGeometry&) {
  } catch (const OpenMesh&) {
  } catch (const InvalidRequest&) {
  } catch (const InvalidGeometry&) {
    // Lengths whose squares overflow; so may translations and means.
  } catch (const InvalidPose&) {
  } catch (const InvalidDistribution&) {
  }
  return std::nullopt;
}

std::string textOf(const PairScene& scene) {
  std::ostringstream out;
  out.precision(17);
  const Eigen::IOFormat row(Eigen::FullPrecision, Eigen::DontAlignCols, ", ", "; ");
  const auto add = [&](const char* name, const Geometry& geometry, const fcl::Transform3d& pose) {
    out << name << ": node type " << geometry->getNodeType() << ", box "
        << geometry->aabb_local.min_.format(row) << " to " << geometry->aabb_local.max_.format(row)
        << "\n  pose " << pose.matrix().topRows<3>().format(row) << "\n";
    if (!isMesh(geometry)) return;
    const detail::MeshView mesh = detail::meshView(*geometry);
    for (int i = 0; i < mesh.vertex_count; ++i)
      out << "  v " << mesh.vertices[i].format(row) << "\n";
    for (int i = 0; i < mesh.triangle_count; ++i) {
      const fcl::Triangle& t = mesh.triangles[i];
      out << "  t " << t[0] << " " << t[1] << " " << t[2] << "\n";
    }
  };
  add("A", scene.a, scene.pose_a);
  add("B", scene.b, scene.pose_b);
  out << "mean " << scene.displacement.mean().format(row) << "\nsigma "
      << scene.displacement.standardDeviations().format(row) << "\naxes "
      << scene.displacement.axes().format(row) << "\nmethod " << toString(scene.request.method)
      << ", contact " << static_cast<int>(scene.request.contact) << ", cells "
      << scene.request.max_cells << ", memory " << scene.request.max_memory << ", tolerance "
      << scene.request.relative_tolerance << ", threshold "
      << scene.request.threshold.value_or(-1.0) << ", gradient " << scene.request.gradient << "\n";
  return out.str();
}

PairScene swapped(const PairScene& scene) {
  PairScene result = scene;
  std::swap(result.a, result.b);
  std::swap(result.pose_a, result.pose_b);
  result.displacement = scene.displacement.reversed();
  return result;
}

void requireSound(const ProbabilityResult& result) {
  if (result.lower) requireProbability(*result.lower, "lower");
  if (result.upper) requireProbability(*result.upper, "upper");
  if (result.lower && result.upper) {
    require(*result.lower <= *result.upper, "bounds cross: " + boundsText(result));
  }
  require(!result.estimate || std::isfinite(*result.estimate), "estimate is not finite");
  require(!result.standard_error || *result.standard_error >= 0.0, "standard error below 0");
  requireFinite(result.gradient, "gradient");
  requireFinite(result.gradient_lower, "lower gradient");
  requireFinite(result.gradient_upper, "upper gradient");
  requireOrdered(result.gradient_lower, result.gradient_upper);
}

void requireCompatible(const ProbabilityResult& x, const ProbabilityResult& y,
                       const std::string& difference) {
  const bool holds = x.lower.value_or(0.0) <= y.upper.value_or(1.0) &&
                     y.lower.value_or(0.0) <= x.upper.value_or(1.0);
  require(holds, difference + ": " + boundsText(x) + " and " + boundsText(y));
}

void requireSame(const ProbabilityResult& x, const ProbabilityResult& y) {
  require(x.lower == y.lower && x.upper == y.upper && x.estimate == y.estimate &&
              x.gradient == y.gradient && x.status == y.status,
          "two answers to one question: " + boundsText(x) + " and " + boundsText(y));
}

bool requireSamplesAgree(const PairScene& scene, const ProbabilityResult& result,
                         std::uint64_t seed) {
  const double margin = 1e-5 * (scene.a->aabb_radius + scene.b->aabb_radius);
  const Eigen::Vector3d& sigma = scene.displacement.standardDeviations();
  if (!fclIsReliable(scene) || sigma.minCoeff() < 10.0 * margin) return false;
  // Upper bounds of solids ask for no closed meshes, so that nobody has looked.
  const bool bound = scene.request.method == ProbabilityMethod::convex_pcd;
  const detail::DisplacedCollider collider(*scene.a, scene.pose_a, *scene.b, scene.pose_b,
                                           bound ? ContactMeaning::fcl : scene.request.contact);
  std::mt19937_64 engine(seed);
  std::normal_distribution<double> normal;
  double hits = 0.0, misses = 0.0;
  for (int i = 0; i < kSamples; ++i) {
    const Eigen::Vector3d whitened(normal(engine), normal(engine), normal(engine));
    const Eigen::Vector3d displacement =
        scene.displacement.mean() + scene.displacement.axes() * sigma.cwiseProduct(whitened);
    const std::optional<bool> collides = robustlyCollides(collider, displacement, margin);
    if (collides) (*collides ? hits : misses) += 1.0 / kSamples;
  }
  constexpr double kLogLeastChance = -30.0;
  const double upper = result.upper.value_or(1.0);
  const double lower = result.lower.value_or(0.0);
  const bool too_many = hits > upper && logChance(hits, upper) < kLogLeastChance;
  const bool too_few = 1.0 - misses < lower && logChance(1.0 - misses, lower) < kLogLeastChance;
  require(!too_many && !too_few, "samples hit " + std::to_string(hits) + ", miss " +
                                     std::to_string(misses) + ", but " + boundsText(result));
  return true;
}

}  // namespace fcl_prob_fuzz
