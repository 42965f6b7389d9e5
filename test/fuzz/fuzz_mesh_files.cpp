// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Mesh files: the first byte says which kind, the rest is the file. What we read ourselves is read
// every time, glTF is checked; what is accepted is loaded whole, in a child process, once in a
// while.
#include <array>
#include <boost/algorithm/string/predicate.hpp>
#include <cstddef>
#include <map>
#include <memory>

#include "fcl_prob/exceptions.h"
#include "fcl_prob/mesh_io.h"
#include "fuzz_tally.h"
#include "io/mesh_formats.h"
#include "memory_file.h"

using namespace fcl_prob;
using namespace fcl_prob_fuzz;

namespace {

constexpr std::array<const char*, 7> kEndings = {".stl",  ".obj", ".ply", ".off",
                                                 ".gltf", ".glb", ".dae"};
/// A process takes some hundred times as long as the checks.
constexpr std::uint64_t kImportOneIn = 16;

std::string_view textOf(const std::uint8_t* data, std::size_t size) {
  return {reinterpret_cast<const char*>(data), size};
}

void requireGood(const TriangleMesh& mesh) {
  validateMesh(mesh);
  require(!mesh.triangles.empty(), "a mesh without triangles");
  const TriangleMesh again = welded(mesh);
  require(again.vertices.size() == mesh.vertices.size(), "welding twice changes the mesh");
}

/// A crash of assimp is contained by the child and is not ours; what comes out has to be good.
bool importWhole(const MemoryFile& file, std::string_view content) {
  file.write(content.data(), content.size());
  ImportLimits limits;
  limits.file_bytes = std::size_t{1} << 20;
  limits.seconds = 2;
  try {
    requireGood(loadMeshIsolated(file.path(), {}, limits));
    return true;
  } catch (const FileError& error) {
    require(boost::starts_with(error.what(), file.path()), "a message without the file's name");
  } catch (const InvalidGeometry& error) {
    require(boost::starts_with(error.what(), file.path()), "a message without the file's name");
  }
  return false;
}

const MemoryFile& fileFor(const std::string& ending) {
  static std::map<std::string, MemoryFile> files;
  return files.try_emplace(ending, ending).first->second;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static Tally tally("mesh files");
  if (size < 1) return 0;
  tally.count("inputs");
  const std::string ending = kEndings[data[0] % kEndings.size()];
  const std::string_view content = textOf(data + 1, size - 1);
  try {
    const std::string name = "file" + ending;
    const auto mesh = detail::readMesh(name, content);
    if (mesh && !mesh->triangles.empty()) validateMesh(*mesh);
    if (detail::meshFormatOf(name) == detail::MeshFormat::gltf) detail::checkGltf(name, content);
  } catch (const FileError&) {
    return 0;
  } catch (const InvalidGeometry&) {
    return 0;
  }
  tally.count("accepted by readers and checks");
  if (hashOf(data, size) % kImportOneIn != 0) return 0;
  tally.count("imported");
  if (importWhole(fileFor(ending), content)) tally.count("meshes out of these");
  return 0;
}
