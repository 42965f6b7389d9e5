// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "io/polygon_mesh.h"

#include "geometry/length.h"
#include "io/polygon_cutter.h"
#include "io/text_reader.h"

namespace fcl_prob::detail {

std::string placeText(const std::string& path, FilePlace place) {
  return path + (place.is_byte ? ": byte " : ": line ") + std::to_string(place.position);
}

fcl::Vector3d parseVertex(const std::string_view* words, const std::string& path, FilePlace place) {
  fcl::Vector3d vertex;
  for (int k = 0; k < 3; ++k) {
    const std::optional<double> number = parseNumber(words[k]);
    if (!number) {
      throw FileError(placeText(path, place) + ": " + inQuotes(words[k]) + " is not a number");
    }
    vertex[k] = *number;
  }
  checkVertex(vertex, path, place);
  return vertex;
}

void checkVertex(const fcl::Vector3d& vertex, const std::string& path, FilePlace place) {
  if (isPosition(vertex)) return;
  throw InvalidGeometry(placeText(path, place) + ": a vertex has a coordinate that is " +
                        (vertex.allFinite() ? "too large to compute with" : "not finite"));
}

void PolygonMesh::addPolygon(const std::vector<std::size_t>& corners, FilePlace place) {
  corners_.insert(corners_.end(), corners.begin(), corners.end());
  polygons_.push_back({corners_.size(), place});
}

TriangleMesh PolygonMesh::triangulated() && {
  mesh_.triangles.reserve(corners_.size() - 2 * polygons_.size());
  PolygonCutter cutter(mesh_.vertices);
  std::vector<std::size_t> corners;
  std::size_t begin = 0;
  for (const Polygon& polygon : polygons_) {
    corners.assign(corners_.begin() + static_cast<std::ptrdiff_t>(begin),
                   corners_.begin() + static_cast<std::ptrdiff_t>(polygon.end));
    begin = polygon.end;
    for (const std::size_t corner : corners) {
      if (corner < mesh_.vertices.size()) continue;
      throw FileError(placeText(path_, polygon.place) + ": vertex index " +
                      std::to_string(corner + first_index_) + ", but the file has only " +
                      std::to_string(mesh_.vertices.size()) + " vertices");
    }
    if (!cutter.cut(corners, mesh_.triangles)) {
      throw FileError(placeText(path_, polygon.place) + ": a face of " +
                      std::to_string(corners.size()) + " corners crosses or folds onto itself");
    }
  }
  return std::move(mesh_);
}

}  // namespace fcl_prob::detail
