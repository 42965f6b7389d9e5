// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include <limits>

#include "catch.h"
#include "fcl_prob/exceptions.h"
#include "fcl_prob/probability_request.h"
#include "fcl_prob/probability_result.h"

using namespace fcl_prob;
using Catch::Matchers::Contains;

namespace {

template <typename Change>
ProbabilityRequest changed(Change change) {
  ProbabilityRequest request;
  change(request);
  return request;
}

template <typename Change>
void checkRefused(const std::string& field, Change change) {
  INFO(field);
  CHECK_THROWS_AS(validateRequest(changed(change)), InvalidRequest);
  CHECK_THROWS_WITH(validateRequest(changed(change)), Contains(field));
}

const double kNan = std::numeric_limits<double>::quiet_NaN();

}  // namespace

TEST_CASE("the default request is valid") { CHECK_NOTHROW(validateRequest({})); }

TEST_CASE("every field is checked and named") {
  checkRefused("relative_tolerance", [](auto& r) { r.relative_tolerance = -0.1; });
  checkRefused("relative_tolerance", [](auto& r) { r.relative_tolerance = kNan; });
  checkRefused("absolute_tolerance",
               [](auto& r) { r.absolute_tolerance = std::numeric_limits<double>::infinity(); });
  checkRefused("both 0", [](auto& r) { r.absolute_tolerance = r.relative_tolerance = 0; });
  checkRefused("threshold is 1.5", [](auto& r) { r.threshold = 1.5; });
  checkRefused("threshold", [](auto& r) { r.threshold = kNan; });
  checkRefused("time_limit", [](auto& r) { r.time_limit = 0; });
  checkRefused("time_limit", [](auto& r) { r.time_limit = kNan; });
  checkRefused("confidence is 1", [](auto& r) { r.confidence = 1; });
  checkRefused("confidence", [](auto& r) { r.confidence = kNan; });
  checkRefused("samples", [](auto& r) { r.samples = 0; });
  checkRefused("threads", [](auto& r) { r.threads = 0; });
  checkRefused("max_cells", [](auto& r) { r.max_cells = 0; });
  checkRefused("max_memory", [](auto& r) { r.max_memory = 0; });
  checkRefused("method", [](auto& r) { r.method = static_cast<ProbabilityMethod>(99); });
  checkRefused("contact", [](auto& r) { r.contact = static_cast<ContactMeaning>(99); });
}

TEST_CASE("method names go both ways") {
  const auto names = methodNames();
  CHECK(names.size() == 9);
  for (const std::string& name : names) {
    const auto method = methodFromString(name);
    REQUIRE(method);
    CHECK(toString(*method) == name);
  }
  CHECK(methodFromString("general-pcd") == ProbabilityMethod::general_pcd);
  CHECK_FALSE(methodFromString("gernal-pcd"));
  CHECK_FALSE(methodFromString(""));
}

TEST_CASE("decisions and statuses have names of their own") {
  CHECK(toString(Decision::below) == "below");
  CHECK(toString(Decision::undecided) == "undecided");
  CHECK(toString(ProbabilityStatus::time_limit) == "time-limit");
  CHECK(toString(ProbabilityStatus::exact) != toString(ProbabilityStatus::converged));
  CHECK_THROWS_AS(toString(static_cast<Decision>(99)), InvalidRequest);
  CHECK_THROWS_AS(toString(static_cast<ProbabilityStatus>(99)), InvalidRequest);
}

TEST_CASE("the single number to use is the best that there is") {
  ProbabilityResult result;
  CHECK(std::isnan(result.probability()));
  result.upper = 0.5;
  CHECK(result.probability() == 0.5);
  result.lower = 0.25;
  CHECK(result.probability() == 0.375);
  result.estimate = 0.3;
  CHECK(result.probability() == 0.3);
}
