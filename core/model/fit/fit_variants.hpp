#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/model/fit/batched/valve_responses.hpp"
#include "core/model/fit/design.hpp"

namespace loopscope::core::model {

/// Fit errors of structures that differ in their last effect alone: what they share is whitened and
/// multiplied once, so that one of them costs no more than the columns that the last effect moves.
class FitVariants {
 public:
  /// `data` has to outlive this. The last effects to come bend the flow, or do not, as the last one
  /// of `structure` does.
  FitVariants(const LoopData& data, const Structure& structure);
  FitVariants(const FitVariants&) = delete;
  FitVariants& operator=(const FitVariants&) = delete;

  /// evaluate(data, structure with `last` as its last effect).fit_error, up to rounding.
  [[nodiscard]] double fit_error(const EffectPtr& last) const;

  /// The same behind another process, of one tap. The last effect has to bend the flow.
  [[nodiscard]] double fit_error(const Effect& last, const ProcessShape& process) const;

  /// The same of many; of valves at a fraction of the cost of one after the other.
  [[nodiscard]] std::vector<double> fit_errors(std::span<const EffectPtr> lasts,
                                               Digits digits = Digits::full) const;

  /// The same of valves each behind a process of its own, of one tap.
  [[nodiscard]] std::vector<double> fit_errors(std::span<const ValveAndProcess> valves,
                                               Digits digits) const;

 private:
  [[nodiscard]] std::vector<Column> moved_columns(const Effect& last,
                                                  const ProcessShape& process) const;
  [[nodiscard]] Eigen::MatrixXd whitened(std::vector<Column> columns) const;
  [[nodiscard]] Eigen::MatrixXd normal_with(const Eigen::MatrixXd& moved) const;
  [[nodiscard]] double error_of(const Eigen::MatrixXd& moved) const;

  const LoopData& data_;
  Structure structure_;  ///< without its last effect
  bool bends_;
  std::vector<double> flow_;          ///< before the last effect
  std::vector<double> answered_;      ///< the process's answer to it, of gain 1
  std::vector<EffectPtr> following_;  ///< whose columns move with what bends the flow
  Design steady_;
  std::vector<Signal> steady_columns_;  ///< of `steady_`, those that every variant has; pv first
  Eigen::MatrixXd steady_normal_;
};

/// The best last effect of the variants that were looked at.
struct BestVariant {
  EffectPtr effect;
  double error;

  /// Takes the best of those that are better by more than rounding: of two laws that move the same
  /// valve alike the first one stays. Whether there was one.
  bool take(const FitVariants& variants, std::span<const EffectPtr> tried, Digits digits);
};

}  // namespace loopscope::core::model
