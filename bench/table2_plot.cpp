// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "bench/table2_plot.h"

#include <algorithm>
#include <iomanip>
#include <sstream>

namespace fcl_prob::cli {
namespace {

using Texts = std::vector<std::string>;

/// Each once, in the order in which they first come.
Texts distinct(const std::vector<PlottedPath>& paths, std::string PlottedPath::*name) {
  Texts names;
  for (const PlottedPath& path : paths) {
    if (std::find(names.begin(), names.end(), path.*name) == names.end()) {
      names.push_back(path.*name);
    }
  }
  return names;
}

std::string pointsName(std::size_t scene, std::size_t method) {
  return "$scene" + std::to_string(scene) + "_method" + std::to_string(method);
}

class Table2Script {
 public:
  explicit Table2Script(const std::vector<PlottedPath>& paths)
      : paths_(paths),
        scenes_(distinct(paths, &PlottedPath::scene)),
        methods_(distinct(paths, &PlottedPath::method)) {}

  std::string text() {
    out_ << std::setprecision(10);
    for (std::size_t s = 0; s < scenes_.size(); ++s) {
      for (std::size_t m : methodsIn(s)) writePoints(s, m);
    }
    out_ << "set multiplot layout 1," << scenes_.size() << "\nset logscale x\nset grid\n"
         << "set xlabel 'time of the tests of states / ms'\nset ylabel 'length of the path / rad'\n"
         << "set key outside below maxrows 4\nset bmargin 8\nset rmargin 5\nset pointsize 1.2\n"
         << "set offsets graph 0, 0, 0.1, 0.1\n";
    for (std::size_t s = 0; s < scenes_.size(); ++s) writePanel(s);
    out_ << "unset multiplot\n";
    return out_.str();
  }

 private:
  bool isOf(const PlottedPath& path, std::size_t scene, std::size_t method) const {
    return path.scene == scenes_[scene] && path.method == methods_[method];
  }

  std::vector<std::size_t> methodsIn(std::size_t scene) const {
    std::vector<std::size_t> found;
    for (std::size_t m = 0; m < methods_.size(); ++m) {
      const auto is_of = [&](const PlottedPath& path) { return isOf(path, scene, m); };
      if (std::any_of(paths_.begin(), paths_.end(), is_of)) found.push_back(m);
    }
    return found;
  }

  void writePoints(std::size_t scene, std::size_t method) {
    out_ << pointsName(scene, method) << " << EOD\n";
    for (const PlottedPath& path : paths_) {
      if (isOf(path, scene, method)) out_ << path.query_ms << ' ' << path.length << '\n';
    }
    out_ << "EOD\n";
  }

  void writePanel(std::size_t scene) {
    out_ << "set title '" << scenes_[scene] << "'\n";
    const char* before = "plot ";
    for (const std::size_t m : methodsIn(scene)) {
      out_ << before << pointsName(scene, m) << " with points lt " << 1 + m << " pt " << 4 + m
           << " title \"" << methods_[m] << '"';
      before = ", \\\n     ";
    }
    out_ << '\n';
  }

  const std::vector<PlottedPath>& paths_;
  Texts scenes_;
  Texts methods_;
  std::ostringstream out_;
};

}  // namespace

std::string table2PlotScript(const std::vector<PlottedPath>& paths) {
  return paths.empty() ? std::string() : Table2Script(paths).text();
}

}  // namespace fcl_prob::cli
