// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "shrink.h"

#include <cmath>
#include <utility>

#include "random_shape.h"

namespace fcl_prob_audit {
namespace {

using Change = std::function<bool(Scene&)>;  ///< false: nothing to change

/// To so many binary digits.
double rounded(double value, int digits) {
  if (value == 0.0 || !std::isfinite(value)) return value;
  int exponent = 0;
  const double mantissa = std::frexp(value, &exponent);
  return std::ldexp(std::nearbyint(std::ldexp(mantissa, digits)), exponent - digits);
}

bool shorten(double& value, int digits) {
  const double before = value;
  value = rounded(value, digits);
  return value != before;
}

template <typename Vector>
bool shortenAll(Vector& v, int digits) {
  bool changed = false;
  for (Eigen::Index i = 0; i < v.size(); ++i) changed |= shorten(v[i], digits);
  return changed;
}

/// Vertices that no triangle uses.
void dropUnused(TriangleMesh& mesh) { mesh = fcl_prob::welded(mesh); }

std::vector<Change> triangleChanges(const Scene& scene) {
  std::vector<Change> changes;
  for (int side = 0; side < 2; ++side) {
    const auto& group = side == 0 ? scene.a : scene.b;
    for (std::size_t i = 0; i < group.size(); ++i) {
      const auto count =
          group[i].shape.kind == Kind::mesh ? group[i].shape.mesh.triangles.size() : 0;
      for (std::size_t length = count / 2; length >= 1; length /= 2) {
        for (std::size_t first = 0; first + length <= count; first += length) {
          changes.push_back([=](Scene& s) {
            TriangleMesh& mesh = (side == 0 ? s.a : s.b)[i].shape.mesh;
            if (mesh.triangles.size() < first + length + 1) return false;
            const auto at = mesh.triangles.begin() + static_cast<std::ptrdiff_t>(first);
            mesh.triangles.erase(at, at + static_cast<std::ptrdiff_t>(length));
            dropUnused(mesh);
            return true;
          });
        }
      }
      for (std::size_t j = 0; j < group[i].shape.voxels.size(); ++j) {
        changes.push_back([=](Scene& s) {
          auto& voxels = (side == 0 ? s.a : s.b)[i].shape.voxels;
          if (voxels.size() < 2 || j >= voxels.size()) return false;
          voxels.erase(voxels.begin() + static_cast<std::ptrdiff_t>(j));
          return true;
        });
      }
    }
  }
  return changes;
}

std::vector<Change> memberChanges(const Scene& scene) {
  std::vector<Change> changes;
  for (int side = 0; side < 2; ++side) {
    const auto& group = side == 0 ? scene.a : scene.b;
    for (std::size_t i = 0; i < group.size(); ++i) {
      changes.push_back([=](Scene& s) {
        auto& members = side == 0 ? s.a : s.b;
        if (members.size() < 2 || i >= members.size()) return false;
        members.erase(members.begin() + static_cast<std::ptrdiff_t>(i));
        return true;
      });
    }
  }
  for (std::size_t i = 0; i < scene.weights.size(); ++i) {
    changes.push_back([=](Scene& s) {
      if (s.weights.size() < 2 || i >= s.weights.size()) return false;
      s.weights.erase(s.weights.begin() + static_cast<std::ptrdiff_t>(i));
      s.displacements.erase(s.displacements.begin() + static_cast<std::ptrdiff_t>(i));
      double sum = 0.0;
      for (const double weight : s.weights) sum += weight;
      if (!(sum > 0.0)) return false;
      for (double& weight : s.weights) weight /= sum;
      return true;
    });
  }
  return changes;
}

std::vector<Change> requestChanges() {
  const fcl_prob::ProbabilityRequest defaults;
  std::vector<Change> changes;
  const auto add = [&changes](auto get, auto value) {
    changes.push_back([=](Scene& s) {
      if (get(s) == value) return false;
      get(s) = value;
      return true;
    });
  };
  add(
      [](Scene & s) -> auto& { return s.request.gradient; }, false);
  add(
      [](Scene & s) -> auto& { return s.request.method; }, defaults.method);
  add(
      [](Scene & s) -> auto& { return s.request.contact; }, defaults.contact);
  add(
      [](Scene & s) -> auto& { return s.request.threads; }, defaults.threads);
  add(
      [](Scene & s) -> auto& { return s.request.threshold; }, std::optional<double>());
  add(
      [](Scene & s) -> auto& { return s.request.time_limit; }, std::optional<double>());
  add(
      [](Scene & s) -> auto& { return s.request.max_memory; }, defaults.max_memory);
  add(
      [](Scene & s) -> auto& { return s.request.confidence; }, defaults.confidence);
  add(
      [](Scene & s) -> auto& { return s.cancel_after; }, std::optional<int>());
  add(
      [](Scene & s) -> auto& { return s.truncation; }, std::optional<double>());
  add(
      [](Scene & s) -> auto& { return s.manager.registered_twice; }, std::vector<int>());
  add(
      [](Scene & s) -> auto& { return s.request.relative_tolerance; }, 0.1);
  add(
      [](Scene & s) -> auto& { return s.request.absolute_tolerance; }, 1e-6);
  return changes;
}

std::vector<Change> numberChanges(int digits) {
  std::vector<Change> changes;
  const auto add = [&changes](auto change) { changes.push_back(change); };
  const auto forMembers = [=](auto change) {
    return [=](Scene& s) {
      bool changed = false;
      for (auto* group : {&s.a, &s.b}) {
        for (Member& member : *group) changed |= change(member);
      }
      return changed;
    };
  };
  const auto forDisplacements = [=](auto change) {
    return [=](Scene& s) {
      bool changed = false;
      for (Displacement& displacement : s.displacements) changed |= change(displacement);
      return changed;
    };
  };
  add(forMembers([](Member& m) {
    const bool changed = !m.pose.linear().isIdentity(0.0);
    m.pose.linear().setIdentity();
    return changed;
  }));
  add(forDisplacements([](Displacement& d) {
    const bool changed = d.axes.w() != 1.0;
    d.axes.setIdentity();
    return changed;
  }));
  add(forDisplacements([](Displacement& d) { return std::exchange(d.by_matrix, false); }));
  add(forDisplacements([](Displacement& d) {
    const bool changed = d.rotated.has_value();
    d.rotated.reset();
    return changed;
  }));
  add(forDisplacements([](Displacement& d) {
    const bool changed = !d.mean.isZero(0.0);
    d.mean.setZero();
    return changed;
  }));
  // The mean into the pose.
  add([](Scene& s) {
    if (s.displacements.size() != 1 || s.a.size() != 1 || s.displacements[0].mean.isZero(0.0)) {
      return false;
    }
    s.a[0].pose.translation() += s.displacements[0].mean;
    s.displacements[0].mean.setZero();
    return true;
  });
  // B to the origin.
  add([](Scene& s) {
    if (s.b.empty() || s.b[0].pose.translation().isZero(0.0)) return false;
    const Vector3d by = s.b[0].pose.translation();
    for (auto* group : {&s.a, &s.b}) {
      for (Member& member : *group) member.pose.translation() -= by;
    }
    return true;
  });
  add(forMembers([=](Member& m) { return shortenAll(m.shape.sizes, digits); }));
  add(forMembers([=](Member& m) {
    Vector3d t = m.pose.translation();
    const bool changed = shortenAll(t, digits);
    m.pose.translation() = t;
    return changed;
  }));
  add(forMembers([=](Member& m) {
    bool changed = false;
    if (m.shape.kind != Kind::mesh) return changed;
    for (Vector3d& v : m.shape.mesh.vertices) changed |= shortenAll(v, digits);
    return changed;
  }));
  add(forDisplacements([=](Displacement& d) { return shortenAll(d.sigma, digits); }));
  add(forDisplacements([=](Displacement& d) { return shortenAll(d.mean, digits); }));
  add(forDisplacements([=](Displacement& d) { return shortenAll(d.axes.coeffs(), digits); }));
  return changes;
}

}  // namespace

Scene shrunk(Scene scene, const std::function<bool(const Scene&)>& fails, int most) {
  bool changed = true;
  while (changed && most > 0) {
    changed = false;
    std::vector<Change> changes = memberChanges(scene);
    for (auto&& more : {triangleChanges(scene), requestChanges(), numberChanges(2),
                        numberChanges(6), numberChanges(20)}) {
      changes.insert(changes.end(), more.begin(), more.end());
    }
    for (const Change& change : changes) {
      Scene candidate = scene;
      if (most <= 0 || !change(candidate)) continue;
      --most;
      try {
        if (!fails(candidate)) continue;
      } catch (const std::exception&) {
        continue;  // no scene any more
      }
      scene = std::move(candidate);
      changed = true;
    }
  }
  return scene;
}

}  // namespace fcl_prob_audit
