#pragma once

#include "core/model/effect.hpp"

namespace loopscope::core::model {

/// A sinusoid from outside the loop.
class ExternalOscillation final : public Effect {
 public:
  explicit ExternalOscillation(double period_samples) : period_(period_samples) {}

  [[nodiscard]] double period_samples() const { return period_; }
  [[nodiscard]] EffectKind kind() const override { return EffectKind::external_oscillation; }
  [[nodiscard]] std::size_t column_count() const override { return 2; }
  void add_columns(const Signals& signals, std::vector<Column>& columns) const override;
  [[nodiscard]] std::vector<EffectPtr> neighbours(double scale) const override;
  [[nodiscard]] std::vector<Parameter> parameters(const LoopData& data,
                                                  std::span<const double> coefficients,
                                                  double gain) const override;
  [[nodiscard]] std::string words(std::span<const Parameter> parameters) const override;

 private:
  double period_;
};

}  // namespace loopscope::core::model
