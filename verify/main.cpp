// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// fcl_prob_verify: checks a certificate without the library that wrote it. See FORMAT.md.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <thread>

#include "claims.h"

namespace {

using namespace verify;

struct Options {
  std::string file;
  bool quiet = false, progress = false;
  int threads = 1;
};

struct Refused : std::runtime_error {
  using std::runtime_error::runtime_error;
};

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

std::string describe(const Cell& cell, int rank) {
  std::string text;
  for (const Vec* side : {&cell.lo, &cell.hi}) {
    for (int i = 0; i < rank; ++i) {
      char number[32];
      std::snprintf(number, sizeof number, "%s%.17g", text.empty() ? "" : ", ", (*side)[i]);
      text += number;
    }
  }
  return "[" + text + "]";
}

// Checks cells by several threads; the first in the file that fails is the one reported.
void check_batch(const Scene& scene, const std::vector<Cell>& cells, std::vector<Tally>& tallies) {
  std::vector<std::string> wrong(cells.size());
  std::atomic<std::size_t> next{0};
  std::atomic<bool> failed{false};
  const auto work = [&](Tally& tally) {
    Ball::bits = scene.frame.bits;
    for (std::size_t i = next++; i < cells.size() && !failed; i = next++) {
      wrong[i] = check_cell(scene, cells[i], tally);
      if (!wrong[i].empty()) failed = true;
    }
  };
  std::vector<std::thread> threads;
  for (std::size_t t = 1; t < tallies.size(); ++t) {
    threads.emplace_back([&, t] {
      work(tallies[t]);
      flint_cleanup();
    });
  }
  work(tallies[0]);
  for (std::thread& thread : threads) thread.join();
  for (std::size_t i = 0; i < cells.size(); ++i) {
    if (wrong[i].empty()) continue;
    throw Refused("line " + std::to_string(cells[i].line) + ", cell " +
                  describe(cells[i], scene.frame.rank) + ": " + wrong[i]);
  }
}

// The bounds that the claims prove, rounded outwards.
struct Bounds {
  double lower, upper;
};

Bounds add_up(const std::vector<Tally>& tallies) {
  const Precision precision(tallies[0].bits);
  Ball contact, cells, undecided;
  for (const Tally& tally : tallies) {
    contact = contact + tally.contact;
    cells = cells + tally.cells;
    undecided = undecided + tally.undecided;
  }
  // A ball's radius may reach beyond what any probability is.
  return {std::max(contact.outward(-1), 0.0),
          std::min((Ball(1) - cells + undecided).outward(1), 1.0)};
}

void check_bounds(const Footer& footer, const Bounds& bounds) {
  char text[200];
  if (!(footer.lower <= bounds.lower)) {
    std::snprintf(text, sizeof text, "last line: \"lower\" is %.17g, but shown is %.17g",
                  footer.lower, bounds.lower);
    throw Refused(text);
  }
  if (!(footer.upper >= bounds.upper)) {
    std::snprintf(text, sizeof text, "last line: \"upper\" is %.17g, but shown is %.17g",
                  footer.upper, bounds.upper);
    throw Refused(text);
  }
}

// Bits for 1 - Σ μ(cell) to be known to 256 of what the last line claims of it: that line is looked
// at before its turn for this only.
slong bits_needed(std::ifstream& in) {
  in.seekg(0, std::ios::end);
  in.seekg(std::max<std::streamoff>(0, static_cast<std::streamoff>(in.tellg()) - 400));
  std::string tail((std::istreambuf_iterator<char>(in)), {});
  in.clear();
  in.seekg(0);
  const std::size_t found = tail.rfind("\"upper\":");
  const double upper =
      found == std::string::npos ? 1 : std::strtod(tail.c_str() + found + 8, nullptr);
  return 256 + (upper > 0 && upper < 1 ? static_cast<slong>(-std::log2(upper)) : 0);
}

void run(const Options& options) {
  const auto start = std::chrono::steady_clock::now();
  std::ifstream in(options.file);
  if (!in) throw std::runtime_error(options.file + ": cannot be read");
  const slong bits = bits_needed(in);
  Reader reader(in);
  reader.read_objects();
  const Scene scene(reader);

  std::vector<Tally> tallies(options.threads, Tally(bits));
  std::vector<Box> boxes;
  std::vector<Cell> batch;
  double last_told = 0;
  for (bool more = true; more;) {
    batch.emplace_back();
    more = reader.next_cell(batch.back());
    if (!more) batch.pop_back();
    if (more && batch.size() < 64 * tallies.size()) continue;
    for (const Cell& cell : batch) boxes.push_back({cell.line, cell.lo, cell.hi});
    check_batch(scene, batch, tallies);
    batch.clear();
    if (options.progress && seconds_since(start) > last_told + 1) {
      last_told = seconds_since(start);
      std::fprintf(stderr, "%zu cells, %.0f s\n", boxes.size(), last_told);
    }
  }
  if (reader.footer.cells != boxes.size()) {
    throw Malformed(boxes.empty() ? 0 : boxes.back().line + 1, "cells",
                    "is " + std::to_string(reader.footer.cells) + ", but there are " +
                        std::to_string(boxes.size()));
  }
  const auto lines = overlapping(boxes, scene.frame.rank);
  if (lines.first != 0) {
    throw Refused("line " + std::to_string(lines.second) + ": the cell overlaps that of line " +
                  std::to_string(lines.first));
  }
  const Bounds bounds = add_up(tallies);
  check_bounds(reader.footer, bounds);
  std::size_t claims = 0;
  for (const Tally& tally : tallies) claims += tally.claims;
  if (options.quiet) return;
  std::printf("verified [%.17g, %.17g]\n%zu cells, %zu claims, %.2f s\n", bounds.lower,
              bounds.upper, boxes.size(), claims, seconds_since(start));
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app(
      "Checks every claim of a certificate of fcl_prob. Exit codes: 0 verified, 1 refused, "
      "2 malformed or unreadable.");
  Options options;
  app.add_option("file", options.file, "JSON Lines, as FORMAT.md says")->required();
  app.add_flag("--quiet", options.quiet, "Print nothing where all is verified");
  app.add_flag("--progress", options.progress, "Tell every second how far it is, on stderr");
  app.add_option("--threads", options.threads, "How many to use")->check(CLI::Range(1, 256));
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  }
  try {
    run(options);
    return 0;
  } catch (const Refused& refused) {
    std::fprintf(stderr, "refused: %s\n", refused.what());
    return 1;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "malformed: %s\n", error.what());
    return 2;
  }
}
