// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// What the readers of mesh files collect, and the mesh that it becomes.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "fcl_prob/triangle_mesh.h"

namespace fcl_prob::detail {

/// Where in a file something is, for messages: a line, from 1, or a byte of a binary file, from 0.
struct FilePlace {
  std::size_t position = 0;
  bool is_byte = false;
};

/// "path: line 3" or "path: byte 90".
std::string placeText(const std::string& path, FilePlace place);

/// Three coordinates. \throws FileError if a word is not a number, InvalidGeometry if it is not
/// finite or beyond the lengths that can be computed with; the message begins with `place`.
fcl::Vector3d parseVertex(const std::string_view* words, const std::string& path, FilePlace place);

/// The same check of numbers that are no text.
void checkVertex(const fcl::Vector3d& vertex, const std::string& path, FilePlace place);

/// Vertices and polygons of one file. A polygon may come before its vertices.
class PolygonMesh {
 public:
  /// \param first_index what the file calls its first vertex: 0 or 1
  PolygonMesh(const std::string& path, std::size_t first_index)
      : path_(path), first_index_(first_index) {}

  void addVertex(const fcl::Vector3d& vertex) { mesh_.vertices.push_back(vertex); }
  std::size_t vertexCount() const { return mesh_.vertices.size(); }

  /// Three corners or more, by indices from 0.
  void addPolygon(const std::vector<std::size_t>& corners, FilePlace place);

  /// What was passed over: told in TriangleMesh::notes.
  void addNote(std::string note) { mesh_.notes.push_back(std::move(note)); }

  /// All of it in triangles. \throws FileError if a corner is none of the vertices, or a polygon
  /// crosses itself
  TriangleMesh triangulated() &&;

 private:
  struct Polygon {
    std::size_t end;  ///< of its corners in corners_
    FilePlace place;
  };

  const std::string& path_;
  std::size_t first_index_;
  TriangleMesh mesh_;
  std::vector<std::size_t> corners_;
  std::vector<Polygon> polygons_;
};

}  // namespace fcl_prob::detail
