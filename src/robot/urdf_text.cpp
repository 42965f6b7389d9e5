// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "robot/urdf_text.h"

#include <console_bridge/console.h>
#include <urdf_parser/urdf_parser.h>

#include <mutex>

#include "fcl_prob/exceptions.h"
#include "io/file_content.h"

namespace fcl_prob::detail {
namespace {

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

// Behind the end of a tag that starts at `from`; quoted values may contain a '>'.
std::size_t endOfTag(const std::string& text, std::size_t from) {
  char quote = 0;
  for (std::size_t i = from; i < text.size(); ++i) {
    const char c = text[i];
    if (quote != 0) {
      if (c == quote) quote = 0;
    } else if (c == '"' || c == '\'') {
      quote = c;
    } else if (c == '>') {
      return i + 1;
    }
  }
  return text.size();
}

std::size_t behind(const std::string& text, const char* end, std::size_t from) {
  const std::size_t found = text.find(end, from);
  return found == std::string::npos ? text.size() : found + std::char_traits<char>::length(end);
}

}  // namespace

void checkXmlText(const std::string& text, const std::string& path) {
  int depth = 0;
  for (std::size_t i = text.find('<'); i < text.size(); i = text.find('<', i)) {
    if (text.compare(i, 4, "<!--") == 0) {
      i = behind(text, "-->", i);
    } else if (text.compare(i, 2, "<?") == 0) {
      i = behind(text, "?>", i);
    } else if (text.compare(i, 2, "<!") == 0) {
      throw FileError(path + ": a document type or CDATA, which no URDF or SRDF needs");
    } else {
      const std::size_t end = endOfTag(text, i);
      if (text.compare(i, 2, "</") == 0) {
        --depth;
      } else if (text[end - 2] != '/' && ++depth > kDeepest) {
        throw FileError(path + ": elements nested deeper than " + std::to_string(kDeepest));
      }
      i = end;
    }
  }
}

urdf::ModelInterfaceSharedPtr parseUrdf(const std::string& path) {
  const std::string text = fileContent(path, kMostXmlBytes);
  checkXmlText(text, path);
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
  if (model->links_.size() > kMostLinks) {
    throw FileError(path + ": " + std::to_string(model->links_.size()) + " links, at most " +
                    std::to_string(kMostLinks));
  }
  return model;
}

}  // namespace fcl_prob::detail
