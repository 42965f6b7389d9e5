// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "lines/line_bets.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "base/known.h"
#include "base/random_words.h"
#include "lines/column_draw.h"

namespace fcl_prob::detail {
namespace {

// Samples of one batch. Each is of two lines that are mirrored at the middle of a column, so that
// what is linear across it counts for nothing.
constexpr std::size_t kBatch = 32;

// Samples that are drawn for an end at most, and for every column before columns are divided
// instead. Measured on links beside an arm.
constexpr std::size_t kFirstBetColumns = 32;
constexpr double kFirstSamples = 64.0;
constexpr double kMostSamples = 2500.0;
constexpr double kSamplesOfColumn = 3.0;
constexpr std::size_t kMostBetColumns = 512;

// A column may differ from what it is known for by this share of it, if its bounds leave that.
constexpr double kMayDiffer = 0.2;

// The deviation of samples before any are drawn, as a share of the most they may be off.
constexpr double kDeviation = 0.1;

// What may be left out of a line, and what its mass is rounded by, with much to spare.
constexpr LeftOut kLeftOut{1e-5, 1e-8};
constexpr double kDoubt = 4e-8;

// Of sums of masses.
constexpr double kRoundedBets = 1e-9;

double moreThan(double mass) { return mass * (1.0 + 2.0 * kLeftOut.share) + kDoubt; }

double lessThan(double mass) { return std::max(0.0, mass - kDoubt); }

}  // namespace

double LineBets::Source::meanOf(int column) {
  Drawn& known = drawn[column];
  if (known.count == 0.0) known = {looks.massInMiddle(column), 1.0};
  return known.sum / known.count;
}

std::unique_ptr<LineBets> LineBets::of(const PartitionObject& a, const PartitionObject& b,
                                       const GaussianDisplacement& displacement,
                                       const ProbabilityRequest& request, double error) {
  if (!wholeBodyOf(a, b, displacement)) return nullptr;
  std::unique_ptr<LineBets> made(new LineBets(
      std::make_unique<const QueryScene>(a, b, displacement, request), request, error));
  LineBets& bets = *made;
  bets.lines_ = WholeBodyLines::of(*bets.scene_);
  if (!bets.lines_) return nullptr;
  bets.below_.source = std::make_shared<Source>(*bets.lines_, Taken::hulls);
  bets.look(bets.below_, false);
  return made;
}

LineBets::LineBets(std::unique_ptr<const QueryScene> scene, const ProbabilityRequest& request,
                   double error)
    : error_(error),
      seed_(request.seed),
      most_columns_(std::min(kMostBetColumns, request.max_cells)),
      scene_(std::move(scene)) {}

// The lower end is of other lines where members are only nearly convex.
LineBets::End& LineBets::endFor(bool above) {
  if (!above) return below_;
  if (above_.source) return above_;
  above_.source =
      lines_->isConvex() ? below_.source : std::make_shared<Source>(*lines_, Taken::cores);
  return above_;
}

bool LineBets::improve(bool above, double target) {
  End& end = endFor(above);
  Source& source = *end.source;
  const std::size_t columns = source.looks.columns().inOrder().size();
  if (columns > end.looked_at) {
    look(end, above);
    return true;
  }
  const Odds odds = oddsOf(source, above);
  const double sign = above ? -1.0 : 1.0;
  const double most = sign * odds.known + odds.all();
  if (!(odds.all() > 0.0)) return false;
  if (!end.bets) end.bets.emplace(sign * odds.known, kDeviation * odds.all());
  const double needed = end.bets->samplesToTell(sign * target, most, 0.5 * error_);
  likely_ = sign * end.bets->mean();
  const bool is_known = end.bets->samplesOfKind() >= kFirstSamples;
  const bool is_cheap = needed < kSamplesOfColumn * static_cast<double>(columns);
  const bool may_be_divided = !is_cheap && (is_known || columns < kFirstBetColumns);
  if (may_be_divided && 2 * columns <= most_columns_ && source.looks.divideTo(2 * columns)) {
    look(end, above);
    end.bets->changeKind();
    return true;
  }
  if (is_known && !(needed < kMostSamples)) return false;
  draw(end, odds, above, target);
  return true;
}

// What is certain.
void LineBets::look(End& end, bool above) {
  ColumnLooks& looks = end.source->looks;
  const std::size_t before = end.looked_at;
  end.looked_at = looks.columns().inOrder().size();
  columns_ += end.looked_at - before;
  if (!end.bets) likely_ = looks.likely();
  const Bounds bounds = looks.look(above);
  certified_ = agreed(certified_, bounds);
  narrow(certified_);
}

LineBets::Odds LineBets::oddsOf(Source& source, bool above) const {
  Odds odds;
  const LineColumns& columns = source.looks.columns();
  for (const int column : columns.inOrder()) {
    const LineColumns::Node& node = columns[column];
    const double mean = std::min(source.meanOf(column), node.most);
    const double off = above ? mean : std::max(node.most - mean, kMayDiffer * node.most);
    odds.known += node.measure * mean;
    odds.so_far.push_back(odds.all() + node.measure * off);
  }
  return odds;
}

double LineBets::massOn(const Source& source, const LineColumns::Node& node,
                        const Eigen::Vector2d& uniform) {
  ++drawn_lines_;
  return lines_->massOn(pointOf(node.column, uniform), node.met, kLeftOut, source.taken);
}

// A column is known for what it was at the beginning of the batch.
void LineBets::draw(End& end, const Odds& odds, bool above, double target) {
  Source& source = *end.source;
  const LineColumns& columns = source.looks.columns();
  const double sign = above ? -1.0 : 1.0;
  const double most = (sign * odds.known + odds.all()) + kRoundedBets * (odds.known + odds.all());
  const double stake = end.bets->stakeFor(sign * target, most);
  struct Drawn {
    std::size_t at;
    Eigen::Vector2d uniform;
  };
  std::array<Drawn, kBatch> drawn;
  for (Drawn& one : drawn) {
    const auto words = randomWords({seed_, 0x62657473}, drawn_++);
    const auto at = std::upper_bound(odds.so_far.begin(), odds.so_far.end(),
                                     unitUniform(words[0]) * odds.all());
    const auto index = static_cast<std::size_t>(at - odds.so_far.begin());
    one = {std::min(index, odds.so_far.size() - 1), {unitUniform(words[1]), unitUniform(words[2])}};
  }
  std::stable_sort(drawn.begin(), drawn.end(),
                   [](const Drawn& x, const Drawn& y) { return x.at < y.at; });
  std::vector<std::pair<int, double>> found;
  for (const Drawn& one : drawn) {
    const int column = columns.inOrder()[one.at];
    const LineColumns::Node& node = columns[column];
    const double weight = odds.so_far[one.at] - (one.at > 0 ? odds.so_far[one.at - 1] : 0.0);
    const double mass = 0.5 * (massOn(source, node, one.uniform) +
                               massOn(source, node, Eigen::Vector2d::Ones() - one.uniform));
    const double mean = std::min(source.meanOf(column), node.most);
    const double bounded = above ? lessThan(mass) : std::min(moreThan(mass), node.most);
    const double x = odds.known + node.measure * (bounded - mean) * (odds.all() / weight);
    end.bets->add(std::min(sign * x, most), most, stake);
    found.emplace_back(column, mass);
  }
  for (const auto& [column, mass] : found) {
    source.drawn[column].sum += mass;
    source.drawn[column].count += 1.0;
  }
  const double bound = sign * end.bets->upper(0.5 * error_, most);
  likely_ = sign * end.bets->mean();
  if (above) {
    narrow({bound * (1.0 - kRoundedBets), 1.0});
  } else {
    narrow({0.0, bound * (1.0 + kRoundedBets)});
  }
}

// Where nothing is left a bet was lost: only what is certain is then kept.
void LineBets::narrow(const Bounds& bounds) {
  probable_ = {std::max(probable_.lower, bounds.lower), std::min(probable_.upper, bounds.upper)};
  if (probable_.lower > probable_.upper) probable_ = certified_;
}

}  // namespace fcl_prob::detail
