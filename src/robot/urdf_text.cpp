// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "robot/urdf_text.h"

#include <console_bridge/console.h>
#include <urdf_parser/urdf_parser.h>

#include <algorithm>
#include <boost/property_tree/ptree.hpp>
#include <boost/property_tree/xml_parser.hpp>
#include <mutex>
#include <nlohmann/json.hpp>
#include <sstream>

#include "fcl_prob/exceptions.h"
#include "io/file_content.h"

namespace fcl_prob::detail {
namespace {

using boost::property_tree::ptree;

constexpr int kDeepest = 64;
constexpr std::size_t kMostLinks = 1000;

/// Keeps what urdfdom says in place of an exception. Its log belongs to the whole process, so that
/// readers take turns.
class UrdfMessages : public console_bridge::OutputHandler {
 public:
  UrdfMessages() : lock_(mutex()) { console_bridge::useOutputHandler(this); }
  ~UrdfMessages() override { console_bridge::restorePreviousOutputHandler(); }
  UrdfMessages(const UrdfMessages&) = delete;
  UrdfMessages& operator=(const UrdfMessages&) = delete;

  void log(const std::string& text, console_bridge::LogLevel level, const char*, int) override {
    if (level >= console_bridge::CONSOLE_BRIDGE_LOG_ERROR && first_.empty()) first_ = text;
  }

  const std::string& first() const { return first_; }

 private:
  static std::mutex& mutex() {
    static std::mutex shared;
    return shared;
  }

  std::lock_guard<std::mutex> lock_;
  std::string first_;
};

/// The elements of a text, as far as they can be told apart without doubt: parsers recurse into
/// them.
class XmlElements {
 public:
  XmlElements(const std::string& text, const std::string& path) : text_(text), path_(path) {}

  void check() {
    for (std::size_t i = text_.find('<'); i < text_.size(); i = text_.find('<', i)) {
      if (startsWith("<!--", i)) {
        i = behind("-->", i + 4);
      } else if (startsWith("<?", i)) {
        i = behind("?>", i + 2);
      } else if (startsWith("<!", i)) {
        throw FileError(path_ + ": a document type or CDATA, which no URDF or SRDF needs");
      } else {
        i = startsWith("</", i) ? behindClosing(i) : behindOpening(i);
      }
    }
  }

 private:
  bool startsWith(const char* what, std::size_t at) const {
    return text_.compare(at, std::char_traits<char>::length(what), what) == 0;
  }

  [[noreturn]] void fail(const std::string& what, std::size_t at) const {
    throw FileError(path_ + ": " + what + ", character " + std::to_string(at));
  }

  std::size_t behind(const char* end, std::size_t from) const {
    const std::size_t found = text_.find(end, from);
    if (found == std::string::npos) fail(std::string("no '") + end + "' ends what begins", from);
    return found + std::char_traits<char>::length(end);
  }

  std::size_t behindClosing(std::size_t from) {
    const std::size_t end = text_.find_first_of("\"'<>", from + 2);
    if (end == std::string::npos || text_[end] != '>') fail("a closing tag without an end", from);
    if (--depth_ < 0) fail("a closing tag without an element", from);
    return end + 1;
  }

  /// Values may contain a '>'; quotes are theirs only.
  std::size_t behindOpening(std::size_t from) {
    for (std::size_t i = from + 1; i < text_.size(); ++i) {
      const char c = text_[i];
      if (c == '>') {
        if (text_[i - 1] != '/' && ++depth_ > kDeepest) {
          fail("elements nested deeper than " + std::to_string(kDeepest), from);
        }
        return i + 1;
      }
      if (c == '<') break;
      if (c != '"' && c != '\'') continue;
      const std::size_t before = text_.find_last_not_of(" \t\r\n", i - 1);
      if (text_[before] != '=') fail("a quote that begins no value", i);
      i = behind(c == '"' ? "\"" : "'", i + 1) - 1;
    }
    fail("a tag without an end", from);
  }

  const std::string& text_;
  const std::string& path_;
  int depth_ = 0;
};

/// None of which text has but tabs and ends of lines.
bool isControlCharacter(char c) {
  if (c == '\t' || c == '\n' || c == '\r') return false;
  const auto code = static_cast<unsigned char>(c);
  return code < ' ' || code == 0x7f;
}

std::size_t elementsOf(const ptree& parent) {
  std::size_t count = 0;
  for (const auto& child : parent) count += child.first != "<xmlattr>";
  return count;
}

/// urdfdom takes some of its messages, in which values of attributes are, for formats of printf;
/// names of files are in none of these.
void requireNoFormat(const ptree& parent, const std::string& path) {
  for (const auto& [tag, child] : parent) {
    if (tag != "<xmlattr>") {
      requireNoFormat(child, path);
      continue;
    }
    for (const auto& [name, value] : child) {
      if (name == "filename" || value.data().find('%') == std::string::npos) continue;
      throw FileError(path + ": " + name + ": a '%', which only names of files may have");
    }
  }
}

/// urdfdom reads the first geometry of a collision element and the first shape of a geometry, and
/// drops a link's other elements where one of them is wrong: what it leaves out could collide.
void requireAllRead(const ptree& document, const urdf::ModelInterface& model,
                    const std::string& path) {
  for (const auto& [tag, element] : document.get_child("robot")) {
    if (tag != "link") continue;
    const std::string name = element.get("<xmlattr>.name", "");
    const std::string where = path + ": link " + name + ": collision ";
    std::size_t collisions = 0;
    for (const auto& [child_tag, collision] : element) {
      if (child_tag != "collision") continue;
      const std::string which = where + std::to_string(collisions++);
      if (collision.count("geometry") != 1) {
        throw FileError(which + ": " + std::to_string(collision.count("geometry")) +
                        " geometries, must be one");
      }
      const std::size_t shapes = elementsOf(collision.get_child("geometry"));
      if (shapes != 1) {
        throw FileError(which + ": its geometry has " + std::to_string(shapes) +
                        " shapes, must be one");
      }
    }
    const auto link = model.links_.find(name);
    if (link == model.links_.end() || link->second->collision_array.size() != collisions) {
      throw FileError(path + ": link " + name + ": not all of its " + std::to_string(collisions) +
                      " collision elements could be read");
    }
  }
}

}  // namespace

void checkXmlText(const std::string& text, const std::string& path) {
  const auto control = std::find_if(text.begin(), text.end(), isControlCharacter);
  if (control != text.end()) {
    throw FileError(path + ": a control character, character " +
                    std::to_string(control - text.begin()));
  }
  // Names go into answers in JSON, where nothing else may stand.
  try {
    nlohmann::json(text).dump();
  } catch (const nlohmann::json::type_error&) {
    throw FileError(path + ": is not UTF-8");
  }
  XmlElements(text, path).check();
}

boost::property_tree::ptree parseXml(const std::string& text, const std::string& path,
                                     const std::string& what) {
  checkXmlText(text, path);
  std::istringstream stream(text);
  ptree document;
  try {
    read_xml(stream, document, boost::property_tree::xml_parser::no_comments);
  } catch (const boost::property_tree::xml_parser_error& error) {
    throw FileError(path + ": no " + what + ": " + error.message() + " in line " +
                    std::to_string(error.line()));
  }
  // Of several, urdfdom reads the first one and says nothing of the others.
  const std::size_t robots = document.count("robot");
  if (robots == 0) throw FileError(path + ": no " + what + ": has no element robot");
  if (robots > 1) throw FileError(path + ": more than one element robot");
  return document;
}

urdf::ModelInterfaceSharedPtr parseUrdf(const std::string& path) {
  const std::string text = fileContent(path, kMostXmlBytes);
  const ptree document = parseXml(text, path, "URDF");
  requireNoFormat(document, path);
  UrdfMessages messages;
  urdf::ModelInterfaceSharedPtr model;
  try {
    model = urdf::parseURDF(text);
  } catch (const std::exception& error) {
    throw FileError(path + ": " + error.what());
  }
  if (!model || !model->getRoot()) {
    throw FileError(path + ": no URDF" + (messages.first().empty() ? "" : ": " + messages.first()));
  }
  // It goes on without the element that it complains of.
  if (!messages.first().empty()) throw FileError(path + ": " + messages.first());
  if (model->links_.size() > kMostLinks) {
    throw FileError(path + ": " + std::to_string(model->links_.size()) + " links, at most " +
                    std::to_string(kMostLinks));
  }
  requireAllRead(document, *model, path);
  return model;
}

}  // namespace fcl_prob::detail
