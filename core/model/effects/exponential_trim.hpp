#pragma once

#include "core/model/effects/effect.hpp"

namespace loopscope::core::model {

/// A trim whose gain grows, or falls, by the same share with every percent of travel: equal
/// percentage (IEC 60534-2-4), and near enough to quick opening. Unlike the polynomial of
/// ValveCharacteristic its slope never turns: one shape parameter, no S.
class ExponentialTrim final : public Effect {
 public:
  /// `growth`: relative change of the gain over `travel_percent` (> 0), signed; 0 = a parabola.
  ExponentialTrim(double growth, double travel_percent)
      : growth_(growth), travel_percent_(travel_percent) {}

  [[nodiscard]] EffectKind kind() const override { return EffectKind::valve_characteristic; }
  [[nodiscard]] std::size_t column_count() const override { return 1; }
  void add_columns(const Signals& signals, std::vector<Column>& columns) const override;
  [[nodiscard]] std::vector<EffectPtr> neighbours(double scale) const override;
  /// curvature c of flow = mv + c (mv - 50)^2 / 50, all in %, at 50 %.
  [[nodiscard]] std::vector<Parameter> parameters(const LoopData& data,
                                                  std::span<const double> coefficients,
                                                  double gain) const override;
  [[nodiscard]] std::string words(std::span<const Parameter> parameters) const override;

 private:
  double growth_;
  double travel_percent_;
};

}  // namespace loopscope::core::model
