// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// fcl_prob bench table1: the paper's Table I with all of its rows, and what it compares with.

#include "bench/bench_scenes.h"
#include "bench/benchmark.h"
#include "bench/published_table.h"
#include "bench/table1_rows.h"
#include "cli/json_values.h"
#include "cli/number_text.h"

namespace fcl_prob::cli {
namespace {

constexpr double kFineTolerance = 1e-3;

constexpr const char* kTable1Notes =
    R"(`P or bound` is clipped at 1; `raw sum` is what the method adds up before that; `error` is that
over the certified P, less 1. δ = 0.99, one thread, trees are built beforehand. The interval of
0.1 % is the reference of all rows of its scene.

**What stands at the leaves decides.** GeneralPCD adds up the bounds of pairs of nodes as if they
collided one at a time, so the sum counts every pair that collides: it is about the mean number of
colliding pairs. The paper decomposes its models into convex parts and builds the hierarchies over
them: a few large parts collide in one to a few pairs (rows `parts`). FCL's trees, as they come, have
triangles at the leaves; meshes that touch do so in tens or hundreds of pairs of triangles, and the
sum says nothing (rows `triangles`). More parts fit the mesh better and are counted more often, so
that the sum is least for few parts, while the union of the parts is nearest to the mesh for many.
min(parent, sum) at every node keeps the bound below the root's.

**`parts-bounds`** takes what is counted twice off again: Hunter's bound, the sum of the masses of
all pairs less the masses of their intersections along a spanning tree, all of them certified. The
remark has Bonferroni's bound from below on the probability that the *parts* touch: what is between
the two and P is what the parts exceed the mesh by.

**BVE**, the bounding volume approximation error, is the volume of the bounding volumes of the first
mesh over the volume that the closed mesh encloses: `BVE` of the root, `BVE leaves` of all leaves of
a tree over parts added up (the paper's column; parts that overlap count twice), `BVE level 6` of the
(up to) 64 nodes at depth 6 of a tree over triangles, below 1 where the nodes no longer fill the
inside. `BVE / hull` is that of the root over the volume of the mesh's convex hull.

**Published** columns are the paper's: other poses of its models, so other probabilities, and another
machine. Beside them is `published CP / P`, their bound over their Monte Carlo result, to be compared
with `raw sum / P`.

The AABBs of `aabb, random frames` are those of the scene in a world turned at random: BVE is the
mean over 10,000 turns as in the paper, the bounds are means over as many as the remark says.
`du-toit-burdick` (density at the middle times volume) is no bound: it can be on either side of P.
`park` (largest density times volume) is one; both are for spheres, once around the whole objects
and once for the pairs of nodes of two trees of spheres. `enlargement` tests A, swept by the ellipsoid
that holds the displacement with 95 %, against B: if it is free, P is at most 5 %, else nothing is
known.

The paper's order by BVE (spheres, AABBs, OBBs, 26-DOPs, convex hulls) holds on all three models for its
AABBs, which are those of random frames. The AABBs of the models as they stand are smaller: FCL fits OBBs
to the covariance of the triangles, which is not the smallest box.
)";

std::string textOf(const std::optional<double>& value) {
  return value ? numberText(*value, 4) : "";
}

class Table1 {
 public:
  Table1() {
    report_.title = "Table I of the paper, with all of its rows";
    report_.table = TextTable({"scene",
                               "method",
                               "kind",
                               "BVE",
                               "BVE / hull",
                               "BVE level 6",
                               "BVE leaves",
                               "P or bound",
                               "raw sum",
                               "min(parent, sum)",
                               "error",
                               "error of min",
                               "raw sum / P",
                               "time / ms",
                               "time of min / ms",
                               "remark",
                               "published BVE",
                               "published CP / %",
                               "published CP / P",
                               "published time / ms"});
  }

  void add(const std::string& scene, const Table1Row& row, const Bounds& reference) {
    const double p = reference.middle();
    const auto error = [p](const std::optional<double>& value) -> std::optional<double> {
      return value ? std::optional<double>(*value / p - 1.0) : std::nullopt;
    };
    const std::optional<PublishedRow> published = publishedRow(row.published_as, scene);
    const auto printed = [&](double PublishedRow::*field) -> std::optional<double> {
      return published ? std::optional<double>((*published).*field) : std::nullopt;
    };
    const auto bve = printed(&PublishedRow::bounding_volume_error);
    const auto cp = printed(&PublishedRow::probability_percent);
    const std::optional<PublishedRow> sampled = publishedRow("monte-carlo", scene);
    const std::optional<double> ratio =
        cp && sampled ? std::optional(*cp / sampled->probability_percent) : std::nullopt;
    const auto time = printed(&PublishedRow::time_ms);
    report_.table.add({scene,
                       row.method,
                       toString(row.kind),
                       textOf(row.root_error),
                       textOf(row.hull_error),
                       textOf(row.level_error),
                       textOf(row.leaf_error),
                       textOf(row.value),
                       textOf(row.raw_sum),
                       textOf(row.minimum),
                       textOf(error(row.value)),
                       textOf(error(row.minimum)),
                       textOf(row.raw_sum ? std::optional(*row.raw_sum / p) : std::nullopt),
                       textOf(row.time_ms),
                       textOf(row.minimum_time_ms),
                       row.remark,
                       textOf(bve),
                       textOf(cp),
                       textOf(ratio),
                       time ? numberText(*time, 6) : ""});
    report_.records.push_back({{"scene", scene},
                               {"method", row.method},
                               {"kind", toString(row.kind)},
                               {"reference_lower", reference.lower},
                               {"reference_upper", reference.upper},
                               {"bve", orNull(row.root_error)},
                               {"bve_over_hull", orNull(row.hull_error)},
                               {"bve_level_6", orNull(row.level_error)},
                               {"bve_leaves", orNull(row.leaf_error)},
                               {"value", orNull(row.value)},
                               {"raw_sum", orNull(row.raw_sum)},
                               {"minimum", orNull(row.minimum)},
                               {"relative_error", orNull(error(row.value))},
                               {"relative_error_of_minimum", orNull(error(row.minimum))},
                               {"time_ms", orNull(row.time_ms)},
                               {"minimum_time_ms", orNull(row.minimum_time_ms)},
                               {"remark", row.remark},
                               {"published_bve", orNull(bve)},
                               {"published_cp_percent", orNull(cp)},
                               {"published_cp_over_p", orNull(ratio)},
                               {"published_time_ms", orNull(time)}});
  }

  BenchReport take() {
    report_.notes = kTable1Notes;
    return std::move(report_);
  }

 private:
  BenchReport report_;
};

Bounds certifiedReference(const PreparedScene& scene) {
  ProbabilityRequest request;
  request.method = ProbabilityMethod::interval;
  request.relative_tolerance = kFineTolerance;
  request.absolute_tolerance = 0.0;
  const ProbabilityResult result = scene.query(request).result;
  return {result.lower.value(), result.upper.value()};
}

/// Adds the rows of one scene; `proceed` is told what comes next and may end it.
void addScene(const BenchScene& scene, const BenchOptions& options, Table1& table,
              const std::function<bool(const std::string&)>& proceed) {
  const PreparedScene prepared = prepareBenchScene(scene, options.models_folder, "obbrss");
  const Bounds reference = certifiedReference(prepared);
  const Table1Scene rows(prepared);
  const auto add = [&](const Table1Row& row) { table.add(scene.name, row, reference); };
  add(rows.monteCarloRow(options.seed));
  for (const std::string& volume : volumesOfTable1()) {
    if (!proceed(volume)) return;
    add(rows.volumeRow(volume));
  }
  if (!proceed("aabb in random frames")) return;
  add(rows.frameRow(options.frames, options.seed));
  if (!proceed("convex parts")) return;
  for (const Table1Row& row : rows.partsRows()) add(row);
  if (!proceed("prior methods")) return;
  for (const Table1Row& row : rows.priorRows()) add(row);
  for (const double tolerance : {0.01, kFineTolerance}) add(rows.intervalRow(tolerance));
  add(rows.estimateRow(0.003, options.seed));
}

}  // namespace

BenchReport benchTable1(const BenchOptions& options, const BenchProgress& progress) {
  Table1 table;
  const double steps = static_cast<double>(volumesOfTable1().size() + 3);
  const double count = static_cast<double>(benchScenes().size());
  double done = 0.0;
  bool stopped = false;
  for (const BenchScene& scene : benchScenes()) {
    if (scene.name.find(options.only) == std::string::npos) continue;
    double steps_done = 0.0;
    addScene(scene, options, table, [&](const std::string& row) {
      stopped = !progress((done + steps_done / steps) / count, scene.name + " " + row);
      steps_done += 1.0;
      return !stopped;
    });
    done += 1.0;
    if (stopped) break;
  }
  return table.take();
}

}  // namespace fcl_prob::cli
