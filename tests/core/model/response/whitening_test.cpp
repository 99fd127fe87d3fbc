#include "core/model/response/whitening.hpp"

#include <algorithm>
#include <gtest/gtest.h>

#include "tests/core/model/model_records.hpp"

namespace loopscope::core::model {
namespace {

/// Alone, in pairs, and with one over; in place or not.
TEST(Whitening, IsThatOfEachSignalAlone) {
  const NoiseModel noise{2, {0.97, 0.5, 0.0}, {-0.6, 0.2, 0.0}};
  for (const std::size_t count : {1U, 2U, 5U}) {
    std::vector<tests::Series> signals, expected;
    Whitening whitening;
    for (std::size_t i = 0; i < count; ++i) signals.push_back(tests::white_noise(300, i));
    for (tests::Series& signal : signals) {
      expected.push_back(tests::Series(signal.size()));
      whiten(noise, signal, expected.back());
      whitening.add(signal, signal);
    }
    whitening.run(noise);
    EXPECT_EQ(signals, expected);
  }
}

TEST(Whitening, OfASignalThatComesASampleLaterIsASampleLater) {
  const NoiseModel noise{1, {0.9, 0.0, 0.0}, {-0.3, 0.0, 0.0}};
  const tests::Series signal = tests::white_noise(200, 1);
  tests::Series later(200), whitened(200), expected(200), result(200);
  put_later(signal, later);
  whiten(noise, later, expected);
  whiten(noise, signal, whitened);
  put_later(whitened, result);
  for (std::size_t k = 0; k < 200; ++k) EXPECT_NEAR(result[k], expected[k], 1e-12);
  put_later({}, {});
}

/// What sits in one place: as if it had been whitened whole, and nothing once it is forgotten.
TEST(Whitening, OfASignalInOnePlaceEndsSoonAfterIt) {
  constexpr std::size_t kSamples = 2000, kFirst = 701, kEnd = 803;
  const NoiseModel noise{2, {0.97, 0.5, 0.0}, {-0.6, 0.2, 0.0}};
  const std::size_t forgotten = kEnd + whitening_memory(noise);
  ASSERT_LT(forgotten, kSamples);
  std::vector<tests::Series> signals(3, tests::Series(kSamples));
  std::vector<tests::Series> results(3, tests::Series(kSamples, 1.0));
  Whitening whitening;
  for (std::size_t i = 0; i < signals.size(); ++i) {
    const tests::Series part = tests::white_noise(kEnd - kFirst, i);
    std::ranges::copy(part, signals[i].begin() + kFirst);
    whitening.add(signals[i], results[i]);
  }
  whitening.run(noise);
  for (std::size_t i = 0; i < signals.size(); ++i) {
    tests::Series whole(kSamples);
    whiten(noise, signals[i], whole);
    for (std::size_t k = 0; k < kSamples; ++k) EXPECT_NEAR(results[i][k], whole[k], 1e-15) << k;
    EXPECT_EQ(results[i][kFirst - 1], 0.0);
    EXPECT_EQ(results[i][forgotten], 0.0);
  }
}

TEST(Whitening, OfSilenceIsSilence) {
  const tests::Series silence(50, 0.0);
  tests::Series result(50, 1.0);
  Whitening whitening;
  whitening.add(silence, result);
  whitening.run(NoiseModel{});
  EXPECT_EQ(result, silence);
}

}  // namespace
}  // namespace loopscope::core::model
