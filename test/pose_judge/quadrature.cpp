// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "quadrature.h"

#include <algorithm>
#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <cmath>
#include <stdexcept>
#include <vector>

namespace fcl_prob_judge {
namespace {

using Eigen::Vector3d;
using Function = std::function<double(double)>;

/// Beyond it there is 1e-18 of the mass.
constexpr double kReach = 8.9;

double density(double z) { return 0.39894228040143267794 * std::exp(-0.5 * z * z); }

double sumWithStep(const Integrand& integrand, double step) {
  const int count = static_cast<int>(std::ceil(kReach / step));
  std::vector<double> weights;
  for (int i = -count; i <= count; ++i) weights.push_back(step * density(i * step));
  const auto weightOf = [&](int i) { return weights[static_cast<std::size_t>(i + count)]; };
  const int counts[3] = {count, integrand.dimension > 1 ? count : 0,
                         integrand.dimension > 2 ? count : 0};
  const double squared = kReach * kReach / (step * step);
  double total = 0.0;
  for (int i = -counts[0]; i <= counts[0]; ++i) {
    double of_slice = 0.0;
    for (int j = -counts[1]; j <= counts[1]; ++j) {
      double of_line = 0.0;
      for (int k = -counts[2]; k <= counts[2]; ++k) {
        if (i * i + j * j + k * k > squared) continue;
        const double value = integrand.value(step * Vector3d(i, j, k));
        of_line += integrand.dimension > 2 ? value * weightOf(k) : value;
      }
      of_slice += integrand.dimension > 1 ? of_line * weightOf(j) : of_line;
    }
    total += of_slice * weightOf(i);
  }
  return total;
}

/// What f is rounded by.
struct Noise {
  double relative, absolute;
};

struct Panel {
  double from, to, value, error;

  Panel(const Function& f, double begin, double end) : from(begin), to(end) {
    using Rule = boost::math::quadrature::gauss_kronrod<double, 15>;
    value = Rule::integrate(f, from, to, 0, 0.0, &error);
  }
};

/// Panels are halved until each is wrong by less than `tolerance`, or as rounding leaves it, by
/// what its two rules and its halves say: a kink close to an end is between the points of both
/// rules.
double integral(const Function& f, const Panel& panel, double tolerance, const Noise& noise,
                int depth) {
  const double middle = 0.5 * (panel.from + panel.to);
  const Panel first(f, panel.from, middle), second(f, middle, panel.to);
  const double halves = first.value + second.value;
  const double error = std::max(panel.error, std::fabs(panel.value - halves));
  const double rounding = noise.relative * std::fabs(halves) + noise.absolute;
  if (error <= std::max(tolerance, rounding) || depth == 0) return halves;
  return integral(f, first, tolerance, noise, depth - 1) +
         integral(f, second, tolerance, noise, depth - 1);
}

double rootBetween(const Function& g, double below, double above) {
  for (int k = 0; k < 60; ++k) {
    const double middle = 0.5 * (below + above);
    (g(middle) < 0.0 ? below : above) = middle;
  }
  return above;
}

double peakBetween(const Function& g, double from, double to) {
  for (int k = 0; k < 40; ++k) {
    const double third = (to - from) / 3.0;
    (g(from + third) < g(to - third) ? from : to) =
        g(from + third) < g(to - third) ? from + third : to - third;
  }
  return 0.5 * (from + to);
}

/// g at steps over all that counts.
struct Steps {
  std::vector<double> at, values;

  Steps(const Function& g, double step) {
    const int count = static_cast<int>(std::ceil(2.0 * kReach / step));
    for (int i = 0; i <= count; ++i) {
      at.push_back(-kReach + 2.0 * kReach * i / count);
      values.push_back(g(at.back()));
    }
  }

  bool isPeak(std::size_t i) const {
    return i > 0 && i + 1 < at.size() && values[i - 1] < values[i] && values[i + 1] < values[i];
  }
};

/// Where g is not negative: ends by halving, peaks between steps by thirds.
std::vector<std::pair<double, double>> piecesInside(const Function& g, double step) {
  std::vector<std::pair<double, double>> pieces;
  const Steps steps(g, step);
  const auto& [at, values] = steps;
  for (std::size_t i = 0; i < at.size(); ++i) {
    if (values[i] >= 0.0) {
      const bool begins = i == 0 || values[i - 1] < 0.0;
      if (begins) pieces.push_back({i == 0 ? at[0] : rootBetween(g, at[i - 1], at[i]), at[i]});
      const bool ends = i + 1 < at.size() && values[i + 1] < 0.0;
      pieces.back().second = ends ? rootBetween(g, at[i + 1], at[i]) : at[i];
    } else if (steps.isPeak(i)) {
      const double peak = peakBetween(g, at[i - 1], at[i + 1]);
      if (g(peak) < 0.0) continue;
      pieces.push_back({rootBetween(g, at[i - 1], peak), rootBetween(g, at[i + 1], peak)});
    }
  }
  return pieces;
}

double stepOf(const Integrand& integrand) { return std::min(0.5, integrand.feature); }

/// The most that `inside` has where the first `axis` + 1 numbers are given.
double mostInside(const Integrand& integrand, Vector3d z, int axis) {
  if (axis + 1 == integrand.dimension) return integrand.inside(z);
  const Function g = [&](double at) {
    z[axis + 1] = at;
    return mostInside(integrand, z, axis + 1);
  };
  const Steps steps(g, stepOf(integrand));
  double most = *std::max_element(steps.values.begin(), steps.values.end());
  for (std::size_t i = 0; i < steps.at.size(); ++i) {
    if (!steps.isPeak(i)) continue;
    most = std::max(most, g(peakBetween(g, steps.at[i - 1], steps.at[i + 1])));
  }
  return most;
}

double panelsOver(const Integrand& integrand, Vector3d z, int axis, double tolerance);

/// density·f, f being the mean over the numbers that follow.
double weighted(const Integrand& integrand, Vector3d z, int axis, double at, double tolerance) {
  z[axis] = at;
  if (axis + 1 == integrand.dimension) return density(at) * integrand.value(z);
  // What is within is to be known better than what is made of it.
  const double within = std::min(1e-3, 0.02 * tolerance / density(at));
  return density(at) * panelsOver(integrand, z, axis + 1, within);
}

double panelsOver(const Integrand& integrand, Vector3d z, int axis, double tolerance) {
  std::vector<std::pair<double, double>> pieces{{-kReach, kReach}};
  if (integrand.inside) {
    pieces = piecesInside(
        [&](double at) {
          z[axis] = at;
          return mostInside(integrand, z, axis);
        },
        stepOf(integrand));
  }
  // Boost's distributions have 12 digits; what is within has one less.
  const bool innermost = axis + 1 == integrand.dimension;
  const Noise noise = innermost ? Noise{1e-11, 1e-16} : Noise{1e-10, 2e-15};
  // What is inside has no kinks; a kink halves its panel until nothing is left of it.
  const int depth = integrand.inside ? 8 : 45;
  double total = 0.0;
  for (const auto& [from, to] : pieces) {
    const double middle = 0.5 * (from + to), half = 0.5 * (to - from);
    const int panels =
        static_cast<int>(std::ceil((to - from) / std::min(1.0, 8.0 * integrand.feature)));
    // Roots at the ends of a piece are smoothed by a sine.
    const Function f = [&, axis](double phi) {
      return half * std::cos(phi) *
             weighted(integrand, z, axis, middle + half * std::sin(phi), tolerance);
    };
    for (int i = 0; i < panels; ++i) {
      const Panel panel(f, M_PI * (double(i) / panels - 0.5),
                        M_PI * (double(i + 1) / panels - 0.5));
      total += integral(f, panel, tolerance / panels, noise, depth);
    }
  }
  return total;
}

}  // namespace

double meanBySums(const Integrand& integrand, double relative_error) {
  if (integrand.dimension == 0) return integrand.value(Vector3d::Zero());
  double step = std::min(1.0, integrand.feature);
  double last = sumWithStep(integrand, step);
  for (int round = 0; round < 6; ++round) {
    step *= 0.5;
    const double now = sumWithStep(integrand, step);
    // One halving squares the error twice over, so that `now` is better than the difference.
    if (std::fabs(now - last) <= std::max(std::sqrt(relative_error) * now, 1e-16) * 1e-2) {
      return now;
    }
    last = now;
  }
  throw std::runtime_error("the trapezoidal rule does not settle");
}

double meanByPanels(const Integrand& integrand, double relative_error) {
  if (integrand.dimension == 0) return integrand.value(Vector3d::Zero());
  const double value = panelsOver(integrand, Vector3d::Zero(), 0, 1e-6);
  return panelsOver(integrand, Vector3d::Zero(), 0, std::max(1e-16, relative_error * value));
}

double meanOf(const Integrand& integrand) {
  return integrand.smooth ? meanBySums(integrand) : meanByPanels(integrand);
}

double roughMeanOf(const Integrand& integrand) {
  if (integrand.dimension == 0) return integrand.value(Vector3d::Zero());
  const double step = std::min(0.8, 2.0 * integrand.feature);
  return sumWithStep(integrand, integrand.smooth ? step : 0.25 * step);
}

}  // namespace fcl_prob_judge
