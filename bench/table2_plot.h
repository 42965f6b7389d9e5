// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Table II as a picture: how short the paths are, and how long it took to tell their states.
#pragma once

#include <string>
#include <vector>

namespace fcl_prob::cli {

/// A path that was found.
struct PlottedPath {
  std::string scene;
  std::string method;
  double query_ms;  ///< that the method took for states, of a whole plan
  double length;    ///< radians
};

/// A panel a scene, a point a path, the same marks for a method in each; for writePlot(). Empty
/// without a path. \param paths  in the order of the panels and of their keys
std::string table2PlotScript(const std::vector<PlottedPath>& paths);

}  // namespace fcl_prob::cli
