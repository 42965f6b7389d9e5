// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// The rows of bench table2 against certified intervals of the same states.
#ifdef FCL_PROB_HAS_PLANNING
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <limits>

#include "bench/table2_methods.h"
#include "bench/table2_plot.h"
#include "catch.h"
#include "cli/geometry.h"
#include "cli/gnuplot.h"
#include "command.h"
#include "mesh_shapes.h"
#include "models.h"

using namespace fcl_prob;
using namespace fcl_prob::cli;

namespace {

bool decides(const Table2Method& method) {
  return method.answer == Table2Answer::certified || method.answer == Table2Answer::probable;
}

std::ptrdiff_t countOf(const std::vector<Table2Method>& methods, Table2Answer answer) {
  return std::count_if(methods.begin(), methods.end(),
                       [&](const Table2Method& method) { return method.answer == answer; });
}

void checkRow(const Table2Method& method, const Table2State& values, const Bounds& truth) {
  constexpr double kAll = std::numeric_limits<double>::infinity();
  CAPTURE(method.name, truth.lower, truth.upper);
  if (decides(method)) {
    // The probable decision is wrong with a chance of 1e-4, for which the seed is fixed.
    const bool below = method.probability(values, 0.05) < 0.05;
    if (below) CHECK(truth.lower < 0.05);
    if (!below) CHECK(truth.upper >= 0.05);
  } else if (method.answer == Table2Answer::counted) {
    const double error = 5.0 * std::sqrt(truth.upper / 10'000) + 5e-4;
    const double share = method.probability(values, kAll);
    CHECK(share >= truth.lower - error);
    CHECK(share <= truth.upper + error);
  } else if (method.answer == Table2Answer::upper_bound) {
    CHECK(method.probability(values, kAll) >= truth.lower);
  }
}

}  // namespace

TEST_CASE("no row of table2 is below what is certain, but padding", "[cli][slow]") {
  if (!fcl_prob_test::modelOrSkip("fetch_robot/fetch.srdf")) return;
  const auto scenes = table2Scenes(*fcl_prob_test::modelsFolder());
  REQUIRE(scenes.size() == 2);
  PartsStore parts;
  for (const Table2Scene& scene : scenes) {
    CHECK(scene.isFree(scene.start));
    CHECK(scene.isFree(scene.goal));
    const auto methods = table2Methods(scene, 0.05, 1, parts);
    CHECK(methods.size() == 16);
    CHECK(countOf(methods, Table2Answer::certified) == 1);
    CHECK(countOf(methods, Table2Answer::probable) == 1);
    CHECK(countOf(methods, Table2Answer::padding) == 4);
    // At the goal half a wave later.
    for (const TimedWaypoint& end :
         {TimedWaypoint{0.0, scene.start}, TimedWaypoint{0.5 * scene.end, scene.goal}}) {
      for (const Table2Method& method : methods) {
        if (!method.plans) continue;
        CAPTURE(scene.name, method.name);
        CHECK(method.probability(scene.at(end), 0.05) < 0.05);
      }
    }
    for (const double at : {0.0, 0.2, 0.3}) {
      const TimedWaypoint state{at * scene.end, scene.start + at * (scene.goal - scene.start)};
      ProbabilityRequest request;
      request.relative_tolerance = 0.1;
      request.max_cells = 20'000;
      const Bounds truth = scene.at(state).query.state(state.values, request).any;
      for (const Table2Method& method : methods) checkRow(method, scene.at(state), truth);
    }
  }
}

TEST_CASE("convex parts are found once, and read where they cover the mesh", "[cli]") {
  const fcl_prob_test::TemporaryFolder folder;
  const auto meshOf = [](double width) {
    return buildTree(fcl_prob_test::torusMesh(1.0, width, 20, 8), "obbrss");
  };
  const auto torus = meshOf(0.3);
  DecompositionRequest request;
  request.max_parts = 4;
  request.pieces = 8;
  const auto partsOf = [&](PartsStore& store, const Geometry& mesh) {
    std::size_t corners = 0;
    const ConvexParts& parts = store.of(mesh, request);
    for (std::size_t i = 0; i < parts.size(); ++i) corners += parts.polytope(i).vertices.size();
    return corners;
  };
  PartsStore first(folder.path("kept"));
  const std::size_t corners = partsOf(first, torus);
  CHECK(partsOf(first, torus) == corners);
  CHECK(first.found() == 1);
  CHECK(first.read() == 0);
  PartsStore second(folder.path("kept"));
  CHECK(partsOf(second, torus) == corners);
  CHECK(second.found() == 0);
  CHECK(second.read() == 1);
  CHECK(partsOf(second, meshOf(0.25)) > 0);
  CHECK(second.found() == 1);
  // Parts of which some were lost are found anew.
  for (const auto& file : std::filesystem::directory_iterator(folder.path("kept"))) {
    const std::string text = fcl_prob_test::readWhole(file.path().string());
    std::ofstream(file.path()) << text.substr(0, text.size() / 2);
  }
  PartsStore third(folder.path("kept"));
  CHECK(partsOf(third, torus) == corners);
  CHECK(third.found() == 1);
  CHECK(third.read() == 0);
}

TEST_CASE("table2 is drawn with a panel a scene and a point a path", "[cli]") {
  CHECK(table2PlotScript({}).empty());
  const std::string script = table2PlotScript({{"cans", "probable decision", 120.5, 6.5},
                                               {"cans", "certified decision", 900.0, 6.25},
                                               {"cans", "probable decision", 80.0, 7.5},
                                               {"waving", "certified decision", 70.0, 5.0}});
  CHECK(script.find("$scene0_method0 << EOD\n120.5 6.5\n80 7.5\nEOD\n") != std::string::npos);
  CHECK(script.find("$scene0_method1 << EOD\n900 6.25\nEOD\n") != std::string::npos);
  CHECK(script.find("$scene1_method1 << EOD\n70 5\nEOD\n") != std::string::npos);
  CHECK(script.find("$scene1_method0") == std::string::npos);
  CHECK(script.find("layout 1,2") != std::string::npos);
  if (std::system("command -v gnuplot >/dev/null 2>&1") != 0) {
    std::cout << "SKIPPED: gnuplot is not installed\n";
    return;
  }
  const fcl_prob_test::TemporaryFolder folder;
  writePlot(script, folder.path("plot.svg"));
  const std::string plot = fcl_prob_test::readWhole(folder.path("plot.svg"));
  for (const char* text : {"<svg", "cans", "waving", "probable decision", "certified decision"}) {
    CAPTURE(text);
    CHECK(plot.find(text) != std::string::npos);
  }
}

TEST_CASE("bench draws what has a plot, to a file whose ending it knows", "[cli]") {
  const fcl_prob_test::TemporaryFolder folder;
  const auto run = [&](const std::string& name, const std::string& plot) {
    return fcl_prob_test::runCommand({"bench", name, "--models", folder.path(""), "--plot", plot},
                                     folder);
  };
  CHECK(run("table2", "x.pdf").refused());
  CHECK(run("table1", "x.svg").refused());
  CHECK(run("table1", "x.svg").err.find("table1 has no plot") != std::string::npos);
}

TEST_CASE("a plot of nothing is told", "[cli]") {
  const fcl_prob_test::TemporaryFolder folder;
  writePlot("", folder.path("plot.svg"));
  CHECK(fcl_prob_test::readWhole(folder.path("plot.svg")).empty());
}
#endif
