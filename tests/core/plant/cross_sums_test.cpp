#include "core/plant/cross_sums.hpp"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <random>

namespace loopscope::core::plant {
namespace {

using Complex = std::complex<double>;

Envelope draw_envelope(std::int64_t first, std::size_t size, double missing,
                       std::mt19937_64& random) {
  std::normal_distribution<double> normal;
  std::bernoulli_distribution gap(missing);
  constexpr double kMissing = std::numeric_limits<double>::quiet_NaN();
  Envelope envelope;
  envelope.frequency_hz = 0.01;
  envelope.first = first;
  for (std::size_t k = 0; k < size; ++k)
    envelope.points.emplace_back(gap(random) ? Complex(kMissing, kMissing)
                                             : Complex(normal(random), normal(random)));
  return envelope;
}

/// By their definitions, point by point.
EnvelopeSums plain_sums(const Envelope& z, const Envelope& r) {
  const auto known = [&](std::int64_t j) {
    return std::isfinite(z.at(j).real()) && std::isfinite(r.at(j).real());
  };
  EnvelopeSums sums;
  for (std::int64_t j = std::min(z.first, r.first); j < std::max(z.end(), r.end()); ++j) {
    if (!known(j)) continue;
    PointSums& points = sums.points;
    points.zr += z.at(j) * std::conj(r.at(j));
    points.zz += std::norm(z.at(j)), points.rr += std::norm(r.at(j));
    ++points.count;
    if (!known(j - 1)) continue;
    CrossSums& pairs = sums.pairs;
    pairs.zz += std::norm(z.at(j)), pairs.rr += std::norm(r.at(j));
    pairs.zz1 += std::norm(z.at(j - 1)), pairs.rr1 += std::norm(r.at(j - 1));
    pairs.zr += z.at(j) * std::conj(r.at(j));
    pairs.zr1 += z.at(j - 1) * std::conj(r.at(j - 1));
    pairs.z_z1 += z.at(j) * std::conj(z.at(j - 1));
    pairs.r_r1 += r.at(j) * std::conj(r.at(j - 1));
    pairs.z_r1 += z.at(j) * std::conj(r.at(j - 1));
    pairs.r_z1 += r.at(j) * std::conj(z.at(j - 1));
    ++pairs.count;
  }
  return sums;
}

void expect_near(Complex one, Complex other) {
  EXPECT_NEAR(std::abs(one - other), 0.0, 1e-11);
}

void expect_same(const EnvelopeSums& one, const EnvelopeSums& other) {
  EXPECT_EQ(one.points.count, other.points.count);
  EXPECT_NEAR(one.points.zz, other.points.zz, 1e-11);
  EXPECT_NEAR(one.points.rr, other.points.rr, 1e-11);
  expect_near(one.points.zr, other.points.zr);
  EXPECT_EQ(one.pairs.count, other.pairs.count);
  EXPECT_NEAR(one.pairs.zz, other.pairs.zz, 1e-11);
  EXPECT_NEAR(one.pairs.rr, other.pairs.rr, 1e-11);
  EXPECT_NEAR(one.pairs.zz1, other.pairs.zz1, 1e-11);
  EXPECT_NEAR(one.pairs.rr1, other.pairs.rr1, 1e-11);
  expect_near(one.pairs.zr, other.pairs.zr);
  expect_near(one.pairs.zr1, other.pairs.zr1);
  expect_near(one.pairs.z_z1, other.pairs.z_z1);
  expect_near(one.pairs.r_r1, other.pairs.r_r1);
  expect_near(one.pairs.z_r1, other.pairs.z_r1);
  expect_near(one.pairs.r_z1, other.pairs.r_z1);
}

/// Of every length modulo the lanes, with runs of one, gaps at the ends, and no point in common.
TEST(CrossSums, AreThoseOfTheirDefinition) {
  std::mt19937_64 random(17);
  for (std::size_t size = 0; size < 40; ++size)
    for (const double missing : {0.0, 0.1, 0.5, 1.0})
      for (const std::int64_t later : {-60, -7, 0, 3, 60}) {
        const Envelope z = draw_envelope(100, size, missing, random);
        const Envelope r = draw_envelope(100 + later, 40 - size / 2, missing / 2.0, random);
        SCOPED_TRACE(testing::Message() << size << ' ' << missing << ' ' << later);
        expect_same(sum_over_common(z, r), plain_sums(z, r));
      }
}

}  // namespace
}  // namespace loopscope::core::plant
