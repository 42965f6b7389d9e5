// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Families of two boxes, as shapes and as meshes.
#include <cmath>

#include "bench/stability_case.h"

namespace fcl_prob::cli {
namespace {

using Eigen::Vector3d;
using Method = ProbabilityMethod;

/// A multiple of 2^-10: sums and differences of such numbers are exact.
double dyadic(double value) { return std::round(value * 1024) / 1024; }

Vector3d dyadic(const Vector3d& v) {
  return v.unaryExpr([](double x) { return dyadic(x); });
}

/// How far along one axis the centre of the C-obstacle is from the mean.
using Offset = std::function<double(StabilityRandom&, double reach, double sigma)>;

/// Near a face of the C-obstacle, or between two of them.
double nearFace(StabilityRandom& random, double reach, double sigma) {
  const double sign = random.coin() ? 1.0 : -1.0;
  if (random.coin()) return sign * random.uniform(0, 1) * reach;
  return sign * (reach + random.uniform(-2, 2) * sigma);
}

/// Half sides of up to `size` and a C-obstacle at `offset` from the mean, in a world turned at
/// random in every other case.
BoxScene boxScene(StabilityRandom& random, double size, const Vector3d& sigma,
                  const Offset& offset = nearFace) {
  BoxScene scene;
  scene.half_a = size * random.uniformVector(0.2, 1);
  scene.half_b = size * random.uniformVector(0.2, 1);
  scene.sigma = sigma;
  if (random.coin()) scene.turn = random.rotation();
  Vector3d centre;
  for (Eigen::Index k = 0; k < 3; ++k) {
    centre[k] = offset(random, scene.half_a[k] + scene.half_b[k], sigma[k]);
  }
  scene.at_a = size * random.uniformVector(-1, 1);
  scene.at_b = scene.at_a + scene.turn * centre;
  return scene;
}

Vector3d ordinarySigma(StabilityRandom& random, double size) {
  return size * Vector3d(random.logUniform(0.03, 1), random.logUniform(0.03, 1),
                         random.logUniform(0.03, 1));
}

BoxScene badlyConditioned(StabilityRandom& random) {
  const double largest = random.logUniform(0.03, 1), least = largest * random.logUniform(1e-8, 1);
  BoxScene scene = boxScene(random, 1, {largest, random.logUniform(least, largest), least});
  scene.covariance_matrix = !scene.isTurned() && random.coin();
  return scene;
}

BoxScene ofRank(int rank, StabilityRandom& random) {
  Vector3d sigma = ordinarySigma(random, 1);
  const int first = random.integer(0, 2);
  for (int k = rank; k < 3; ++k) sigma[(first + k) % 3] = 0;
  return boxScene(random, 1, sigma, [](StabilityRandom& r, double reach, double s) {
    // Where nothing moves, mostly in reach, and never as near to touching as rounding is.
    if (s > 0) return nearFace(r, reach, s);
    return (r.coin() ? 1 : -1) * reach * (r.uniform(0, 1) < 0.9 ? r.uniform(0, 0.999) : 1.001);
  });
}

BoxScene anySigma(StabilityRandom& random) {
  const double sigma = random.logUniform(1e-12, 1e12);
  return boxScene(random, 1, sigma * random.uniformVector(0.2, 1));
}

/// Along one axis far beyond the size, along another far below it, and the offset with them.
BoxScene mixedSigma(StabilityRandom& random) {
  const Vector3d sigma(random.logUniform(1e-6, 1e6), random.logUniform(1e-6, 1e6),
                       random.logUniform(1e-6, 1e6));
  return boxScene(random, 1, sigma);
}

BoxScene anyLength(StabilityRandom& random) {
  const double size = random.logUniform(1e-9, 1e9);
  return boxScene(random, size, ordinarySigma(random, size));
}

BoxScene farFromOrigin(StabilityRandom& random) {
  BoxScene scene = boxScene(random, 1, ordinarySigma(random, 1));
  const Vector3d far = 1e6 * random.uniformVector(-1, 1);
  scene.at_a += far;
  scene.at_b += far;
  return scene;
}

BoxScene rare(StabilityRandom& random) {
  const double size = random.logUniform(1e-3, 1e3);
  const int tail = random.integer(0, 2);
  int axis = 0;
  return boxScene(random, size, random.uniformVector(0.5, 1),
                  [&](StabilityRandom& r, double reach, double sigma) {
                    if (axis++ != tail) return r.uniform(-1, 1) * reach;
                    return reach + r.uniform(0, 36.5) * sigma;
                  });
}

BoxScene nearlyCertain(StabilityRandom& random) {
  const Vector3d half = random.uniformVector(0.5, 1);
  BoxScene scene;
  scene.half_a = scene.half_b = half;
  scene.sigma = 2 * half / random.uniform(1, 8.5);
  if (random.coin()) scene.turn = random.rotation();
  scene.at_a = random.uniformVector(-1, 1);
  scene.at_b = scene.at_a;
  return scene;
}

/// Faces that touch, are coplanar, or are the same, to the last bit, at the mean.
BoxScene aligned(StabilityRandom& random) {
  BoxScene scene;
  scene.half_a = dyadic(random.uniformVector(0.2, 1));
  scene.half_b = random.coin() ? scene.half_a : dyadic(random.uniformVector(0.2, 1));
  scene.sigma = ordinarySigma(random, 1);
  scene.at_a = dyadic(random.uniformVector(-1, 1));
  scene.at_b = scene.at_a;
  for (Eigen::Index k = 0; k < 3; ++k) {
    const double sum = scene.half_a[k] + scene.half_b[k];
    const double difference = scene.half_b[k] - scene.half_a[k];
    const double centres[] = {sum, -sum, difference, -difference, 0};
    scene.at_b[k] += centres[random.integer(0, 4)];
  }
  return scene;
}

BoxScene alignedOfLowRank(StabilityRandom& random) {
  BoxScene scene = aligned(random);
  const int dead = random.integer(1, 2), first = random.integer(0, 2);
  for (int k = 0; k < dead; ++k) scene.sigma[(first + k) % 3] = 0;
  return scene;
}

BoxScene farMean(StabilityRandom& random) {
  BoxScene scene = boxScene(
      random, 1, ordinarySigma(random, 0.1),
      [](StabilityRandom& r, double reach, double) { return reach * r.uniform(-0.2, 0.2); });
  if (random.coin()) scene.mean = random.logUniform(10, 1e9) * (scene.turn * Vector3d(1, 0.3, 0));
  return scene;
}

/// A vertex on the edge between two others, very near to one of them: two slivers a triangle.
void addSlivers(TriangleMesh& mesh, StabilityRandom& random) {
  for (int count = 0; count < 3; ++count) {
    const auto picked =
        static_cast<std::size_t>(random.integer(0, static_cast<int>(mesh.triangles.size()) - 1));
    const std::size_t i = mesh.triangles[picked][0], j = mesh.triangles[picked][1];
    const double part = random.logUniform(1e-14, 1e-3);
    // An edge along an axis or in a plane across one: its points stay on the faces.
    const Vector3d point = mesh.vertices[i] + part * (mesh.vertices[j] - mesh.vertices[i]);
    mesh.vertices.push_back(point);
    const std::size_t middle = mesh.vertices.size() - 1;
    const std::size_t before = mesh.triangles.size();
    for (std::size_t t = 0; t < before; ++t) {
      for (int k = 0; k < 3; ++k) {
        const std::size_t from = mesh.triangles[t][k], to = mesh.triangles[t][(k + 1) % 3];
        if (std::minmax(from, to) != std::minmax(i, j)) continue;
        const std::size_t apex = mesh.triangles[t][(k + 2) % 3];
        mesh.triangles[t] = fcl::Triangle(from, middle, apex);
        mesh.triangles.emplace_back(middle, to, apex);
        break;
      }
    }
  }
}

void addDegenerate(TriangleMesh& mesh, StabilityRandom& random) {
  for (int count = 0; count < 4; ++count) {
    const fcl::Triangle t = mesh.triangles[static_cast<std::size_t>(random.integer(0, 11))];
    const fcl::Triangle added[] = {t, {t[0], t[0], t[1]}, {t[2], t[2], t[2]}, {t[0], t[1], t[0]}};
    mesh.triangles.push_back(added[random.integer(0, 3)]);
  }
}

using SceneMaker = BoxScene (*)(StabilityRandom&);

class BoxFamilies {
 public:
  void add(const std::string& name, double absolute_tolerance, const SceneMaker& make) {
    addForm(name, "boxes", BoxForm::shapes, absolute_tolerance,
            {Method::exact, Method::interval, Method::estimate, Method::convex_pcd}, make, {});
    addMeshes(name, absolute_tolerance, make, {});
  }

  void addMeshes(const std::string& name, double absolute_tolerance, const SceneMaker& make,
                 const MeshChange& change) {
    addForm(name, "surfaces", BoxForm::surfaces, absolute_tolerance,
            {Method::interval, Method::estimate, Method::convex_pcd, Method::general_pcd}, make,
            change);
    // Doubled triangles enclose nothing.
    addForm(name, "solids", BoxForm::solids, absolute_tolerance,
            {Method::interval, Method::estimate, Method::convex_pcd}, make, change);
  }

  void addSurfaces(const std::string& name, double absolute_tolerance, const SceneMaker& make,
                   const MeshChange& change) {
    addForm(name, "surfaces", BoxForm::surfaces, absolute_tolerance,
            {Method::interval, Method::estimate, Method::convex_pcd, Method::general_pcd}, make,
            change);
  }

  std::vector<StabilityFamily> take() { return std::move(families_); }

 private:
  void addForm(const std::string& name, const std::string& objects, BoxForm form,
               double absolute_tolerance, const std::vector<Method>& methods,
               const SceneMaker& make, const MeshChange& change) {
    families_.push_back(
        {name, objects, methods, absolute_tolerance, [form, make, change](StabilityRandom& random) {
           return boxCase(make(random), form, random, change);
         }});
  }

  std::vector<StabilityFamily> families_;
};

}  // namespace

std::vector<StabilityFamily> stabilityFamilies() {
  BoxFamilies boxes;
  boxes.add("condition number of Σ up to 1e16", kAbsoluteTolerance, badlyConditioned);
  boxes.add("Σ of rank 2", kAbsoluteTolerance, [](StabilityRandom& r) { return ofRank(2, r); });
  boxes.add("Σ of rank 1", kAbsoluteTolerance, [](StabilityRandom& r) { return ofRank(1, r); });
  boxes.add("Σ of rank 0", kAbsoluteTolerance, [](StabilityRandom& r) { return ofRank(0, r); });
  boxes.add("σ from 1e-12 to 1e12 of the size", kTinyTolerance, anySigma);
  boxes.add("σ from 1e-6 to 1e6 of the size, by axis", kTinyTolerance, mixedSigma);
  boxes.add("lengths from 1e-9 to 1e9 m", kAbsoluteTolerance, anyLength);
  boxes.add("1e6 sizes from the origin", kAbsoluteTolerance, farFromOrigin);
  boxes.add("P down to 1e-300", kTinyTolerance, rare);
  boxes.add("P up to 1 - 1e-16", kAbsoluteTolerance, nearlyCertain);
  boxes.add("touching, coplanar and equal faces", kAbsoluteTolerance, aligned);
  boxes.add("the same with Σ of rank 1 or 2", kAbsoluteTolerance, alignedOfLowRank);
  boxes.add("mean far inside or outside", kAbsoluteTolerance, farMean);
  const SceneMaker ordinary = [](StabilityRandom& r) {
    return boxScene(r, 1, ordinarySigma(r, 1));
  };
  boxes.addMeshes("slivers", kAbsoluteTolerance, ordinary, addSlivers);
  boxes.addSurfaces("zero-area and duplicate triangles", kAbsoluteTolerance, ordinary,
                    addDegenerate);
  std::vector<StabilityFamily> families = boxes.take();
  for (StabilityFamily& family : otherStabilityFamilies()) families.push_back(std::move(family));
  return families;
}

}  // namespace fcl_prob::cli
