// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// fcl_prob check from outside: answers, the JSON contract, exit codes, bad input.
#include <filesystem>
#include <fstream>
#include <iostream>
#include <nlohmann/json.hpp>

#include "catch.h"
#include "collada_tetrahedron.h"
#include "command.h"
#include "fcl_prob/normal_mass.h"
#include "models.h"

using namespace fcl_prob_test;
using nlohmann::json;

namespace {

json checkJson(const std::vector<std::string>& arguments, const TemporaryFolder& folder) {
  std::vector<std::string> all{"check"};
  all.insert(all.end(), arguments.begin(), arguments.end());
  all.push_back("--json");
  const CommandResult result = runCommand(all, folder);
  CAPTURE(result.err);
  REQUIRE((result.exit_code == 0 || result.exit_code == 3));
  CHECK(result.out.find('\n') == result.out.size() - 1);
  return json::parse(result.out);
}

/// Two unit cubes as OBJ files; A is moved along x by a normal displacement, so that P is a
/// difference of two tails of the normal distribution.
struct Cubes {
  TemporaryFolder folder;
  std::string file;
  Cubes() {
    std::string obj;
    for (const char* x : {"-0.5", "0.5"}) {
      for (const char* y : {"-0.5", "0.5"}) {
        for (const char* z : {"-0.5", "0.5"})
          obj += std::string("v ") + x + " " + y + " " + z + "\n";
      }
    }
    obj += "f 1 2 4 3\nf 5 7 8 6\nf 1 5 6 2\nf 3 4 8 7\nf 1 3 7 5\nf 2 6 8 4\n";
    file = folder.write("cube.obj", obj);
  }
};

}  // namespace

TEST_CASE("check widens by bands around the shapes", "[cli]") {
  const Cubes cubes;
  const std::vector<std::string> base{cubes.file,      cubes.file, "--pose-a",
                                      "1.2,0.13,0.07", "--sigma",  "0.1,0,0"};
  const auto with = [&](std::vector<std::string> more) {
    more.insert(more.begin(), base.begin(), base.end());
    return more;
  };
  const auto tail = [](double deviations) { return fcl_prob::normalTailMass(deviations); };
  const json both = checkJson(with({"--band-a", "0.006", "--band-b", "0.004,0.014"}), cubes.folder);
  CHECK(both.at("status") == "band-limit");
  CHECK(both.at("upper").get<double>() >= tail(1.9));
  CHECK(both.at("upper").get<double>() <= 1.1 * tail(1.9));
  CHECK(both.at("lower").get<double>() <= tail(2.2));
  CHECK(both.at("lower").get<double>() >= 0.9 * tail(2.2));

  const std::string file =
      cubes.folder.write("scene.json", R"({"a": {"mesh": "cube.obj", "pose": [1.2, 0.13, 0.07],
      "band": [0.01]}, "b": {"mesh": "cube.obj"}, "displacement": {"sigma": [0.1, 0, 0]}})");
  const json scene = checkJson({"--scene", file}, cubes.folder);
  CHECK(scene.at("upper").get<double>() >= tail(1.9));
  CHECK(scene.at("lower").get<double>() <= tail(2.1));

  for (const char* bad : {"-0.1", "x", "1,2,3", "nan"}) {
    const CommandResult refused = runCommand(
        {"check", cubes.file, cubes.file, "--sigma", "0.1,0,0", "--band-a", bad}, cubes.folder);
    CHECK(refused.exit_code == 2);
    CHECK(refused.err.find("--band-a") != std::string::npos);
  }
}

TEST_CASE("a reconstructed cloud is between what was seen and what may be there", "[cli]") {
  const Cubes cubes;
  std::string larger = "v -0.6 -0.5 -0.5\nv -0.6 -0.5 0.5\nv -0.6 0.5 -0.5\nv -0.6 0.5 0.5\n";
  larger += "v 0.6 -0.5 -0.5\nv 0.6 -0.5 0.5\nv 0.6 0.5 -0.5\nv 0.6 0.5 0.5\n";
  larger += "f 1 2 4 3\nf 5 7 8 6\nf 1 5 6 2\nf 3 4 8 7\nf 1 3 7 5\nf 2 6 8 4\n";
  cubes.folder.write("larger.obj", larger);
  const auto ask = [&](const std::string& variance, const std::string& threshold) {
    const std::string file =
        cubes.folder.write("seen.json", R"({"surface": "cube.obj", "obstacle": "larger.obj",
        "obstacle_is_solid": false, "band": [0.0], "covariance": [)" +
                                            variance + ", 0, 0, 0, 0, 0]}");
    return checkJson({cubes.file, file, "--pose-a", "1.2,0.13,0.07", "--sigma", "0.1,0,0",
                      "--threshold", threshold},
                     cubes.folder);
  };
  const auto tail = [](double deviations) { return fcl_prob::normalTailMass(deviations); };
  // 0.2 m to what was seen, 0.1 m to what may be there.
  const json seen = ask("0", "0.1");
  CHECK(seen.at("lower").get<double>() == Approx(tail(2.0)).epsilon(0.02));
  CHECK(seen.at("upper").get<double>() == Approx(tail(1.0)).epsilon(0.02));
  CHECK(seen.at("status") == "band-limit");
  CHECK(seen.at("decision") == "undecided");
  CHECK(ask("0", "0.2").at("decision") == "below");
  CHECK(ask("0", "0.02").at("decision") == "above");

  const json shared = ask("0.03", "0.25");
  CHECK(shared.at("lower").get<double>() == Approx(tail(1.0)).epsilon(0.02));
  CHECK(shared.at("upper").get<double>() == Approx(tail(0.5)).epsilon(0.02));
}

TEST_CASE("check takes errors of a pose", "[cli][slow]") {
  const Cubes cubes;
  const std::vector<std::string> base{cubes.file, cubes.file, "--pose-a", "1.2,0.13,0.07"};
  const auto with = [&](std::vector<std::string> more) {
    more.insert(more.begin(), base.begin(), base.end());
    return more;
  };
  // Without rotation as for --sigma.
  const json still = checkJson(with({"--pose-sigma", "0.1,0,0,0,0,0"}), cubes.folder);
  CHECK(still.at("lower").get<double>() <= fcl_prob::normalTailMass(2.0));
  CHECK(still.at("upper").get<double>() >= fcl_prob::normalTailMass(2.0));
  const json turned = checkJson(
      with({"--pose-sigma", "0.1,0.05,0.05,0.1,0.1,0.1", "--method", "estimate"}), cubes.folder);
  CHECK(turned.at("method") == "estimate");
  CHECK(turned.at("status") == "converged");
  const json counted = checkJson(
      with({"--pose-covariance", "0.01,0,0,0,0,0,0.0025,0,0,0,0,0.0025,0,0,0,0.01,0,0,0.01,0,0.01",
            "--method", "monte-carlo", "--samples", "20000", "--relative-tolerance", "1e-9"}),
      cubes.folder);
  const double difference =
      turned.at("estimate").get<double>() - counted.at("estimate").get<double>();
  CHECK(std::fabs(difference) <= 5.0 * std::hypot(turned.at("standard_error").get<double>(),
                                                  counted.at("standard_error").get<double>()));
  const json interval = checkJson(with({"--pose-sigma", "0.1,0.05,0.05,0.01,0.01,0.01", "--method",
                                        "interval", "--relative-tolerance", "0.5"}),
                                  cubes.folder);
  CHECK(interval.at("upper").get<double>() > interval.at("lower").get<double>());
  const std::vector<std::vector<std::string>> refused{
      {"--pose-sigma", "0.1,0,0"},
      {"--pose-sigma", "0.1,0,0,0,0,45"},
      {"--pose-sigma", "0.1,0,0,0,0,x"},
      {"--pose-covariance", "1,2,3"},
      {"--pose-sigma", "0.1,0,0,0,0,0.1", "--sigma", "0.1,0,0"},
      {"--pose-sigma", "0.1,0,0,0,0,0.1", "--pose-convention", "mine"},
      {"--pose-sigma", "0.1,0,0,0,0,0.1", "--method", "general-pcd"},
      {"--pose-sigma", "0.1,0,0,0,0,0.1", "--bv", "sphere"}};
  for (const auto& bad : refused) {
    std::vector<std::string> all = with(bad);
    all.insert(all.begin(), "check");
    const CommandResult result = runCommand(all, cubes.folder);
    CAPTURE(bad[1], result.err);
    CHECK(result.refused());
  }
}

TEST_CASE("check answers what the normal distribution says of two cubes", "[cli]") {
  const Cubes cubes;
  // Centres 1.2 m apart, sigma 0.1 m along x only; surfaces of cubes that overlap touch.
  const json answer = checkJson(
      {cubes.file, cubes.file, "--pose-a", "1.2,0.13,0.07", "--sigma", "0.1,0,0"}, cubes.folder);
  const double expected = fcl_prob::normalTailMass(2.0);
  REQUIRE(answer.at("lower").is_number());
  CHECK(answer.at("lower").get<double>() <= expected);
  CHECK(answer.at("upper").get<double>() >= expected);
  CHECK(answer.at("upper").get<double>() - answer.at("lower").get<double>() <= 0.011 * expected);
  CHECK(answer.at("fcl").at("collides") == false);
  CHECK(answer.at("fcl").at("distance").get<double>() == Approx(0.2));
}

TEST_CASE("the JSON of check has every field of the contract", "[cli]") {
  const Cubes cubes;
  for (const std::string method : {"auto", "interval", "monte-carlo", "general-pcd"}) {
    CAPTURE(method);
    const json answer = checkJson({cubes.file, cubes.file, "--pose-a", "1.1,0.13,0.07", "--sigma",
                                   "0.1,0.1,0.1", "--method", method, "--threshold", "0.9"},
                                  cubes.folder);
    for (const char* key :
         {"method", "lower", "upper", "estimate", "standard_error", "decision", "gradient",
          "status", "time_ms", "build_ms", "fcl", "plan", "statistics"}) {
      CHECK(answer.contains(key));
    }
    CHECK(answer.at("fcl").contains("collides"));
    CHECK(answer.at("fcl").contains("distance"));
    CHECK(answer.at("plan").is_array());
    // An upper bound can be too weak to decide.
    CHECK(answer.at("decision") == (method == "general-pcd" ? "undecided" : "below"));
    CHECK(answer.at("time_ms").get<double>() > 0.0);
    const bool samples = method == "monte-carlo";
    CHECK(answer.at("lower").is_null() == (samples || method == "general-pcd"));
    CHECK(answer.at("upper").is_null() == samples);
    CHECK(answer.at("standard_error").is_number() == samples);
  }
  const json free_of_threshold =
      checkJson({cubes.file, cubes.file, "--pose-a", "3,0,0", "--sigma", "1,1,1"}, cubes.folder);
  CHECK(free_of_threshold.at("decision").is_null());
}

TEST_CASE("a gradient is computed only when asked for, and along all axes", "[cli]") {
  const TemporaryFolder folder;
  const auto answer = [&](std::vector<std::string> more) {
    more.insert(more.begin(), {"--scene", dataFile("two_boxes.json"), "--sigma", "0.08,0.05,0.02"});
    return checkJson(more, folder);
  };
  const json without = answer({});
  CHECK(without.at("gradient").is_null());
  const json with = answer({"--gradient"});
  CHECK(with.at("gradient").size() == 3);
  for (const json& result : {without, with}) {
    CHECK(result.at("method") == "exact");
    CHECK(result.at("upper").get<double>() - result.at("lower").get<double>() <
          1e-9 * result.at("upper").get<double>());
  }
}

TEST_CASE("what single precision rounds is told of the formats that have it, where it matters",
          "[cli]") {
  const Cubes cubes;
  const std::string imported = cubes.folder.write("t.dae", kColladaTetrahedron);
  const auto planOf = [&](const std::string& a, const char* sigma, const char* tolerance) {
    return checkJson({a, cubes.file, "--pose-a", "0.55,0,0", "--sigma", sigma,
                      "--relative-tolerance", tolerance, "--absolute-tolerance", "0"},
                     cubes.folder)
        .at("plan")
        .dump();
  };
  const std::string told = "A is read in single precision";
  CHECK(planOf(imported, "0.1,0.1,0.1", "0.05").find(told) == std::string::npos);
  CHECK(planOf(imported, "0.1,0.1,0.1", "0.001").find(told) != std::string::npos);
  CHECK(planOf(imported, "0.05,0.05,0.0001", "0.05").find(told) != std::string::npos);
  CHECK(planOf(cubes.file, "0.1,0.1,0.1", "0.001").find("single precision") == std::string::npos);
}

TEST_CASE("what a mesh file's reader passed over is told", "[cli]") {
  const Cubes cubes;
  std::ifstream file(cubes.file);
  const std::string obj((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
  const std::string with_more = cubes.folder.write("more.obj", "6540 2180\n" + obj);
  for (const bool is_a : {false, true}) {
    const std::string plan =
        checkJson({is_a ? with_more : cubes.file, is_a ? cubes.file : with_more, "--pose-a",
                   "1.1,0,0", "--sigma", "0.1,0.1,0.1"},
                  cubes.folder)
            .at("plan")
            .dump();
    CHECK(plan.find("more.obj: line 1: '6540' is not a statement of OBJ") != std::string::npos);
  }
}

TEST_CASE("every bounding volume bounds the probability from above", "[cli]") {
  const Cubes cubes;
  const double expected = fcl_prob::normalTailMass(2.0);
  for (const std::string volume : {"obb", "aabb", "rss", "obbrss", "kios", "kdop16", "kdop18",
                                   "kdop24", "kdop26", "sphere", "convex"}) {
    CAPTURE(volume);
    const json answer = checkJson({cubes.file, cubes.file, "--pose-a", "1.2,0.13,0.07", "--sigma",
                                   "0.1,0,0", "--method", "general-pcd-min", "--bv", volume},
                                  cubes.folder);
    CHECK(answer.at("upper").get<double>() >= expected);
    CHECK(answer.at("upper").get<double>() <= (volume == "sphere" ? 1.0 : 0.1));
  }
  CHECK(runCommand({"check", cubes.file, cubes.file, "--sigma", "1,1,1", "--bv", "sphere"},
                   cubes.folder)
            .refused());
}

TEST_CASE("normalize, scale, poses, mean and covariance reach the query", "[cli]") {
  const Cubes cubes;
  const std::string big = cubes.folder.write(
      "big.obj", "v 10 10 10\nv 14 10 10\nv 10 14 10\nv 10 10 14\nf 1 3 2\nf 1 2 4\nf 2 3 4\n");
  const auto distanceOf = [&](std::vector<std::string> arguments) {
    arguments.insert(arguments.end(), {"--covariance", "1e-8,0,0,1e-8,0,1e-8"});
    return checkJson(arguments, cubes.folder).at("fcl").at("distance").get<double>();
  };
  CHECK(distanceOf({cubes.file, cubes.file, "--pose-a", "2,0,0"}) == Approx(1.0));
  CHECK(distanceOf({cubes.file, cubes.file, "--pose-a", "2,0,0,1,0,0,1"}) == Approx(1.0));
  CHECK(distanceOf({cubes.file, cubes.file, "--pose-b", "0,-2.5,0"}) == Approx(1.5));
  CHECK(distanceOf({cubes.file, cubes.file, "--pose-a", "2,0,0", "--mean", "-0.25,0,0"}) ==
        Approx(0.75));
  CHECK(distanceOf({cubes.file, cubes.file, "--pose-a", "4,0,0", "--scale-a", "2", "--scale-b",
                    "0.5"}) == Approx(2.75));
  CHECK(distanceOf({big, cubes.file, "--pose-a", "3,0,0", "--normalize"}) == Approx(2.0));
}

TEST_CASE("a scene file and the options that win over it", "[cli]") {
  const TemporaryFolder folder;
  const json scene = checkJson({"--scene", dataFile("two_knots.json")}, folder);
  CHECK(scene.at("decision") == "above");
  const json far = checkJson({"--scene", dataFile("two_knots.json"), "--pose-a", "0.5,0,0",
                              "--sigma", "0.001,0.001,0.001", "--mean", "0,0,0"},
                             folder);
  CHECK(far.at("decision") == "below");
  CHECK(far.at("fcl").at("distance").get<double>() > 0.3);
}

TEST_CASE("the readable answer has the probability, its bounds and FCL's answer", "[cli]") {
  const Cubes cubes;
  const CommandResult result = runCommand(
      {"check", cubes.file, cubes.file, "--pose-a", "1.2,0.13,0.07", "--sigma", "0.1,0,0"},
      cubes.folder);
  CHECK(result.exit_code == 0);
  CHECK(result.err.empty());
  for (const char* part : {"P(collision)    0.02", "certified", "fcl::collide    free",
                           "distance 0.2 m", "method", "ms to build the trees", "plan"}) {
    CAPTURE(part, result.out);
    CHECK(result.out.find(part) != std::string::npos);
  }
}

TEST_CASE("a limit before the tolerance exits with 3 and a valid answer", "[cli]") {
  const TemporaryFolder folder;
  const CommandResult result =
      runCommand({"check", "--scene", dataFile("finger_mug.json"), "--method", "monte-carlo",
                  "--samples", "1000000000", "--relative-tolerance", "1e-9", "--absolute-tolerance",
                  "0", "--time-limit", "0.05", "--json"},
                 folder);
  CHECK(result.exit_code == 3);
  const json answer = json::parse(result.out);
  CHECK(answer.at("status") == "time-limit");
  CHECK(answer.at("confidence_interval").at(0).get<double>() <= 0.07);
  CHECK(answer.at("confidence_interval").at(1).get<double>() >= 0.065);
}

TEST_CASE("bad input is refused with one line and exit code 2", "[cli]") {
  const Cubes cubes;
  const std::string& cube = cubes.file;
  const TemporaryFolder& folder = cubes.folder;
  const std::string empty = folder.write("empty.stl", "");
  const std::string points = folder.write("points.obj", "v 0 0 0\nv 1 1 1\np 1 2\n");
  const std::string noise = folder.write("noise.ply", std::string("ply\n\x01\x02\0\xff junk", 13));
  const std::string scene = folder.write("scene.json", R"({"a": {"sphere": 1}})");

  const auto refusal = [&](std::vector<std::string> arguments) {
    const CommandResult result = runCommand(arguments, folder);
    CAPTURE(arguments, result.exit_code, result.out, result.err);
    CHECK(result.refused());
    return result.err;
  };
  const auto says = [](const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
  };
  const std::vector<std::string> pair{"check", cube, cube};
  const auto with = [&](std::vector<std::string> more) {
    more.insert(more.begin(), pair.begin(), pair.end());
    return more;
  };
  const auto withSigma = [&](std::vector<std::string> more) {
    more.insert(more.end(), {"--sigma", "1,1,1"});
    return with(more);
  };

  CHECK(says(refusal({"check", "missing.obj", cube, "--sigma", "1,1,1"}), "missing.obj: no such"));
  CHECK(says(refusal({"check", cube, empty, "--sigma", "1,1,1"}), "empty.stl: the file is empty"));
  CHECK(says(refusal({"check", cube, points, "--sigma", "1,1,1"}), "no triangles"));
  CHECK(says(refusal({"check", noise, cube, "--sigma", "1,1,1"}), "noise.ply: line 2"));
  CHECK(says(refusal({"check", folder.path(""), cube, "--sigma", "1,1,1"}), "not a regular file"));
  CHECK(says(refusal({"check", "--scene", scene}), "scene.json: b: missing"));
  CHECK(says(refusal({"check", "--scene", "nowhere.json"}), "nowhere.json: no such file"));
  refusal({"check", "--scene", scene, cube, cube});
  refusal({"check"});
  refusal({"check", cube, "--sigma", "1,1,1"});
  refusal({"check", cube, cube, cube, "--sigma", "1,1,1"});
  refusal({"chekc"});
  CHECK(says(refusal(pair), "needs --covariance or --sigma"));
  CHECK(says(refusal(with({"--covariance", "nan,0,0,1,0,1"})), "--covariance"));
  CHECK(says(refusal(with({"--covariance", "1,2,0,1,0,1"})), "--covariance"));
  CHECK(says(refusal(with({"--covariance", "1,0,0,1,0"})), "--covariance: a covariance needs 6"));
  CHECK(says(refusal(with({"--sigma", "1,-1,1"})), "--sigma"));
  CHECK(says(refusal(with({"--sigma", "1,1"})), "--sigma"));
  CHECK(says(refusal(with({"--sigma", "1,x,1"})), "--sigma: 'x' is not a number"));
  CHECK(says(refusal(with({"--sigma", "1,,1"})), "--sigma: '' is not a number"));
  refusal(with({"--sigma", "1,1,1", "--covariance", "1,0,0,1,0,1"}));
  refusal(with({"--covariance", "1,0,0,1,0,1", "--sigma-axes", "1,0,0,0"}));
  CHECK(says(refusal(with({"--sigma", "1,1,1", "--sigma-axes", "0,0,0,0"})), "--sigma-axes"));
  CHECK(says(refusal(withSigma({"--mean", "0,inf,0"})), "inf"));
  CHECK(says(refusal(withSigma({"--pose-a", "1,2"})), "--pose-a: a pose needs 3, 6, 7"));
  CHECK(says(refusal(withSigma({"--pose-a", "10mm,0,0"})), "'10mm' is not a number"));
  CHECK(says(refusal(withSigma({"--pose-a", "1,2,3,90"})), "--pose-a: a pose needs 3, 6, 7"));
  CHECK(says(refusal(withSigma({"--pose-b", "1,2,3,0,0,90"})), "90 radians is more than a turn"));
  CHECK(says(refusal(withSigma({"--pose-b", "0,0,0,0,0,0,0"})), "--pose-b: a quaternion"));
  CHECK(says(refusal(withSigma({"--pose-b", "0,0,0,nan,0,0,0"})), "--pose-b"));
  CHECK(says(refusal(withSigma({"--scale-a", "0"})), "scale"));
  refusal(withSigma({"--scale-a", "two"}));
  CHECK(says(refusal(withSigma({"--method", "magic"})), "--method: unknown method 'magic'"));
  refusal(withSigma({"--bv", "ball"}));
  refusal(withSigma({"--contact", "maybe"}));
  refusal(withSigma({"--samples", "-5"}));
  refusal(withSigma({"--samples", "1.5"}));
  refusal(withSigma({"--threads", "0"}));
  refusal(withSigma({"--relative-tolerance", "-1"}));
  refusal(withSigma({"--relative-tolerance", "nan"}));
  refusal(withSigma({"--threshold", "2"}));
  refusal(withSigma({"--time-limit", "-1"}));
  refusal(withSigma({"--confidence", "1"}));
  refusal(withSigma({"--unknown"}));
}

TEST_CASE("a file that crashes the importer is refused like any other", "[cli]") {
  const Cubes cubes;
  constexpr int kDepth = 100'000;  // the importer recurses into each node
  std::string deep =
      "<?xml version=\"1.0\"?><COLLADA version=\"1.4.1\"><asset/>"
      "<library_visual_scenes><visual_scene id=\"s\">";
  for (int i = 0; i < kDepth; ++i) deep += "<node>";
  for (int i = 0; i < kDepth; ++i) deep += "</node>";
  deep +=
      "</visual_scene></library_visual_scenes>"
      "<scene><instance_visual_scene url=\"#s\"/></scene></COLLADA>";
  const std::string path = cubes.folder.write("deep.dae", deep);
  const CommandResult result =
      runCommand({"check", path, cubes.file, "--sigma", "1,1,1"}, cubes.folder);
  CAPTURE(result.err);
  CHECK(result.refused());
  CHECK(result.err.find("deep.dae: the mesh importer crashed on this file") != std::string::npos);
  for (const auto& entry : std::filesystem::directory_iterator(cubes.folder.path(""))) {
    CHECK(entry.path().filename().string().rfind("core", 0) != 0);
  }

  const auto known = modelOrSkip("nasty/real/assimp_crash-30d6d0f7.ply");
  if (!known) return;
  CHECK(runCommand({"check", *known, cubes.file, "--sigma", "1,1,1"}, cubes.folder).refused());
}

TEST_CASE("output that does not arrive exits with 2", "[cli]") {
  const TemporaryFolder folder;
  if (!std::filesystem::exists("/dev/full")) {
    std::cout << "SKIPPED: no /dev/full\n";
    return;
  }
  const std::vector<std::string> arguments{"check", "--scene", dataFile("two_boxes.json")};
  REQUIRE(runCommand(arguments, folder).exit_code == 0);
  const CommandResult full = runCommand(arguments, folder, "/dev/full");
  CHECK(full.exit_code == 2);
  CHECK(full.err.find("standard output: cannot be written") != std::string::npos);
  const CommandResult help = runCommand({"check", "--help"}, folder);
  CHECK(help.exit_code == 0);
  CHECK(help.err.empty());
}

TEST_CASE("check writes a certificate, whole or not at all", "[cli]") {
  const Cubes cubes;
  const std::string file = cubes.folder.path("cubes.jsonl");
  const std::vector<std::string> arguments{cubes.file, cubes.file,    "--pose-a",      "1.2,0,0",
                                           "--sigma",  "0.2,0.1,0.1", "--certificate", file};
  const json answer = checkJson(arguments, cubes.folder);
  std::ifstream lines(file);
  std::string first, line, last;
  std::getline(lines, first);
  while (std::getline(lines, line)) last = line;
  CHECK(json::parse(first).at("fcl_prob_certificate") == 1);
  CHECK(json::parse(last).at("lower") == answer.at("lower"));
  CHECK(json::parse(last).at("upper") == answer.at("upper"));
  std::filesystem::remove(file);
  std::vector<std::string> refused = arguments;
  refused.insert(refused.begin(), "check");
  refused.insert(refused.end(), {"--band-a", "0.01"});
  const CommandResult result = runCommand(refused, cubes.folder);
  CHECK((result.exit_code == 2 && !std::filesystem::exists(file)));
  CHECK(result.err.find("no certificate with bands") != std::string::npos);
}

TEST_CASE("a reproduction needs no other file, and is answered with the same bits", "[cli]") {
  const Cubes cubes;
  const TemporaryFolder& folder = cubes.folder;
  const std::string file = folder.path("fault.json");
  const json first = checkJson(
      {cubes.file, cubes.file, "--scale-a", "0.7", "--pose-a", "1,0.1,0.2,0.9,0.1,0.2,0.3",
       "--covariance", "0.01,0,0,0.02,0,0.03", "--relative-tolerance", "0.02", "--reproduce", file},
      folder);
  std::filesystem::remove(cubes.file);
  const json again = checkJson({"--scene", file}, folder);
  for (const char* key : {"lower", "upper", "method", "status", "decision"}) {
    CHECK(first[key] == again[key]);
  }
  std::ifstream stream(file);
  const std::string description = json::parse(stream)["description"];
  CHECK(description.find("\"lower\":" + first["lower"].dump()) != std::string::npos);
  CHECK(description.rfind("fcl_prob ", 0) == 0);
}

TEST_CASE("P of a cube within a larger one", "[cli]") {
  const Cubes cubes;
  const json result = checkJson({cubes.file, cubes.file, "--scale-a", "0.4", "--sigma",
                                 "0.2,0.3,0.1", "--contact", "contained"},
                                cubes.folder);
  double truth = 1.0;
  for (const double sigma : {0.2, 0.3, 0.1}) {
    truth *= fcl_prob::normalIntervalMass(-0.3 / sigma, 0.3 / sigma);
  }
  CHECK(result["lower"].get<double>() <= truth);
  CHECK(result["upper"].get<double>() >= truth);
  CHECK(result["upper"].get<double>() - result["lower"].get<double>() < 0.0101 * truth);
}
