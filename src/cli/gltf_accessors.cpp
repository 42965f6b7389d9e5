// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "cli/gltf_accessors.h"

#include <vector>

namespace fcl_prob::cli {
namespace {

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

}  // namespace

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

}  // namespace fcl_prob::cli
