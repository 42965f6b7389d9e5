// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "oracle_check.h"

#include <random>

#include "oracle/oracle.h"
// The audit can be built on versions of the library that do not hand out what they claim.
#if __has_include("cells/claim_observer.h")
#include "oracle/claim_checker.h"
#define FCL_PROB_AUDIT_CLAIMS 1
#endif

namespace fcl_prob_audit {
namespace {

/// A scene as the oracle takes it, with geometries of its own.
class OracleScene {
 public:
  explicit OracleScene(const Scene& scene) {
    const bool solid = scene.request.contact == fcl_prob::ContactMeaning::solid;
    try {
      const std::vector<oracle::Placed> a = placed(scene.a), b = placed(scene.b);
      scene_.emplace(a, b, solid ? oracle::Contact::solid : oracle::Contact::surface);
    } catch (const std::invalid_argument&) {
      // An open mesh as a solid: the library refuses it, too.
    }
  }

  const oracle::Scene* get() const { return scene_ ? &*scene_ : nullptr; }

 private:
  std::vector<oracle::Placed> placed(const std::vector<Member>& members) {
    std::vector<oracle::Placed> result;
    for (const Member& member : members) {
      geometries_.push_back(makeGeometry(member.shape));
      result.push_back({geometries_.back().get(), member.pose});
    }
    return result;
  }

  std::vector<Geometry> geometries_;
  std::optional<oracle::Scene> scene_;
};

#ifdef FCL_PROB_AUDIT_CLAIMS
void count(const oracle::ClaimReport& report, FamilyTally& tally, std::vector<Violation>& found) {
  const oracle::ClaimCount total = report.total();
  tally.claims += total.checked;
  tally.claim_points += total.points;
  tally.undecided += total.undecided;
  for (const oracle::Violation& violation : report.violations) {
    found.push_back({"claim: " + violation.method, violation.text});
  }
}
#endif

}  // namespace

Answer askCheckingClaims(const Scene& scene, const Scene& truth, FamilyTally& tally,
                         std::vector<Violation>& found) {
#ifdef FCL_PROB_AUDIT_CLAIMS
  const OracleScene placed(truth);
  // Where nothing moves, cells are points, and planes may leave nothing of them.
  bool moves = true;
  for (const Displacement& displacement : scene.displacements) {
    moves = moves && makeDisplacement(displacement).rank() > 0;
  }
  if (placed.get() != nullptr && moves) {
    Answer answer;
    constexpr oracle::ClaimBudget kBudget = {300, 1, 1};
    const oracle::ClaimReport report = oracle::checkClaims(
        *placed.get(), [&] { answer = ask(scene); }, kBudget, scene.index);
    count(report, tally, found);
    return answer;
  }
#endif
  (void)truth;
  (void)tally;
  (void)found;
  return ask(scene);
}

std::optional<SampledTruth> hitsOfOracle(const Scene& scene, int samples) {
  const OracleScene placed(scene);
  if (placed.get() == nullptr || scene.truncation) return std::nullopt;
  const TruthQuestion question = truthQuestion(scene);
  std::mt19937_64 engine(scene.index);
  std::normal_distribution<double> normal;
  std::discrete_distribution<std::size_t> component(question.weights.begin(),
                                                    question.weights.end());
  SampledTruth truth;
  for (; truth.lines < samples; ++truth.lines) {
    const Normal& of = question.normals[component(engine)];
    const Vector3d y(normal(engine), normal(engine), normal(engine));
    const Vector3d displacement = of.mean + of.axes * of.sigma.cwiseProduct(y);
    const oracle::Verdict verdict = placed.get()->touches(displacement);
    if (verdict == oracle::Verdict::undecided) return std::nullopt;
    if (verdict == oracle::Verdict::touching) truth.mean += 1.0 / samples;
  }
  truth.mean = std::min(1.0, truth.mean);
  return truth;
}

}  // namespace fcl_prob_audit
