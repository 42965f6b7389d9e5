// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Some seconds of the audit, and that its scenes are what they are meant to be.
#include "audit_run.h"
#include "catch.h"
#include "families.h"
#include "scene_generator.h"

using namespace fcl_prob_audit;

TEST_CASE("a scene is given by its seed, index and family") {
  for (std::uint64_t index = 0; index < 200; ++index) {
    const Scene scene = generate(3, index);
    REQUIRE(textOf(scene) == textOf(generate(3, index)));
    REQUIRE(textOf(scene) != textOf(generate(4, index)));
  }
}

TEST_CASE("the scenes of the audit are of all sorts, with all sorts of P") {
  AuditPlan plan;
  plan.seed = 12;
  plan.scenes = 500;
  AuditReport report = runAudit(plan);
  INFO(textOf(report));
  CHECK(report.tally.families.size() == families().size());
  FamilyTally sum;
  for (const auto& [name, family] : report.tally.families) {
    INFO(name);
    CHECK(family.answered > family.scenes / 3);
    sum.non_trivial += family.non_trivial;
    sum.exact_truths += family.exact_truths;
    sum.sampled_truths += family.sampled_truths;
  }
  CHECK(sum.non_trivial > 100);
  CHECK(sum.exact_truths > 75);
  CHECK(sum.sampled_truths > 50);
  for (int rank = 0; rank <= 3; ++rank) CHECK(report.tally.ranks[rank] >= 10);
  CHECK(report.tally.kinds.size() == kKinds);
  CHECK(report.tally.solids > 50);
  CHECK(report.tally.decades.size() > 10);
}
