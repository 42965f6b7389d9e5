// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// The numbers of a glTF file: binary data, and the lists that say what is where in it.
#pragma once

#include <Eigen/Core>
#include <nlohmann/json.hpp>
#include <string>

namespace fcl_prob::cli {

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

}  // namespace fcl_prob::cli
