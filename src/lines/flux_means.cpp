// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "lines/flux_means.h"

#include <algorithm>
#include <cmath>

#include "gaussian/bounded_mean.h"
#include "gaussian/normal_density.h"

namespace fcl_prob::detail {
namespace {

// How often a line may touch a convex C-obstacle.
constexpr double kLeastEnds = 2.0;

/// The means of the flux. What a line has is bounded by its ends, whose densities are bounded by
/// how frequent it is: of each part there are as many as a line had at most, or two. Of parts that
/// are convex, beside what is, a line has no more; of others that is what was seen.
class FluxMeans {
 public:
  FluxMeans(const PartLines& drawn, int rank, const std::vector<FluxLine>& lines,
            const PartVelocities& velocities, const std::vector<std::vector<PartSpeed>>& speeds)
      : drawn_(drawn),
        lines_(lines),
        velocities_(velocities),
        speeds_(speeds),
        parameters_(velocities[0].cols()),
        of_all_(static_cast<double>(drawn.countOfAll(lines.size())) /
                static_cast<double>(lines.size())) {
    countEnds();
    setBounds(kCrofton[rank]);
    addLines();
  }

  double mean(Eigen::Index k) const { return means_[static_cast<std::size_t>(k)].mean(count()); }

  /// Where no line tells, what the flux is at most.
  double standardError(Eigen::Index k) const {
    return std::min(means_[static_cast<std::size_t>(k)].standardError(count()),
                    std::fabs(mean(k)) + most_of_mean_[k]);
  }

 private:
  /// A part that a parameter moves, per density where it touches.
  struct MovedPart {
    double flux;       ///< at most, by all ends of a line
    double frequency;  ///< of the line, at least
  };

  double count() const { return static_cast<double>(lines_.size()); }

  void countEnds() {
    ends_of_part_.assign(speeds_.size(), 0.0);
    std::vector<double> of_line(speeds_.size(), 0.0);
    for (const FluxLine& line : lines_) {
      for (const FluxEnd& end : line.ends) {
        of_line[end.part] += 1.0;
        ends_of_part_[end.part] = std::max(ends_of_part_[end.part], of_line[end.part]);
        steepest_ = std::max(steepest_, end.steepness);
      }
      for (const FluxEnd& end : line.ends) of_line[end.part] = 0.0;
    }
  }

  void setBounds(double crofton) {
    most_of_mean_ = Eigen::VectorXd::Zero(parameters_);
    std::vector<std::vector<MovedPart>> moved(static_cast<std::size_t>(parameters_));
    for (std::size_t part = 0; part < speeds_.size(); ++part) {
      const double ends = std::max(kLeastEnds, ends_of_part_[part]);
      const double frequency = drawn_.leastOfPart(part, lines_.size());
      for (const PartSpeed& speed : speeds_[part]) {
        const double flux = crofton * ends * (speed.along + steepest_ * speed.across);
        if (!(flux > 0.0) || std::isinf(frequency)) continue;
        moved[static_cast<std::size_t>(speed.parameter)].push_back({flux, frequency});
        most_of_mean_[speed.parameter] += flux * drawn_.meanOfEnd(part);
      }
    }
    for (std::vector<MovedPart>& parts : moved) {
      const double bound = mostOfLine(parts);
      means_.emplace_back(-bound, bound);
    }
  }

  /// What a line of given frequency has the most of: parts that have most for what they make it
  /// more frequent come first, and more of them as long as that helps.
  double mostOfLine(std::vector<MovedPart>& parts) const {
    std::sort(parts.begin(), parts.end(), [](const MovedPart& one, const MovedPart& other) {
      return one.flux * other.frequency > other.flux * one.frequency;
    });
    double most = 0.0, flux = 0.0, frequency = drawn_.leastOfAll(lines_.size());
    for (const MovedPart& part : parts) {
      flux += part.flux;
      frequency += part.frequency;
      most = std::max(most, flux / frequency);
    }
    return most;
  }

  void addLines() {
    Eigen::VectorXd flux = Eigen::VectorXd::Zero(parameters_);
    for (const FluxLine& line : lines_) {
      const double frequency =
          of_all_ * line.frequency.of_all + (1.0 - of_all_) * line.frequency.of_parts;
      for (const FluxEnd& end : line.ends) {
        for (const PartSpeed& speed : speeds_[end.part]) {
          flux[speed.parameter] +=
              velocities_[end.part].col(speed.parameter).dot(end.per_velocity) / frequency;
        }
      }
      for (const FluxEnd& end : line.ends) {
        for (const PartSpeed& speed : speeds_[end.part]) {
          double& value = flux[speed.parameter];
          if (value != 0.0) means_[static_cast<std::size_t>(speed.parameter)].add(value);
          value = 0.0;
        }
      }
    }
  }

  const PartLines& drawn_;
  const std::vector<FluxLine>& lines_;
  const PartVelocities& velocities_;
  const std::vector<std::vector<PartSpeed>>& speeds_;
  Eigen::Index parameters_;
  double of_all_;  ///< share of lines of the first kind
  std::vector<double> ends_of_part_;
  double steepest_ = 1.0;
  Eigen::VectorXd most_of_mean_;
  std::vector<BoundedMean> means_;
};

}  // namespace

MeanAndError meansOfLines(const PartLines& drawn, int rank, const std::vector<FluxLine>& lines,
                          const PartVelocities& velocities,
                          const std::vector<std::vector<PartSpeed>>& speeds) {
  const Eigen::Index parameters = velocities[0].cols();
  MeanAndError result{Eigen::VectorXd(1 + parameters), Eigen::VectorXd(1 + parameters),
                      lines.size()};
  BoundedMean probability(0.0, drawn.mostOfLine());
  for (std::size_t i = 0; i < lines.size(); ++i) {
    if (lines[i].mass > 0.0 && drawn.isOfAll(i)) {
      probability.add(lines[i].mass / lines[i].frequency.of_all);
    }
  }
  const auto count = static_cast<double>(drawn.countOfAll(lines.size()));
  result.mean[0] = probability.mean(count);
  result.standard_error[0] = probability.standardError(count);
  const FluxMeans flux(drawn, rank, lines, velocities, speeds);
  for (Eigen::Index k = 0; k < parameters; ++k) {
    result.mean[k + 1] = flux.mean(k);
    result.standard_error[k + 1] = flux.standardError(k);
  }
  if (rank == 1) result.standard_error.setZero();  // on a single line all is known
  return result;
}

}  // namespace fcl_prob::detail
