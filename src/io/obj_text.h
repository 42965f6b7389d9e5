// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Meshes as Wavefront files.
#pragma once

#include <iomanip>
#include <sstream>
#include <string>

#include "fcl_prob/triangle_mesh.h"

namespace fcl_prob::detail {

/// \param digits  of a coordinate: with 17 what is read again is the same to the last bit
inline std::string objText(const TriangleMesh& mesh, int digits) {
  std::ostringstream text;
  text << std::setprecision(digits);
  for (const fcl::Vector3d& v : mesh.vertices)
    text << "v " << v.x() << ' ' << v.y() << ' ' << v.z() << '\n';
  for (const fcl::Triangle& t : mesh.triangles)
    text << "f " << t[0] + 1 << ' ' << t[1] + 1 << ' ' << t[2] + 1 << '\n';
  return text.str();
}

}  // namespace fcl_prob::detail
