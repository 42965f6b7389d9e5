// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "cli/gltf_file.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cstdint>
#include <nlohmann/json.hpp>

namespace fcl_prob::cli {
namespace {

using Json = nlohmann::ordered_json;

// Constants of the glTF 2.0 specification.
constexpr int kFloat = 5126;
constexpr int kArrayBuffer = 34962;
constexpr std::uint32_t kMagic = 0x46546C67;      // "glTF"
constexpr std::uint32_t kJsonChunk = 0x4E4F534A;  // "JSON"
constexpr std::uint32_t kBinaryChunk = 0x004E4942;

/// Collects the binary data and the JSON that describes it.
class GltfBuilder {
 public:
  GltfBuilder() {
    document_["asset"] = {{"version", "2.0"}, {"generator", "fcl_prob"}};
    document_["scene"] = 0;
    document_["scenes"] = Json::array({{{"nodes", Json::array()}}});
    for (const char* list : {"nodes", "meshes", "materials", "accessors", "bufferViews"}) {
      document_[list] = Json::array();
    }
  }

  void add(const ColouredMesh& mesh) {
    const Json attributes = {{"POSITION", addPositions(mesh.mesh)},
                             {"NORMAL", addNormals(mesh.mesh)},
                             {"COLOR_0", addColours(mesh)}};
    const std::size_t index = document_["meshes"].size();
    document_["materials"].push_back(materialOf(mesh));
    document_["meshes"].push_back(
        {{"name", mesh.name},
         {"primitives", Json::array({{{"attributes", attributes}, {"material", index}}})}});
    document_["nodes"].push_back({{"name", mesh.name}, {"mesh", index}});
    document_["scenes"][0]["nodes"].push_back(index);
  }

  std::string container() {
    document_["buffers"] = Json::array({{{"byteLength", binary_.size()}}});
    std::string json = document_.dump();
    json.resize((json.size() + 3) / 4 * 4, ' ');
    std::string result;
    append(result, kMagic);
    append(result, std::uint32_t{2});
    append(result, static_cast<std::uint32_t>(12 + 8 + json.size() + 8 + binary_.size()));
    append(result, static_cast<std::uint32_t>(json.size()));
    append(result, kJsonChunk);
    result += json;
    append(result, static_cast<std::uint32_t>(binary_.size()));
    append(result, kBinaryChunk);
    return result + binary_;
  }

 private:
  template <typename Number>
  static void append(std::string& bytes, Number number) {
    bytes.append(reinterpret_cast<const char*>(&number), sizeof number);
  }

  template <int Size>
  using Values = std::vector<Eigen::Matrix<float, Size, 1>>;

  template <int Size>
  std::size_t addAccessor(const Values<Size>& values, const char* type, bool with_bounds) {
    const std::size_t offset = binary_.size();
    for (const auto& value : values) {
      for (int i = 0; i < Size; ++i) append(binary_, value[i]);
    }
    document_["bufferViews"].push_back({{"buffer", 0},
                                        {"byteOffset", offset},
                                        {"byteLength", binary_.size() - offset},
                                        {"target", kArrayBuffer}});
    Json accessor = {{"bufferView", document_["bufferViews"].size() - 1},
                     {"componentType", kFloat},
                     {"count", values.size()},
                     {"type", type}};
    if (with_bounds) addBounds(values, accessor);
    document_["accessors"].push_back(accessor);
    return document_["accessors"].size() - 1;
  }

  template <int Size>
  static void addBounds(const Values<Size>& values, Json& accessor) {
    Eigen::Matrix<float, Size, 1> lo = values.front();
    Eigen::Matrix<float, Size, 1> hi = values.front();
    for (const auto& value : values) {
      lo = lo.cwiseMin(value);
      hi = hi.cwiseMax(value);
    }
    accessor["min"] = std::vector<float>(lo.data(), lo.data() + Size);
    accessor["max"] = std::vector<float>(hi.data(), hi.data() + Size);
  }

  std::size_t addPositions(const TriangleMesh& mesh) {
    Values<3> values;
    for (const fcl::Triangle& triangle : mesh.triangles) {
      for (int k = 0; k < 3; ++k) values.push_back(mesh.vertices[triangle[k]].cast<float>());
    }
    return addAccessor<3>(values, "VEC3", true);
  }

  std::size_t addNormals(const TriangleMesh& mesh) {
    Values<3> values;
    for (const fcl::Triangle& t : mesh.triangles) {
      const Eigen::Vector3d side = mesh.vertices[t[1]] - mesh.vertices[t[0]];
      const Eigen::Vector3d normal = side.cross(mesh.vertices[t[2]] - mesh.vertices[t[0]]);
      const double length = normal.norm();
      const Eigen::Vector3d unit =
          length > 0.0 ? Eigen::Vector3d(normal / length) : Eigen::Vector3d::UnitZ();
      values.insert(values.end(), 3, unit.cast<float>());
    }
    return addAccessor<3>(values, "VEC3", false);
  }

  std::size_t addColours(const ColouredMesh& mesh) {
    Values<4> values;
    for (const fcl::Triangle& triangle : mesh.mesh.triangles) {
      for (int k = 0; k < 3; ++k) values.push_back(mesh.colours[triangle[k]]);
    }
    return addAccessor<4>(values, "VEC4", false);
  }

  static Json materialOf(const ColouredMesh& mesh) {
    Json material = {{"name", mesh.name},
                     {"doubleSided", true},
                     {"pbrMetallicRoughness", {{"metallicFactor", 0.0}, {"roughnessFactor", 0.8}}}};
    const auto transparent = [](const Colour& colour) { return colour[3] < 1.0F; };
    if (std::any_of(mesh.colours.begin(), mesh.colours.end(), transparent)) {
      material["alphaMode"] = "BLEND";
    }
    return material;
  }

  Json document_;
  std::string binary_;
};

}  // namespace

std::string glbOf(const std::vector<ColouredMesh>& meshes) {
  GltfBuilder builder;
  for (const ColouredMesh& mesh : meshes) builder.add(mesh);
  return builder.container();
}

}  // namespace fcl_prob::cli
