// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "certificate.h"

#include <algorithm>
#include <climits>
#include <cmath>

namespace verify {
namespace {

// Without the line's number, which Reader adds.
struct Wrong : std::runtime_error {
  using std::runtime_error::runtime_error;
};
void check(bool condition, const std::string& why) {
  if (!condition) throw Wrong(why);
}

void read(const Json& json, bool& value) {
  check(json.is_boolean(), "must be true or false");
  value = json.get<bool>();
}
void read(const Json& json, double& value) {
  check(json.is_number(), "must be a number");
  value = json.get<double>();
  check(std::isfinite(value), "must be finite");
}
void read(const Json& json, int& value) {
  check(json.is_number_integer(), "must be an index");
  const auto index = json.get<std::int64_t>();
  check(index >= 0 && index < INT_MAX / 4, "is no index");
  value = static_cast<int>(index);
}
void read(const Json& json, std::string& value) {
  check(json.is_string(), "must be a string");
  value = json.get<std::string>();
}
template <class T, std::size_t N>
void read(const Json& json, std::array<T, N>& values) {
  check(json.is_array() && json.size() == N, "must be arrays of " + std::to_string(N));
  for (std::size_t i = 0; i < N; ++i) read(json[i], values[i]);
}
template <class T>
void read(const Json& json, std::vector<T>& values) {
  check(json.is_array(), "must be an array");
  values.resize(json.size());
  for (std::size_t i = 0; i < values.size(); ++i) read(json[i], values[i]);
}

template <class T>
T field(const Json& line, const std::string& name) {
  check(line.contains(name), "\"" + name + "\" is missing");
  T value{};
  try {
    read(line[name], value);
  } catch (const Wrong& wrong) {
    throw Wrong("\"" + name + "\": " + wrong.what());
  }
  return value;
}

// Which of two words a field is.
int choice(const Json& line, const std::string& name, const char* first, const char* second) {
  const auto word = field<std::string>(line, name);
  check(word == first || word == second, "\"" + name + "\" cannot be \"" + word + "\"");
  return word == first ? 0 : 1;
}

Header read_header(const Json& line) {
  Header header;
  header.version = field<int>(line, "fcl_prob_certificate");
  check(header.version == 1 || header.version == 2, "must be of version 1 or 2");
  if (line.contains("name")) header.name = field<std::string>(line, "name");
  header.solid_contact = choice(line, "contact", "surface", "solid") == 1;
  header.mean = field<Vec>(line, "mean");
  header.axes = field<std::vector<Vec>>(line, "axes");
  header.rank = static_cast<int>(header.axes.size());
  check(header.rank <= 3 && (header.rank > 0 || header.version > 1),
        "\"axes\": must be three at most, and at least one in version 1");
  header.deviations = field<std::vector<double>>(line, "deviations");
  check(header.deviations.size() == header.axes.size(), "\"deviations\": must be as many as axes");
  check(line.contains("whitening"), "\"whitening\" is missing");
  if (line["whitening"].is_null()) return header;
  header.whitening = field<std::vector<Vec>>(line, "whitening");
  check(header.whitening.size() == header.axes.size(), "\"whitening\": must be as many as axes");
  return header;
}

void check_indices(const std::vector<Triangle>& triangles, std::size_t count) {
  for (const Triangle& triangle : triangles) {
    for (const int i : triangle) {
      check(static_cast<std::size_t>(i) < count, "\"triangles\": no such vertex");
    }
  }
}

std::vector<Plane> read_planes(const Json& line, const char* name, int rank) {
  std::vector<Plane> result;
  for (const auto& numbers : field<std::vector<std::vector<double>>>(line, name)) {
    check(numbers.size() == static_cast<std::size_t>(rank) + 1, "planes have rank + 1 numbers");
    // What is on a plane weighs nothing, unless all is.
    check(std::any_of(numbers.begin(), numbers.end() - 1, [](double m) { return m != 0; }),
          "planes must have a normal");
    result.emplace_back();
    std::copy(numbers.begin(), numbers.end() - 1, result.back().normal.begin());
    result.back().level = numbers.back();
  }
  return result;
}

Witness read_witness(const Json& region) {
  check(region.contains("by") && region["by"].is_object(), "\"by\" is missing");
  const Json& by = region["by"];
  check(by.contains("pair") + by.contains("inside") + by.contains("contained") == 1,
        "must be by one of \"pair\", \"inside\" and \"contained\"");
  Witness witness;
  if (by.contains("pair")) {
    witness.pair = field<std::array<int, 2>>(by, "pair");
  } else if (by.contains("inside")) {
    witness.kind = Witness::kInside;
    witness.object = choice(by, "inside", "A", "B");
    witness.vertex = field<int>(by, "vertex");
    const bool has_outside = by.contains("outside") && !by["outside"].is_null();
    if (has_outside) witness.outside = field<int>(by, "outside");
  } else {
    witness.kind = Witness::kContained;
    check(field<bool>(by, "contained"), "\"contained\" must be true");
  }
  return witness;
}

Cell read_cell(const Json& line, int rank) {
  Cell cell;
  const auto sides = field<std::vector<double>>(line, "cell");
  check(sides.size() == 2 * static_cast<std::size_t>(rank), "\"cell\": must be 2 rank numbers");
  for (int i = 0; i < rank; ++i) {
    cell.lo[i] = sides[i];
    cell.hi[i] = sides[rank + i];
    check(cell.lo[i] < cell.hi[i], "\"cell\": must have lo < hi");
  }
  if (line.contains("free") && line["free"].is_boolean()) {
    cell.claims_free = field<bool>(line, "free");
  } else if (line.contains("free")) {
    // An empty list claims nothing; of a cell without planes it would mean all.
    cell.free_planes = read_planes(line, "free", rank);
    cell.claims_free = !cell.free_planes.empty();
  }
  if (!line.contains("contact")) return cell;
  check(line["contact"].is_array(), "\"contact\": must be an array");
  for (const Json& region : line["contact"]) {
    check(region.is_object(), "\"contact\": must be objects");
    cell.contact.push_back({read_planes(region, "planes", rank), read_witness(region)});
  }
  return cell;
}

Json parse(const std::string& text) {
  Json json = Json::parse(text, nullptr, false);
  check(json.is_object(), "is no JSON object");
  return json;
}

// Calls what reads of a line, and says of which one it is in what it throws.
template <class Read>
auto at_line(std::size_t line, const Read& read) {
  try {
    return read();
  } catch (const Wrong& wrong) {
    throw Malformed(line, wrong.what());
  }
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

void Reader::read_part_or_caps(const Json& line) {
  const bool is_part = !line.contains("caps");
  const int object = choice(line, is_part ? "part" : "caps", "A", "B");
  const auto vertices = field<std::vector<Vec>>(line, "vertices");
  const auto triangles = field<std::vector<Triangle>>(line, "triangles");
  if (!is_part) {
    const auto part = static_cast<std::size_t>(field<int>(line, "part"));
    check(part < parts[object].size(), "\"part\": no such part");
    check(!parts[object][part].convex, "\"part\": is convex");
    check_indices(triangles, parts[object][part].vertices.size() + vertices.size());
    caps[object].push_back({line_, vertices, triangles});
    return;
  }
  check(object == 1 || parts[1].empty(), "\"part\": A after B");
  check_indices(triangles, vertices.size());
  const bool convex = field<bool>(line, "convex");
  check(!convex || !vertices.empty(), "\"vertices\": none");
  const bool swept = header.version > 1 && line.contains("radius");
  const double radius = swept ? field<double>(line, "radius") : 0;
  check(radius >= 0 && (convex || radius == 0), "\"radius\": is not for this part");
  parts[object].push_back({line_, field<std::array<Vec, 3>>(line, "rotation"),
                           field<Vec>(line, "translation"), vertices, triangles, convex,
                           field<bool>(line, "solid"), radius});
}

void Reader::read_objects() {
  parts = {};
  caps = {};
  const auto next = [&] {
    const Json json = parse(text_);
    const bool is_object = json.contains("caps") || json.contains("part");
    if (is_object) read_part_or_caps(json);
    return is_object;
  };
  header = at_line(line_, [&] { return read_header(parse(text_)); });
  while (next_line() && at_line(line_, next)) {
  }
  if (parts[0].empty() || parts[1].empty()) throw Malformed(line_, "an object has no part");
}

bool Reader::next_cell(Cell& cell) {
  if (!in_) throw Malformed(line_, "the last line is missing");
  const bool is_cell = at_line(line_, [&] {
    const Json json = parse(text_);
    if (!json.contains("cell")) {
      footer = {field<double>(json, "lower"), field<double>(json, "upper"),
                static_cast<std::size_t>(field<int>(json, "cells"))};
      return false;
    }
    cell = read_cell(json, header.rank);
    cell.line = line_;
    return true;
  });
  next_line();
  return is_cell;
}

}  // namespace verify
