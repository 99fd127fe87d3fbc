#pragma once

#include "core/model/effect.hpp"

namespace loopscope::core::model {

/// A process gain that changes once, or drifts over the rest of the record.
class GainChange final : public Effect {
 public:
  GainChange(std::size_t at, std::size_t until) : at_(at), until_(until) {}

  [[nodiscard]] EffectKind kind() const override { return EffectKind::gain_change; }
  [[nodiscard]] std::size_t column_count() const override { return 1; }
  void add_columns(const Signals& signals, std::vector<Column>& columns) const override;
  [[nodiscard]] std::vector<EffectPtr> neighbours(double scale) const override;
  [[nodiscard]] std::vector<Parameter> parameters(const LoopData& data,
                                                  std::span<const double> coefficients,
                                                  double gain) const override;
  /// From a fifth to five times: a gain that falls to nothing or turns its sign is that of an op
  /// which has lost its hold, at a limit or by hand.
  [[nodiscard]] bool plausible(std::span<const double> coefficients, double gain) const override;
  [[nodiscard]] std::string words(std::span<const Parameter> parameters) const override;

 private:
  std::size_t at_;     ///< sample of the change, or where it begins
  std::size_t until_;  ///< where it ends; at_ = sudden
};

}  // namespace loopscope::core::model
