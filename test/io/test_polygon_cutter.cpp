// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Polygons of many forms are covered once by their triangles, whichever way they lie in space.
#include "io/polygon_cutter.h"

#include <numeric>
#include <random>

#include "catch.h"

using namespace fcl_prob;
using fcl_prob::detail::PolygonCutter;

namespace {

using Outline = std::vector<Eigen::Vector2d>;

double cross(const Eigen::Vector2d& u, const Eigen::Vector2d& v) {
  return u.x() * v.y() - u.y() * v.x();
}

bool contains(const Outline& outline, const Eigen::Vector2d& p) {
  bool inside = false;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Eigen::Vector2d& a = outline[i];
    const Eigen::Vector2d& b = outline[(i + 1) % outline.size()];
    if ((a.y() > p.y()) == (b.y() > p.y())) continue;
    if (p.x() < a.x() + (p.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x())) inside = !inside;
  }
  return inside;
}

struct Cut {
  bool done = false;
  std::vector<fcl::Triangle> triangles;
};

/// The outline in a plane of space, cut.
Cut cutInSpace(const Outline& outline, const Eigen::Affine3d& place) {
  std::vector<fcl::Vector3d> vertices;
  for (const Eigen::Vector2d& p : outline)
    vertices.emplace_back(place * fcl::Vector3d(p.x(), p.y(), 0.0));
  std::vector<std::size_t> corners(outline.size());
  std::iota(corners.begin(), corners.end(), 0U);
  Cut cut;
  cut.done = PolygonCutter(vertices).cut(corners, cut.triangles);
  return cut;
}

/// Random points are in as many triangles as they are in the outline, once or not at all. \returns
/// how many were in
int checkCover(const Outline& outline, const std::vector<fcl::Triangle>& triangles,
               std::mt19937& generator) {
  Eigen::AlignedBox2d box;
  for (const Eigen::Vector2d& p : outline) box.extend(p);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  int within = 0;
  for (int i = 0; i < 300; ++i) {
    const Eigen::Vector2d p =
        box.min() + Eigen::Vector2d(unit(generator), unit(generator)).cwiseProduct(box.sizes());
    int covering = 0;
    for (const fcl::Triangle& t : triangles) {
      covering += contains({outline[t[0]], outline[t[1]], outline[t[2]]}, p) ? 1 : 0;
    }
    CAPTURE(p.transpose());
    CHECK(covering == (contains(outline, p) ? 1 : 0));
    within += covering > 0 ? 1 : 0;
  }
  return within;
}

Eigen::Affine3d randomPlace(std::mt19937& generator) {
  std::normal_distribution<double> normal;
  const auto draw = [&] { return normal(generator); };
  Eigen::Affine3d place = Eigen::Affine3d::Identity();
  place.translate(Eigen::Vector3d(draw(), draw(), draw()) * std::pow(10.0, 2.0 * draw()));
  place.rotate(Eigen::Quaterniond(draw(), draw(), draw(), draw()).normalized());
  place.scale(std::pow(10.0, draw()));
  return place;
}

Outline star(int corners, double waist, std::mt19937& generator) {
  std::uniform_real_distribution<double> radius(waist, 1.0);
  Outline outline;
  for (int i = 0; i < corners; ++i) {
    const double angle = 2.0 * M_PI * i / corners;
    outline.emplace_back(radius(generator) * Eigen::Vector2d(std::cos(angle), std::sin(angle)));
  }
  return outline;
}

Outline comb(int teeth) {
  Outline outline{{0, -1}, {2.0 * teeth, -1}};
  for (int i = 2 * teeth; i >= 0; --i) outline.emplace_back(i, i % 2 == 0 ? 0.0 : 5.0);
  return outline;
}

Outline spiral(int turns) {
  Outline outer, inner;
  for (int i = 0; i <= 12 * turns; ++i) {
    const double angle = 2.0 * M_PI * i / 12.0;
    const Eigen::Vector2d direction(std::cos(angle), std::sin(angle));
    outer.emplace_back((1.0 + angle) * direction);
    inner.emplace_back((0.2 + angle) * direction);
  }
  outer.insert(outer.end(), inner.rbegin(), inner.rend());
  return outer;
}

/// A square with a square hole that a double edge ties to it.
Outline ring() {
  return {{0, 0}, {4, 0}, {4, 4}, {0, 4}, {0, 0}, {1, 1}, {1, 3}, {3, 3}, {3, 1}, {1, 1}};
}

/// Every edge halved, so that corners lie on edges.
Outline halved(const Outline& outline) {
  Outline result;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    result.push_back(outline[i]);
    result.emplace_back(0.5 * (outline[i] + outline[(i + 1) % outline.size()]));
  }
  return result;
}

}  // namespace

TEST_CASE("triangles cover a polygon once, wherever it lies", "[io]") {
  std::mt19937 generator(47);
  std::vector<Outline> outlines{comb(1),
                                comb(4),
                                comb(20),
                                spiral(1),
                                spiral(4),
                                ring(),
                                {{0, 0}, {4, 0}, {1, 1}, {0, 4}},    // concave quadrilaterals,
                                {{0, 0}, {1, 0.2}, {2, 0}, {1, 5}},  // by each of their corners
                                {{2, 0}, {1, 5}, {0, 0}, {1, 0.2}}};
  for (int corners = 4; corners < 40; ++corners) {
    outlines.push_back(star(corners, 0.95, generator));
    outlines.push_back(star(corners, 0.1, generator));
  }
  const std::size_t plain = outlines.size();
  for (std::size_t i = 0; i < plain; ++i) outlines.push_back(halved(outlines[i]));
  int within = 0;
  for (Outline outline : outlines) {
    for (const bool backwards : {false, true}) {
      if (backwards) std::reverse(outline.begin(), outline.end());
      CAPTURE(outline.size(), backwards);
      const Cut cut = cutInSpace(outline, randomPlace(generator));
      REQUIRE(cut.done);
      REQUIRE(cut.triangles.size() == outline.size() - 2);
      within += checkCover(outline, cut.triangles, generator);
      for (const fcl::Triangle& t : cut.triangles) {
        const double turn = cross(outline[t[1]] - outline[t[0]], outline[t[2]] - outline[t[0]]);
        CHECK((backwards ? -turn : turn) > -1e-9);
      }
    }
  }
  CHECK(within > 100 * static_cast<int>(outlines.size()));
}

TEST_CASE("a convex polygon becomes the fan of its first corner", "[io]") {
  std::mt19937 generator(1);
  for (int corners = 3; corners < 30; ++corners) {
    const Outline outline = star(corners, 1.0, generator);
    const Cut cut = cutInSpace(outline, randomPlace(generator));
    REQUIRE(cut.done);
    REQUIRE(cut.triangles.size() == outline.size() - 2);
    for (std::size_t i = 0; i < cut.triangles.size(); ++i) {
      CHECK(cut.triangles[i][0] == 0);
      CHECK(cut.triangles[i][1] == i + 1);
      CHECK(cut.triangles[i][2] == i + 2);
    }
  }
}

TEST_CASE("polygons without area, and those that cross themselves", "[io]") {
  std::mt19937 generator(2);
  // Near the origin, where rounding leaves corners on their line.
  const auto place = [&] {
    Eigen::Affine3d result = randomPlace(generator);
    result.translation().setZero();
    return result;
  };
  const Outline line{{0, 0}, {1, 0}, {3, 0}, {2, 0}};
  const Outline point(5, Eigen::Vector2d(1, 1));
  const Outline doubled{{0, 0}, {1, 0}, {1, 0}, {0, 1}};  // a triangle as a quadrilateral
  for (const Outline& outline : {line, point, doubled}) {
    for (int i = 0; i < 20; ++i) {
      const Cut cut = cutInSpace(outline, place());
      CHECK(cut.done);
      CHECK(cut.triangles.size() == outline.size() - 2);
    }
  }
  const Outline bow{{0, 0}, {1, 1}, {1, 0}, {0, 1}};
  const Outline uneven_bow{{0, 0}, {3, 3}, {3, 0}, {0, 1}};
  const Outline fold{{0, 0}, {1, 0}, {0, 1}, {1, 0}};
  for (const Outline& outline : {bow, uneven_bow, fold}) {
    for (int i = 0; i < 20; ++i) {
      const Cut cut = cutInSpace(outline, place());
      CHECK_FALSE(cut.done);
      CHECK(cut.triangles.empty());
    }
  }
}

TEST_CASE("a polygon that is not quite plane is seen along its mean normal", "[io]") {
  std::mt19937 generator(3);
  std::normal_distribution<double> bend(0.0, 0.05);
  for (int corners = 4; corners < 30; ++corners) {
    const Outline outline = star(corners, 0.5, generator);
    std::vector<fcl::Vector3d> vertices;
    for (const Eigen::Vector2d& p : outline) vertices.emplace_back(p.x(), p.y(), bend(generator));
    std::vector<std::size_t> indices(outline.size());
    std::iota(indices.begin(), indices.end(), 0U);
    std::vector<fcl::Triangle> triangles;
    REQUIRE(PolygonCutter(vertices).cut(indices, triangles));
    CHECK(triangles.size() == outline.size() - 2);
    checkCover(outline, triangles, generator);
  }
}
