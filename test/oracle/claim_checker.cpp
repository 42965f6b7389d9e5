// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "claim_checker.h"

#include <algorithm>
#include <cstdio>

#include <sstream>

#include "cells/claim_observer.h"
#include "claim_region.h"
#include "whitened_frame.h"

namespace oracle {

namespace {

using fcl_prob::detail::Cell;
using fcl_prob::detail::Claim;
using fcl_prob::detail::ClaimObserver;

std::string hexadecimal(double x) {
  char text[40];
  std::snprintf(text, sizeof text, "%a", x);
  return text;
}

std::string hexadecimal(const Eigen::Vector3d& v) {
  return "(" + hexadecimal(v[0]) + ", " + hexadecimal(v[1]) + ", " + hexadecimal(v[2]) + ")";
}

struct FramedClaim {
  Claim claim;
  std::size_t frame;
};

struct Sliver {
  Cell cell;
  Eigen::Vector3d m;
  double from;
  double to;
  std::size_t frame;
};

/// Keeps a fair choice of the claims of each method (Vitter's reservoirs, 1985).
class Recorder : public ClaimObserver {
 public:
  Recorder(std::size_t capacity, Random& random) : capacity_(capacity), random_(random) {
    fcl_prob::detail::claim_observer = this;
  }
  ~Recorder() override { stop(); }
  Recorder(const Recorder&) = delete;
  Recorder& operator=(const Recorder&) = delete;

  void stop() { fcl_prob::detail::claim_observer = nullptr; }

  void frame(const fcl_prob::Whitening& whitening,
             const fcl_prob::GaussianDisplacement& displacement) override {
    frames.emplace_back(whitening, displacement);
  }

  void claim(const Claim& claim) override {
    Reservoir& reservoir = reservoirs[claim.method];
    ++reservoir.made;
    const FramedClaim framed{claim, frames.size() - 1};
    if (reservoir.claims.size() < capacity_) {
      reservoir.claims.push_back(framed);
    } else if (capacity_ > 0) {
      const std::uint64_t place = random_() % reservoir.made;
      if (place < capacity_) reservoir.claims[place] = framed;
    }
  }

  void excuse(const Cell& cell, const Eigen::Vector3d& m, double from, double to) override {
    slivers.push_back({cell, m, from, to, frames.size() - 1});
  }

  bool isExcused(const Eigen::Vector3d& y, std::size_t frame) const {
    return std::any_of(slivers.begin(), slivers.end(), [&](const Sliver& sliver) {
      if (sliver.frame != frame) return false;
      for (int k = 0; k < sliver.cell.rank; ++k) {
        if (y[k] < sliver.cell.lo[k] || y[k] > sliver.cell.hi[k]) return false;
      }
      constexpr double kRounding = 1e-14;
      const double height = sliver.m.dot(y);
      return height >= sliver.from - kRounding && height <= sliver.to + kRounding;
    });
  }

  struct Reservoir {
    std::uint64_t made = 0;
    std::vector<FramedClaim> claims;
  };
  std::map<std::string, Reservoir> reservoirs;
  std::vector<WhitenedFrame> frames;
  std::vector<Sliver> slivers;

 private:
  std::size_t capacity_;
  Random& random_;
};

std::string describe(const Claim& claim, const Eigen::Vector3d& y, const WhitenedFrame& frame) {
  std::ostringstream text;
  text.precision(17);
  const Eigen::Vector3d displacement = frame.rounded(y);
  text << claim.method << (claim.collides ? ": contact" : ": no contact")
       << " claimed at y = " << y.transpose() << " = " << hexadecimal(y) << "\n  displacement "
       << displacement.transpose() << " = " << hexadecimal(displacement) << "\n  cell "
       << claim.cell.lo.transpose() << " .. " << claim.cell.hi.transpose() << " = "
       << hexadecimal(claim.cell.lo) << " .. " << hexadecimal(claim.cell.hi);
  for (int i = 0; i < claim.within.count; ++i) {
    const auto& plane = claim.within.planes[static_cast<std::size_t>(i)];
    text << "\n  m·y >= s: " << plane.m.transpose() << ", " << plane.s << " = "
         << hexadecimal(plane.m) << ", " << hexadecimal(plane.s);
  }
  return text.str();
}

/// Checks the claims of one query.
class Checker {
 public:
  Checker(const Scene& scene, const Recorder& recorder, const ClaimBudget& budget, Random& random,
          ClaimReport& report)
      : scene_(scene), recorder_(recorder), budget_(budget), random_(random), report_(report) {}

  void check(const FramedClaim& framed, ClaimCount& count) {
    const WhitenedFrame& frame = recorder_.frames[framed.frame];
    const Claim& claim = framed.claim;
    const ClaimRegion region(claim.cell, claim.within, frame.rank());
    bool any = false;
    const int points = claim.cell.lo == claim.cell.hi ? 1 : budget_.points;
    for (int i = 0; i < points; ++i) {
      // Corners as often as edges and faces; now and then anywhere.
      const int hits = 3 - static_cast<int>(random_() % 4);
      const auto y = region.point(hits, random_);
      if (!y) continue;
      any = true;
      ++count.points;
      const Verdict verdict = scene_.touches(frame.displacement(*y));
      if (verdict == Verdict::undecided) ++count.undecided;
      if (verdict == (claim.collides ? Verdict::apart : Verdict::touching)) {
        note(framed, *y, count);
      }
    }
    count.checked += any ? 1 : 0;
  }

 private:
  void note(const FramedClaim& framed, const Eigen::Vector3d& y, ClaimCount& count) {
    const Claim& claim = framed.claim;
    if (!claim.collides && recorder_.isExcused(y, framed.frame)) {
      ++count.excused;
      return;
    }
    ++count.violated;
    if (report_.violations.size() >= budget_.kept) return;
    const WhitenedFrame& frame = recorder_.frames[framed.frame];
    report_.violations.push_back(
        {claim.method, claim.collides, y, frame.rounded(y), describe(claim, y, frame)});
  }

  const Scene& scene_;
  const Recorder& recorder_;
  const ClaimBudget& budget_;
  Random& random_;
  ClaimReport& report_;
};

}  // namespace

ClaimCount ClaimReport::total() const {
  ClaimCount sum;
  for (const auto& [unused, count] : by_method) {
    sum.made += count.made;
    sum.checked += count.checked;
    sum.points += count.points;
    sum.undecided += count.undecided;
    sum.excused += count.excused;
    sum.violated += count.violated;
  }
  return sum;
}

ClaimReport& ClaimReport::operator+=(const ClaimReport& other) {
  for (const auto& [method, count] : other.by_method) {
    ClaimCount& sum = by_method[method];
    sum.made += count.made;
    sum.checked += count.checked;
    sum.points += count.points;
    sum.undecided += count.undecided;
    sum.excused += count.excused;
    sum.violated += count.violated;
  }
  violations.insert(violations.end(), other.violations.begin(), other.violations.end());
  return *this;
}

std::string ClaimReport::table() const {
  std::ostringstream text;
  for (const auto& [method, count] : by_method) {
    text << method << ": " << count.made << " claims, " << count.checked << " checked at "
         << count.points << " points, " << count.undecided << " undecided, " << count.excused
         << " excused, " << count.violated << " violated\n";
  }
  return text.str();
}

ClaimReport checkClaims(const Scene& scene, const std::function<void()>& query,
                        const ClaimBudget& budget, std::uint64_t seed) {
  Random random(seed);
  // What is rare gets more than its share.
  Recorder recorder(budget.claims, random);
  query();
  recorder.stop();
  ClaimReport report;
  std::size_t methods = recorder.reservoirs.size();
  std::size_t left = budget.claims;
  Checker checker(scene, recorder, budget, random, report);
  std::vector<std::pair<std::size_t, std::string>> order;
  for (const auto& [method, reservoir] : recorder.reservoirs) {
    order.emplace_back(reservoir.claims.size(), method);
  }
  std::sort(order.begin(), order.end());
  for (const auto& [unused, method] : order) {
    Recorder::Reservoir& reservoir = recorder.reservoirs[method];
    ClaimCount& count = report.by_method[method];
    count.made = reservoir.made;
    std::shuffle(reservoir.claims.begin(), reservoir.claims.end(), random);
    const std::size_t share = std::min(left / methods--, reservoir.claims.size());
    for (std::size_t i = 0; i < share; ++i) checker.check(reservoir.claims[i], count);
    left -= share;
  }
  return report;
}

ClaimReport checkClaims(const Placed& a, const Placed& b,
                        const fcl_prob::GaussianDisplacement& displacement,
                        const fcl_prob::ProbabilityRequest& request, const ClaimBudget& budget,
                        std::uint64_t seed, fcl_prob::ProbabilityResult* result) {
  const bool solid = request.contact == fcl_prob::ContactMeaning::solid;
  const Scene scene(a, b, solid ? Contact::solid : Contact::surface);
  fcl_prob::ProbabilityResult answer;
  const auto query = [&] {
    fcl_prob::collisionProbability(a.geometry, a.pose, b.geometry, b.pose, displacement, request,
                                   answer);
  };
  ClaimReport report = checkClaims(scene, query, budget, seed);
  if (result) *result = std::move(answer);
  return report;
}

}  // namespace oracle
