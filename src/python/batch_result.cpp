// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Answers of many queries as arrays.
#include <pybind11/stl.h>

#include <limits>

#include "fcl_prob/combined_bounds.h"
#include "python/arrays.h"
#include "python/results.h"

namespace fcl_prob::python {
namespace {

using Field = std::optional<double> ProbabilityResult::*;

py::object column(const BatchArrays& batch, Field field) {
  std::vector<double> values;
  values.reserve(batch.answers.size());
  for (const auto& answer : batch.answers) {
    const auto value = answer ? (*answer).*field : std::nullopt;
    values.push_back(value.value_or(std::numeric_limits<double>::quiet_NaN()));
  }
  return arrayOf(values);
}

py::object probabilities(const BatchArrays& batch) {
  std::vector<double> values;
  for (const auto& answer : batch.answers) {
    values.push_back(answer ? answer->probability() : std::numeric_limits<double>::quiet_NaN());
  }
  return arrayOf(values);
}

/// An array of names, picked by number: `of` gives that of an answer, 0 stands for none.
template <class Of>
py::object nameColumn(const BatchArrays& batch, const std::vector<std::string>& names,
                      const Of& of) {
  std::vector<std::int64_t> numbers;
  numbers.reserve(batch.answers.size());
  for (const auto& answer : batch.answers) numbers.push_back(answer ? of(*answer) : 0);
  return py::module_::import("numpy").attr("array")(names).attr("take")(arrayOf(numbers));
}

py::object statuses(const BatchArrays& batch) {
  std::vector<std::string> names = {"cancelled"};
  for (const ProbabilityStatus status : kStatuses) names.push_back(toString(status));
  return nameColumn(batch, names,
                    [](const ProbabilityResult& r) { return 1 + static_cast<int>(r.status); });
}

py::object decisions(const BatchArrays& batch) {
  std::vector<std::string> names = {"none"};
  for (const Decision decision : kDecisions) names.push_back(toString(decision));
  return nameColumn(batch, names,
                    [](const ProbabilityResult& r) { return 1 + static_cast<int>(r.decision); });
}

py::object gradients(const BatchArrays& batch) {
  Eigen::MatrixXd rows = Eigen::MatrixXd::Constant(static_cast<Eigen::Index>(batch.answers.size()),
                                                   3, std::numeric_limits<double>::quiet_NaN());
  for (std::size_t i = 0; i < batch.answers.size(); ++i) {
    const auto& answer = batch.answers[i];
    if (answer && answer->gradient) rows.row(static_cast<Eigen::Index>(i)) = *answer->gradient;
  }
  return arrayOf(rows);
}

py::tuple pathOf(const BatchArrays& batch) {
  std::vector<Bounds> all;
  for (const auto& answer : batch.answers) {
    all.push_back(answer ? Bounds{answer->lower.value_or(0.0), answer->upper.value_or(1.0)}
                         : Bounds{0.0, 1.0});
  }
  return pairOf(anyOf(all));
}

std::size_t doneOf(const BatchArrays& batch) {
  std::size_t done = 0;
  for (const auto& answer : batch.answers) done += answer ? 1 : 0;
  return done;
}

py::object itemOf(const BatchArrays& batch, py::ssize_t i) {
  const auto size = static_cast<py::ssize_t>(batch.answers.size());
  if (i < -size || i >= size)
    throw py::index_error("there are " + std::to_string(size) + " results");
  return orNone(batch.answers[static_cast<std::size_t>(i < 0 ? i + size : i)]);
}

std::string reprOf(const BatchArrays& batch) {
  return "<BatchResult of " + std::to_string(batch.answers.size()) + " queries, " +
         std::to_string(doneOf(batch)) + " answered>";
}

py::dict dictOf(const BatchArrays& batch) {
  py::dict dict;
  dict["probability"] = probabilities(batch);
  dict["lower"] = column(batch, &ProbabilityResult::lower);
  dict["upper"] = column(batch, &ProbabilityResult::upper);
  dict["estimate"] = column(batch, &ProbabilityResult::estimate);
  dict["standard_error"] = column(batch, &ProbabilityResult::standard_error);
  dict["status"] = statuses(batch);
  dict["decision"] = decisions(batch);
  return dict;
}

}  // namespace

void bindBatchResult(py::module_& module) {
  using Batch = BatchArrays;
  py::class_<Batch>(module, "BatchResult",
                    "Answers of many queries, in their order. An attribute makes a new array of n "
                    "entries: NaN where a method does not compute the number, or the query was not "
                    "reached before the batch was cancelled.")
      .def_property_readonly("probability", &probabilities,
                             "The single number to use, (n,) float64.")
      .def_property_readonly(
          "lower", [](const Batch& b) { return column(b, &ProbabilityResult::lower); },
          "Certified lower bounds, (n,) float64.")
      .def_property_readonly(
          "upper", [](const Batch& b) { return column(b, &ProbabilityResult::upper); },
          "Certified upper bounds, (n,) float64.")
      .def_property_readonly(
          "estimate", [](const Batch& b) { return column(b, &ProbabilityResult::estimate); },
          "Estimates, (n,) float64.")
      .def_property_readonly(
          "standard_error",
          [](const Batch& b) { return column(b, &ProbabilityResult::standard_error); },
          "Of the estimates, (n,) float64.")
      .def_property_readonly("gradient", &gradients, "dP/dmean, 1/m, (n, 3) float64.")
      .def_property_readonly(
          "status", &statuses,
          "As ProbabilityResult.status, (n,) of str; 'cancelled' where the query "
          "was not answered.")
      .def_property_readonly("decision", &decisions,
                             "'below', 'above', 'undecided' or 'none', (n,) of str.")
      .def_property_readonly("done", &doneOf, "How many were answered.")
      .def_property_readonly(
          "cancelled", [](const Batch& b) { return doneOf(b) < b.answers.size(); },
          "Whether some were not.")
      .def_property_readonly("path", &pathOf,
                             "Certified (lower, upper) of the probability that there is contact at "
                             "any of them, whatever the dependence between their displacements.")
      .def(
          "to_dict", [](const Batch& b) { return dictOf(b); }, "The arrays as a dict.")
      .def("__len__", [](const Batch& b) { return b.answers.size(); })
      .def("__getitem__", &itemOf, "The i-th ProbabilityResult; None if it was not answered.")
      .def("__repr__", [](const Batch& b) { return reprOf(b); })
      .def(py::pickle(
          [](const Batch& b) {
            py::list all;
            for (const auto& answer : b.answers) all.append(orNone(answer));
            return py::make_tuple(all);
          },
          [](const py::tuple& state) {
            Batch batch;
            for (const py::handle one : state[0]) {
              batch.answers.push_back(one.cast<std::optional<ProbabilityResult>>());
            }
            return batch;
          }));
}

}  // namespace fcl_prob::python
