// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// A user of the installed mesh loader.
#include <fcl/geometry/bvh/BVH_model.h>
#include <fcl_prob/mesh_io.h>

#include <iostream>

int main(int argc, char* argv[]) {
  if (argc != 2) return 2;
  const fcl_prob::TriangleMesh mesh = fcl_prob::loadMesh(argv[1]);
  const auto model = fcl_prob::buildModel<fcl::OBBRSSd>(mesh);
  std::cout << model->num_tris << " triangles\n";
  return model->num_tris > 0 ? 0 : 1;
}
