// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// A file of results that survives being killed.
#pragma once

#include <string>

#include "io/write_file.h"
#include "sweep/pending_lines.h"

namespace fcl_prob::sweep {

/// Lines are appended as they come; when all are there they are put in order. Whoever has the file
/// open has it alone.
class ResultsFile {
 public:
  /// \param resume  take over what is there already; else nothing may be there. A last line that
  ///                has no end, as a killed run may leave it, is cut off
  /// \throws FileError if it cannot be written, another run has it open, it is there and `resume`
  ///                   is false, or it holds anything that is no result of a sweep
  ResultsFile(const std::string& path, bool resume);

  const Done& done() const { return done_; }

  /// \param record  without the end of the line \throws FileError
  void append(const std::string& record);

  /// Sorts the lines by their numbers, in a new file that takes the old one's place at once.
  void finish();

 private:
  void takeOver();

  std::string path_;
  detail::FileDescriptor descriptor_;
  Done done_;
};

}  // namespace fcl_prob::sweep
