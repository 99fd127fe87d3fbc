#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <gtest/gtest.h>
#include <sstream>
#include <string>
#include <vector>

#include "tests/support/source_dir.hpp"
#include "tests/verdict/record_rows.hpp"

/// The figures that the curves were fitted to are those that this program computes.
namespace loopscope::tests::verdict {
namespace {

std::vector<std::string> cells_of(const std::string& line) {
  std::vector<std::string> cells;
  std::stringstream stream(line);
  for (std::string cell; std::getline(stream, cell, '\t');) cells.push_back(cell);
  if (!line.empty() && line.back() == '\t') cells.emplace_back();
  return cells;
}

std::vector<std::string> kept_lines() {
  std::ifstream file(source_dir() / "tests/verdict/kept_records.tsv");
  std::vector<std::string> lines;
  for (std::string line; std::getline(file, line);) lines.push_back(line);
  return lines;
}

/// Empty, or a number within 1e-6 of it.
bool same(const std::string& a, const std::string& b) {
  if (a.empty() || b.empty()) return a == b;
  const double x = std::strtod(a.c_str(), nullptr), y = std::strtod(b.c_str(), nullptr);
  return std::abs(x - y) <= 1e-6 * std::max({std::abs(x), std::abs(y), 1e-6});
}

TEST(KeptRecords, FiguresAreThoseOfTheFit) {
  const std::vector<std::string> lines = kept_lines();
  ASSERT_GE(lines.size(), 51U) << "tests/verdict/train writes them";
  const std::string now = heading();
  ASSERT_EQ(lines.front() + "\n", now) << "figures changed: run tests/verdict/train";
  const std::vector<std::string> names = cells_of(lines.front());
  constexpr std::size_t kFirstFigure = 4;
  for (std::size_t k = 1; k < lines.size(); ++k) {
    const std::vector<std::string> kept = cells_of(lines[k]);
    ASSERT_EQ(kept.size(), names.size());
    std::string row = simulated_row(std::strtoull(kept.front().c_str(), nullptr, 10));
    ASSERT_FALSE(row.empty());
    row.pop_back();
    const std::vector<std::string> found = cells_of(row);
    ASSERT_EQ(found.size(), names.size());
    for (std::size_t i = kFirstFigure; i < names.size(); ++i)
      EXPECT_TRUE(same(kept[i], found[i]))
          << "seed " << kept.front() << ", " << names[i] << ": " << kept[i] << " -> " << found[i];
  }
}

}  // namespace
}  // namespace loopscope::tests::verdict
