// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Reading binary glTF files as far as the tests need it, by nothing but the format's specification.
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <cstring>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

#include "catch.h"

namespace fcl_prob_test {

class GlbFile {
 public:
  explicit GlbFile(const std::string& bytes) {
    REQUIRE(bytes.size() > 28);
    CHECK(bytes.substr(0, 4) == "glTF");
    CHECK(number(bytes, 4) == 2);
    CHECK(number(bytes, 8) == bytes.size());
    const std::size_t length = number(bytes, 12);
    CHECK(bytes.substr(16, 4) == "JSON");
    REQUIRE(20 + length + 8 <= bytes.size());
    json = nlohmann::json::parse(bytes.substr(20, length));
    CHECK(number(bytes, 20 + length) == bytes.size() - 28 - length);
    binary_ = bytes.substr(28 + length);
  }

  /// Everything that a node, a mesh or an animation refers to is there and as long as it says.
  void checkAccessors() const {
    REQUIRE(json.at("buffers").at(0).at("byteLength") == binary_.size());
    for (std::size_t i = 0; i < json.at("accessors").size(); ++i) {
      const nlohmann::json& accessor = json["accessors"][i];
      const Eigen::MatrixXf all = values(i);
      REQUIRE(all.allFinite());
      if (!accessor.contains("min")) continue;
      for (Eigen::Index row = 0; row < all.rows(); ++row) {
        CHECK(accessor["min"].at(row).get<float>() == all.row(row).minCoeff());
        CHECK(accessor["max"].at(row).get<float>() == all.row(row).maxCoeff());
      }
    }
    for (const nlohmann::json& mesh : json.at("meshes")) checkMesh(mesh);
    checkNodes();
  }

  /// One value a column.
  Eigen::MatrixXf values(std::size_t accessor_index) const {
    const nlohmann::json& accessor = json.at("accessors").at(accessor_index);
    const nlohmann::json& view = json.at("bufferViews").at(accessor["bufferView"].get<int>());
    REQUIRE(accessor.at("componentType") == 5126);
    const std::string type = accessor.at("type");
    const Eigen::Index rows = type == "SCALAR" ? 1 : type == "VEC3" ? 3 : 4;
    Eigen::MatrixXf result(rows, accessor.at("count").get<Eigen::Index>());
    const std::size_t size = static_cast<std::size_t>(result.size()) * sizeof(float);
    const std::size_t offset = view.at("byteOffset");
    REQUIRE(view.at("byteLength") == size);
    REQUIRE(offset % sizeof(float) == 0);
    REQUIRE(offset + size <= binary_.size());
    std::memcpy(result.data(), binary_.data() + offset, size);
    return result;
  }

  /// The nodes of the scene, and those in one of them.
  std::vector<nlohmann::json> groups() const { return nodesAt(json["scenes"][0].at("nodes")); }
  std::vector<nlohmann::json> childrenOf(const nlohmann::json& node) const {
    return nodesAt(node.value("children", nlohmann::json::array()));
  }

  static Eigen::Isometry3d poseOf(const nlohmann::json& node) {
    const std::vector<double> t = node.at("translation");
    const std::vector<double> r = node.at("rotation");
    return Eigen::Translation3d(t[0], t[1], t[2]) * Eigen::Quaterniond(r[3], r[0], r[1], r[2]);
  }

  Eigen::AlignedBox3f boxOf(const nlohmann::json& node) const {
    const nlohmann::json& mesh = json.at("meshes").at(node.at("mesh").get<int>());
    const Eigen::MatrixXf corners = values(mesh["primitives"][0]["attributes"]["POSITION"]);
    return {Eigen::Vector3f(corners.rowwise().minCoeff()),
            Eigen::Vector3f(corners.rowwise().maxCoeff())};
  }

  /// The nodes that the animation moves, as they are at this share of the way from one of its times
  /// to the next.
  std::vector<nlohmann::json> animatedNodes(Eigen::Index time, float share) const {
    std::map<std::size_t, nlohmann::json> nodes;
    const nlohmann::json& animation = json.at("animations").at(0);
    for (const nlohmann::json& channel : animation.at("channels")) {
      const nlohmann::json& sampler = animation["samplers"].at(channel["sampler"].get<int>());
      const Eigen::MatrixXf all = values(sampler.at("output"));
      Eigen::VectorXf value = (1.0F - share) * all.col(time) + share * all.col(time + 1);
      if (value.size() == 4) value.normalize();
      const std::size_t index = channel.at("target").at("node");
      nlohmann::json& node = nodes.try_emplace(index, json["nodes"].at(index)).first->second;
      node[channel["target"].at("path").get<std::string>()] =
          std::vector<float>(value.data(), value.data() + value.size());
    }
    std::vector<nlohmann::json> result;
    for (const auto& [index, node] : nodes) result.push_back(node);
    return result;
  }

  const std::string& binary() const { return binary_; }

  nlohmann::json json;

 private:
  static std::size_t number(const std::string& bytes, std::size_t offset) {
    std::uint32_t value = 0;
    std::memcpy(&value, bytes.data() + offset, sizeof value);
    return value;
  }

  void checkMesh(const nlohmann::json& mesh) const {
    const nlohmann::json& primitive = mesh.at("primitives").at(0);
    CHECK(primitive.at("material").get<std::size_t>() < json.at("materials").size());
    const Eigen::Index corners = values(primitive["attributes"].at("POSITION")).cols();
    CHECK(corners % 3 == 0);
    for (const auto& [name, accessor] : primitive["attributes"].items()) {
      CAPTURE(name);
      CHECK(values(accessor).cols() == corners);
    }
  }

  /// Each is in the scene or in one other node, once.
  void checkNodes() const {
    std::multiset<std::size_t> named;
    const auto note = [&](const nlohmann::json& list) {
      for (const nlohmann::json& index : list) named.insert(index.get<std::size_t>());
    };
    note(json.at("scenes").at(0).at("nodes"));
    for (const nlohmann::json& node : json.at("nodes")) {
      if (node.contains("children")) note(node["children"]);
      if (!node.contains("mesh")) continue;
      CHECK(node["mesh"].get<std::size_t>() < json.at("meshes").size());
    }
    REQUIRE(named.size() == json["nodes"].size());
    for (std::size_t i = 0; i < named.size(); ++i) CHECK(named.count(i) == 1);
  }

  std::vector<nlohmann::json> nodesAt(const nlohmann::json& indices) const {
    std::vector<nlohmann::json> nodes;
    for (const nlohmann::json& index : indices) {
      nodes.push_back(json.at("nodes").at(index.get<std::size_t>()));
    }
    return nodes;
  }

  std::string binary_;
};

}  // namespace fcl_prob_test
