#include "core/hos/kernels/record_sums.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <numbers>
#include <vector>

#include "core/hos/kernels/kernels.hpp"
#include "tests/core/hos/runnable_kernels.hpp"
#include "tests/core/hos/signals.hpp"
#include "tests/support/numbers.hpp"

namespace loopscope::core::hos {
namespace {

using loopscope::tests::kInfinity;
using loopscope::tests::kNaN;

/// Records of every length up to `most`, some samples missing.
template <class Check>
void for_each_record(std::size_t most, const Check& check) {
  for (const Kernels* kernels : tests::runnable_kernels()) {
    for (std::size_t length = 0; length <= most; ++length) {
      std::vector<double> record = tests::white_noise(length + 1, length);
      if (length > 9) record[length / 2] = kNaN;
      if (length > 20) record[length / 3] = -kInfinity;
      check(*kernels, record);
    }
  }
}

TEST(HosRecordSums, ScanFindsTheLargestMagnitudeAndGaps) {
  for_each_record(70, [](const Kernels& kernels, const std::vector<double>& record) {
    const MagnitudeScan found = kernels.scan(record);
    EXPECT_EQ(found.largest, largest_magnitude(record)) << kernels.name;
    EXPECT_EQ(found.complete, record.size() <= 9) << kernels.name << ' ' << record.size();
  });
}

TEST(HosRecordSums, PowersByTheDefinition) {
  const Centring centring{2.0, 0.3, -0.1, 0.0};
  for_each_record(70, [&](const Kernels& kernels, const std::vector<double>& record) {
    PowerSums expected;
    for (const double sample : record) {
      if (!std::isfinite(sample)) continue;
      const double y = sample * 2.0 - 0.3 + 0.1;
      expected.count += 1.0;
      expected.first += y;
      expected.second += y * y;
      expected.third += y * y * y;
      expected.fourth += y * y * y * y;
    }
    const PowerSums found = kernels.sum_powers(record, centring);
    EXPECT_EQ(found.count, expected.count) << kernels.name;
    EXPECT_NEAR(found.first, expected.first, 1e-12);
    EXPECT_NEAR(found.second, expected.second, 1e-12 * (1.0 + expected.second));
    EXPECT_NEAR(found.third, expected.third, 1e-12 * (1.0 + expected.fourth));
    EXPECT_NEAR(found.fourth, expected.fourth, 1e-12 * (1.0 + expected.fourth));
  });
}

TEST(HosRecordSums, TrendByTheDefinition) {
  for_each_record(70, [](const Kernels& kernels, const std::vector<double>& record) {
    TrendSums expected;
    const double middle = (static_cast<double>(record.size()) - 1.0) / 2.0;
    for (std::size_t n = 0; n < record.size(); ++n) {
      if (!std::isfinite(record[n])) continue;
      const double place = static_cast<double>(n) - middle;
      expected.count += 1.0;
      expected.place += place;
      expected.place_square += place * place;
      expected.value += record[n] - 0.5;
      expected.moment += place * (record[n] - 0.5);
    }
    const TrendSums found = kernels.sum_trend(record, {1.0, 0.5, 0.0, 0.0});
    EXPECT_EQ(found.count, expected.count) << kernels.name;
    EXPECT_EQ(found.place, expected.place) << kernels.name;
    EXPECT_EQ(found.place_square, expected.place_square) << kernels.name;
    EXPECT_NEAR(found.value, expected.value, 1e-12);
    EXPECT_NEAR(found.moment, expected.moment, 1e-11);
  });
}

TEST(HosRecordSums, TaperIsARaisedCosineOverTheRecord) {
  for_each_record(300, [](const Kernels& kernels, const std::vector<double>& record) {
    std::vector<double> found(record.size());
    kernels.taper_record(record, {2.0, 0.5, -0.25, 0.125}, found.data());
    const auto count = static_cast<double>(record.size());
    for (std::size_t n = 0; n < record.size(); ++n) {
      const double place = static_cast<double>(n) - (count - 1.0) / 2.0;
      const double turn = (static_cast<double>(n) + 0.5) / count;
      const double weight = 0.5 - 0.5 * std::cos(2.0 * std::numbers::pi * turn);
      const double expected = (record[n] * 2.0 - 0.5 + 0.25 - 0.125 * place) * weight;
      ASSERT_NEAR(found[n], std::isfinite(record[n]) ? expected : 0.0, 1e-12) << kernels.name;
    }
  });
}

TEST(HosRecordSums, DifferencesLeaveOutWhatIsMissing) {
  for_each_record(70, [](const Kernels& kernels, const std::vector<double>& record) {
    PairSums expected;
    for (std::size_t n = 2; n < record.size(); ++n) {
      const double now = record[n] - record[n - 1];
      const double before = record[n - 1] - record[n - 2];
      if (!std::isfinite(now + before)) continue;
      expected.product += now * before;
      expected.power += now * now + before * before;
    }
    const PairSums found = kernels.sum_differences(record);
    EXPECT_NEAR(found.product, expected.product, 1e-12 * (1.0 + expected.power)) << kernels.name;
    EXPECT_NEAR(found.power, expected.power, 1e-12 * (1.0 + expected.power)) << kernels.name;
  });
}

TEST(HosRecordSums, PairsAndPredictionsByTheDefinition) {
  const std::vector<double> f = tests::white_noise(1, 61);
  const std::vector<double> b = tests::white_noise(2, 61);
  const std::vector<double> a = {0.5, -0.25, 0.125};
  for (const Kernels* kernels : tests::runnable_kernels()) {
    for (std::size_t count = 0; count <= f.size(); ++count) {
      PairSums expected;
      std::vector<double> new_f = f;
      std::vector<double> new_b = b;
      for (std::size_t n = 0; n < count; ++n) {
        expected.product += f[n] * b[n];
        expected.power += f[n] * f[n] + b[n] * b[n];
      }
      kernels->predict_each_other(new_f.data(), new_b.data(), count, 0.3);
      const PairSums found = kernels->sum_pairs(f.data(), b.data(), count);
      EXPECT_NEAR(found.product, expected.product, 1e-12);
      EXPECT_NEAR(found.power, expected.power, 1e-12);
      for (std::size_t n = 0; n < f.size(); ++n) {
        ASSERT_NEAR(new_f[n], n < count ? f[n] - 0.3 * b[n] : f[n], 1e-15) << kernels->name;
        ASSERT_NEAR(new_b[n], n < count ? b[n] - 0.3 * f[n] : b[n], 1e-15) << kernels->name;
      }
      if (count < a.size()) continue;
      std::vector<double> errors(count - a.size());
      kernels->subtract_predictions(f.data() + a.size(), errors.size(), a, errors.data());
      for (std::size_t n = 0; n < errors.size(); ++n) {
        const double error = f[n + 3] - 0.5 * f[n + 2] + 0.25 * f[n + 1] - 0.125 * f[n];
        ASSERT_NEAR(errors[n], error, 1e-15) << kernels->name;
      }
    }
  }
}

TEST(HosRecordSums, TapsAndWeightedRowsByTheDefinition) {
  const std::vector<double> x = tests::white_noise(3, 50);
  const std::vector<double> columns = tests::white_noise(4, 50 * FilterTaps::kColumns);
  const AlignedVector rows(5 * 24, 0.5);
  const std::vector<double> weights = {1.0, -2.0, 3.0, 0.5, 4.0};
  for (const Kernels* kernels : tests::runnable_kernels()) {
    for (std::size_t length = 0; length <= x.size(); ++length) {
      std::vector<double> found(FilterTaps::kColumns);
      kernels->apply_taps({columns.data(), length}, x.data(), found.data());
      for (std::size_t i = 0; i < found.size(); ++i) {
        double expected = 0.0;
        for (std::size_t n = 0; n < length; ++n) expected += columns[i * length + n] * x[n];
        ASSERT_NEAR(found[i], expected, 1e-13) << kernels->name;
      }
    }
    std::vector<double> sums(16);
    kernels->weigh_rows({rows.data(), 24, 16, 5}, weights.data(), sums.data());
    for (const double sum : sums) EXPECT_EQ(sum, 0.5 * 6.5) << kernels->name;
  }
}

TEST(HosRecordSums, LagsByTheDefinition) {
  constexpr std::size_t kLags = 27;
  const std::vector<double> x = tests::white_noise(5, kLags + 40);
  for (const Kernels* kernels : tests::runnable_kernels()) {
    for (const std::size_t count : {0U, 1U, 8U, 40U}) {
      const std::vector<double> weighted = tests::white_noise(6, count);
      for (std::size_t lags = 1; lags <= kLags; ++lags) {
        std::vector<double> found(lags);
        kernels->sum_lags(weighted, x.data() + kLags, found);
        for (std::size_t l = 0; l < lags; ++l) {
          double expected = 0.0;
          for (std::size_t n = 0; n < count; ++n) expected += weighted[n] * x[kLags + n - l];
          ASSERT_NEAR(found[l], expected, 1e-13) << kernels->name;
        }
      }
    }
  }
}

}  // namespace
}  // namespace loopscope::core::hos
