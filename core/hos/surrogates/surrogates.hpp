#pragma once

#include <cstddef>
#include <cstdint>
#include <random>
#include <span>
#include <vector>

#include "core/hos/linear/innovations.hpp"

namespace loopscope::core::hos {

/// Which linear records a finding has to stand out from. Both are driven by the record's own
/// innovations through its own linear model.
enum class Null {
  /// Each with a random sign, in its place (wild bootstrap): keeps tails and loudness over time.
  random_signs,
  /// In random order: keeps tails and skewness.
  permuted,
};

/// Records that a linear loop could have made of the same noise.
class Surrogates {
 public:
  /// `signal` and `innovations`, which are of it and have a known one, outlive this.
  Surrogates(std::span<const double> signal, const Innovations& innovations, Null null,
             std::uint64_t seed);

  /// The next one, as long as the signal, in its unit, about mean 0; NaN where the signal is
  /// missing. It begins with the signal's own samples, as many as the model has coefficients.
  /// `record` keeps its memory.
  void draw(std::vector<double>& record);

 private:
  void flip_signs(std::vector<double>& record);
  void permute(std::vector<double>& record);
  [[nodiscard]] std::size_t below(std::size_t count);

  std::span<const double> signal_;
  const Innovations* innovations_;
  Null null_;
  std::mt19937_64 random_;
  std::vector<double> known_;         // the innovations, one after another
  std::vector<std::size_t> places_;   // and where they belong
  std::vector<std::size_t> unknown_;  // behind gaps the loop is driven by any of them
};

}  // namespace loopscope::core::hos
