// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "checks.h"

#include <cmath>
#include <sstream>

#include "ask.h"
#include "band_check.h"
#include "families.h"
#include "oracle_check.h"
#include "random_shape.h"
#include "relations.h"
#include "slopes.h"
#include "soundness.h"
#include "truth.h"
#include "verify_check.h"

namespace fcl_prob_audit {
namespace {

using namespace fcl_prob;

std::string numberText(double value) {
  std::ostringstream out;
  out.precision(17);
  out << value;
  return out.str();
}

std::string vectorText(const Vector3d& v) {
  return "(" + numberText(v[0]) + ", " + numberText(v[1]) + ", " + numberText(v[2]) + ")";
}

/// One scene, its answer, and what is wrong with it.
class SceneCheck {
 public:
  SceneCheck(const Scene& scene, Tally& tally, const CheckOptions& options)
      : scene_(scene),
        tally_(tally),
        family_(tally.families[scene.family]),
        options_(options),
        random_(static_cast<unsigned>(scene.seed * 1000003 + scene.index)),
        sampled_(chance(random_, 0.4)) {}

  std::vector<Violation> run() {
    answer_ = askCheckingClaims(scene_, scene_, family_, found_);
    checkSound(scene_, answer_, found_);
    count();
    checkDisplacements();
    if (!answer_) return std::move(found_);
    checkTruth();
    checkRelations();
    constexpr std::uint64_t kWithBands = 8;
    const bool chosen = options_.everything || scene_.index / families().size() % kWithBands == 0;
    if (chosen && mayFind("bands")) checkBands(scene_, tally_, found_);
    const bool verified =
        options_.everything || scene_.index / families().size() % options_.verify_every == 0;
    if (verified && !options_.verifier.empty() && mayFind("certificate")) {
      checkByVerifier(scene_, options_.verifier, tally_, found_);
    }
    return std::move(found_);
  }

 private:
  const ProbabilityResult& result() const { return *answer_.result; }
  bool isVanishing() const { return makeDisplacement(scene_.displacements[0]).rank() == 0; }

  void count() {
    family_.seconds += answer_.seconds;
    family_.slowest = std::max(family_.slowest, answer_.seconds);
    constexpr double kLate = 0.2;
    family_.late +=
        scene_.request.time_limit && answer_.seconds > *scene_.request.time_limit + kLate;
    ++tally_.ranks[makeDisplacement(scene_.displacements[0]).rank()];
    tally_.solids += scene_.request.contact == ContactMeaning::solid;
    if (!answer_) {
      ++family_.refused;
      ++tally_.refusals[scene_.family + ": " +
                        (answer_.refusal + answer_.foreign_exception).substr(0, 70)];
      return;
    }
    ++family_.answered;
    const double lower = result().lower.value_or(0.0), upper = result().upper.value_or(1.0);
    family_.non_trivial += lower > 1e-3 && upper < 0.999;
    const double p = std::max(1e-30, result().probability());
    ++tally_.decades[static_cast<int>(std::floor(std::log10(p)))];
  }

  void report(const std::string& check, const std::string& detail) {
    found_.push_back({check, detail + " | " + textOf(result())});
  }

  void checkDisplacements() {
    ++tally_.checks["axes are a rotation"];
    for (const Displacement& displacement : scene_.displacements) {
      const GaussianDisplacement d = makeDisplacement(displacement);
      const double off = (d.axes().transpose() * d.axes() - Matrix3d::Identity()).norm();
      if (off > 1e-13) found_.push_back({"axes are a rotation", "off by " + numberText(off)});
    }
  }

  void checkTruth() {
    // Without motion the answer is that of fcl::collide, by contract.
    if (isVanishing() || !isDisplaced()) return;
    const TruthQuestion question = truthQuestion(scene_);
    if (const auto truth = exactProbability(question)) {
      ++family_.exact_truths;
      ++tally_.checks["exact truth"];
      checkExact(*truth);
      if (result().gradient_lower && result().gradient_upper) checkExactGradient(question);
    } else if (options_.everything || sampled_) {
      checkSampled(question);
    }
  }

  bool isDisplaced() const {
    for (const Displacement& displacement : scene_.displacements) {
      if (makeDisplacement(displacement).rank() == 0) return false;
    }
    return true;
  }

  void checkExact(const Exact& truth) {
    const bool above = result().upper && truth > Exact(*result().upper);
    const bool below = result().lower && truth < Exact(*result().lower);
    if (above || below) {
      report("exact truth",
             numberText(static_cast<double>(truth)) + ", off by " +
                 numberText(static_cast<double>(above ? Exact(truth - Exact(*result().upper))
                                                      : Exact(Exact(*result().lower) - truth))));
    }
    checkEstimate(static_cast<double>(truth));
  }

  void checkEstimate(double truth) {
    if (!result().estimate || !result().standard_error ||
        result().method != ProbabilityMethod::estimate) {
      return;
    }
    ++tally_.estimates;
    const double error = std::abs(*result().estimate - truth);
    // Where nothing is sampled, the rounding margin of the interval is what is left.
    const double deviations = 5.0 * *result().standard_error + 1e-9 * truth;
    tally_.estimates_beyond += error > deviations + 1e-15;
    if (error > 2.0 * deviations + 1e-15) report("estimate beyond 10 s.e.", numberText(truth));
  }

  void checkExactGradient(const TruthQuestion& question) {
    const auto gradient = exactGradient(question);
    if (!gradient) return;
    ++tally_.checks["exact gradient"];
    for (int k = 0; k < 3; ++k) {
      const double slope = gradient->value[k];
      const double slack = 1e-9 * std::abs(slope) + gradient->rounding;
      if (slope < (*result().gradient_lower)[k] - slack ||
          slope > (*result().gradient_upper)[k] + slack) {
        return report("exact gradient", vectorText(gradient->value));
      }
    }
  }

  void checkSampled(const TruthQuestion& question) {
    auto truth = sampledProbability(question, 60, scene_.index);
    // Shapes with curved sides.
    if (!truth) truth = hitsOfOracle(scene_, 60);
    if (!truth) return;
    ++family_.sampled_truths;
    ++tally_.checks["sampled truth"];
    if (truth->excludes(result().lower.value_or(0.0), result().upper.value_or(1.0))) {
      report("sampled truth", numberText(truth->mean));
    }
  }

  void checkRelations() {
    if (scene_.cancel_after || scene_.request.time_limit) return;
    for (const Relation& relation : relations()) {
      const auto choice = static_cast<std::uint64_t>(random_.integer(0, 1 << 20));
      const bool chosen = chance(random_, 0.15);
      if (!(chosen || options_.everything) || !mayFind(relation.name)) continue;
      // fcl::collide is not that consistent.
      if (!isDisplaced() && relation.name != "two threads") continue;
      const std::optional<Scene> derived = relation.derive(scene_, choice);
      if (derived) checkRelation(relation, *derived, choice);
    }
    const bool asked = result().gradient_lower && result().gradient_upper;
    if (asked && !isVanishing() && mayFind("slopes")) {
      ++tally_.checks["slopes"];
      if (const auto detail = slopesOutside(scene_, result())) report("slopes", *detail);
    }
  }

  bool mayFind(const std::string& relation) const {
    return options_.only.empty() || options_.only.find(relation) != std::string::npos;
  }

  void checkRelation(const Relation& relation, const Scene& derived, std::uint64_t choice) {
    const Answer other = ask(derived);
    family_.seconds += other.seconds;
    ++tally_.checks[relation.name];
    std::vector<Violation> of_other;
    checkSound(derived, other, of_other);
    for (Violation& violation : of_other) {
      found_.push_back({relation.name + ", then " + violation.check, violation.detail});
    }
    if (!other) return;
    compare(relation, *other.result, choice);
  }

  void compare(const Relation& relation, const ProbabilityResult& other, std::uint64_t choice) {
    const std::string detail = "other: " + textOf(other);
    if (relation.name == "two threads") {
      const bool same = result().lower == other.lower && result().upper == other.upper &&
                        result().estimate == other.estimate && result().status == other.status;
      if (!same) report(relation.name, detail);
      return;
    }
    using Holds = Relation::Holds;
    const bool too_small = other.upper.value_or(1.0) < result().lower.value_or(0.0);
    const bool too_large = other.lower.value_or(0.0) > result().upper.value_or(1.0);
    if ((too_small && relation.holds != Holds::at_most) ||
        (too_large && relation.holds != Holds::at_least)) {
      report(relation.name, detail);
    }
    if (!relation.gradient || !result().gradient_lower || !other.gradient_lower ||
        !result().gradient_upper || !other.gradient_upper) {
      return;
    }
    // The matrix has one entry a row: bounds stay bounds.
    const Matrix3d map = relation.gradient(choice);
    const Vector3d x = map * *result().gradient_lower, y = map * *result().gradient_upper;
    const Vector3d least = x.cwiseMin(y), most = x.cwiseMax(y);
    if ((other.gradient_lower->array() > most.array()).any() ||
        (other.gradient_upper->array() < least.array()).any()) {
      report("gradient " + relation.name, detail);
    }
  }

  const Scene& scene_;
  Tally& tally_;
  FamilyTally& family_;
  const CheckOptions& options_;
  RandomBodies random_;
  bool sampled_;
  Answer answer_;
  std::vector<Violation> found_;
};

}  // namespace

std::vector<Violation> check(const Scene& scene, Tally& tally, const CheckOptions& options) {
  ++tally.families[scene.family].scenes;
  for (const auto* group : {&scene.a, &scene.b}) {
    for (const Member& member : *group) ++tally.kinds[nameOf(member.shape.kind)];
  }
  std::vector<Violation> found;
  if (scene.question == Question::manager) {
    checkManager(scene, tally, found);
  } else if (scene.question == Question::batch) {
    checkBatch(scene, tally, found);
  } else {
    found = SceneCheck(scene, tally, options).run();
  }
  for (const Violation& violation : found) {
    ++tally.violations[scene.family + ": " + violation.check];
  }
  return found;
}

void Tally::add(const Tally& other) {
  for (const auto& [name, of] : other.families) {
    FamilyTally& sum = families[name];
    sum.scenes += of.scenes;
    sum.answered += of.answered;
    sum.refused += of.refused;
    sum.exact_truths += of.exact_truths;
    sum.sampled_truths += of.sampled_truths;
    sum.claims += of.claims;
    sum.claim_points += of.claim_points;
    sum.undecided += of.undecided;
    sum.non_trivial += of.non_trivial;
    sum.late += of.late;
    sum.seconds += of.seconds;
    sum.slowest = std::max(sum.slowest, of.slowest);
  }
  const auto addCounts = [](auto& to, const auto& from) {
    for (const auto& [name, count] : from) to[name] += count;
  };
  addCounts(checks, other.checks);
  addCounts(violations, other.violations);
  addCounts(refusals, other.refusals);
  addCounts(ranks, other.ranks);
  addCounts(kinds, other.kinds);
  addCounts(decades, other.decades);
  solids += other.solids;
  estimates += other.estimates;
  estimates_beyond += other.estimates_beyond;
}

}  // namespace fcl_prob_audit
