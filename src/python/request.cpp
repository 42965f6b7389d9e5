// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "python/request.h"

#include <algorithm>
#include <array>
#include <limits>
#include <optional>
#include <string>

#include "fcl_prob/exceptions.h"
#include "gaussian/named_values.h"
#include "python/arrays.h"

namespace fcl_prob::python {
namespace {

[[noreturn]] void refuse(const char* name, const std::string& expected, py::handle value) {
  throw py::type_error(std::string(name) + " must be " + expected + ", not " + textOf(value));
}

double numberFrom(const char* name, py::handle value) {
  const double number = PyFloat_AsDouble(value.ptr());
  if (number == -1.0 && PyErr_Occurred() != nullptr) {
    PyErr_Clear();
    refuse(name, "a number", value);
  }
  return number;
}

template <class Count>
Count countFrom(const char* name, py::handle value) {
  const auto index = py::reinterpret_steal<py::object>(PyNumber_Index(value.ptr()));
  if (!index) {
    PyErr_Clear();
    refuse(name, "a whole number", value);
  }
  const unsigned long long number = PyLong_AsUnsignedLongLong(index.ptr());
  if (PyErr_Occurred() != nullptr || number > std::numeric_limits<Count>::max()) {
    PyErr_Clear();
    throw InvalidRequest(std::string(name) + " is " + textOf(value) + ", must be from 0 to " +
                         std::to_string(std::numeric_limits<Count>::max()));
  }
  return static_cast<Count>(number);
}

/// Nothing if it is no text, or one that UTF-8 does not have.
std::optional<std::string> utf8Of(py::handle value) {
  if (!py::isinstance<py::str>(value)) return std::nullopt;
  Py_ssize_t size = 0;
  const char* text = PyUnicode_AsUTF8AndSize(value.ptr(), &size);
  if (text == nullptr) {
    PyErr_Clear();
    return std::nullopt;
  }
  return std::string(text, static_cast<std::size_t>(size));
}

std::string nameFrom(const char* name, py::handle value) {
  const std::optional<std::string> given = utf8Of(value);
  if (!given) refuse(name, "a name", value);
  std::string text = *given;
  std::replace(text.begin(), text.end(), '_', '-');
  return text;
}

void setMethod(Question& question, py::handle value) {
  std::string name = nameFrom("method", value);
  if (name == "automatic") name = "auto";
  const auto method = methodFromString(name);
  if (!method) {
    std::string known;
    for (const std::string& one : methodNames()) known += " " + one;
    throw InvalidRequest("method is " + textOf(value) + ", must be one of" + known);
  }
  question.request.method = *method;
}

void setContact(Question& question, py::handle value) {
  question.request.contact = contactFrom(value);
}

void setThreads(Question& question, py::handle value) {
  question.request.threads = countFrom<unsigned>("threads", value);
  question.threads_are_given = true;
}

template <bool ProbabilityRequest::*field>
void setTruth(Question& question, py::handle value, const char* /*name*/) {
  const int truth = PyObject_IsTrue(value.ptr());
  if (truth < 0) throw py::error_already_set();
  question.request.*field = truth == 1;
}

template <double ProbabilityRequest::*field>
void setNumber(Question& question, py::handle value, const char* name) {
  question.request.*field = numberFrom(name, value);
}

template <std::optional<double> ProbabilityRequest::*field>
void setOptional(Question& question, py::handle value, const char* name) {
  if (!value.is_none()) question.request.*field = numberFrom(name, value);
}

template <std::size_t ProbabilityRequest::*field>
void setCount(Question& question, py::handle value, const char* name) {
  question.request.*field = countFrom<std::size_t>(name, value);
}

/// Metres: one number, or outwards and inwards.
template <Band ProbabilityRequest::*field>
void setBand(Question& question, py::handle value, const char* name) {
  if (!py::isinstance<py::tuple>(value) && !py::isinstance<py::list>(value)) {
    question.request.*field = Band::within(numberFrom(name, value));
    return;
  }
  const auto both = py::reinterpret_borrow<py::sequence>(value);
  if (both.size() != 2) refuse(name, "a number or two, outwards and inwards", value);
  const py::object outward = both[0], inward = both[1];
  question.request.*field = {numberFrom(name, outward), numberFrom(name, inward)};
}

using Setter = void (*)(Question&, py::handle, const char*);

struct Keyword {
  const char* name;
  Setter set;
};

using R = ProbabilityRequest;

constexpr std::array<Keyword, 16> kKeywords = {{
    {"method", [](Question& q, py::handle v, const char*) { setMethod(q, v); }},
    {"contact", [](Question& q, py::handle v, const char*) { setContact(q, v); }},
    {"relative_tolerance", setNumber<&R::relative_tolerance>},
    {"absolute_tolerance", setNumber<&R::absolute_tolerance>},
    {"threshold", setOptional<&R::threshold>},
    {"time_limit", setOptional<&R::time_limit>},
    {"max_cells", setCount<&R::max_cells>},
    {"max_memory", setCount<&R::max_memory>},
    {"confidence", setNumber<&R::confidence>},
    {"samples", setCount<&R::samples>},
    {"seed", [](Question& q, py::handle v,
                const char* name) { q.request.seed = countFrom<std::uint64_t>(name, v); }},
    {"threads", [](Question& q, py::handle v, const char*) { setThreads(q, v); }},
    {"gradient", setTruth<&R::gradient>},
    {"band_a", setBand<&R::band_a>},
    {"band_b", setBand<&R::band_b>},
    {"on_progress",
     [](Question& q, py::handle v, const char*) { q.on_progress = progressFrom(v); }},
}};

}  // namespace

std::optional<py::function> progressFrom(py::handle value) {
  if (value.is_none()) return std::nullopt;
  if (PyCallable_Check(value.ptr()) == 0) refuse("on_progress", "callable", value);
  return py::reinterpret_borrow<py::function>(value);
}

ContactMeaning contactFrom(py::handle value) {
  const std::string name = nameFrom("contact", value);
  if (const auto contact = detail::valueOf(detail::kContactMeanings, name)) return *contact;
  throw InvalidRequest("contact is " + textOf(value) + ", must be 'fcl', 'solid' or 'contained'");
}

Question questionFrom(const py::kwargs& keywords) {
  Question question;
  for (const auto& [key, value] : keywords) {
    const std::string name = utf8Of(key).value_or("");
    const auto keyword = std::find_if(kKeywords.begin(), kKeywords.end(),
                                      [&](const Keyword& one) { return name == one.name; });
    if (keyword == kKeywords.end()) {
      std::string known;
      for (const Keyword& one : kKeywords) known += std::string(" ") + one.name;
      throw py::type_error("unexpected keyword argument " + textOf(key) +
                           "; those of a request are" + known);
    }
    keyword->set(question, value, keyword->name);
  }
  // Where more than a pair is asked, that is refused there.
  ProbabilityRequest of_pair = question.request;
  if (of_pair.contact == ContactMeaning::contained) of_pair.contact = ContactMeaning::fcl;
  validateRequest(of_pair);
  return question;
}

PoseConvention conventionFrom(const std::string& name) {
  if (const auto convention = detail::valueOf(detail::kPoseConventions, name)) return *convention;
  throw InvalidRequest("convention is '" + name +
                       "', must be one of world, body, world-exponential, body-exponential");
}

std::string toString(PoseConvention convention) {
  return detail::nameOf(detail::kPoseConventions, convention);
}

}  // namespace fcl_prob::python
