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

#include "scene.h"

namespace {

using namespace verify;

struct Options {
  std::string file;
  bool quiet = false, progress = false;
  int threads = 1;
};

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

// A cell as its line has it, up to 1,000 characters.
std::string cell_text(const std::string& file, std::size_t line) {
  std::ifstream in(file);
  std::string text;
  for (std::size_t i = 0; i < line && std::getline(in, text); ++i) {
  }
  return text.substr(0, 1000);
}

// Checks cells by several threads; the first in the file that fails is the one reported.
void check_batch(const Scene& scene, const std::string& file, const std::vector<Cell>& cells,
                 std::vector<Tally>& tallies) {
  std::vector<std::string> wrong(cells.size());
  std::atomic<std::size_t> next{0};
  std::atomic<bool> failed{false};
  const auto work = [&](Tally& tally) {
    Ball::bits = scene.frame.bits;
    for (std::size_t i = next++; i < cells.size() && !failed; i = next++) {
      try {
        check_cell(scene, cells[i], tally);
      } catch (const Refused& refused) {
        wrong[i] = refused.what();
        failed = true;
      }
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
    require(wrong[i].empty(), "line " + std::to_string(cells[i].line) + ": " + wrong[i] + "\n" +
                                  cell_text(file, cells[i].line));
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

void check_bounds(const Footer& footer, const Bounds& shown, std::size_t line) {
  char text[200];
  std::snprintf(text, sizeof text, "line %zu: [%.17g, %.17g] is claimed, but [%.17g, %.17g] shown",
                line, footer.lower, footer.upper, shown.lower, shown.upper);
  require(footer.lower <= shown.lower && footer.upper >= shown.upper, text);
}

// Bits for 1 - Σ μ(cell) to be known to 256 of what the last lines claim of it: they are looked at
// before their turn for this only.
slong bits_needed(const std::string& file) {
  std::ifstream in(file);
  double least = 1;
  for (std::string line; std::getline(in, line);) {
    const std::size_t found = line.size() < 400 ? line.find("\"upper\":") : std::string::npos;
    if (found == std::string::npos) continue;
    const double upper = std::strtod(line.c_str() + found + 8, nullptr);
    if (upper > 0) least = std::min(least, upper);
  }
  return 256 - static_cast<slong>(std::log2(least));
}

struct Verified {
  Bounds bounds{};
  std::size_t cells = 0, claims = 0;

  void print(const std::string& of, double seconds) const {
    std::printf("verified [%.17g, %.17g]%s\n%zu cells, %zu claims, %.2f s\n", bounds.lower,
                bounds.upper, of.c_str(), cells, claims, seconds);
  }
};

// Of any of independent events.
Bounds bounds_of_any(const std::vector<Verified>& all) {
  const Precision precision(2400);
  Ball none_lower(1), none_upper(1);
  for (const Verified& one : all) {
    none_lower = none_lower * (Ball(1) - Ball(one.bounds.upper));
    none_upper = none_upper * (Ball(1) - Ball(one.bounds.lower));
  }
  return {std::max((Ball(1) - none_upper).outward(-1), 0.0),
          std::min((Ball(1) - none_lower).outward(1), 1.0)};
}

// Checks the next certificate of the file.
Verified check_certificate(Reader& reader, const Options& options, slong bits) {
  const auto start = std::chrono::steady_clock::now();
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
    check_batch(scene, options.file, batch, tallies);
    batch.clear();
    if (options.progress && seconds_since(start) > last_told + 1) {
      last_told = seconds_since(start);
      std::fprintf(stderr, "line %zu, %zu cells, %.0f s\n", reader.line(), boxes.size(), last_told);
    }
  }
  if (reader.footer.cells != boxes.size()) {
    throw Malformed(reader.line() - 1, "there are " + std::to_string(boxes.size()) + " cells");
  }
  const auto lines = overlapping(boxes, scene.frame.rank);
  require(lines.first == 0, "line " + std::to_string(lines.second) +
                                ": the cell overlaps that of line " + std::to_string(lines.first));
  Verified result{add_up(tallies), boxes.size(), 0};
  for (const Tally& tally : tallies) result.claims += tally.claims;
  check_bounds(reader.footer, result.bounds, reader.line() - 1);
  return result;
}

void run(const Options& options) {
  const auto start = std::chrono::steady_clock::now();
  std::ifstream in(options.file);
  if (!in) throw std::runtime_error(options.file + ": cannot be read");
  const slong bits = bits_needed(options.file);
  Reader reader(in);
  std::vector<Verified> all;
  Verified any;
  do {
    const std::size_t first = reader.line();
    all.push_back(check_certificate(reader, options, bits));
    any.cells += all.back().cells;
    any.claims += all.back().claims;
    const bool only = all.size() == 1 && !reader.more();
    if (options.quiet || only) continue;
    const std::string name = reader.header.name.empty() ? "" : " \"" + reader.header.name + "\"";
    all.back().print(
        name + " lines " + std::to_string(first) + " to " + std::to_string(reader.line() - 1),
        seconds_since(start));
  } while (reader.more());
  any.bounds = all.size() == 1 ? all[0].bounds : bounds_of_any(all);
  const std::string of = all.size() == 1 ? "" : " any of " + std::to_string(all.size());
  if (!options.quiet) any.print(of, seconds_since(start));
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
