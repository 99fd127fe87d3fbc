#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "core/hos/coupling/coupling_tests.hpp"

namespace loopscope::core::hos {

/// Where one first-pass p-value of a record stands among those of its surrogates.
///
/// Draws stop at the first that is as extreme among the first kEarly, or at the second one
/// thereafter (Besag and Clifford 1991): p is their share, and at most a share x of linear records
/// have a p up to x whatever the number of draws was. Where kMost did not do, the p of what lies
/// beyond them is read from their tail: an exponential through the most extreme quarter, in terms
/// of -ln p, which has mean 1 for Gaussian noise and any larger one here.
class SurrogateP {
 public:
  static constexpr std::size_t kEarly = 10;
  static constexpr std::size_t kMost = 40;

  explicit SurrogateP(double first_pass_p);

  /// Another surrogate's first-pass p.
  void add(double first_pass_p);
  /// Further draws are not counted.
  [[nodiscard]] bool settled() const { return settled_; }
  /// At least the first pass's, which it is without draws.
  [[nodiscard]] double p() const;

 private:
  [[nodiscard]] double tail_p() const;

  double first_pass_p_;
  double evidence_;
  std::size_t exceeding_ = 0;
  bool settled_ = false;
  std::vector<double> draws_;  // -ln p
};

/// `found` (by the first pass, or let stand by surrogates of another kind) against surrogates:
/// every p-value below `unclear` is replaced by its SurrogateP, the others stay. `next` draws one
/// surrogate and tests it, its harmonics only where that is asked for.
[[nodiscard]] CouplingTests against_surrogates(
    const CouplingTests& found, double unclear,
    const std::function<CouplingTests(bool harmonics)>& next);

}  // namespace loopscope::core::hos
