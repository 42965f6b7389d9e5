// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "io/strict_json.h"

#include "fcl_prob/exceptions.h"
#include "io/file_content.h"
#include "io/text_reader.h"

namespace fcl_prob::detail {
namespace {

using Json = nlohmann::json;

constexpr std::size_t kMaxFileBytes = std::size_t{16} << 20;

/// The parser keeps the last of two equal keys in silence; this hears of both.
class DuplicateKeyWatch {
 public:
  explicit DuplicateKeyWatch(const std::string& path) : path_(path) {}

  bool operator()(int /*depth*/, Json::parse_event_t event, Json& parsed) {
    if (event == Json::parse_event_t::object_start) keys_.emplace_back();
    if (event == Json::parse_event_t::object_end) keys_.pop_back();
    if (event == Json::parse_event_t::key) {
      const std::string key = parsed.get<std::string>();
      if (!keys_.back().insert(key).second) {
        throw FileError(path_ + ": the key " + inQuotes(key) + " is given twice");
      }
    }
    return true;
  }

 private:
  const std::string& path_;
  std::vector<std::set<std::string>> keys_;
};

}  // namespace

Json parseJson(const std::string& content, const std::string& where) {
  DuplicateKeyWatch watch(where);
  try {
    return Json::parse(content, std::ref(watch));
  } catch (const Json::exception& error) {
    throw FileError(where + ": not valid JSON: " + error.what());
  }
}

Json parseJsonFile(const std::string& path) {
  return parseJson(fileContent(path, kMaxFileBytes), path);
}

StrictObject::StrictObject(const Json& value, std::string where)
    : value_(value), where_(std::move(where)) {
  if (!value_.is_object()) throw FileError(where_ + ": not an object");
}

const Json& StrictObject::take(const std::string& key) {
  taken_.insert(key);
  const auto position = value_.find(key);
  if (position == value_.end()) fail(key, "missing");
  return *position;
}

StrictObject StrictObject::object(const std::string& key) {
  return {take(key), where_ + ": " + key};
}

std::string StrictObject::text(const std::string& key) {
  const Json& value = take(key);
  if (!value.is_string()) fail(key, "not a string");
  return value.get<std::string>();
}

bool StrictObject::boolean(const std::string& key) {
  const Json& value = take(key);
  if (!value.is_boolean()) fail(key, "neither true nor false");
  return value.get<bool>();
}

double StrictObject::number(const std::string& key) {
  const Json& value = take(key);
  if (!value.is_number()) fail(key, "not a number");
  return value.get<double>();
}

std::uint64_t StrictObject::count(const std::string& key) {
  const Json& value = take(key);
  if (!value.is_number_unsigned()) fail(key, "not a whole number >= 0");
  return value.get<std::uint64_t>();
}

std::vector<double> StrictObject::numbers(const std::string& key) {
  const Json& value = take(key);
  if (!value.is_array()) fail(key, "not a list of numbers");
  std::vector<double> result;
  for (const Json& item : value) {
    if (!item.is_number()) fail(key, "not a list of numbers");
    result.push_back(item.get<double>());
  }
  return result;
}

std::vector<std::uint64_t> StrictObject::counts(const std::string& key) {
  const Json& value = take(key);
  if (!value.is_array()) fail(key, "not a list of whole numbers");
  std::vector<std::uint64_t> result;
  for (const Json& item : value) {
    if (!item.is_number_unsigned()) fail(key, "not a list of whole numbers");
    result.push_back(item.get<std::uint64_t>());
  }
  return result;
}

std::vector<StrictObject> StrictObject::objects(const std::string& key) {
  const Json& value = take(key);
  if (!value.is_array()) fail(key, "not a list of objects");
  std::vector<StrictObject> result;
  for (std::size_t i = 0; i < value.size(); ++i) {
    result.emplace_back(value[i], where_ + ": " + key + " " + std::to_string(i));
  }
  return result;
}

std::vector<std::string> StrictObject::texts(const std::string& key) {
  const Json& value = take(key);
  if (!value.is_array()) fail(key, "not a list of texts");
  std::vector<std::string> result;
  for (const Json& item : value) {
    if (!item.is_string()) fail(key, "not a list of texts");
    result.push_back(item.get<std::string>());
  }
  return result;
}

std::map<std::string, double> StrictObject::numbersByName() const {
  std::map<std::string, double> result;
  for (const auto& [key, value] : value_.items()) {
    if (!value.is_number()) fail(key, "not a number");
    result[key] = value.get<double>();
  }
  return result;
}

std::map<std::string, std::string> StrictObject::textsByName() const {
  std::map<std::string, std::string> result;
  for (const auto& [key, value] : value_.items()) {
    if (!value.is_string()) fail(key, "not a text");
    result[key] = value.get<std::string>();
  }
  return result;
}

std::string StrictObject::oneOf(const std::vector<std::string>& keys) const {
  std::string found;
  std::string all;
  int count = 0;
  for (const std::string& key : keys) {
    all += (all.empty() ? "" : ", ") + key;
    if (!has(key)) continue;
    found = key;
    ++count;
  }
  if (count != 1) throw FileError(where_ + ": needs exactly one of " + all);
  return found;
}

void StrictObject::finish() const {
  for (const auto& [key, value] : value_.items()) {
    if (taken_.count(key) == 0) fail(inQuotes(key), "unknown key");
  }
}

void StrictObject::fail(const std::string& key, const std::string& fault) const {
  throw FileError(where_ + ": " + key + ": " + fault);
}

}  // namespace fcl_prob::detail
