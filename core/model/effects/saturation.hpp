#pragma once

#include "core/model/effects/effect.hpp"
#include "core/model/effects/effect_traits.hpp"

namespace loopscope::core::model {

inline constexpr EffectTraits kSaturation{.kind = EffectKind::valve_saturation,
                                          .word = "valve_saturation",
                                          .cause = EffectKind::valve_saturation,
                                          .place = Place::valve,
                                          .worth_fitting = kWorthFittingWhole,
                                          .looked_at_whole = true,
                                          .fitted_when_asked = true};

/// A stem that cannot travel the whole way: flow held between two limits.
class Saturation final : public Effect {
 public:
  /// Limits in % from the mean of op; infinite = none on that side.
  Saturation(double low, double high) : low_(low), high_(high) {}

  [[nodiscard]] EffectKind kind() const override { return EffectKind::valve_saturation; }
  void shape_flow(std::span<double> flow) const override;
  [[nodiscard]] std::vector<EffectPtr> neighbours(double scale) const override;
  /// low, high (% of op).
  [[nodiscard]] std::vector<Parameter> parameters(const LoopData& data, std::span<const double>,
                                                  double) const override;
  [[nodiscard]] std::string words(std::span<const Parameter> parameters) const override;

 private:
  double low_, high_;
};

}  // namespace loopscope::core::model
