#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <span>
#include <vector>

#include "core/model/limit_cycle/cycle_band.hpp"
#include "core/model/valve_law/valve_law.hpp"

namespace loopscope::core::model {

/// Process behind the valve, in kept samples of a CycleBand.
struct SimulatedProcess {
  double lag = 0.0;        ///< kept samples; kIntegratingLag = a pole at 1
  std::size_t delay = 0;   ///< kept samples
  double gain = 0.0;       ///< pv units per % behind the lag
  double stickband = 0.0;  ///< S of the input's valve, % of op
  double slip_jump = 0.0;  ///< J
};
inline constexpr double kIntegratingLag = std::numeric_limits<double>::infinity();

/// Fits x(k) = pole x(k-1) + (1 - pole) input(k - delay), pv = gain x, by the simulation error in
/// the band, over a grid of lags and delays, for one input after another (op itself, or op behind
/// candidate valves), and keeps the best. Blocks of two cycles are taken by turns to fit and to
/// score: held_out() is the error on blocks that did not choose.
class SimulationFit {
 public:
  /// `pv` in the band; `weights` 0 where pv is missing, else 1. `gain_sign` +1 or -1 is that of the
  /// controller, which a process under negative feedback shares; 0 = not known.
  SimulationFit(const CycleBand& band, std::span<const double> pv, std::span<const double> weights,
                double gain_sign, std::size_t longest_delay);

  /// `input` kept samples, not yet in the band.
  void offer(std::span<const double> input);
  /// One to eight inputs at once: inputs[k][i] is op behind valves[i].
  void offer(std::span<const EightNumbers> inputs, std::span<const Valve> valves);

  /// Share of pv's variance that is left on the blocks held out, >= 0; 1 before the first offer.
  [[nodiscard]] double held_out() const;
  /// Best over the whole record.
  [[nodiscard]] const SimulatedProcess& best() const { return best_; }
  /// pv in the band as that process gives it.
  [[nodiscard]] std::vector<double> simulate(const SimulatedProcess& process,
                                             std::span<const double> input) const;
  /// Kept samples of a block: two cycles, 20 at least.
  [[nodiscard]] std::size_t block() const { return block_; }

 private:
  struct Fold {
    double pv_square = 0.0;
    double best_error = std::numeric_limits<double>::infinity();  ///< on this fold
    double error_elsewhere = 0.0;                                 ///< of that model, on the other
  };
  struct Sums {
    double cross = 0.0;
    double square = 0.0;
  };

  /// Of each lag's answers to the inputs, as CycleBand::pass_sums() takes them.
  [[nodiscard]] std::vector<std::vector<EightNumbers>> respond(
      std::span<const double> lags, std::span<const EightNumbers> inputs) const;
  [[nodiscard]] double gain(const Sums& sums) const;
  void compare(const std::array<Sums, 2>& sums, SimulatedProcess process);

  const CycleBand& band_;
  std::span<const double> pv_;
  std::span<const double> weights_;
  std::vector<double> weighted_pv_;
  double gain_sign_;
  std::size_t block_;
  std::vector<std::size_t> delays_;
  std::array<Fold, 2> folds_;
  SimulatedProcess best_;
  double best_error_ = std::numeric_limits<double>::infinity();
};

}  // namespace loopscope::core::model
