#include "core/model/fit/load_signatures.hpp"

#include <gtest/gtest.h>

#include "tests/core/model/model_records.hpp"

namespace loopscope::core::model {
namespace {

using tests::kNoise;

Structure lagged() {
  Structure structure = tests::structure_of(tests::one_lag(0.8, 3));
  structure.noise = kNoise;
  return structure;
}

/// White noise of deviation one with the mark of a load of eight at each of the places.
tests::Series marked(const LoadSignature& mark, const std::vector<std::size_t>& places) {
  tests::Series innovations = tests::white_noise(2000, 3);
  for (const std::size_t at : places) {
    for (std::size_t j = 0; j < mark.size(); ++j) innovations[at + j] += 8.0 * mark[j];
  }
  return innovations;
}

TEST(LoadSignatures, StartAtTheLoadsOwnSample) {
  EXPECT_EQ(output_load_signature(kNoise).front(), 1.0);
  // One lag of pole 0.8 lets a fifth of it through at once.
  EXPECT_NEAR(input_load_signature(lagged()).front(), 0.2, 1e-12);
}

TEST(LoadSignatures, AreFoundWhereTheyAre) {
  const std::vector<std::size_t> truth = {300, 900, 1500};
  for (const LoadSignature& mark :
       {output_load_signature(kNoise), input_load_signature(lagged())}) {
    std::vector<std::size_t> found = places_of(mark, marked(mark, truth));
    std::ranges::sort(found);
    ASSERT_EQ(found.size(), truth.size());
    for (std::size_t i = 0; i < truth.size(); ++i)
      EXPECT_NEAR(static_cast<double>(found[i]), static_cast<double>(truth[i]), 3.0);
  }
}

TEST(LoadSignatures, NothingIsFoundInNothing) {
  EXPECT_TRUE(places_of(output_load_signature(kNoise), tests::Series(500, 0.0)).empty());
  EXPECT_TRUE(places_of(output_load_signature(kNoise), {}).empty());
  EXPECT_TRUE(places_of(output_load_signature(kNoise), tests::Series(30, 1.0)).empty());
}

}  // namespace
}  // namespace loopscope::core::model
