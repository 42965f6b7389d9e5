// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// A brick, for files that hold nothing else, and what every reader of mesh files has to do.
#pragma once

#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <random>
#include <string>
#include <string_view>
#include <vector>

#include "catch.h"
#include "fcl_prob/triangle_mesh.h"

namespace fcl_prob_test {

using fcl_prob::TriangleMesh;
using MeshReader = TriangleMesh (*)(const std::string&, std::string_view);

/// Corner i is at x of bit 0, y of bit 1 and z of bit 2; faces are seen from outside.
struct Brick {
  std::array<std::array<std::string, 2>, 3> sides;  ///< decimal fractions
  std::string corner(int i, const char* blank = " ") const {
    return sides[0][i & 1] + blank + sides[1][(i >> 1) & 1] + blank + sides[2][(i >> 2) & 1];
  }
  fcl::Vector3d position(int i) const {
    return {std::strtod(sides[0][i & 1].c_str(), nullptr),
            std::strtod(sides[1][(i >> 1) & 1].c_str(), nullptr),
            std::strtod(sides[2][(i >> 2) & 1].c_str(), nullptr)};
  }
};

using Corners = std::vector<int>;
inline const std::vector<Corners> kQuads{{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                                         {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
inline std::vector<Corners> triangles() {
  std::vector<Corners> result;
  for (const Corners& q : kQuads) {
    result.push_back({q[0], q[1], q[2]});
    result.push_back({q[0], q[2], q[3]});
  }
  return result;
}

/// Sides of any magnitude, in the ways that programs print numbers.
inline Brick randomBrick(std::mt19937& generator) {
  constexpr std::array<const char*, 6> kFormats{"%.17g", "%.6f", "%.4f", "%g", "%.9e", "%+.3E"};
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  Brick brick;
  for (auto& side : brick.sides) {
    const double low = 3.0 * unit(generator);
    const double high = low + 0.1 + std::abs(unit(generator));
    for (int k = 0; k < 2; ++k) {
      std::array<char, 64> text;
      std::snprintf(text.data(), text.size(), kFormats[generator() % kFormats.size()],
                    k == 0 ? low : high);
      side[k] = text.data();
    }
  }
  return brick;
}

/// Every corner is one of the brick's eight to the last bit, and the surface is closed, as large
/// as the brick's and turned outwards.
inline void checkBrick(const TriangleMesh& raw, const Brick& brick) {
  const TriangleMesh mesh = fcl_prob::welded(raw);
  CHECK(mesh.vertices.size() == 8);
  CHECK(mesh.triangles.size() == 12);
  for (const fcl::Vector3d& v : mesh.vertices) {
    int known = 0;
    for (int i = 0; i < 8; ++i) known += v == brick.position(i) ? 1 : 0;
    CAPTURE(v.transpose());
    CHECK(known == 1);
  }
  const fcl::Vector3d size = brick.position(7) - brick.position(0);
  double area = 0.0, volume = 0.0;
  for (const fcl::Triangle& t : mesh.triangles) {
    const fcl::Vector3d a = mesh.vertices[t[0]] - brick.position(0);
    const fcl::Vector3d b = mesh.vertices[t[1]] - brick.position(0);
    const fcl::Vector3d c = mesh.vertices[t[2]] - brick.position(0);
    area += 0.5 * (b - a).cross(c - a).norm();
    volume += a.dot(b.cross(c)) / 6.0;
  }
  CHECK(volume == Approx(size.prod()));
  CHECK(area == Approx(2.0 * (size.x() * size.y() + size.y() * size.z() + size.z() * size.x())));
  CHECK(mesh.coordinate_error == 0.0);
}

inline std::string withLineEnds(const std::string& text, const std::string& end) {
  std::string result;
  for (const char c : text) c == '\n' ? result += end : result += c;
  return result;
}

inline std::string replaced(std::string text, const std::string& what, const std::string& by) {
  const std::size_t position = text.find(what);
  REQUIRE(position != text.npos);
  return text.replace(position, what.size(), by);
}

/// As it is, with other line ends, after a byte order mark, and without the last line end.
inline void checkText(MeshReader read, const std::string& text, const Brick& brick,
                      std::size_t notes = 0) {
  for (const char* end : {"\n", "\r\n", "\r", " \t\n", "\n\n"}) {
    const bool adds_lines = std::string_view(end) == "\n\n";
    const bool continues = text.find("\\\n") != text.npos || text.find("\\ \n") != text.npos;
    if (adds_lines && continues) continue;
    for (const char* mark : {"", "\xEF\xBB\xBF"}) {
      const std::string file = mark + withLineEnds(text, end);
      CAPTURE(file);
      const TriangleMesh mesh = read("file", file);
      checkBrick(mesh, brick);
      CHECK(mesh.notes.size() == notes);
    }
  }
  checkBrick(read("file", text.substr(0, text.find_last_not_of('\n') + 1)), brick);
}

inline void checkRefused(MeshReader read, const std::string& text, const std::string& fault) {
  CAPTURE(text, fault);
  try {
    read("file", text);
    FAIL_CHECK("it was read");
  } catch (const fcl_prob::Exception& error) {
    const std::string message = error.what();
    CAPTURE(message);
    CHECK(message.rfind("file: ", 0) == 0);
    CHECK(message.find(fault) != message.npos);
  }
}

/// Sides that single precision holds.
inline Brick coarseBrick() { return {{{{"-1", "2.5"}, {"-0.5", "1"}, {"0.25", "3"}}}}; }

}  // namespace fcl_prob_test
