// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "bench/benchmark.h"

#ifdef FCL_PROB_HAS_CLOUD
#include "bench/bench_clouds.h"
#endif

namespace fcl_prob::cli {
namespace {

std::string markdownLine(const std::vector<std::string>& row) {
  std::string line = "|";
  for (const std::string& cell : row) line += " " + cell + " |";
  return line + '\n';
}

}  // namespace

std::string markdownOf(const TextTable& table) {
  std::string result = markdownLine(table.header()) + "|";
  for (std::size_t i = 0; i < table.header().size(); ++i) result += " --- |";
  result += '\n';
  for (const auto& row : table.rows()) result += markdownLine(row);
  return result;
}

std::string BenchReport::markdown() const {
  const std::string warning = interrupted ? "**Interrupted: rows are missing.**\n\n" : "";
  std::string text = "## " + title + "\n\n" + warning + markdownOf(table) + "\n";
  for (const NamedTable& more : more_tables) {
    text += "### " + more.title + "\n\n" + markdownOf(more.table) + "\n";
  }
  return text + notes;
}

std::string BenchReport::csv() const {
  std::string text = table.csv();
  for (const NamedTable& more : more_tables) text += "\n" + more.table.csv();
  return text + (interrupted ? "# interrupted: rows are missing\n" : "");
}

std::string BenchReport::json() const {
  nlohmann::ordered_json all = records;
  if (interrupted) all.push_back({{"interrupted", true}});
  return all.dump(1) + "\n";
}

const std::vector<Benchmark>& benchmarks() {
  static const std::vector<Benchmark> all{
      {"certified",
       "intervals, estimates and decisions against 10,000 calls of fcl::collide, on six scenes",
       true, benchCertified},
#ifdef FCL_PROB_HAS_CLOUD
      {"cloud", "rendered depth images of three objects against the objects themselves", true,
       benchCloud},
#endif
      {"conjunction", "2,170 encounters of satellites against what their file says of them", true,
       benchConjunction},
      {"ladder", "which rungs answer, and what queries take without each of them", true,
       benchLadder},
      {"mixed", "100 random pairs of meshes of any kind and size beside their errors", true,
       benchMixed},
      {"parts", "100 random scenes of robot parts and a can beside a human arm", true, benchParts},
      {"pose", "errors of rotations and joints against counting, on six scenes and an arm", true,
       benchPose},
      {"pose_pairs",
       "random ellipsoids and superquadrics with errors of the pose, as others draw them", false,
       benchPosePairs},
#ifdef FCL_PROB_HAS_ROBOT
      {"random-states", "decisions on random states of a KUKA and a Fetch beside a person", true,
       benchRandomStates},
#endif
      {"stability", "stiff and extreme scenes whose P is known in 100 digits", false,
       benchStability},
      {"table1", "the paper's Table I on six scenes, with all of its rows and more", true,
       benchTable1},
#ifdef FCL_PROB_HAS_PLANNING
      {"states", "decisions on the states of a Fetch arm along paths past a human arm", true,
       benchStates},
      {"table2",
       "the paper's Table II: one trajectory by every method, and a path for every method", true,
       benchTable2, true},
#endif
  };
  return all;
}

}  // namespace fcl_prob::cli
