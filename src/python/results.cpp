// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "python/results.h"

#include <pybind11/stl.h>

#include <array>
#include <limits>
#include <sstream>

#include "fcl_prob/combined_bounds.h"
#include "fcl_prob/exceptions.h"
#include "python/arrays.h"

namespace fcl_prob::python {
namespace {

constexpr std::array<Decision, 4> kDecisions = {Decision::none, Decision::below, Decision::above,
                                                Decision::undecided};
constexpr std::array<ProbabilityStatus, 10> kStatuses = {
    ProbabilityStatus::converged,        ProbabilityStatus::exact,
    ProbabilityStatus::decided,          ProbabilityStatus::bound_only,
    ProbabilityStatus::sampled,          ProbabilityStatus::time_limit,
    ProbabilityStatus::cell_limit,       ProbabilityStatus::memory_limit,
    ProbabilityStatus::resolution_limit, ProbabilityStatus::cancelled};

/// The one of `all` with this name. \throws InvalidRequest
template <class All>
auto named(const All& all, const std::string& name) {
  for (const auto one : all) {
    if (toString(one) == name) return one;
  }
  throw InvalidRequest("'" + name + "' is not known");
}

using Vector = std::array<double, 3>;

std::optional<Vector> listed(const std::optional<Eigen::Vector3d>& value) {
  if (!value) return std::nullopt;
  return Vector{value->x(), value->y(), value->z()};
}

std::optional<Eigen::Vector3d> vectorOf(const std::optional<Vector>& value) {
  if (!value) return std::nullopt;
  return Eigen::Vector3d((*value)[0], (*value)[1], (*value)[2]);
}

py::object pairOf(const std::optional<Bounds>& bounds) {
  if (!bounds) return py::none();
  return py::make_tuple(bounds->lower, bounds->upper);
}

py::dict dictOf(const ProbabilityStatistics& statistics) {
  py::dict seconds;
  for (const auto& [stage, time] : statistics.seconds) seconds[py::str(stage)] = time;
  py::dict result;
  result["cells"] = statistics.cells;
  result["cells_open"] = statistics.cells_open;
  result["pairs_tested"] = statistics.pairs_tested;
  result["leaf_pairs"] = statistics.leaf_pairs;
  result["peak_front"] = statistics.peak_front;
  result["peak_memory"] = statistics.peak_memory;
  result["samples"] = statistics.samples;
  result["hits"] = statistics.hits;
  result["effective_samples"] = orNone(statistics.effective_samples);
  result["raw_sum"] = orNone(statistics.raw_sum);
  result["seconds"] = seconds;
  return result;
}

py::dict dictOf(const ProbabilityResult& result) {
  py::dict dict;
  dict["method"] = toString(result.method);
  dict["probability"] = result.probability();
  dict["lower"] = orNone(result.lower);
  dict["upper"] = orNone(result.upper);
  dict["estimate"] = orNone(result.estimate);
  dict["standard_error"] = orNone(result.standard_error);
  dict["confidence_interval"] = pairOf(result.confidence_interval);
  dict["gradient"] = orNone(listed(result.gradient));
  dict["gradient_lower"] = orNone(listed(result.gradient_lower));
  dict["gradient_upper"] = orNone(listed(result.gradient_upper));
  dict["gradient_standard_error"] = orNone(listed(result.gradient_standard_error));
  dict["decision"] = decisionOf(result.decision);
  dict["status"] = toString(result.status);
  dict["plan"] = result.plan;
  dict["statistics"] = dictOf(result.statistics);
  return dict;
}

ProbabilityStatistics statisticsFrom(const py::dict& dict) {
  ProbabilityStatistics statistics;
  const auto count = [&](const char* key) { return dict[key].cast<std::size_t>(); };
  statistics.cells = count("cells");
  statistics.cells_open = count("cells_open");
  statistics.pairs_tested = count("pairs_tested");
  statistics.leaf_pairs = count("leaf_pairs");
  statistics.peak_front = count("peak_front");
  statistics.peak_memory = count("peak_memory");
  statistics.samples = count("samples");
  statistics.hits = count("hits");
  statistics.effective_samples = dict["effective_samples"].cast<std::optional<double>>();
  statistics.raw_sum = dict["raw_sum"].cast<std::optional<double>>();
  for (const auto& [stage, time] : dict["seconds"].cast<py::dict>()) {
    statistics.seconds.emplace_back(stage.cast<std::string>(), time.cast<double>());
  }
  return statistics;
}

/// Whether all is equal but the time that it took.
bool areEqual(const ProbabilityResult& a, const ProbabilityResult& b) {
  const auto withoutTimes = [](ProbabilityResult result) {
    result.statistics.seconds.clear();
    return dictOf(result);
  };
  return withoutTimes(a).equal(withoutTimes(b));
}

/// What dictOf() has made a dict of.
ProbabilityResult resultFrom(const py::dict& dict) {
  using Number = std::optional<double>;
  ProbabilityResult result;
  const auto method = methodFromString(dict["method"].cast<std::string>());
  if (!method) throw InvalidRequest("method is " + textOf(dict["method"]));
  result.method = *method;
  result.lower = dict["lower"].cast<Number>();
  result.upper = dict["upper"].cast<Number>();
  result.estimate = dict["estimate"].cast<Number>();
  result.standard_error = dict["standard_error"].cast<Number>();
  if (const auto interval =
          dict["confidence_interval"].cast<std::optional<std::array<double, 2>>>()) {
    result.confidence_interval = Bounds{(*interval)[0], (*interval)[1]};
  }
  const auto vector = [&](const char* key) {
    return vectorOf(dict[key].cast<std::optional<Vector>>());
  };
  result.gradient = vector("gradient");
  result.gradient_lower = vector("gradient_lower");
  result.gradient_upper = vector("gradient_upper");
  result.gradient_standard_error = vector("gradient_standard_error");
  const auto decision = dict["decision"].cast<std::optional<std::string>>();
  result.decision = named(kDecisions, decision.value_or("none"));
  result.status = named(kStatuses, dict["status"].cast<std::string>());
  result.plan = dict["plan"].cast<std::vector<std::string>>();
  result.statistics = statisticsFrom(dict["statistics"].cast<py::dict>());
  return result;
}

std::string reprOf(const ProbabilityResult& result) {
  std::ostringstream text;
  text.precision(6);
  text << "<ProbabilityResult P = " << result.probability();
  if (result.standard_error) text << " ± " << *result.standard_error << " (standard error)";
  if (result.lower && result.upper) {
    text << ", certified in [" << *result.lower << ", " << *result.upper << "]";
  } else if (result.upper) {
    text << ", certified <= " << *result.upper;
  } else if (result.confidence_interval) {
    text << ", confidence interval [" << result.confidence_interval->lower << ", "
         << result.confidence_interval->upper << "]";
  }
  if (result.decision != Decision::none) text << ", decision " << toString(result.decision);
  text << ", " << toString(result.method) << ": " << toString(result.status) << ">";
  return text.str();
}

py::object gradientArray(const std::optional<Eigen::Vector3d>& gradient) {
  return gradient ? vectorArray(*gradient) : py::none();
}

void bindResult(py::module_& module) {
  using Result = ProbabilityResult;
  py::class_<Result>(module, "ProbabilityResult",
                     "What a query answers. Numbers that its method does not compute are None.")
      .def_property_readonly("probability", &Result::probability,
                             "The single number to use: the estimate, else the middle of the "
                             "interval, else the upper bound.")
      .def_property_readonly(
          "lower", [](const Result& r) { return orNone(r.lower); },
          "Certified: lower <= P on every input.")
      .def_property_readonly(
          "upper", [](const Result& r) { return orNone(r.upper); },
          "Certified: P <= upper on every input.")
      .def_property_readonly(
          "estimate", [](const Result& r) { return orNone(r.estimate); },
          "Not certified; see standard_error.")
      .def_property_readonly(
          "standard_error", [](const Result& r) { return orNone(r.standard_error); },
          "Of the estimate.")
      .def_property_readonly(
          "confidence_interval", [](const Result& r) { return pairOf(r.confidence_interval); },
          "(lower, upper) of sampling methods; nothing certified.")
      .def_property_readonly(
          "gradient", [](const Result& r) { return gradientArray(r.gradient); },
          "dP/dmean, 1/m, world frame, (3,) float64.")
      .def_property_readonly(
          "gradient_lower", [](const Result& r) { return gradientArray(r.gradient_lower); },
          "Certified, component by component, (3,) float64.")
      .def_property_readonly(
          "gradient_upper", [](const Result& r) { return gradientArray(r.gradient_upper); },
          "Certified, component by component, (3,) float64.")
      .def_property_readonly(
          "gradient_standard_error",
          [](const Result& r) { return gradientArray(r.gradient_standard_error); },
          "Where the method samples, (3,) float64.")
      .def_property_readonly(
          "decision", [](const Result& r) { return decisionOf(r.decision); },
          "'below', 'above' or 'undecided' of the threshold; None without one.")
      .def_property_readonly(
          "status", [](const Result& r) { return toString(r.status); },
          "Why the query stopped: 'converged', 'exact', 'decided', 'bound-only', "
          "'sampled', 'time-limit', 'cell-limit', 'memory-limit', "
          "'resolution-limit' or 'cancelled'. The interval is valid in any case.")
      .def_property_readonly(
          "method", [](const Result& r) { return toString(r.method); }, "The one that answered.")
      .def_property_readonly(
          "plan", [](const Result& r) { return r.plan; },
          "What was used, what was left out, and why: a list of sentences.")
      .def_property_readonly(
          "statistics", [](const Result& r) { return dictOf(r.statistics); },
          "What the query did, as a dict of counters.")
      .def(
          "to_dict", [](const Result& r) { return dictOf(r); },
          "All of it as a dict of plain Python values, as json.dumps takes it.")
      .def("__float__", &Result::probability)
      .def("__repr__", &reprOf)
      .def("__eq__",
           [](const Result& r, const py::object& other) -> py::object {
             if (!py::isinstance<Result>(other)) {
               return py::reinterpret_borrow<py::object>(Py_NotImplemented);
             }
             return py::bool_(areEqual(r, other.cast<const Result&>()));
           })
      .def(py::pickle([](const Result& r) { return dictOf(r); }, &resultFrom));
}

// Batches.

using Field = std::optional<double> ProbabilityResult::*;

py::object column(const BatchResult& batch, Field field) {
  std::vector<double> values;
  values.reserve(batch.answers.size());
  for (const auto& answer : batch.answers) {
    const auto value = answer ? (*answer).*field : std::nullopt;
    values.push_back(value.value_or(std::numeric_limits<double>::quiet_NaN()));
  }
  return arrayOf(values);
}

py::object probabilities(const BatchResult& batch) {
  std::vector<double> values;
  for (const auto& answer : batch.answers) {
    values.push_back(answer ? answer->probability() : std::numeric_limits<double>::quiet_NaN());
  }
  return arrayOf(values);
}

/// An array of names, picked by number: `of` gives that of an answer, 0 stands for none.
template <class Of>
py::object nameColumn(const BatchResult& batch, const std::vector<std::string>& names,
                      const Of& of) {
  std::vector<std::int64_t> numbers;
  numbers.reserve(batch.answers.size());
  for (const auto& answer : batch.answers) numbers.push_back(answer ? of(*answer) : 0);
  return py::module_::import("numpy").attr("array")(names).attr("take")(arrayOf(numbers));
}

py::object statuses(const BatchResult& batch) {
  std::vector<std::string> names = {"cancelled"};
  for (const ProbabilityStatus status : kStatuses) names.push_back(toString(status));
  return nameColumn(batch, names,
                    [](const ProbabilityResult& r) { return 1 + static_cast<int>(r.status); });
}

py::object decisions(const BatchResult& batch) {
  std::vector<std::string> names = {"none"};
  for (const Decision decision : kDecisions) names.push_back(toString(decision));
  return nameColumn(batch, names,
                    [](const ProbabilityResult& r) { return 1 + static_cast<int>(r.decision); });
}

py::object gradients(const BatchResult& batch) {
  Eigen::MatrixXd rows = Eigen::MatrixXd::Constant(static_cast<Eigen::Index>(batch.answers.size()),
                                                   3, std::numeric_limits<double>::quiet_NaN());
  for (std::size_t i = 0; i < batch.answers.size(); ++i) {
    const auto& answer = batch.answers[i];
    if (answer && answer->gradient) rows.row(static_cast<Eigen::Index>(i)) = *answer->gradient;
  }
  return arrayOf(rows);
}

py::tuple pathOf(const BatchResult& batch) {
  std::vector<Bounds> all;
  for (const auto& answer : batch.answers) {
    all.push_back(answer ? Bounds{answer->lower.value_or(0.0), answer->upper.value_or(1.0)}
                         : Bounds{0.0, 1.0});
  }
  const Bounds path = anyOf(all);
  return py::make_tuple(path.lower, path.upper);
}

std::size_t doneOf(const BatchResult& batch) {
  std::size_t done = 0;
  for (const auto& answer : batch.answers) done += answer ? 1 : 0;
  return done;
}

py::object itemOf(const BatchResult& batch, py::ssize_t i) {
  const auto size = static_cast<py::ssize_t>(batch.answers.size());
  if (i < -size || i >= size)
    throw py::index_error("there are " + std::to_string(size) + " results");
  return orNone(batch.answers[static_cast<std::size_t>(i < 0 ? i + size : i)]);
}

std::string reprOf(const BatchResult& batch) {
  return "<BatchResult of " + std::to_string(batch.answers.size()) + " queries, " +
         std::to_string(doneOf(batch)) + " answered>";
}

py::dict dictOf(const BatchResult& batch) {
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

void bindBatch(py::module_& module) {
  using Batch = BatchResult;
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

}  // namespace

py::object decisionOf(Decision decision) {
  if (decision == Decision::none) return py::none();
  return py::str(toString(decision));
}

void bindResults(py::module_& module) {
  bindMemoryView(module);
  bindResult(module);
  bindBatch(module);
}

}  // namespace fcl_prob::python
