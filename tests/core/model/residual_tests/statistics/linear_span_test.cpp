#include "core/model/residual_tests/statistics/linear_span.hpp"

#include <array>
#include <gtest/gtest.h>

#include "tests/core/model/residual_tests/loops.hpp"

namespace loopscope::core::model {
namespace {

using tests::Series;
using tests::White;

constexpr std::size_t kSamples = 700;

double length(const Series& signal) {
  return Eigen::Map<const Eigen::VectorXd>(signal.data(), static_cast<long>(signal.size())).norm();
}

class TheSpan : public testing::Test {
 protected:
  TheSpan() {
    first.add(old, std::array{0});
    second.add(more, std::array{0});
    second.add(old, std::array{0});  // known already
    for (std::size_t k = 0; k < kSamples; ++k) near[k] += 1e-4 * more[kSamples - 1 - k];
    second.add(near, std::array{0});
  }
  const Series old = tests::white(White::gaussian, kSamples, 1);
  const Series more = tests::white(White::laplace, kSamples, 2);
  Series near = old;
  Eigen::ArrayXd recorded = Eigen::ArrayXd::Ones(static_cast<long>(kSamples));
  LaggedColumns first{kSamples}, second{kSamples};
};

TEST_F(TheSpan, GrowsByWhatIsNew) {
  const LinearSpan span(LinearSpan(first, recorded), second, recorded);
  EXPECT_EQ(span.columns(), 5);
  EXPECT_EQ(span.rank(), 4) << "a constant, old, more and what is near old";
  for (const Series& signal : {old, more, near})
    EXPECT_LT(span.without(signal).norm(), 1e-7 * length(signal));
}

TEST_F(TheSpan, LeavesWhatIsAtRightAnglesToIt) {
  const LinearSpan span(first, recorded);
  const Eigen::VectorXd left = span.without(more);
  EXPECT_LT((span.rows({0, kSamples}).transpose() * left).cwiseAbs().maxCoeff(), 1e-9);
  EXPECT_LT(left.norm(), length(more));
}

TEST_F(TheSpan, SeesOnlyWhatIsRecorded) {
  Series gappy = more;
  for (Eigen::Index k = 100; k < 200; ++k) {
    recorded[k] = 0.0;
    gappy[static_cast<std::size_t>(k)] = 0.0;
  }
  const LinearSpan span(first, recorded);
  EXPECT_EQ(span.rank(), 2);
  EXPECT_EQ(span.without(gappy).segment(100, 100).norm(), 0.0);
}

TEST_F(TheSpan, OfNothingRecordedIsEmpty) {
  recorded.setZero();
  const LinearSpan span(first, recorded);
  EXPECT_EQ(span.rank(), 0);
  EXPECT_EQ(span.without(Series(kSamples, 0.0)).norm(), 0.0);
}

}  // namespace
}  // namespace loopscope::core::model
