// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "query/partition.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <string>

#include "base/ladder.h"
#include "base/number_text.h"
#include "cells/carved_partition.h"
#include "cells/cell_estimate.h"
#include "cells/claim_observer.h"
#include "cells/partition_engine.h"
#include "cells/without_contact.h"
#include "geometry/validation.h"
#include "lines/column_bounds.h"
#include "lines/line_estimate.h"

namespace fcl_prob::detail {
namespace {

constexpr const char* kNoGradient =
    "no gradient: what the mean changes where A does not move is no moment of the section";

// By how many deviations rounding may move the ends of lines, of the relative tolerance: no part of
// their errors.
constexpr double kMostRoundingOfLines = 0.03;

/// One scene, one question. The rungs are in the order of kLadder, and know nothing of each other
/// but what is certain by then.
class PartitionQuery {
 public:
  PartitionQuery(const PartitionObject& a, const PartitionObject& b,
                 const GaussianDisplacement& displacement, const ProbabilityRequest& request,
                 const BallTruncation* ball)
      : given_(displacement),
        request_(request),
        ball_(ball),
        budget_(request),
        known_(request),
        scene_(a, b, displacement, request, ball != nullptr),
        why_no_polytopes_(whyNoPolytopes()) {
    result_.method = isEstimate() ? ProbabilityMethod::estimate : ProbabilityMethod::interval;
    result_.statistics.rungs.push_back(
        {"whitening", budget_.seconds(), known_.interval(), 1, 0, noteOnFrame()});
    announceFrame();
  }

  ProbabilityResult answer();

 private:
  bool isEstimate() const { return request_.method == ProbabilityMethod::estimate; }
  bool isDecision() const { return request_.threshold.has_value(); }

  static bool needsAllClaims() { return claim_observer && claim_observer->needsAll(); }

  void announceFrame() const {
    if (claim_observer) claim_observer->frame(scene_.whitening(), given_);
  }

  std::string noteOnFrame() const;

  const char* whyNoPolytopes() const;
  Climbed dividePolytopes();

  // A mean over lines, where nothing but P is asked for and an object can be taken whole.
  const char* whyNoLines() const;
  Climbed estimateByLines();

  // Bounds on columns of lines, where an object can be taken whole.
  Climbed boundColumns();

  Climbed divideBoxes();
  Climbed sampleBoxes();

  PartitionEngine& engine();
  std::unique_ptr<PointTester> makeTester();
  std::string noteOnBoxes() const;

  static const std::vector<Rung<PartitionQuery>> kLadder;

  const GaussianDisplacement& given_;
  const ProbabilityRequest& request_;
  const BallTruncation* ball_;
  Budget budget_;
  Known known_;
  QueryScene scene_;
  const char* const why_no_polytopes_;
  std::optional<PartitionEngine> engine_;
  ProbabilityResult result_;
};

const std::vector<Rung<PartitionQuery>> PartitionQuery::kLadder{
    {"lines", [](const PartitionQuery& q) { return q.whyNoLines(); },
     &PartitionQuery::estimateByLines},
    {"columns", [](const PartitionQuery& q) { return q.isDecision() ? q.why_no_polytopes_ : ""; },
     &PartitionQuery::boundColumns},
    {"polytope cells", [](const PartitionQuery& q) { return q.why_no_polytopes_; },
     &PartitionQuery::dividePolytopes},
    {"boxes", nullptr, &PartitionQuery::divideBoxes, true},
    {"samples of boxes", [](const PartitionQuery& q) { return unless(q.isEstimate()); },
     &PartitionQuery::sampleBoxes, true},
};

ProbabilityResult PartitionQuery::answer() {
  climb(kLadder, *this, known_, result_.statistics.rungs);
  known_.tell(result_);
  ProbabilityStatistics& statistics = result_.statistics;
  for (const RungRecord& rung : statistics.rungs) {
    if (rung.times > 0) statistics.seconds.emplace_back(rung.name, rung.seconds);
  }
  result_.plan = planOf(statistics.rungs);
  return std::move(result_);
}

std::string PartitionQuery::noteOnFrame() const {
  const int rank = scene_.rank(), of_covariance = given_.rank();
  std::vector<std::string> notes;
  if (rank < of_covariance) {
    notes.push_back("deviations below what positions are rounded by, " +
                    std::to_string(of_covariance - rank) +
                    " axes left out of the cells, their reach added to the rounding");
  }
  if (of_covariance < 3) {
    notes.push_back("covariance of rank " + std::to_string(of_covariance) + ", " +
                    std::to_string(3 - of_covariance) + " axes left out of the cells");
  }
  if (request_.gradient && rank < 3) notes.emplace_back(kNoGradient);
  return noteOf(notes);
}

const char* PartitionQuery::whyNoPolytopes() const {
  if (ball_) return "cells along planes do not end at an ellipsoid";
  if (needsAllClaims()) return "claims of boxes are what is asked for";
  return whyNotCarved(scene_, request_);
}

Climbed PartitionQuery::dividePolytopes() {
  const ProbabilityMethod method = result_.method;
  Climbed climbed = carve(scene_, request_, budget_, result_);
  known_.narrow(result_);
  if (climbed.answered) return climbed;
  // What was claimed so far is over.
  result_.method = method;
  announceFrame();
  return climbed;
}

const char* PartitionQuery::whyNoLines() const {
  if (!isEstimate()) return "";
  if (ball_) return "lines do not end at an ellipsoid";
  if (request_.gradient || isDecision()) return "lines have neither gradients nor decisions";
  return scene_.wholeBody() ? nullptr : kNoWholeBody;
}

Climbed PartitionQuery::estimateByLines() {
  const auto lines = WholeBodyLines::of(scene_);
  if (!lines || !lines->isConvex()) return {false, "masses on lines are between bounds only"};
  if (lines->rounding() > kMostRoundingOfLines * request_.relative_tolerance) {
    return {false, "ends of lines are rounded by more than the tolerance allows"};
  }
  const auto estimate = lineEstimate(*lines, request_, budget_);
  if (!estimate) return {false, "too little of P was met by lines"};
  result_.status = estimate->status;
  result_.estimate = estimate->value;
  result_.standard_error = estimate->standard_error;
  known_.narrow({0.0, estimate->upper});
  result_.statistics.cells = estimate->columns;
  result_.statistics.samples = estimate->lines;
  return {true, "mean over " + std::to_string(estimate->lines) + " parallel lines in " +
                    std::to_string(estimate->columns) +
                    " columns, against convex meshes taken whole; cells left out"};
}

Climbed PartitionQuery::boundColumns() {
  const auto lines = WholeBodyLines::of(scene_);
  if (!lines) return {false, "one surface may be within the convex object and not touch it"};
  const double threshold = *request_.threshold;
  const ColumnBounds columns = columnBounds(*lines, threshold, request_.max_cells);
  known_.narrow(columns.bounds);
  const std::string bounds = "bounds on " + std::to_string(columns.columns) + " columns";
  if (!isDecided(known_.decision())) return {false, bounds + " decide nothing"};
  result_.status = ProbabilityStatus::decided;
  result_.statistics.cells = columns.columns;
  return {true, "decided by " + bounds + ", against convex meshes taken whole; cells left out"};
}

PartitionEngine& PartitionQuery::engine() {
  if (!engine_) {
    const PartitionScene boxes{scene_.pair(),
                               scene_.rank(),
                               scene_.solids(),
                               ball_,
                               request_.gradient,
                               isEstimate(),
                               request_.relative_tolerance};
    engine_.emplace(boxes, request_, budget_, result_.statistics);
  }
  return *engine_;
}

std::unique_ptr<PointTester> PartitionQuery::makeTester() {
  return std::make_unique<PointTester>(scene_.pair(), engine().obstacles(), scene_.solids());
}

Climbed PartitionQuery::divideBoxes() {
  result_.status = engine().run(isEstimate());
  known_.narrow(engine().interval());
  if (!isEstimate() && request_.gradient && scene_.rank() == 3) {
    fillGradient(scene_.whitening(), engine().moment(), result_);
  }
  return {!isEstimate(), noteOnBoxes()};
}

Climbed PartitionQuery::sampleBoxes() {
  if (request_.threads > 1) engine().obstacles().share();
  CellSampler sampler(
      makeTester(), [this] { return makeTester(); }, request_.seed,
      claim_observer ? 1 : request_.threads);
  const SampledMass sampled =
      sampleOpenCells(engine(), sampler, result_.statistics, result_.status);
  known_.narrow(engine().interval());
  const bool with_gradient = request_.gradient && scene_.rank() == 3;
  if (with_gradient) fillGradient(scene_.whitening(), engine().moment(), result_);
  fillEstimate(scene_.whitening(), engine(), sampled, with_gradient, result_);
  return {true, std::to_string(result_.statistics.samples) + " displacements in open cells"};
}

std::string PartitionQuery::noteOnBoxes() const {
  std::vector<std::string> notes{
      "partition of the displacement space into " + std::to_string(result_.statistics.cells) +
      " cells, " + std::to_string(result_.statistics.leaf_pairs) + " pairs of pieces refined"};
  if (request_.hasBand()) {
    notes.push_back(
        "holds for all shapes within bands of " +
        numberText(request_.band_a.outward + request_.band_b.outward) + " m outwards and " +
        numberText(request_.band_a.inward + request_.band_b.inward) + " m inwards, added up");
  }
  if (scene_.solids()) notes.emplace_back("containment decided once for every free cell");
  return noteOf(notes);
}

}  // namespace

ProbabilityResult partitionProbability(const PartitionObject& a, const PartitionObject& b,
                                       const GaussianDisplacement& displacement,
                                       const ProbabilityRequest& request,
                                       const BallTruncation* ball) {
  if (a.tree->isEmpty() || b.tree->isEmpty()) {
    return withoutContact(request, "an octree without occupied cells collides with nothing");
  }
  if (displacement.rank() > 0 && std::max(a.tree->radius(), b.tree->radius()) < kLeastSize) {
    requireMeasurable(a.tree->radius(), b.tree->radius());
  }
  return PartitionQuery(a, b, displacement, request, ball).answer();
}

}  // namespace fcl_prob::detail
