#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "core/model/effects/model_structure.hpp"
#include "core/model/effects/valve.hpp"
#include "core/model/record/loop_data.hpp"
#include "core/model/response/products.hpp"

namespace loopscope::core::model {

/// A valve and the process that answers to it.
struct ValveAndProcess {
  const ValveEffect* valve;
  const ProcessShape* process;
};

/// Digits of a search among many valves: `single` ranks them, at half the cost, mostly within 1e-6
/// of an error; of 320 stems between the samples on six records the worst was off by 5e-4.
enum class Digits { single, full };

/// What least squares needs of the answers of processes to many valves: each valve's answer passes
/// its process and the whitening, and is multiplied by columns that no valve moves, without ever
/// being kept. Valves go side by side, since each of these steps waits for the one before: those of
/// one law and one dead time.
class ValveResponses {
 public:
  /// `op`: what the valves see, %, without NaN; `steady`: whitened columns of its length; noise and
  /// taps by `structure`. All have to outlive this.
  ValveResponses(std::span<const double> op, const Structure& structure,
                 std::span<const Signal> steady, std::span<const Range> rows);

  /// For each valve the sums over the rows of its whitened answer with every steady column and with
  /// itself, a row for each tap: taps x (steady + taps). Processes that all integrate, or none.
  [[nodiscard]] std::vector<Eigen::MatrixXd> products(std::span<const ValveAndProcess> valves,
                                                      Digits digits) const;

 private:
  std::span<const double> op_;
  const Structure& structure_;
  std::span<const Signal> steady_;
  std::span<const Range> rows_;
};

}  // namespace loopscope::core::model
