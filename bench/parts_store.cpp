// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "bench/parts_store.h"

#include <boost/crc.hpp>
#include <filesystem>
#include <fstream>
#include <iomanip>
#include <optional>
#include <sstream>

#include "base/stopwatch.h"
#include "cli/output.h"
#include "fcl_prob/exceptions.h"
#include "geometry/mesh_visitor.h"

namespace fcl_prob::cli {
namespace {

using Points = std::vector<Eigen::Vector3d>;

/// A cyclic redundancy check of 64 bits (ECMA-182, as XZ has it).
class Hash {
 public:
  template <typename Number>
  void add(const Number& number) {
    crc_.process_bytes(&number, sizeof(Number));
  }

  std::string text() const {
    std::ostringstream text;
    text << std::hex << std::setw(16) << std::setfill('0') << crc_.checksum();
    return text.str();
  }

 private:
  boost::crc_optimal<64, 0x42F0E1EBA9EA3693, ~0ULL, ~0ULL, true, true> crc_;
};

std::string nameOf(const TriangleMesh& mesh, const DecompositionRequest& request) {
  Hash hash;
  hash.add(request.max_parts);
  hash.add(request.pieces);
  hash.add(request.concavity);
  for (const Eigen::Vector3d& v : mesh.vertices) {
    for (int k = 0; k < 3; ++k) hash.add(v[k]);
  }
  for (const fcl::Triangle& triangle : mesh.triangles) {
    for (int k = 0; k < 3; ++k) hash.add(triangle[k]);
  }
  return hash.text() + ".parts";
}

/// A line with a number of points for each part, and one for each of them.
std::string textOf(const ConvexParts& parts) {
  std::ostringstream text;
  text << std::setprecision(17);
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const Points& corners = parts.polytope(i).vertices;
    text << corners.size() << '\n';
    for (const Eigen::Vector3d& v : corners) {
      text << v.x() << ' ' << v.y() << ' ' << v.z() << '\n';
    }
  }
  return text.str();
}

std::vector<Points> pointsOf(std::istream& text) {
  std::vector<Points> parts;
  for (std::size_t count = 0; text >> count;) {
    parts.emplace_back();
    Eigen::Vector3d v;
    while (parts.back().size() < count && text >> v.x() >> v.y() >> v.z()) {
      parts.back().push_back(v);
    }
  }
  return parts;
}

/// Nothing where there is no file, or its parts do not cover the mesh.
std::optional<ConvexParts> partsOfFile(const std::string& path, const TriangleMesh& mesh) {
  std::ifstream text(path);
  if (!text) return std::nullopt;
  try {
    return ConvexParts(mesh, pointsOf(text));
  } catch (const Exception&) {
    return std::nullopt;
  }
}

}  // namespace

const ConvexParts& PartsStore::of(const std::shared_ptr<const fcl::CollisionGeometryd>& geometry,
                                  const DecompositionRequest& request) {
  const auto known = known_.find(geometry);
  if (known != known_.end()) return known->second;
  const TriangleMesh mesh = triangleMesh(detail::meshView(*geometry));
  const std::filesystem::path file = std::filesystem::path(folder_) / nameOf(mesh, request);
  if (!folder_.empty()) {
    if (auto read = partsOfFile(file.string(), mesh)) {
      return known_.emplace(geometry, std::move(*read)).first->second;
    }
  }
  const detail::Stopwatch watch;
  ConvexParts parts(mesh, request);
  found_ms_ += watch.milliseconds();
  ++found_;
  if (!folder_.empty()) {
    std::filesystem::create_directories(folder_);
    writeFile(file.string(), textOf(parts));
  }
  return known_.emplace(geometry, std::move(parts)).first->second;
}

}  // namespace fcl_prob::cli
