// The figures that another implementation computed from the same samples, to 1e-9 relative.

#include <algorithm>
#include <cmath>
#include <fstream>
#include <gtest/gtest.h>
#include <iterator>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "core/hos/analyse.hpp"
#include "core/hos/bicoherence/bicoherence.hpp"
#include "tests/core/hos/reference_figures.hpp"
#include "tests/support/source_dir.hpp"

namespace loopscope::core::hos {
namespace {

using tests::kReferenceBins;
using tests::kReferenceFigures;
using tests::ReferenceFigures;

std::map<std::string, std::vector<double>, std::less<>> read_columns(std::istream& csv) {
  std::string line;
  std::getline(csv, line);
  std::erase(line, '\r');
  std::vector<std::string> names;
  std::istringstream header(line);
  for (std::string name; std::getline(header, name, ',');) {
    names.push_back(name);
  }
  std::map<std::string, std::vector<double>, std::less<>> columns;
  while (std::getline(csv, line)) {
    std::istringstream row(line);
    for (const std::string& name : names) {
      std::string cell;
      std::getline(row, cell, ',');
      columns[name].push_back(std::stod(cell));
    }
  }
  return columns;
}

class HosReference : public testing::TestWithParam<ReferenceFigures> {
 protected:
  void SetUp() override {
    std::ifstream csv(loopscope::tests::shared_dir() / "reference" / "signals.csv");
    if (!csv) {
      GTEST_SKIP() << "no reference/signals.csv in " << loopscope::tests::shared_dir();
    }
    const auto columns = read_columns(csv);
    const auto column = columns.find(GetParam().signal);
    ASSERT_NE(column, columns.end());
    signal_ = column->second;
  }

  std::vector<double> signal_;
};

void expect_relative(double value, double expected, const char* what) {
  EXPECT_NEAR(value, expected, 1e-9 * std::abs(expected)) << what;
}

TEST_P(HosReference, IndicesMatch) {
  const ReferenceFigures& expected = GetParam();
  const auto result = analyse(signal_, Settings{});
  ASSERT_TRUE(result.has_value());
  EXPECT_EQ(result->segments, expected.segments);
  EXPECT_EQ(result->bifrequencies, expected.bifrequencies);
  expect_relative(result->mean_bic2, expected.mean_bic2, "mean_bic2");
  expect_relative(result->std_bic2, expected.std_bic2, "std_bic2");
  expect_relative(result->max_bic2, expected.max_bic2, "max_bic2");
  expect_relative(result->critical_mean_bic2, expected.critical_mean_bic2, "critical_mean_bic2");
  expect_relative(result->ngi, expected.ngi, "ngi");
  expect_relative(result->nli, expected.nli, "nli");
}

TEST_P(HosReference, SquaredBicoherencesMatch) {
  const ReferenceFigures& expected = GetParam();
  Bicoherence bicoherence{Settings{}};
  const auto bic2 = bicoherence.estimate(signal_);
  ASSERT_EQ(bic2.size(), expected.bifrequencies);
  for (std::size_t i = 0; i < kReferenceBins.size(); ++i) {
    expect_relative(bic2[bicoherence.domain().index(kReferenceBins[i])], expected.bic2[i], "bic2");
  }
  const auto largest = std::max_element(bic2.begin(), bic2.end());
  const auto at = static_cast<std::size_t>(std::distance(bic2.begin(), largest));
  EXPECT_EQ(bicoherence.domain().at(at), expected.argmax);
}

INSTANTIATE_TEST_SUITE_P(Signals, HosReference, testing::ValuesIn(kReferenceFigures),
                         [](const auto& figures) { return std::string(figures.param.signal); });

}  // namespace
}  // namespace loopscope::core::hos
