// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "obj_file.h"

#include <Eigen/Geometry>
#include <fstream>
#include <sstream>

namespace fcl_prob_test {

namespace {

std::size_t readVertexIndex(std::istringstream& line, std::size_t vertex_count) {
  std::string token;
  line >> token;
  const std::size_t index = std::stoul(token);  // stops at the first '/', if there is one
  if (index < 1 || index > vertex_count) throw std::runtime_error("OBJ: bad vertex index " + token);
  return index - 1;
}

}  // namespace

TriangleMesh readObj(const std::string& path) {
  std::ifstream file(path);
  if (!file) throw std::runtime_error("cannot open " + path);
  TriangleMesh mesh;
  for (std::string text; std::getline(file, text);) {
    std::istringstream line(text);
    std::string keyword;
    line >> keyword;
    if (keyword == "v") {
      Eigen::Vector3d v;
      if (!(line >> v.x() >> v.y() >> v.z())) throw std::runtime_error("OBJ: bad vertex: " + text);
      mesh.vertices.push_back(v);
    } else if (keyword == "f") {
      const std::size_t i = readVertexIndex(line, mesh.vertices.size());
      const std::size_t j = readVertexIndex(line, mesh.vertices.size());
      const std::size_t k = readVertexIndex(line, mesh.vertices.size());
      if (std::string rest; line >> rest) throw std::runtime_error("OBJ: not a triangle: " + text);
      mesh.triangles.emplace_back(i, j, k);
    }
  }
  if (mesh.triangles.empty()) throw std::runtime_error("OBJ: no triangles in " + path);
  return mesh;
}

double meshVolume(const TriangleMesh& mesh) {
  double volume = 0.0;
  for (const fcl::Triangle& t : mesh.triangles) {
    volume += mesh.vertices[t[0]].dot(mesh.vertices[t[1]].cross(mesh.vertices[t[2]])) / 6.0;
  }
  return volume;
}

}  // namespace fcl_prob_test
