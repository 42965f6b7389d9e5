// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "cli/gnuplot.h"

#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <optional>

#include "cli/output.h"
#include "fcl_prob/exceptions.h"

namespace fcl_prob::cli {
namespace {

class ScriptFile {
 public:
  explicit ScriptFile(const std::string& script)
      : path_((std::filesystem::temp_directory_path() / "fcl_prob_plot_XXXXXX").string()) {
    const int descriptor = ::mkstemp(path_.data());
    if (descriptor < 0) throw FileError(path_ + ": cannot be created");
    const detail::FileDescriptor file(descriptor);
    try {
      detail::writeAll(descriptor, script, path_);
    } catch (...) {
      ::unlink(path_.c_str());
      throw;
    }
  }
  ~ScriptFile() { ::unlink(path_.c_str()); }
  ScriptFile(const ScriptFile&) = delete;
  ScriptFile& operator=(const ScriptFile&) = delete;
  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

bool installed() { return std::system("command -v gnuplot >/dev/null 2>&1") == 0; }

std::optional<std::string> terminalOf(const std::string& path) {
  const std::string extension = std::filesystem::path(path).extension().string();
  if (extension == ".svg") return "svg size 1200,500 dynamic background rgb 'white'";
  if (extension == ".png") return "pngcairo size 1200,500";
  return std::nullopt;
}

}  // namespace

void validatePlotPath(const std::string& path) {
  if (path.empty() || terminalOf(path)) return;
  throw InvalidRequest("--plot: the file name must end in .svg or .png");
}

void writePlot(const std::string& script, const std::string& path) {
  if (script.empty()) {
    std::cerr << "fcl_prob: no plot: there is nothing to draw\n";
    return;
  }
  if (!installed()) {
    std::cerr << "fcl_prob: no plot: gnuplot is not installed (package gnuplot-nox)\n";
    return;
  }
  const ScriptFile file("set terminal " + terminalOf(path).value() + " noenhanced\nset output\n" +
                        script);
  std::FILE* pipe = ::popen(("gnuplot '" + file.path() + "' 2>/dev/null").c_str(), "r");
  if (pipe == nullptr) throw FileError(path + ": gnuplot could not be started");
  std::string plot;
  std::array<char, 65536> buffer{};
  for (std::size_t count; (count = std::fread(buffer.data(), 1, buffer.size(), pipe)) > 0;) {
    plot.append(buffer.data(), count);
  }
  if (::pclose(pipe) != 0 || plot.empty()) throw FileError(path + ": gnuplot failed");
  writeFile(path, plot);
}

}  // namespace fcl_prob::cli
