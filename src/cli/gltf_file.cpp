// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "cli/gltf_file.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <map>
#include <utility>

namespace fcl_prob::cli {
namespace {

using Json = nlohmann::ordered_json;

// Constants of the glTF 2.0 specification.
constexpr int kFloat = 5126;
constexpr int kArrayBuffer = 34962;

const char* typeOfRows(Eigen::Index rows) {
  if (rows == 1) return "SCALAR";
  return rows == 3 ? "VEC3" : "VEC4";
}

std::vector<float> listOf(const Eigen::VectorXf& values) {
  return {values.data(), values.data() + values.size()};
}

/// The numbers of the file: binary data, and the lists that say what is where in it.
class GltfAccessors {
 public:
  enum class Use { vertices, animation };

  /// One value a column: of one row, of three or of four.
  /// \returns the index of its accessor, which has the least and the largest value if
  /// `with_bounds`: the format asks for them of positions and of times
  std::size_t add(const Eigen::MatrixXf& values, Use use, bool with_bounds);

  const nlohmann::ordered_json& accessors() const { return accessors_; }
  const nlohmann::ordered_json& bufferViews() const { return buffer_views_; }
  const std::string& binary() const { return binary_; }

 private:
  nlohmann::ordered_json accessors_ = nlohmann::ordered_json::array();
  nlohmann::ordered_json buffer_views_ = nlohmann::ordered_json::array();
  std::string binary_;
};

std::size_t GltfAccessors::add(const Eigen::MatrixXf& values, Use use, bool with_bounds) {
  const std::size_t offset = binary_.size();
  binary_.append(reinterpret_cast<const char*>(values.data()),
                 static_cast<std::size_t>(values.size()) * sizeof(float));
  buffer_views_.push_back(
      {{"buffer", 0}, {"byteOffset", offset}, {"byteLength", binary_.size() - offset}});
  if (use == Use::vertices) buffer_views_.back()["target"] = kArrayBuffer;
  nlohmann::ordered_json accessor = {{"bufferView", buffer_views_.size() - 1},
                                     {"componentType", kFloat},
                                     {"count", values.cols()},
                                     {"type", typeOfRows(values.rows())}};
  if (with_bounds && values.cols() > 0) {
    accessor["min"] = listOf(values.rowwise().minCoeff());
    accessor["max"] = listOf(values.rowwise().maxCoeff());
  }
  accessors_.push_back(accessor);
  return accessors_.size() - 1;
}

/// Three columns a triangle: its corners' values.
template <int Rows, typename Value>
Eigen::MatrixXf byCorner(const TriangleMesh& mesh, const Value& value) {
  Eigen::Matrix<float, Rows, Eigen::Dynamic> values(Rows, 3 * mesh.triangles.size());
  Eigen::Index column = 0;
  for (const fcl::Triangle& triangle : mesh.triangles) {
    for (int k = 0; k < 3; ++k) values.col(column++) = value(triangle, k);
  }
  return values;
}

Eigen::MatrixXf cornerPositions(const TriangleMesh& mesh) {
  return byCorner<3>(mesh, [&](const fcl::Triangle& triangle, int k) {
    return Eigen::Vector3f(mesh.vertices[triangle[k]].cast<float>());
  });
}

Eigen::MatrixXf cornerNormals(const TriangleMesh& mesh) {
  return byCorner<3>(mesh, [&](const fcl::Triangle& t, int) {
    const Eigen::Vector3d side = mesh.vertices[t[1]] - mesh.vertices[t[0]];
    const Eigen::Vector3d normal = side.cross(mesh.vertices[t[2]] - mesh.vertices[t[0]]);
    const double length = normal.norm();
    const Eigen::Vector3d unit =
        length > 0.0 ? Eigen::Vector3d(normal / length) : Eigen::Vector3d::UnitZ();
    return Eigen::Vector3f(unit.cast<float>());
  });
}

/// Unit quaternions x, y, z, w. Of the two of each rotation the one that is nearer to the one
/// before: a viewer that takes them for plain vectors between two times is right, too.
Eigen::MatrixXf rotationsAlong(const std::vector<fcl::Transform3d>& path) {
  Eigen::Matrix<float, 4, Eigen::Dynamic> rotations(4, path.size());
  Eigen::Vector4d before = Eigen::Vector4d::Zero();
  for (std::size_t i = 0; i < path.size(); ++i) {
    Eigen::Vector4d now = Eigen::Quaterniond(path[i].linear()).normalized().coeffs();
    if (now.dot(before) < 0.0) now = -now;
    rotations.col(static_cast<Eigen::Index>(i)) = now.cast<float>();
    before = now;
  }
  return rotations;
}

Eigen::MatrixXf translationsAlong(const std::vector<fcl::Transform3d>& path) {
  Eigen::Matrix<float, 3, Eigen::Dynamic> translations(3, path.size());
  for (std::size_t i = 0; i < path.size(); ++i) {
    translations.col(static_cast<Eigen::Index>(i)) = path[i].translation().cast<float>();
  }
  return translations;
}

std::vector<float> floatsOf(const Eigen::MatrixXf& column) {
  return {column.data(), column.data() + column.size()};
}

Json materialOf(const std::string& name, bool transparent) {
  Json material = {{"name", name},
                   {"doubleSided", true},
                   {"pbrMetallicRoughness", {{"metallicFactor", 0.0}, {"roughnessFactor", 0.8}}}};
  if (transparent) material["alphaMode"] = "BLEND";
  return material;
}

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
    Json attributes = attributesOf(mesh.mesh);
    attributes["COLOR_0"] =
        accessors_.add(byCorner<4>(mesh.mesh, [&](const fcl::Triangle& triangle,
                                                  int k) { return mesh.colours[triangle[k]]; }),
                       GltfAccessors::Use::vertices, false);
    const auto transparent = [](const Colour& colour) { return colour[3] < 1.0F; };
    const std::size_t material = append(
        "materials",
        materialOf(mesh.name, std::any_of(mesh.colours.begin(), mesh.colours.end(), transparent)));
    const std::size_t index = addMesh(mesh.name, attributes, material);
    document_["scenes"][0]["nodes"].push_back(
        append("nodes", {{"name", mesh.name}, {"mesh", index}}));
  }

  void add(const AnimatedScene& scene) {
    if (!scene.times.empty()) startAnimation(scene.times);
    for (const MeshGroup& group : scene.groups) {
      Json node = {{"name", group.name}};
      if (!group.notes.is_null()) node["extras"] = group.notes;
      for (const PlacedMesh& member : group.members) node["children"].push_back(addNode(member));
      document_["scenes"][0]["nodes"].push_back(append("nodes", node));
    }
  }

  std::string file(GltfForm form) {
    document_["accessors"] = accessors_.accessors();
    document_["bufferViews"] = accessors_.bufferViews();
    return gltfFile(document_, accessors_.binary(), form);
  }

 private:
  std::size_t append(const char* list, Json entry) {
    document_[list].push_back(std::move(entry));
    return document_[list].size() - 1;
  }

  Json attributesOf(const TriangleMesh& mesh) {
    const auto vertices = GltfAccessors::Use::vertices;
    const std::size_t positions = accessors_.add(cornerPositions(mesh), vertices, true);
    return {{"POSITION", positions},
            {"NORMAL", accessors_.add(cornerNormals(mesh), vertices, false)}};
  }

  std::size_t addMesh(const std::string& name, const Json& attributes, std::size_t material) {
    return append(
        "meshes",
        {{"name", name},
         {"primitives", Json::array({{{"attributes", attributes}, {"material", material}}})}});
  }

  std::size_t materialOfColour(const Colour& colour) {
    const std::vector<float> key = floatsOf(colour);
    const auto known = materials_.find(key);
    if (known != materials_.end()) return known->second;
    const bool transparent = colour[3] < 1.0F;
    Json material = materialOf("colour " + std::to_string(materials_.size() + 1), transparent);
    if (!transparent) material["pbrMetallicRoughness"]["baseColorFactor"] = key;
    return materials_[key] = append("materials", material);
  }

  /// A colour is its material's, but a transparent one that of the vertices: VTK's importer (9.1)
  /// ignores the opacity of a material.
  std::size_t meshOf(const PlacedMesh& placed) {
    const std::size_t material = materialOfColour(placed.colour);
    const auto known = meshes_.find({placed.mesh.get(), material});
    if (known != meshes_.end()) return known->second;
    Json& shared = attributes_[placed.mesh.get()];
    if (shared.is_null()) shared = attributesOf(*placed.mesh);
    Json attributes = shared;
    if (placed.colour[3] < 1.0F) {
      attributes["COLOR_0"] =
          accessors_.add(placed.colour.replicate(1, 3 * placed.mesh->triangles.size()),
                         GltfAccessors::Use::vertices, false);
    }
    return meshes_[{placed.mesh.get(), material}] = addMesh(placed.name, attributes, material);
  }

  std::size_t addNode(const PlacedMesh& placed) {
    const std::size_t node =
        append("nodes", {{"name", placed.name},
                         {"mesh", meshOf(placed)},
                         {"translation", floatsOf(translationsAlong({placed.pose}))},
                         {"rotation", floatsOf(rotationsAlong({placed.pose}))}});
    if (!placed.path.empty()) {
      addChannel(node, "translation", translationsAlong(placed.path));
      addChannel(node, "rotation", rotationsAlong(placed.path));
    }
    return node;
  }

  void startAnimation(const std::vector<double>& times) {
    const Eigen::RowVectorXd row = Eigen::Map<const Eigen::RowVectorXd>(times.data(), times.size());
    times_ = accessors_.add(row.cast<float>(), GltfAccessors::Use::animation, true);
    document_["animations"] = Json::array(
        {{{"name", "motion"}, {"channels", Json::array()}, {"samplers", Json::array()}}});
  }

  void addChannel(std::size_t node, const char* path, const Eigen::MatrixXf& values) {
    Json& animation = document_["animations"][0];
    const std::size_t output = accessors_.add(values, GltfAccessors::Use::animation, false);
    animation["samplers"].push_back(
        {{"input", times_}, {"interpolation", "LINEAR"}, {"output", output}});
    animation["channels"].push_back({{"sampler", animation["samplers"].size() - 1},
                                     {"target", {{"node", node}, {"path", path}}}});
  }

  Json document_;
  GltfAccessors accessors_;
  std::size_t times_ = 0;  ///< accessor of the animation's times
  std::map<const TriangleMesh*, Json> attributes_;
  std::map<std::vector<float>, std::size_t> materials_;                        ///< by colour
  std::map<std::pair<const TriangleMesh*, std::size_t>, std::size_t> meshes_;  ///< by material, too
};

}  // namespace

std::string gltfOf(const std::vector<ColouredMesh>& meshes, GltfForm form) {
  GltfBuilder builder;
  for (const ColouredMesh& mesh : meshes) builder.add(mesh);
  return builder.file(form);
}

std::string gltfOf(const AnimatedScene& scene, GltfForm form) {
  GltfBuilder builder;
  builder.add(scene);
  return builder.file(form);
}

}  // namespace fcl_prob::cli
