#pragma once

#include <cmath>
#include <gtest/gtest.h>

#include "tests/core/model/model_records.hpp"

namespace loopscope::core::model::tests {

/// The greatest distance between the flows, columns included, of an effect and its neighbours.
inline double farthest_neighbour(const Effect& effect, double scale) {
  // Steps and a little noise: a valve's band and jump show apart only where op moves between them.
  const Series op = sum(sum(stepping_op(1000, 1), white_noise(1000, 2)), Series(1000, -50.0));
  const auto seen = [&](const Effect& one) {
    Series flow = op;
    one.shape_flow(flow);
    const Series response = answer(one_lag(0.6, 2), flow);
    std::vector<Column> columns{flow};
    one.add_columns({flow, response, one_lag(0.6, 2)}, columns);
    Series joint;
    for (const Column& column : columns) joint.insert(joint.end(), column.begin(), column.end());
    return joint;
  };
  const Series here = seen(effect);
  double farthest = 0.0;
  for (const EffectPtr& neighbour : effect.neighbours(scale)) {
    const Series there = seen(*neighbour);
    double square = 0.0;
    for (std::size_t k = 0; k < here.size(); ++k) square += std::pow(there[k] - here[k], 2);
    EXPECT_GT(square, 0.0) << "a neighbour is the effect itself";
    farthest = std::max(farthest, square);
  }
  return farthest;
}

/// Of the same kind, other than the effect, and nearer at a smaller scale.
inline void expect_neighbours(const Effect& effect) {
  ASSERT_FALSE(effect.neighbours(1.0).empty());
  for (const EffectPtr& neighbour : effect.neighbours(1.0)) {
    EXPECT_EQ(neighbour->column_count(), effect.column_count());
  }
  EXPECT_LT(farthest_neighbour(effect, 0.125), farthest_neighbour(effect, 1.0));
}

/// As many columns as announced, each as long as the signals and finite.
inline void expect_columns(const Effect& effect) {
  for (const ProcessShape& shape : {one_lag(0.6, 2), two_lags(0.9, 0.5, 1), integrator(3)}) {
    const Series flow = sum(stepping_op(1000, 1), Series(1000, -50.0));
    const Series response = answer(shape, flow);
    std::vector<Column> columns;
    effect.add_columns({flow, response, shape}, columns);
    ASSERT_EQ(columns.size(), effect.column_count());
    for (const Column& column : columns) {
      ASSERT_EQ(column.size(), flow.size());
      for (const double value : column) ASSERT_TRUE(std::isfinite(value));
    }
  }
}

/// Says what it found, with figures.
inline void expect_words(const Effect& effect, const std::vector<Parameter>& parameters) {
  const std::string words = effect.words(parameters);
  EXPECT_GT(words.size(), 20U);
  EXPECT_EQ(words.back(), '.');
  EXPECT_NE(words.find_first_of("0123456789"), std::string::npos) << words;
}

}  // namespace loopscope::core::model::tests
