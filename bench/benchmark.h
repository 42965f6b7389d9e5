// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Named benchmarks and what they report.
#pragma once

#include <functional>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "cli/text_table.h"

namespace fcl_prob::cli {

struct BenchOptions {
  std::string models_folder;
  std::string only;  ///< run only scenes whose name contains this
  std::string task;  ///< parts, stability: only tasks, or methods, whose name contains this
  std::uint64_t seed = 1;
  std::size_t frames = 100;  ///< table1: random frames that bounds by AABBs are averaged over
  std::size_t cases = 50;    ///< stability: scenes of each family
  std::string parts_folder;  ///< table2: where convex parts of meshes are kept; empty: nowhere
  std::optional<std::size_t> states;  ///< table2: that a planner may ask for
  bool quick = false;                 ///< a few scenes, seeds or samples only
};

/// | a | b |
std::string markdownOf(const TextTable& table);

struct NamedTable {
  std::string title;
  TextTable table;
};

/// A table for people and the same numbers, unrounded, for programs.
struct BenchReport {
  std::string title;
  std::string notes;  ///< Markdown, under the table: what the columns mean
  TextTable table{{}};
  std::vector<NamedTable> more_tables;  ///< after it
  nlohmann::ordered_json records = nlohmann::ordered_json::array();
  std::string plot;          ///< for writePlot(); empty: there is nothing to draw
  bool interrupted = false;  ///< rows are missing: all that is written says so

  std::string markdown() const;
  std::string csv() const;
  std::string json() const;
};

/// Told what is being run and how much is done (0 to 1); returns false to stop early.
using BenchProgress = std::function<bool(double fraction, const std::string& what)>;

struct Benchmark {
  std::string name;
  std::string description;
  bool needs_models;
  BenchReport (*run)(const BenchOptions& options, const BenchProgress& progress);
  bool has_plot = false;
};

/// All of them. Deterministic for a seed, but for the times.
const std::vector<Benchmark>& benchmarks();

/// The benchmarks, one a file.
BenchReport benchCertified(const BenchOptions& options, const BenchProgress& progress);
BenchReport benchConjunction(const BenchOptions& options, const BenchProgress& progress);
BenchReport benchLadder(const BenchOptions& options, const BenchProgress& progress);
BenchReport benchMixed(const BenchOptions& options, const BenchProgress& progress);
BenchReport benchParts(const BenchOptions& options, const BenchProgress& progress);
BenchReport benchPose(const BenchOptions& options, const BenchProgress& progress);
BenchReport benchPosePairs(const BenchOptions& options, const BenchProgress& progress);
BenchReport benchStability(const BenchOptions& options, const BenchProgress& progress);
BenchReport benchTable1(const BenchOptions& options, const BenchProgress& progress);
#ifdef FCL_PROB_HAS_ROBOT
BenchReport benchRandomStates(const BenchOptions& options, const BenchProgress& progress);
#endif
#ifdef FCL_PROB_HAS_PLANNING
BenchReport benchStates(const BenchOptions& options, const BenchProgress& progress);
BenchReport benchTable2(const BenchOptions& options, const BenchProgress& progress);
#endif

}  // namespace fcl_prob::cli
