#pragma once

#include "core/model/effects/effect.hpp"

namespace loopscope::core::model {

/// A load that enters before the lags of the process and moves once, or along a ramp: the mark of a
/// feed, and of a gain that changes about another working point than the mean of op.
class InputLoad final : public Effect {
 public:
  /// Samples; until >= at, equal = sudden.
  InputLoad(std::size_t at, std::size_t until) : at_(at), until_(until) {}

  /// 0 before the move, 1 after it, as a flow at the inlet of the process.
  [[nodiscard]] Column course(const Signals& signals) const;

  [[nodiscard]] EffectKind kind() const override { return EffectKind::load_step; }
  [[nodiscard]] std::size_t column_count() const override { return 1; }
  void add_columns(const Signals& signals, std::vector<Column>& columns) const override;
  /// at (s), size (pv units; of a vessel pv units a sample).
  [[nodiscard]] std::vector<Parameter> parameters(const LoopData& data,
                                                  std::span<const double> coefficients,
                                                  double gain) const override;
  [[nodiscard]] std::string words(std::span<const Parameter> parameters) const override;

 private:
  std::size_t at_;     ///< sample at which it comes out of the dead time
  std::size_t until_;  ///< where it ends; at_ = sudden
};

}  // namespace loopscope::core::model
