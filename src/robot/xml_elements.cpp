// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "robot/xml_elements.h"

#include <libxml/parser.h>
#include <libxml/parserInternals.h>

#include <algorithm>
#include <memory>
#include <mutex>

#include "fcl_prob/exceptions.h"
#include "io/file_content.h"

namespace fcl_prob::detail {
namespace {

constexpr int kDeepest = 64;
constexpr const char* kBlanks = " \t\r\n";

std::string textOf(const xmlChar* text) {
  return text == nullptr ? "" : reinterpret_cast<const char*>(text);
}

/// A parser with what it complained of first.
class XmlParser {
 public:
  XmlParser() : context_(xmlNewParserCtxt(), &xmlFreeParserCtxt), document_(nullptr, &xmlFreeDoc) {
    if (!context_) throw std::bad_alloc();
    context_->_private = this;
    context_->sax->serror = &XmlParser::complain;
    context_->sax->internalSubset = &XmlParser::refuseDocumentType;
  }

  /// \returns null if the text is not well-formed; fault() and line() then tell why
  const xmlNode* parse(const std::string& text) {
    // What is beside the rules, and no matter, must not end the parser: hence XML_PARSE_RECOVER.
    const int options = XML_PARSE_RECOVER | XML_PARSE_NONET | XML_PARSE_NOCDATA |
                        XML_PARSE_COMPACT | XML_PARSE_BIG_LINES;
    document_.reset(xmlCtxtReadMemory(context_.get(), text.data(), static_cast<int>(text.size()),
                                      nullptr, nullptr, options));
    const xmlNode* root = document_ ? xmlDocGetRootElement(document_.get()) : nullptr;
    if (root == nullptr && fault_.empty()) fault_ = "has no element";
    return fault_.empty() ? root : nullptr;
  }

  const std::string& fault() const { return fault_; }
  long line() const { return line_; }

 private:
  static XmlParser& of(void* context) {
    return *static_cast<XmlParser*>(static_cast<xmlParserCtxtPtr>(context)->_private);
  }

  /// Prefixes that are not declared and hyphens within comments, which many files have, change
  /// nothing of the elements.
  static bool isHarmless(const xmlError& error) {
    return error.level < XML_ERR_ERROR || error.domain == XML_FROM_NAMESPACE ||
           error.code == XML_ERR_HYPHEN_IN_COMMENT;
  }

  static void complain(void* context, xmlErrorPtr error) {
    if (!isHarmless(*error)) of(context).keep(error->message, error->line);
  }

  static void refuseDocumentType(void* context, const xmlChar*, const xmlChar*, const xmlChar*) {
    auto* parser = static_cast<xmlParserCtxtPtr>(context);
    of(context).keep("a document type, which no URDF or SRDF needs", parser->input->line);
    xmlStopParser(parser);
  }

  void keep(std::string fault, long line) {
    if (!fault_.empty()) return;
    fault.erase(std::find(fault.begin(), fault.end(), '\n'), fault.end());
    fault_ = fault.empty() ? "no XML" : std::move(fault);
    line_ = line;
  }

  std::unique_ptr<xmlParserCtxt, decltype(&xmlFreeParserCtxt)> context_;
  std::unique_ptr<xmlDoc, decltype(&xmlFreeDoc)> document_;
  std::string fault_;
  long line_ = 0;
};

/// Where a file begins with empty lines, lines are counted from its first one.
class XmlElements {
 public:
  XmlElements(const std::string& path, long lines_before) : path_(path), before_(lines_before) {}

  [[noreturn]] void fail(long line, const std::string& fault) const {
    throw FileError(path_ + ": line " + std::to_string(line + before_) + ": " + fault);
  }

  XmlElement elementOf(const xmlNode& node, int depth) const {
    XmlElement element;
    element.line = xmlGetLineNo(&node) + before_;
    if (depth > kDeepest) {
      fail(xmlGetLineNo(&node), "elements nested deeper than " + std::to_string(kDeepest));
    }
    setName(node, element);
    for (const xmlAttr* at = node.properties; at != nullptr; at = at->next) {
      const std::string prefix = at->ns == nullptr ? "" : textOf(at->ns->prefix) + ":";
      const std::unique_ptr<xmlChar, void (*)(xmlChar*)> value(
          xmlNodeListGetString(node.doc, at->children, 1), [](xmlChar* text) { xmlFree(text); });
      element.attributes.push_back({prefix + textOf(at->name), textOf(value.get())});
    }
    for (const xmlNode* child = node.children; child != nullptr; child = child->next) {
      if (child->type == XML_ELEMENT_NODE) {
        element.children.push_back(elementOf(*child, depth + 1));
      } else if (child->type == XML_TEXT_NODE) {
        element.has_text |= textOf(child->content).find_first_not_of(kBlanks) != std::string::npos;
      }
    }
    return element;
  }

 private:
  static void setName(const xmlNode& node, XmlElement& element) {
    element.name = textOf(node.name);
    if (node.ns != nullptr) {
      element.prefix = textOf(node.ns->prefix);
    } else if (const std::size_t colon = element.name.find(':'); colon != std::string::npos) {
      // Of a prefix that is not declared.
      element.prefix = element.name.substr(0, colon);
      element.name.erase(0, colon + 1);
    }
    const bool declared = node.ns != nullptr && !element.prefix.empty() &&
                          textOf(node.ns->href).find("xacro") != std::string::npos;
    element.of_xacro = element.prefix == "xacro" || declared;
  }

  const std::string& path_;
  long before_;
};

/// None of which text has but tabs and ends of lines.
bool isControlCharacter(char c) {
  if (c == '\t' || c == '\n' || c == '\r') return false;
  const auto code = static_cast<unsigned char>(c);
  return code < ' ' || code == 0x7f;
}

}  // namespace

const std::string* XmlElement::attribute(const std::string& wanted) const {
  const auto is_it = [&](const XmlAttribute& one) { return one.name == wanted; };
  const auto found = std::find_if(attributes.begin(), attributes.end(), is_it);
  return found == attributes.end() ? nullptr : &found->value;
}

XmlElement readRobotXml(std::string text, const std::string& name, const std::string& what) {
  if (text.size() > kMostXmlBytes) {
    throw FileError(name + ": more than " + std::to_string(kMostXmlBytes) + " bytes");
  }
  const auto control = std::find_if(text.begin(), text.end(), isControlCharacter);
  if (control != text.end()) {
    throw FileError(name + ": a control character, character " +
                    std::to_string(control - text.begin()));
  }
  // Before its declaration XML may have nothing, but files do.
  const std::size_t begin = std::min(text.find_first_not_of(kBlanks), text.size());
  const auto first = text.begin() + static_cast<std::ptrdiff_t>(begin);
  const XmlElements elements(name, std::count(text.begin(), first, '\n'));
  text.erase(text.begin(), first);
  static std::once_flag once;
  std::call_once(once, &xmlInitParser);
  if (text.empty()) throw FileError(name + ": no " + what + ": is empty");
  XmlParser parser;
  const xmlNode* root = parser.parse(text);
  if (root == nullptr) elements.fail(parser.line(), "no " + what + ": " + parser.fault());
  XmlElement robot = elements.elementOf(*root, 1);
  if (robot.name != "robot" || robot.of_xacro) {
    elements.fail(xmlGetLineNo(root),
                  "no " + what + ": its element is " + robot.fullName() + ", not robot");
  }
  return robot;
}

XmlElement readSrdf(const std::string& path, const std::string& robot) {
  XmlElement root = readRobotXml(fileContent(path, kMostXmlBytes), path, "SRDF");
  const std::string* name = root.attribute("name");
  if (name == nullptr || *name != robot) {
    throw FileError(path + ": robot: its name is " + (name == nullptr ? "" : *name) + ", not " +
                    robot);
  }
  for (const XmlElement& element : root.children) {
    if (!element.of_xacro) continue;
    throw FileError(path + ": line " + std::to_string(element.line) + ": the element " +
                    element.fullName() + ": xacro has not been run on this file");
  }
  return root;
}

}  // namespace fcl_prob::detail
