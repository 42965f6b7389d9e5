// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include <nlohmann/json.hpp>

#include "fcl_prob/reconstruction.h"
#include "io/obj_text.h"

namespace fcl_prob {
namespace {

using Json = nlohmann::ordered_json;

template <typename Vector>
Json listOf(const Vector& vector) {
  Json list = Json::array();
  for (Eigen::Index i = 0; i < vector.size(); ++i) list.push_back(vector[i]);
  return list;
}

template <typename Matrix>
Json upperTriangle(const Matrix& matrix) {
  Json list = Json::array();
  for (Eigen::Index i = 0; i < matrix.rows(); ++i) {
    for (Eigen::Index j = i; j < matrix.cols(); ++j) list.push_back(matrix(i, j));
  }
  return list;
}

}  // namespace

std::string toJson(const Reconstruction& reconstruction, const std::string& surface,
                   const std::string& obstacle) {
  Json json;
  json["surface"] = surface;
  json["obstacle"] = obstacle;
  json["obstacle_is_solid"] = reconstruction.obstacle_is_solid;
  json["band"] = {reconstruction.band.outward, reconstruction.band.inward};
  json["covariance"] = upperTriangle(reconstruction.covariance);
  json["pose_covariance"] = upperTriangle(reconstruction.pose_covariance);
  json["reference"] = listOf(reconstruction.reference);
  json["deviation"] = reconstruction.deviation;
  json["share_used"] = reconstruction.share_used;
  json["largest_hole"] = reconstruction.largest_hole;
  json["plane"] = reconstruction.plane ? listOf(*reconstruction.plane) : Json();
  json["regions"] = Json::array();
  for (const ReconstructedRegion& region : reconstruction.regions) {
    json["regions"].push_back({{"points", region.points},
                               {"band", region.band},
                               {"box", {listOf(region.box.min()), listOf(region.box.max())}}});
  }
  json["triangles"] = {reconstruction.surface.triangles.size(),
                       reconstruction.obstacle.triangles.size()};
  json["seconds"] = Json::object();
  for (const auto& [stage, seconds] : reconstruction.seconds) json["seconds"][stage] = seconds;
  json["notes"] = reconstruction.notes;
  return json.dump(2) + "\n";
}

std::string toObj(const TriangleMesh& mesh) { return detail::objText(mesh, 9); }

}  // namespace fcl_prob
