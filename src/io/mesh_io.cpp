// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Meshes of files: those that assimp imports are not believed.
#include "fcl_prob/mesh_io.h"

#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <algorithm>
#include <assimp/Importer.hpp>
#include <cmath>
#include <limits>
#include <optional>
#include <sstream>

#include "geometry/length.h"
#include "io/file_content.h"
#include "io/import_isolated.h"
#include "io/mesh_formats.h"

namespace fcl_prob {
namespace {

/// assimp checks indices only on request, and triangulates before it does.
void checkIndices(const aiScene& scene, const std::string& path) {
  for (unsigned m = 0; m < scene.mNumMeshes; ++m) {
    const aiMesh& mesh = *scene.mMeshes[m];
    if (mesh.mNumVertices > 0 && mesh.mVertices == nullptr) {
      throw InvalidGeometry(path + ": the importer returned vertices without positions");
    }
    for (unsigned f = 0; f < mesh.mNumFaces; ++f) {
      const aiFace& face = mesh.mFaces[f];
      for (unsigned i = 0; i < face.mNumIndices; ++i) {
        if (face.mIndices[i] >= mesh.mNumVertices) {
          throw InvalidGeometry(path + ": face " + std::to_string(f) + " has vertex index " +
                                std::to_string(face.mIndices[i]) + ", but there are only " +
                                std::to_string(mesh.mNumVertices) + " vertices");
        }
      }
    }
  }
}

/// Triangles once every polygon of n corners has become n - 2 of them. Points and lines count
/// nothing.
std::size_t countTriangles(const aiScene& scene) {
  std::size_t count = 0;
  for (unsigned m = 0; m < scene.mNumMeshes; ++m) {
    const aiMesh& mesh = *scene.mMeshes[m];
    for (unsigned f = 0; f < mesh.mNumFaces; ++f) {
      count += std::max(mesh.mFaces[f].mNumIndices, 2U) - 2U;
    }
  }
  return count;
}

void checkCount(std::size_t expected, std::size_t found, const std::string& path) {
  if (found < expected) {
    throw FileError(path + ": holds " + std::to_string(expected) +
                    " triangles, but the importer could read only " + std::to_string(found));
  }
}

const aiScene& import(Assimp::Importer& importer, const std::string& path,
                      std::optional<std::size_t> expected_triangles) {
  // The axes are the file's own; turning them is the business of the pose.
  importer.SetPropertyBool(AI_CONFIG_IMPORT_COLLADA_IGNORE_UP_DIRECTION, true);
  const aiScene* scene = importer.ReadFile(path, 0);
  if (scene == nullptr && expected_triangles == 0U) throw InvalidGeometry(path + ": no triangles");
  if (scene == nullptr) {
    throw FileError(path + ": the importer refused it: " + importer.GetErrorString());
  }
  checkIndices(*scene, path);
  const std::size_t triangles = countTriangles(*scene);
  if (expected_triangles) checkCount(*expected_triangles, triangles, path);
  scene = importer.ApplyPostProcessing(aiProcess_Triangulate);
  if (scene == nullptr || scene->mRootNode == nullptr) {
    throw FileError(path + ": the importer could not triangulate it");
  }
  checkCount(triangles, countTriangles(*scene), path);
  return *scene;
}

Eigen::Affine3d toEigen(const aiMatrix4x4& matrix, const std::string& path) {
  if (matrix.d1 != 0.0F || matrix.d2 != 0.0F || matrix.d3 != 0.0F || matrix.d4 != 1.0F) {
    throw FileError(path + ": a node's transform is not affine");
  }
  Eigen::Matrix4d result;
  for (unsigned row = 0; row < 4; ++row) {
    for (unsigned column = 0; column < 4; ++column) result(row, column) = matrix[row][column];
  }
  return Eigen::Affine3d(result);
}

void append(const aiMesh& source, const Eigen::Affine3d& transform, TriangleMesh& mesh) {
  const std::size_t first = mesh.vertices.size();
  // Vertices and matrices are both rounded to single precision, half an ε each.
  constexpr double kRounding = std::numeric_limits<float>::epsilon();
  const Eigen::Matrix3d magnitudes = transform.linear().cwiseAbs();
  for (unsigned i = 0; i < source.mNumVertices; ++i) {
    const Eigen::Vector3d v(source.mVertices[i].x, source.mVertices[i].y, source.mVertices[i].z);
    mesh.vertices.emplace_back(transform * v);
    const Eigen::Vector3d terms = magnitudes * v.cwiseAbs() + transform.translation().cwiseAbs();
    mesh.coordinate_error = std::max(mesh.coordinate_error, kRounding * terms.maxCoeff());
  }
  for (unsigned f = 0; f < source.mNumFaces; ++f) {
    const aiFace& face = source.mFaces[f];
    if (face.mNumIndices != 3) continue;  // points and lines
    mesh.triangles.emplace_back(first + face.mIndices[0], first + face.mIndices[1],
                                first + face.mIndices[2]);
  }
}

void appendNode(const aiScene& scene, const aiNode& node, const Eigen::Affine3d& parent,
                const std::string& path, TriangleMesh& mesh) {
  const Eigen::Affine3d transform = parent * toEigen(node.mTransformation, path);
  for (unsigned i = 0; i < node.mNumMeshes; ++i) {
    append(*scene.mMeshes[node.mMeshes[i]], transform, mesh);
  }
  for (unsigned i = 0; i < node.mNumChildren; ++i) {
    appendNode(scene, *node.mChildren[i], transform, path, mesh);
  }
}

TriangleMesh imported(const std::string& path, std::string_view content) {
  std::optional<std::size_t> expected_triangles;  // assimp checks COLLADA itself
  if (detail::meshFormatOf(path) == detail::MeshFormat::gltf) {
    expected_triangles = detail::checkGltf(path, content);
  }
  TriangleMesh mesh;
  const std::lock_guard<std::mutex> lock(detail::importMutex());
  Assimp::Importer importer;
  const aiScene& scene = import(importer, path, expected_triangles);
  appendNode(scene, *scene.mRootNode, Eigen::Affine3d::Identity(), path, mesh);
  return mesh;
}

/// A precision can only hold a mesh that is not too far from its origin for its size.
void checkResolution(const TriangleMesh& mesh, bool is_single, const std::string& path) {
  constexpr double kCoarsest = 1e-3;  // of the longest side
  const double rounding = is_single ? double{std::numeric_limits<float>::epsilon()}
                                    : std::numeric_limits<double>::epsilon();
  const std::string precision = is_single ? "the importer's single precision" : "double precision";
  Eigen::AlignedBox3d box;
  for (const fcl::Vector3d& v : mesh.vertices) box.extend(v);
  const double longest_side = box.sizes().maxCoeff();
  const double largest = std::max(box.min().cwiseAbs().maxCoeff(), box.max().cwiseAbs().maxCoeff());
  // Squares of less vanish, as those of more than the largest length overflow.
  if (!(longest_side >= 1.0 / detail::kLargestLength)) {
    throw InvalidGeometry(path + ": all vertices coincide (in " + precision + ")");
  }
  if (rounding * largest > kCoarsest * longest_side) {
    std::ostringstream fault;
    fault << path << ": a mesh of size " << longest_side << " with coordinates up to " << largest
          << " is lost in " << precision << "; store it nearer to its origin";
    throw InvalidGeometry(fault.str());
  }
}

TriangleMesh scaled(TriangleMesh mesh, double factor, const std::string& path) {
  for (fcl::Vector3d& v : mesh.vertices) v *= factor;
  mesh.coordinate_error *= factor;
  validateMesh(mesh, path);
  return mesh;
}

}  // namespace

std::mutex& detail::importMutex() {
  static std::mutex mutex;
  return mutex;
}

TriangleMesh loadMesh(const std::string& path, const MeshOptions& options,
                      const ImportLimits& limits) {
  if (!(options.scale > 0.0) || !std::isfinite(options.scale)) {
    throw InvalidRequest("mesh scale " + std::to_string(options.scale) +
                         " is not finite and positive");
  }
  const std::string content = detail::fileContent(path, limits.file_bytes);
  std::optional<TriangleMesh> read = detail::readMesh(path, content);
  const bool is_single = !read;
  TriangleMesh mesh = read ? *std::move(read) : imported(path, content);
  validateMesh(mesh, path);
  checkResolution(mesh, is_single, path);
  mesh = welded(mesh);
  if (options.normalize) mesh = normalized(mesh);
  return options.scale == 1.0 ? mesh : scaled(std::move(mesh), options.scale, path);
}

}  // namespace fcl_prob
