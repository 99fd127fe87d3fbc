#pragma once

#include "core/model/effects/effect.hpp"

namespace loopscope::core::model {

/// A vessel whose outflow grows with the root of its level (Torricelli): gain and time constant
/// both rise with the level.
///
///     T dx/dt = f - 2 D (sqrt(1 + x / D) - 1)
class SquareRootOutflow final : public Effect {
 public:
  /// `depth_percent` D: the level over the empty vessel, as the flow (% of op) that would raise it
  /// so far at the slope it has at rest; negative = gain and time constant fall with the level.
  explicit SquareRootOutflow(double depth_percent) : depth_(depth_percent) {}

  [[nodiscard]] EffectKind kind() const override { return EffectKind::process_nonlinearity; }
  [[nodiscard]] std::size_t column_count() const override { return 1; }
  void add_columns(const Signals& signals, std::vector<Column>& columns) const override;
  [[nodiscard]] std::vector<EffectPtr> neighbours(double scale) const override;
  /// curvature c of y + c y^2 / 50, y in pv units from the mean.
  [[nodiscard]] std::vector<Parameter> parameters(const LoopData& data,
                                                  std::span<const double> coefficients,
                                                  double gain) const override;
  [[nodiscard]] std::string words(std::span<const Parameter> parameters) const override;

 private:
  double depth_;
};

}  // namespace loopscope::core::model
