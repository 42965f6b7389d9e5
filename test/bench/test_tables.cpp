// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// The parts that the benchmark tables are made of.
#include <boost/math/constants/constants.hpp>
#include <map>

#include "bench/bench_scenes.h"
#include "bench/benchmark.h"
#include "bench/fcl_loop.h"
#include "bench/published_table.h"
#include "bench/table1_rows.h"
#include "bench/uniforms.h"
#include "bench/volume_trees.h"
#include "catch.h"
#include "command.h"
#include "models.h"

using namespace fcl_prob;
using namespace fcl_prob::cli;
using fcl_prob_test::modelOrSkip;
using fcl_prob_test::modelsFolder;

namespace {

TriangleMesh cuboid(double x, double y, double z) {
  TriangleMesh mesh;
  for (const double sx : {0.0, x}) {
    for (const double sy : {0.0, y}) {
      for (const double sz : {0.0, z}) mesh.vertices.emplace_back(sx, sy, sz);
    }
  }
  mesh.triangles = {{0, 1, 3}, {0, 3, 2}, {4, 6, 7}, {4, 7, 5}, {0, 4, 5}, {0, 5, 1},
                    {2, 3, 7}, {2, 7, 6}, {0, 2, 6}, {0, 6, 4}, {1, 5, 7}, {1, 7, 3}};
  return mesh;
}

}  // namespace

TEST_CASE("volumes of a cuboid and of its bounding volumes", "[cli]") {
  const TriangleMesh mesh = cuboid(1, 2, 3);
  CHECK(enclosedVolume(mesh) == Approx(6.0));
  const double pi = boost::math::constants::pi<double>();
  const double ball = 4.0 / 3.0 * pi * std::pow(std::sqrt(14.0) / 2.0, 3);
  for (const std::string volume : {"aabb", "kdop16", "kdop18", "kdop24", "kdop26", "convex"}) {
    CAPTURE(volume);
    CHECK(makeVolumeTrees(volume, mesh, mesh)->volumes(3).at(0) == Approx(6.0).epsilon(1e-6));
  }
  CHECK(makeVolumeTrees("sphere", mesh, mesh)->volumes(1).at(0) >= ball);
  CHECK(makeVolumeTrees("sphere", mesh, mesh)->volumes(1).at(0) <= 1.1 * ball);
  // FCL fits these to the covariance of the triangles, whose diagonals turn them.
  for (const std::string volume : {"rss", "kios", "obb", "obbrss"}) {
    CAPTURE(volume);
    CHECK(makeVolumeTrees(volume, mesh, mesh)->volumes(1).at(0) >= 6.0 * (1 - 1e-12));
    CHECK(makeVolumeTrees(volume, mesh, mesh)->volumes(1).at(0) <= 3.0 * 6.0);
  }
  fcl::OBBd box;
  box.extent = {0.5, 1.0, 1.5};
  CHECK(volumeOf(box) == Approx(6.0));

  fcl::RSSd rss;
  rss.axis.setIdentity();
  rss.To.setZero();
  rss.r = 0.5;
  rss.l[0] = 2.0;
  rss.l[1] = 3.0;
  CHECK(volumeOf(rss) == Approx(6.0 + 0.25 * pi * 5.0 + pi / 6.0));
}

TEST_CASE("a cut cube is smaller as a k-DOP than as a box", "[cli]") {
  // A regular octahedron: its 26-DOP is itself, its 18-DOP only cuts the edges of its box.
  TriangleMesh octahedron;
  for (int k = 0; k < 3; ++k) {
    octahedron.vertices.push_back(Eigen::Vector3d::Unit(k));
    octahedron.vertices.push_back(-Eigen::Vector3d::Unit(k));
  }
  octahedron.triangles = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4},
                          {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
  CHECK(enclosedVolume(octahedron) == Approx(4.0 / 3.0));
  const auto rootVolume = [&](const char* volume) {
    return makeVolumeTrees(volume, octahedron, octahedron)->volumes(1).at(0);
  };
  CHECK(rootVolume("aabb") == Approx(8.0));
  CHECK(rootVolume("kdop26") == Approx(4.0 / 3.0).epsilon(1e-6));
  CHECK(rootVolume("convex") == Approx(4.0 / 3.0).epsilon(1e-6));
  CHECK(rootVolume("kdop18") == Approx(2.0).epsilon(1e-6));  // a rhombic dodecahedron
}

TEST_CASE("random rotations are rotations, and have no preferred direction", "[cli]") {
  Eigen::Matrix3d mean = Eigen::Matrix3d::Zero();
  Eigen::Matrix3d mean_square = Eigen::Matrix3d::Zero();
  constexpr int kCount = 20'000;
  for (int i = 0; i < kCount; ++i) {
    const Eigen::Matrix3d rotation = randomRotation(7, i);
    REQUIRE((rotation.transpose() * rotation - Eigen::Matrix3d::Identity()).norm() < 1e-12);
    REQUIRE(rotation.determinant() > 0.0);
    mean += rotation / kCount;
    mean_square += rotation.cwiseAbs2() / kCount;
  }
  CHECK(mean.cwiseAbs().maxCoeff() < 5.0 / std::sqrt(3.0 * kCount));
  CHECK((mean_square.array() - 1.0 / 3.0).abs().maxCoeff() < 0.015);
  CHECK(randomRotation(7, 5) == randomRotation(7, 5));
  CHECK(randomRotation(7, 5) != randomRotation(8, 5));
}

TEST_CASE("tables as Markdown", "[cli]") {
  TextTable table({"a", "long"});
  table.add({"1,5", "x\"y"});
  CHECK(markdownOf(table) == "| a | long |\n| --- | --- |\n| 1,5 | x\"y |\n");
}

TEST_CASE("the published table is looked up by row, model and distance", "[cli]") {
  CHECK(publishedRow("obb", "dragon_5cm")->probability_percent == 6.23);
  CHECK(publishedRow("monte-carlo", "buddha_1cm")->time_ms == 108'000);
  CHECK(publishedRow("sphere", "bunny_1cm")->bounding_volume_error == 4.80);
  CHECK(!publishedRow("kios", "bunny_1cm"));
  CHECK(!publishedRow("obb", "bunny_2cm"));
}

TEST_CASE("the certified benchmark repeats but for its times", "[cli]") {
  const auto model = modelOrSkip("benchmark/bunny_5110.obj");
  if (!model) return;
  const fcl_prob_test::TemporaryFolder folder;
  const auto run = [&] {
    const auto result = fcl_prob_test::runCommand(
        {"bench", "certified", "--models", *modelsFolder(), "--only", "bunny_5cm", "--json"},
        folder);
    REQUIRE(result.exit_code == 0);
    return nlohmann::json::parse(result.out);
  };
  const nlohmann::json first = run();
  const nlohmann::json second = run();
  REQUIRE(first.size() == second.size());
  REQUIRE(first.size() >= 7);
  int intervals = 0;
  for (std::size_t i = 0; i < first.size(); ++i) {
    if (!first[i].contains("hash")) continue;
    CHECK(first[i].at("hash") == second[i].at("hash"));
    CHECK(first[i].at("lower").get<double>() <= 0.101536876);
    CHECK(first[i].at("upper").get<double>() >= 0.101530829);
    ++intervals;
  }
  CHECK(intervals >= 6);
}

namespace {

/// Volumes of the root's bounding volumes over that of the mesh.
std::map<std::string, double> rootErrors(const TriangleMesh& mesh) {
  std::map<std::string, double> errors{{"convex", hullVolume(mesh)}};
  for (const std::string& volume : volumesOfTable1()) {
    if (volume == "convex") continue;  // hulls of all nodes take seconds
    errors[volume] = makeVolumeTrees(volume, mesh, mesh)->volumes(1).at(0);
  }
  constexpr int kFrames = 500;
  for (int i = 0; i < kFrames; ++i) {
    fcl::AABBd box;
    for (const auto& vertex : rotated(mesh, randomRotation(1, i)).vertices) box += vertex;
    errors["aabb, random frames"] += volumeOf(box) / kFrames;
  }
  for (auto& [volume, error] : errors) error /= enclosedVolume(mesh);
  return errors;
}

void checkTable1(const std::string& only, std::size_t scenes) {
  const fcl_prob_test::TemporaryFolder folder;
  const auto result = fcl_prob_test::runCommand(
      {"bench", "table1", "--models", *modelsFolder(), "--only", only, "--frames", "1", "--json"},
      folder);
  REQUIRE(result.exit_code == 0);
  const nlohmann::json records = nlohmann::json::parse(result.out);
  std::size_t bounds = 0, published = 0, certified = 0;
  for (const nlohmann::json& record : records) {
    CAPTURE(record.dump());
    const double lower = record.at("reference_lower").get<double>();
    const double upper = record.at("reference_upper").get<double>();
    REQUIRE(lower > 0.01);
    REQUIRE(upper <= 1.002 * lower);
    CHECK(record.at("time_ms").get<double>() > 0.0);
    published += !record.at("published_time_ms").is_null();
    if (record.at("kind") == "certified interval") {
      CHECK(record.at("value").get<double>() == Approx(0.5 * (lower + upper)).epsilon(0.01));
      ++certified;
    }
    if (record.at("kind") != "upper bound") continue;
    ++bounds;
    for (const char* number : {"value", "minimum", "raw_sum"}) {
      if (!record.at(number).is_null()) CHECK(record.at(number).get<double>() >= lower);
    }
    CHECK(record.at("value").get<double>() <= 1.0);
  }
  CHECK(bounds == scenes * 28);
  CHECK(certified == scenes * 2);
  CHECK(published == scenes * 9);
}

}  // namespace

TEST_CASE("by volume, spheres are the loosest and convex hulls the tightest", "[cli][slow]") {
  for (const char* const name : {"bunny_5110", "dragon_10000", "buddha_10000"}) {
    const auto model = modelOrSkip(std::string("benchmark/") + name + ".obj");
    if (!model) continue;
    CAPTURE(name);
    MeshOptions options;
    options.normalize = true;
    std::map<std::string, double> errors = rootErrors(loadMesh(*model, options));
    for (const auto& [volume, error] : errors) {
      CAPTURE(volume, error);
      CHECK(error >= 1.0);
      CHECK(error <= errors.at("sphere"));
      CHECK(error >= errors.at("convex"));
    }
    // Each has the directions of the one before, and more.
    CHECK(errors.at("aabb") > errors.at("kdop16"));
    CHECK(errors.at("kdop16") >= errors.at("kdop18") * (1 - 1e-9));
    CHECK(errors.at("kdop18") >= errors.at("kdop24") * (1 - 1e-9));
    CHECK(errors.at("kdop24") >= errors.at("kdop26") * (1 - 1e-9));
    CHECK(errors.at("kdop26") > errors.at("convex"));
    // The paper's order of boxes: its AABBs are those of random frames.
    CHECK(errors.at("sphere") > errors.at("aabb, random frames"));
    CHECK(errors.at("aabb, random frames") > errors.at("obb"));
    CHECK(errors.at("obb") > errors.at("kdop26"));
  }
}

TEST_CASE("every upper bound of table1 is above the certified P, on one scene", "[cli][long]") {
  if (modelOrSkip("benchmark/bunny_5110.obj")) checkTable1("bunny_5cm", 1);
}

TEST_CASE("every upper bound of table1 is above the certified P, on all scenes", "[cli][long]") {
  if (modelOrSkip("benchmark/bunny_5110.obj")) checkTable1("cm", 6);
}

TEST_CASE("bench lists its tables and refuses others", "[cli]") {
  const fcl_prob_test::TemporaryFolder folder;
  const auto list = fcl_prob_test::runCommand({"bench"}, folder);
  CHECK(list.exit_code == 0);
  for (const Benchmark& benchmark : benchmarks()) {
    CHECK(list.out.find(benchmark.name) != std::string::npos);
  }
  CHECK(fcl_prob_test::runCommand({"bench", "nothing", "--models", "."}, folder).refused());
  CHECK(fcl_prob_test::runCommand({"bench", "certified", "--models", "."}, folder).refused());
}

TEST_CASE("a table that was interrupted says so in whatever is written of it", "[cli]") {
  BenchReport report;
  report.title = "Some";
  report.table = TextTable({"a", "b"});
  report.table.add({"1", "2"});
  report.records.push_back({{"a", 1}});
  for (const bool interrupted : {false, true}) {
    report.interrupted = interrupted;
    for (const std::string& text : {report.markdown(), report.csv(), report.json()}) {
      CAPTURE(text);
      CHECK((text.find("nterrupted") != std::string::npos) == interrupted);
    }
    CHECK(nlohmann::json::parse(report.json()).size() == (interrupted ? 2 : 1));
  }
}
