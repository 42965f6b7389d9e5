// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// The loader on every test model: sound ones load completely, nasty ones are told apart.
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iomanip>
#include <iostream>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "catch.h"
#include "fcl_prob/mesh_io.h"
#include "models.h"

using namespace fcl_prob;
using namespace fcl_prob_test;
namespace fs = std::filesystem;

namespace {

bool isMeshFile(const fs::path& path) {
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(), ::tolower);
  for (const char* known : {".stl", ".obj", ".ply", ".off", ".dae", ".gltf", ".glb"}) {
    if (extension == known) return true;
  }
  return false;
}

nlohmann::json modelStatistics(const std::string& folder) {
  std::ifstream file(fs::path(folder) / "stats.json");
  return nlohmann::json::parse(file);
}

struct Verdict {
  std::size_t triangles = 0;
  std::string fault;  ///< empty if the file was loaded
};

Verdict verdictOn(const std::string& path) {
  try {
    return {loadMeshIsolated(path).triangles.size(), ""};
  } catch (const FileError& error) {
    return {0, error.what()};
  } catch (const InvalidGeometry& error) {
    return {0, error.what()};
  }
}

/// Files whose contents are not the mesh that they claim, or that hold no mesh.
const std::set<std::string>& mustBeRefused() {
  static const std::set<std::string> names = [] {
    std::set<std::string> result;
    for (const char* name :
         {"AllIndicesOutOfRange.gltf", "BoxWithInfinites.glb", "IndexOutOfRange.gltf",
          "OutOfMemory.off", "RecursiveNodes.gltf", "crash-30d6d0f7.ply", "empty.off", "empty.ply",
          "invalid.off", "issue623.ply", "malformed.obj", "malformed2.obj", "point_cloud.obj"}) {
      result.insert(std::string("nasty/real/assimp_") + name);
    }
    for (const char* name : {"empty.obj", "empty.stl", "notenoughindices.obj", "obj_wireframe.obj",
                             "points_emptyface.ply", "ply_empty_bin.ply", "stl_empty_bin.stl"}) {
      result.insert(std::string("nasty/real/trimesh_") + name);
    }
    for (const char* name : {"all_vertices_equal.obj",
                             "ascii_truncated.stl",
                             "cube_count_too_big.ply",
                             "cube_count_too_big.stl",
                             "cube_count_too_big_bin.ply",
                             "cube_count_too_small.stl",
                             "cube_denormal_1e-310.obj",
                             "cube_face_count_too_big_bin.ply",
                             "cube_huge_1e300.obj",
                             "cube_index_out_of_range.obj",
                             "cube_index_overflow.obj",
                             "cube_index_zero.obj",
                             "cube_inf_vertex.obj",
                             "cube_inf_vertex.stl",
                             "cube_nan_vertex.obj",
                             "cube_nan_vertex.stl",
                             "cube_negative_index.ply",
                             "cube_negative_index_bin.ply",
                             "cube_truncated.obj",
                             "cube_truncated.stl",
                             "cube_truncated_bin.ply",
                             "empty.obj",
                             "empty.stl",
                             "header_only_79_bytes.stl",
                             "random_bytes.obj",
                             "random_bytes.stl",
                             "zero_triangles.stl"}) {
      result.insert(std::string("nasty/synthetic/") + name);
    }
    return result;
  }();
  return names;
}

}  // namespace

TEST_CASE("every sound test model loads with all of its triangles", "[io]") {
  const auto folder = modelsFolder();
  if (!folder || !modelOrSkip("stats.json")) return;
  int checked = 0;
  const nlohmann::json all = modelStatistics(*folder);
  for (const auto& [name, statistics] : all.items()) {
    if (name.rfind("nasty/", 0) == 0 || !isMeshFile(name) || !statistics.contains("tris")) continue;
    CAPTURE(name);
    const TriangleMesh mesh = loadMesh((fs::path(*folder) / name).string());
    CHECK(mesh.triangles.size() == statistics.at("tris").get<std::size_t>());
    ++checked;
  }
  CHECK(checked > 80);
}

TEST_CASE("what the loader says of every nasty file", "[io]") {
  const auto folder = modelsFolder();
  if (!folder || !modelOrSkip("nasty")) return;
  const nlohmann::json statistics = modelStatistics(*folder);
  int loaded = 0;
  int refused = 0;
  std::map<std::string, fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator(fs::path(*folder) / "nasty")) {
    if (isMeshFile(entry.path())) {
      files[fs::relative(entry.path(), *folder).string()] = entry.path();
    }
  }
  for (const auto& [name, path] : files) {
    const Verdict verdict = verdictOn(path.string());
    std::cout << std::left << std::setw(66) << name;
    if (verdict.fault.empty()) {
      std::cout << verdict.triangles << " triangles\n";
      ++loaded;
      CAPTURE(name);
      CHECK(mustBeRefused().count(name) == 0);
      if (statistics.contains(name) && statistics.at(name).contains("tris")) {
        CHECK(verdict.triangles == statistics.at(name).at("tris").get<std::size_t>());
      }
    } else {
      REQUIRE(verdict.fault.rfind(path.string(), 0) == 0);
      std::cout << "refused" << verdict.fault.substr(path.string().size()) << "\n";
      ++refused;
    }
  }
  CHECK(loaded > 40);
  CHECK(refused >= static_cast<int>(mustBeRefused().size()));
}
