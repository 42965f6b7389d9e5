// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Whatever an import does to its own process, the caller gets a mesh or an exception.
#include "io/import_isolated.h"

#include <unistd.h>

#include <csignal>
#include <cstdio>

#include "catch.h"
#include "temporary_folder.h"

using namespace fcl_prob;
using fcl_prob::detail::importIsolated;

namespace {

TriangleMesh oneTriangle() {
  TriangleMesh mesh;
  mesh.vertices = {{0.1, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  mesh.triangles = {{0, 1, 2}};
  return mesh;
}

std::string faultOf(const std::function<TriangleMesh()>& import, const ImportLimits& limits = {}) {
  try {
    importIsolated("file.ply", import, limits);
  } catch (const FileError& error) {
    return error.what();
  }
  return "";
}

}  // namespace

TEST_CASE("an isolated import returns the same mesh", "[io]") {
  const fcl_prob_test::TemporaryFolder folder;
  const std::string path =
      folder.write("t.obj", "a\nv 0.1 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\nf 1 3 4\n");
  const TriangleMesh direct = loadMesh(path, {true, 3.0});
  const TriangleMesh isolated = loadMeshIsolated(path, {true, 3.0});
  REQUIRE(isolated.vertices.size() == direct.vertices.size());
  for (std::size_t i = 0; i < direct.vertices.size(); ++i) {
    CHECK(isolated.vertices[i] == direct.vertices[i]);
  }
  REQUIRE(isolated.triangles.size() == 2);
  CHECK(isolated.triangles[1][2] == direct.triangles[1][2]);
  CHECK(direct.notes.size() == 1);
  CHECK(isolated.notes == direct.notes);
}

TEST_CASE("exceptions of an isolated import keep their type and text", "[io]") {
  CHECK_THROWS_AS(importIsolated("f", []() -> TriangleMesh { throw InvalidGeometry("g"); }, {}),
                  InvalidGeometry);
  CHECK_THROWS_AS(importIsolated("f", []() -> TriangleMesh { throw InvalidRequest("r"); }, {}),
                  InvalidRequest);
  CHECK(faultOf([]() -> TriangleMesh { throw FileError("text of it"); }) == "text of it");
  CHECK(faultOf([]() -> TriangleMesh { throw std::runtime_error("why"); }) ==
        "file.ply: the mesh importer failed: why");
}

TEST_CASE("crashes, loops and memory hogs of an import stay in its process", "[io]") {
  CHECK(faultOf([]() -> TriangleMesh {
          ::raise(SIGSEGV);
          return oneTriangle();
        }) == "file.ply: the mesh importer crashed on this file (Segmentation fault)");
  CHECK(faultOf([]() -> TriangleMesh { std::abort(); }).find("(Aborted)") != std::string::npos);
  CHECK(faultOf([]() -> TriangleMesh { ::_exit(7); }).find("exit code 7") != std::string::npos);
  CHECK(faultOf([]() -> TriangleMesh { ::_exit(0); }).find("exit code 0") != std::string::npos);
}

TEST_CASE("an import that returns nonsense is refused by its caller", "[io]") {
  const auto nonsense = [] {
    TriangleMesh mesh = oneTriangle();
    mesh.triangles[0][0] = 99;
    return mesh;
  };
  CHECK_THROWS_AS(importIsolated("file.ply", nonsense, {}), InvalidGeometry);
}

TEST_CASE("an import is limited in time and memory", "[io]") {
  ImportLimits limits;
  limits.seconds = 1;
  CHECK(faultOf(
            []() -> TriangleMesh {
              volatile bool forever = true;
              while (forever) {
              }
              return oneTriangle();
            },
            limits)
            .find("did not finish in time") != std::string::npos);

  if (!fcl_prob::detail::importMemoryIsLimited()) return;
  limits.memory_bytes = std::size_t{256} << 20;
  CHECK(faultOf(
            []() -> TriangleMesh {
              const std::vector<char> much(std::size_t{1} << 30);
              std::puts(much.data());
              return oneTriangle();
            },
            limits)
            .find("importer failed: std::bad_alloc") != std::string::npos);
}

TEST_CASE("a mesh larger than the pipe's buffer arrives whole", "[io]") {
  constexpr std::size_t kVertices = 100'000;
  const auto large = [] {
    TriangleMesh mesh;
    for (std::size_t i = 0; i < kVertices; ++i) mesh.vertices.emplace_back(double(i), 0.5, -1.0);
    for (std::size_t i = 0; i + 2 < kVertices; ++i) mesh.triangles.emplace_back(i, i + 1, i + 2);
    return mesh;
  };
  const TriangleMesh mesh = importIsolated("file.ply", large, {});
  REQUIRE(mesh.vertices.size() == kVertices);
  CHECK(mesh.vertices.back().x() == double(kVertices - 1));
  CHECK(mesh.triangles.back()[2] == kVertices - 1);
}
