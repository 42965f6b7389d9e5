// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "bench/published_table.h"

#include <array>
#include <map>

namespace fcl_prob::cli {
namespace {

/// One line: the bounding volume error of the three models, then for each distance their
/// probabilities (per cent) and times (ms).
struct PrintedLine {
  const char* row;
  std::array<double, 3> bounding_volume_error;
  std::array<double, 3> percent_1cm;
  std::array<double, 3> time_1cm;
  std::array<double, 3> percent_5cm;
  std::array<double, 3> time_5cm;
};

constexpr std::array<const char*, 3> kModels{"bunny", "dragon", "buddha"};

const std::array<PrintedLine, 6> kTable{{
    {"monte-carlo",
     {1.00, 1.00, 1.00},
     {13.2, 15.7, 6.82},
     {54'300, 213'000, 108'000},
     {2.38, 3.72, 0.89},
     {32'800, 176'000, 92'000}},
    {"sphere",
     {4.80, 6.28, 6.50},
     {45.7, 52.8, 34.9},
     {847, 2'480, 2'070},
     {10.3, 18.1, 10.3},
     {261, 1'580, 1'030}},
    {"aabb",
     {3.28, 5.20, 4.96},
     {32.6, 38.1, 31.7},
     {190, 578, 420},
     {6.21, 11.9, 7.06},
     {67, 213, 126}},
    {"obb",
     {1.63, 3.16, 2.94},
     {20.3, 31.7, 28.8},
     {179, 580, 441},
     {4.20, 6.23, 2.00},
     {86, 278, 158}},
    {"kdop26",
     {1.26, 1.68, 1.88},
     {16.7, 22.3, 12.7},
     {897, 3'320, 2'637},
     {3.57, 2.90, 1.27},
     {326, 1'010, 868}},
    {"convex",
     {1.00, 1.00, 1.00},
     {14.2, 18.9, 8.09},
     {3'721, 10'800, 8'780},
     {2.70, 4.18, 1.12},
     {1'082, 2'520, 2'330}},
}};

}  // namespace

std::optional<PublishedRow> publishedRow(const std::string& row, const std::string& scene) {
  for (const PrintedLine& line : kTable) {
    if (row != line.row) continue;
    for (std::size_t model = 0; model < kModels.size(); ++model) {
      const std::string name = kModels[model];
      const double error = line.bounding_volume_error[model];
      if (scene == name + "_1cm") {
        return PublishedRow{error, line.percent_1cm[model], line.time_1cm[model]};
      }
      if (scene == name + "_5cm") {
        return PublishedRow{error, line.percent_5cm[model], line.time_5cm[model]};
      }
    }
  }
  return std::nullopt;
}

std::optional<PublishedPath> publishedPath(const std::string& row, const std::string& scene) {
  using Column = std::map<std::string, PublishedPath>;
  static const std::map<std::string, Column> columns{{"cans",
                                                      {{"monte-carlo", {1.00, 20'800}},
                                                       {"sphere", {3.81, 3'260}},
                                                       {"aabb", {3.72, 637}},
                                                       {"obb", {2.50, 819}},
                                                       {"kdop26", {2.11, 1'280}},
                                                       {"convex", {1.59, 8'440}}}},
                                                     {"waving",
                                                      {{"monte-carlo", {1.00, 15'200}},
                                                       {"sphere", {4.72, 1'730}},
                                                       {"aabb", {3.26, 425}},
                                                       {"obb", {2.80, 433}},
                                                       {"kdop26", {2.71, 823}},
                                                       {"convex", {1.39, 4'630}}}}};
  const auto column = columns.find(scene);
  if (column == columns.end()) return std::nullopt;
  const auto found = column->second.find(row);
  if (found == column->second.end()) return std::nullopt;
  return found->second;
}

}  // namespace fcl_prob::cli
