// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Convex parts of every mesh file that the models have.
#include <algorithm>
#include <filesystem>
#include <iostream>
#include <optional>
#include <vector>

#include "catch.h"
#include "fcl_prob/convex_parts.h"
#include "fcl_prob/exceptions.h"
#include "fcl_prob/mesh_io.h"
#include "geometry/closed_mesh.h"
#include "models.h"

using namespace fcl_prob;

namespace {

std::vector<std::string> meshFilesBelow(const std::string& folder) {
  static const std::vector<std::string> kEndings{".obj", ".stl", ".STL",  ".ply",
                                                 ".dae", ".off", ".gltf", ".glb"};
  std::vector<std::string> files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    const std::string ending = entry.path().extension().string();
    const bool is_mesh = std::find(kEndings.begin(), kEndings.end(), ending) != kEndings.end();
    if (entry.is_regular_file() && is_mesh) files.push_back(entry.path().string());
  }
  std::sort(files.begin(), files.end());
  return files;
}

std::optional<TriangleMesh> loaded(const std::string& file) {
  try {
    return loadMeshIsolated(file);
  } catch (const Exception&) {
    return std::nullopt;
  }
}

}  // namespace

TEST_CASE("every mesh of the models is covered by its parts, closed ones with what is inside",
          "[long]") {
  const auto folder = fcl_prob_test::modelsFolder();
  if (!folder) {
    std::cout << "SKIPPED: no models\n";
    return;
  }
  std::size_t covered = 0, closed = 0;
  for (const std::string& file : meshFilesBelow(*folder)) {
    CAPTURE(file);
    const std::optional<TriangleMesh> mesh = loaded(file);
    if (!mesh) continue;
    const bool is_closed = !detail::opennessOf(detail::viewOf(*mesh));
    const ConvexParts parts(*mesh);  // throws where the cover is not proven
    CHECK(parts.coversSolid() == is_closed);
    ++covered;
    closed += is_closed ? 1 : 0;
  }
  std::cout << covered << " meshes covered by parts, " << closed << " of them closed\n";
  CHECK(closed > 50);
}
