// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// What the lines of a certificate say (FORMAT.md), read and checked for form only.
#pragma once

#include <array>
#include <istream>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "ball.h"

namespace verify {

/// The file is no certificate.
struct Malformed : std::runtime_error {
  Malformed(std::size_t line, const std::string& why)
      : std::runtime_error("line " + std::to_string(line) + ": " + why) {}
};

/// A claim that does not hold, or of which it is not certain.
struct Refused : std::runtime_error {
  using std::runtime_error::runtime_error;
};
inline void require(bool condition, const std::string& why) {
  if (!condition) throw Refused(why);
}

using Json = nlohmann::json;
using Triangle = std::array<int, 3>;

struct Header {
  std::string name;  // empty if it has none
  int version = 1;
  bool solid_contact = false;
  int rank = 0;
  Vec mean{};
  std::vector<Vec> axes;
  std::vector<double> deviations;
  std::vector<Vec> whitening;  // empty for the identity
};

struct Part {
  std::size_t line = 0;
  std::array<Vec, 3> rotation{};
  Vec translation{};
  std::vector<Vec> vertices;
  std::vector<Triangle> triangles;
  bool convex = false;
  bool solid = false;
  double radius = 0;  // of the ball that a convex part is swept by
};

/// Triangles that close a part; indices below the part's number of vertices are the part's.
struct Caps {
  std::size_t line = 0;
  std::vector<Vec> vertices;
  std::vector<Triangle> triangles;
};

/// `normal · y > level` or `<`, whichever the context says.
struct Plane {
  Vec normal{};
  double level = 0;
};

struct Witness {
  enum Kind { kPair, kInside, kContained } kind = kPair;
  std::array<int, 2> pair{};  // pieces of A and B
  int object = 0;             // whose vertex is inside
  int vertex = -1, outside = -1;
};

struct ContactRegion {
  std::vector<Plane> planes;  // all `>`
  Witness witness;
};

struct Cell {
  std::size_t line = 0;
  Vec lo{}, hi{};  // (0, 0) beyond the rank
  bool claims_free = false;
  std::vector<Plane> free_planes;  // all `<`; none: all of the cell
  std::vector<ContactRegion> contact;
};

struct Footer {
  double lower = 0, upper = 0;
  std::size_t cells = 0;
};

/// The certificates of a file, one after the other. Every method throws Malformed.
class Reader {
 public:
  explicit Reader(std::istream& in) : in_(in) { next_line(); }
  /// Whether there is another certificate.
  bool more();
  /// Reads its header, its parts and its caps; stops before the first cell.
  void read_objects();
  /// False at the footer.
  bool next_cell(Cell& cell);
  /// Of the line that comes next, or would.
  std::size_t line() const { return line_; }

  Header header;
  std::array<std::vector<Part>, 2> parts;
  std::array<std::vector<Caps>, 2> caps;
  Footer footer;

 private:
  bool next_line();
  void read_part_or_caps(const Json& line);

  std::istream& in_;
  std::string text_;
  std::size_t line_ = 0;
};

}  // namespace verify
