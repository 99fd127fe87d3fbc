#pragma once

#include <cstddef>

namespace loopscope::core::hos {

/// Sums over the finite samples x of a record, of y = x factor - first - centre.
struct PowerSums {
  double count = 0.0;
  double first = 0.0;   ///< sum of y
  double second = 0.0;  ///< of y^2, y^3 and y^4
  double third = 0.0;
  double fourth = 0.0;
};

/// Sums over the finite samples for the straight line through them: t is a sample's place, counted
/// from the middle of the record, y = x factor - first.
struct TrendSums {
  double count = 0.0;
  double place = 0.0;         ///< sum of t
  double place_square = 0.0;  ///< of t^2
  double value = 0.0;         ///< of y
  double moment = 0.0;        ///< of t y
};

/// What y is.
struct Centring {
  double factor = 1.0;
  double first = 0.0;
  double centre = 0.0;
  double slope = 0.0;  ///< per sample; only where said
};

/// Of two series: sum of f b, and of f^2 + b^2.
struct PairSums {
  double product = 0.0;
  double power = 0.0;
};

/// Of values of at least zero.
struct ValueTotals {
  double sum = 0.0;
  double largest = 0.0;
};

/// Columns of equal length, one after another, by which a series is multiplied.
struct FilterTaps {
  static constexpr std::size_t kColumns = 6;
  const double* first;
  std::size_t length;
};

}  // namespace loopscope::core::hos
