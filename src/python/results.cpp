// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "python/results.h"

#include <pybind11/stl.h>

#include <array>
#include <sstream>

#include "base/decision.h"
#include "base/known_text.h"
#include "fcl_prob/exceptions.h"
#include "python/arrays.h"

namespace fcl_prob::python {
namespace {

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
  py::list rungs;
  for (const RungRecord& rung : statistics.rungs) {
    py::dict record;
    record["name"] = rung.name;
    record["seconds"] = rung.seconds;
    record["lower"] = rung.known.lower;
    record["upper"] = rung.known.upper;
    record["times"] = rung.times;
    record["answered"] = rung.answered;
    record["note"] = rung.note;
    rungs.append(record);
  }
  result["rungs"] = rungs;
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
  for (const py::handle& rung : dict["rungs"].cast<py::list>()) {
    statistics.rungs.push_back({rung["name"].cast<std::string>(),
                                rung["seconds"].cast<double>(),
                                {rung["lower"].cast<double>(), rung["upper"].cast<double>()},
                                rung["times"].cast<std::size_t>(),
                                rung["answered"].cast<std::size_t>(),
                                rung["note"].cast<std::string>()});
  }
  return statistics;
}

/// Whether all is equal but the time that it took.
bool areEqual(const ProbabilityResult& a, const ProbabilityResult& b) {
  const auto withoutTimes = [](ProbabilityResult result) {
    result.statistics.seconds.clear();
    for (RungRecord& rung : result.statistics.rungs) rung.seconds = 0.0;
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
  text << "<ProbabilityResult P " << detail::relationText(result);
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

}  // namespace

py::object decisionOf(Decision decision) {
  if (decision == Decision::none) return py::none();
  return py::str(toString(decision));
}

void bindResults(py::module_& module) {
  bindMemoryView(module);
  bindResult(module);
  bindBatchResult(module);
}

}  // namespace fcl_prob::python
