// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "io/import_notes.h"

#include <algorithm>
#include <boost/math/constants/constants.hpp>
#include <limits>
#include <sstream>

namespace fcl_prob::detail {
namespace {

constexpr double kNegligible = 1e-3;  // of the least deviation, or of the tolerance

}  // namespace

void addNotes(const std::vector<std::string>& more, std::vector<std::string>& notes) {
  for (const std::string& note : more) {
    if (std::find(notes.begin(), notes.end(), note) == notes.end()) notes.push_back(note);
  }
}

double leastDeviation(const GaussianDisplacement& displacement) {
  return displacement.rank() > 0 ? displacement.standardDeviations()[displacement.rank() - 1]
                                 : std::numeric_limits<double>::infinity();
}

std::optional<std::string> precisionNote(const std::string& subject, double coordinate_error,
                                         double least_deviation, double tolerance) {
  // A face that is moved by one deviation sweeps a mass of at most the density's maximum.
  const double deviations = coordinate_error / least_deviation;
  const double moved_mass = deviations * boost::math::double_constants::one_div_root_two_pi;
  if (deviations <= kNegligible && moved_mass <= kNegligible * tolerance) return std::nullopt;
  std::ostringstream note;
  note.precision(2);
  note << subject << " read in single precision: coordinates may be off by " << coordinate_error
       << " m, " << deviations << " of the least standard deviation, which no bound contains";
  return note.str();
}

}  // namespace fcl_prob::detail
