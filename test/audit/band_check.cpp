// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "band_check.h"

#include <cmath>
#include <map>
#include <optional>
#include <tuple>

#include "ask.h"
#include "oracle_check.h"
#include "random_bodies.h"

namespace fcl_prob_audit {
namespace {

using fcl_prob_test::RandomBodies;

// Of the band, so that the rounding of moved coordinates stays within it.
constexpr double kShare = 0.999999;

enum class Motion { none, all_one_way, outwards, inwards, each_its_own_way };

/// How the points of one shape move.
struct Field {
  Motion motion;
  Vector3d direction;
  double length;

  Vector3d moved(const Vector3d& v, const Vector3d& middle, RandomBodies& random) const {
    const Vector3d from_middle = v - middle;
    const double radius = from_middle.norm();
    switch (motion) {
      case Motion::none:
        return v;
      case Motion::all_one_way:
        return v + length * direction;
      case Motion::outwards:
        return radius > 0.0 ? Vector3d(v + length / radius * from_middle) : v;
      case Motion::inwards:
        return radius > 0.0 ? Vector3d(v - length / radius * from_middle) : v;
      case Motion::each_its_own_way:
        return v + length * random.direction();
    }
    return v;
  }
};

/// Corners at the same place stay so: a triangle's points are between its corners, and move by no
/// more than those.
Shape movedMesh(const Shape& shape, const Field& field, RandomBodies& random) {
  Shape result = shape;
  std::vector<Vector3d>& vertices = result.mesh.vertices;
  Vector3d middle = Vector3d::Zero();
  for (const Vector3d& v : vertices) middle += v / static_cast<double>(vertices.size());
  std::map<std::tuple<double, double, double>, Vector3d> places;
  for (Vector3d& v : vertices) {
    const auto key = std::make_tuple(v.x(), v.y(), v.z());
    auto place = places.find(key);
    if (place == places.end()) {
      place = places.emplace(key, field.moved(v, middle, random)).first;
    }
    v = place->second;
  }
  return result;
}

std::optional<Shape> moved(const Shape& shape, const Field& field, RandomBodies& random) {
  if (shape.kind == Kind::mesh || shape.kind == Kind::triangle) {
    return movedMesh(shape, field, random);
  }
  const double growth = field.motion == Motion::outwards  ? field.length
                        : field.motion == Motion::inwards ? -field.length
                                                          : 0.0;
  Shape result = shape;
  if (shape.kind == Kind::sphere) {
    if (result.sizes[0] + growth > 0.0) result.sizes[0] += growth;
    return result;
  }
  if (shape.kind != Kind::box) return std::nullopt;
  for (int k = 0; k < 3; ++k) {
    const double side = result.sizes[k] + 2.0 * growth / std::sqrt(3.0);
    if (side > 0.0) result.sizes[k] = side;
  }
  return result;
}

bool canHaveBands(const Scene& scene) {
  return scene.question == Question::pair && scene.displacements.size() == 1 && !scene.truncation &&
         !scene.cancel_after && !scene.request.time_limit &&
         makeDisplacement(scene.displacements[0]).rank() > 0;
}

double bandOf(double size, RandomBodies& random) { return size * random.logUniform(1e-9, 0.2); }

}  // namespace

void checkBands(const Scene& scene, Tally& tally, std::vector<Violation>& found) {
  if (!canHaveBands(scene)) return;
  RandomBodies random(static_cast<unsigned>(scene.seed * 1000033 + scene.index));
  const double size = std::min(extentOf(scene.a[0].shape), extentOf(scene.b[0].shape));
  if (!(size > 0.0)) return;
  Scene model = scene;
  model.request.method = fcl_prob::ProbabilityMethod::interval;
  model.request.gradient = false;
  model.request.threshold.reset();
  model.request.max_cells = std::min<std::size_t>(scene.request.max_cells, 2000);
  const double band_a = bandOf(size, random);
  const double band_b = random.integer(0, 2) > 0 ? bandOf(size, random) : 0.0;
  model.request.band_a = fcl_prob::Band::within(band_a);
  model.request.band_b = fcl_prob::Band::within(band_b);

  const auto motion = [&] { return static_cast<Motion>(random.integer(0, 4)); };
  const Field of_a{motion(), random.direction(), kShare * band_a};
  // What moves one way is worst where the other comes to meet it.
  const bool meet = of_a.motion == Motion::all_one_way;
  const Field of_b{meet ? Motion::all_one_way : motion(),
                   meet ? Vector3d(-of_a.direction) : random.direction(), kShare * band_b};
  const auto a = moved(scene.a[0].shape, of_a, random);
  const auto b = moved(scene.b[0].shape, of_b, random);
  if (!a || !b) return;
  Scene truth = scene;
  truth.a[0].shape = *a;
  truth.b[0].shape = *b;

  ++tally.checks["bands"];
  std::vector<Violation> violations;
  const Answer answer = askCheckingClaims(model, truth, tally.families[scene.family], violations);
  for (Violation& violation : violations) {
    found.push_back({"bands, " + violation.check, violation.detail});
  }
  if (!answer.foreign_exception.empty()) {
    found.push_back({"bands, exception", answer.foreign_exception});
  }
  if (!answer) return;
  truth.request.method = fcl_prob::ProbabilityMethod::interval;
  const Answer known = ask(truth);
  if (!known || !known.result->lower || !known.result->upper) return;
  if (*answer.result->lower > *known.result->upper ||
      *answer.result->upper < *known.result->lower) {
    found.push_back({"bands", "with bands " + textOf(*answer.result) + ", moved shapes " +
                                  textOf(*known.result)});
  }
}

}  // namespace fcl_prob_audit
