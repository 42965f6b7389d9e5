// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "certificate.h"

#include <climits>
#include <cmath>
#include <nlohmann/json.hpp>

namespace verify {
namespace {

using Json = nlohmann::json;

// A value together with where it stands, for messages.
struct Field {
  const Json& json;
  std::size_t line;
  std::string name;

  [[noreturn]] void fail(const std::string& why) const { throw Malformed(line, name, why); }
  Field operator[](const char* key) const {
    const auto found = json.find(key);
    if (found == json.end()) throw Malformed(line, key, "missing");
    return {*found, line, key};
  }
  bool has(const char* key) const { return json.contains(key); }
  bool boolean() const {
    if (!json.is_boolean()) fail("must be true or false");
    return json.get<bool>();
  }
  double number() const {
    if (!json.is_number()) fail("must be a number");
    const double value = json.get<double>();
    if (!std::isfinite(value)) fail("must be finite");
    return value;
  }
  int index() const {
    if (!json.is_number_integer()) fail("must be an index");
    const auto value = json.get<std::int64_t>();
    if (value < 0 || value > INT_MAX / 4) fail("is no index");
    return static_cast<int>(value);
  }
  int object() const {
    if (json != "A" && json != "B") fail("must be \"A\" or \"B\"");
    return json == "A" ? 0 : 1;
  }
  std::size_t size() const {
    if (!json.is_array()) fail("must be an array");
    return json.size();
  }
  Field at(std::size_t i) const { return {json[i], line, name}; }
  std::vector<double> numbers(std::size_t count) const {
    if (size() != count) fail("must have " + std::to_string(count) + " numbers");
    std::vector<double> result;
    for (std::size_t i = 0; i < count; ++i) result.push_back(at(i).number());
    return result;
  }
  Vec vec() const {
    const auto n = numbers(3);
    return {n[0], n[1], n[2]};
  }
  std::vector<Vec> vecs() const {
    std::vector<Vec> result(size());
    for (std::size_t i = 0; i < result.size(); ++i) result[i] = at(i).vec();
    return result;
  }
  std::vector<Triangle> triangles() const {
    std::vector<Triangle> result(size());
    for (std::size_t i = 0; i < result.size(); ++i) {
      if (at(i).size() != 3) fail("must be triples of indices");
      for (int k = 0; k < 3; ++k) result[i][k] = at(i).at(k).index();
    }
    return result;
  }
  std::vector<Plane> planes(int rank) const {
    std::vector<Plane> result;
    for (std::size_t i = 0; i < size(); ++i) {
      const auto n = at(i).numbers(rank + 1);
      Plane plane;
      std::copy(n.begin(), n.end() - 1, plane.normal.begin());
      plane.level = n.back();
      result.push_back(plane);
    }
    return result;
  }
};

Header read_header(const Field& line) {
  if (line["fcl_prob_certificate"].json != 1) line["fcl_prob_certificate"].fail("must be 1");
  Header header;
  if (line.has("name")) {
    if (!line["name"].json.is_string()) line["name"].fail("must be a string");
    header.name = line["name"].json.get<std::string>();
  }
  const Field contact = line["contact"];
  if (contact.json != "surface" && contact.json != "solid") {
    contact.fail("must be \"surface\" or \"solid\"");
  }
  header.solid_contact = contact.json == "solid";
  header.mean = line["mean"].vec();
  header.axes = line["axes"].vecs();
  header.rank = static_cast<int>(header.axes.size());
  if (header.rank < 1 || header.rank > 3) line["axes"].fail("must be one to three");
  header.deviations = line["deviations"].numbers(header.axes.size());
  if (!line["whitening"].json.is_null()) {
    header.whitening = line["whitening"].vecs();
    if (header.whitening.size() != header.axes.size()) line["whitening"].fail("must be as axes");
  }
  return header;
}

void check_indices(const Field& field, const std::vector<Triangle>& triangles, std::size_t count) {
  for (const Triangle& triangle : triangles) {
    for (const int i : triangle) {
      if (static_cast<std::size_t>(i) >= count) field.fail("no such vertex");
    }
  }
}

Part read_part(const Field& line) {
  Part part;
  part.line = line.line;
  part.object = line["part"].object();
  const auto rows = line["rotation"].vecs();
  if (rows.size() != 3) line["rotation"].fail("must have three rows");
  std::copy(rows.begin(), rows.end(), part.rotation.begin());
  part.translation = line["translation"].vec();
  part.vertices = line["vertices"].vecs();
  part.triangles = line["triangles"].triangles();
  check_indices(line["triangles"], part.triangles, part.vertices.size());
  part.convex = line["convex"].boolean();
  part.solid = line["solid"].boolean();
  if (part.convex && part.vertices.empty()) line["vertices"].fail("none");
  return part;
}

Caps read_caps(const Field& line, const std::array<std::vector<Part>, 2>& parts) {
  Caps caps;
  caps.line = line.line;
  caps.part = line["part"].index();
  const auto& of_object = parts[line["caps"].object()];
  if (static_cast<std::size_t>(caps.part) >= of_object.size()) line["part"].fail("no such part");
  if (of_object[caps.part].convex) line["part"].fail("is convex");
  caps.vertices = line["vertices"].vecs();
  caps.triangles = line["triangles"].triangles();
  check_indices(line["triangles"], caps.triangles,
                of_object[caps.part].vertices.size() + caps.vertices.size());
  return caps;
}

Witness read_witness(const Field& by) {
  Witness witness;
  if (by.has("pair") + by.has("inside") + by.has("contained") != 1) {
    by.fail("must have one of \"pair\", \"inside\" and \"contained\"");
  }
  if (by.has("contained")) {
    if (!by["contained"].boolean()) by["contained"].fail("must be true");
    witness.kind = Witness::kContained;
    return witness;
  }
  if (by.has("pair")) {
    const Field pair = by["pair"];
    if (pair.size() != 2) pair.fail("must be two indices");
    witness.pair = {pair.at(0).index(), pair.at(1).index()};
    return witness;
  }
  witness.kind = Witness::kInside;
  witness.object = by["inside"].object();
  witness.vertex = by["vertex"].index();
  if (by.has("outside") && !by["outside"].json.is_null()) witness.outside = by["outside"].index();
  return witness;
}

Cell read_cell(const Field& line, int rank) {
  Cell cell;
  cell.line = line.line;
  const auto sides = line["cell"].numbers(2 * rank);
  for (int i = 0; i < rank; ++i) {
    cell.lo[i] = sides[i];
    cell.hi[i] = sides[rank + i];
    if (!(cell.lo[i] < cell.hi[i])) line["cell"].fail("must have lo < hi");
  }
  if (line.has("free")) {
    cell.claims_free = line["free"].json != false;
    if (!line["free"].json.is_boolean()) {
      cell.free_planes = line["free"].planes(rank);
      // An empty list claims nothing; here it would mean all.
      cell.claims_free = !cell.free_planes.empty();
    }
  }
  if (!line.has("contact")) return cell;
  const Field contact = line["contact"];
  for (std::size_t i = 0; i < contact.size(); ++i) {
    const Field region = contact.at(i);
    cell.contact.push_back({region["planes"].planes(rank), read_witness(region["by"])});
  }
  return cell;
}

Json parse(const std::string& text, std::size_t line) {
  Json json = Json::parse(text, nullptr, false);
  if (!json.is_object()) throw Malformed(line, "", "is no JSON object");
  return json;
}

}  // namespace

bool Reader::next_line() {
  ++line_;
  return static_cast<bool>(std::getline(in_, text_));
}

bool Reader::more() {
  while (in_ && text_.empty()) next_line();
  return static_cast<bool>(in_);
}

void Reader::read_objects() {
  parts = {};
  caps = {};
  const Json first = parse(text_, line_);
  header = read_header({first, line_, ""});
  while (next_line()) {
    const Json json = parse(text_, line_);
    const Field line{json, line_, ""};
    if (json.contains("caps")) {
      caps[line["caps"].object()].push_back(read_caps(line, parts));
    } else if (json.contains("part")) {
      Part part = read_part(line);
      if (part.object == 0 && !parts[1].empty()) line["part"].fail("A after B");
      parts[part.object].push_back(std::move(part));
    } else {
      break;
    }
  }
  for (const int object : {0, 1}) {
    if (parts[object].empty()) throw Malformed(line_, "part", "an object has no part");
  }
}

bool Reader::next_cell(Cell& cell) {
  if (!in_) throw Malformed(line_, "lower", "the last line is missing");
  const Json json = parse(text_, line_);
  const Field line{json, line_, ""};
  if (json.contains("cell")) {
    cell = read_cell(line, header.rank);
    next_line();
    return true;
  }
  footer.lower = line["lower"].number();
  footer.upper = line["upper"].number();
  footer.cells = static_cast<std::size_t>(line["cells"].index());
  next_line();
  return false;
}

}  // namespace verify
