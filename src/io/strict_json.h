// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// JSON of which every key must be known, once, and of the right kind.
#pragma once

#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

namespace fcl_prob::detail {

/// Parses a whole file. \throws FileError if it is not JSON or an object has a key twice.
nlohmann::json parseJsonFile(const std::string& path);

/// The same of a text. \param where  how messages begin
nlohmann::json parseJson(const std::string& content, const std::string& where);

/// One object of the document. Ask for what may be in it, then call finish().
/// Every member throws FileError "file: key: fault".
class StrictObject {
 public:
  /// \param where  "file.json: a" for the object at key a
  StrictObject(const nlohmann::json& value, std::string where);

  bool has(const std::string& key) const { return value_.contains(key); }
  bool holdsObject(const std::string& key) const { return has(key) && value_[key].is_object(); }
  bool holdsText(const std::string& key) const { return has(key) && value_[key].is_string(); }

  /// The object at `key`, which must be there.
  StrictObject object(const std::string& key);

  std::string text(const std::string& key);
  bool boolean(const std::string& key);
  double number(const std::string& key);
  std::uint64_t count(const std::string& key);
  std::vector<double> numbers(const std::string& key);
  std::vector<std::uint64_t> counts(const std::string& key);

  /// Lists of objects and texts, and what an object with keys of its own holds at each of them.
  std::vector<StrictObject> objects(const std::string& key);
  std::vector<std::string> texts(const std::string& key);
  std::map<std::string, double> numbersByName() const;
  std::map<std::string, std::string> textsByName() const;

  /// The key among `keys` that is there. Exactly one must be.
  std::string oneOf(const std::vector<std::string>& keys) const;

  /// \throws FileError if there is a key that nobody has asked for.
  void finish() const;

  [[noreturn]] void fail(const std::string& key, const std::string& fault) const;

 private:
  const nlohmann::json& take(const std::string& key);

  const nlohmann::json& value_;
  std::string where_;
  std::set<std::string> taken_;
};

}  // namespace fcl_prob::detail
