#pragma once

#include "core/model/effects/effect.hpp"
#include "core/model/effects/effect_traits.hpp"

namespace loopscope::core::model {

/// % of op: curvatures are those of parabolas over half a span of 100 (contract.md).
inline constexpr double kHalfSpan = 50.0;

inline constexpr EffectTraits kTrim{.kind = EffectKind::valve_characteristic,
                                    .word = "valve_characteristic",
                                    .cause = EffectKind::valve_characteristic,
                                    .place = Place::process,
                                    .worth_fitting = kWorthFittingWhole,
                                    .looked_at_whole = true};
inline constexpr EffectTraits kCurvedProcess{.kind = EffectKind::process_nonlinearity,
                                             .word = "process_nonlinearity",
                                             .cause = EffectKind::process_nonlinearity,
                                             .place = Place::process,
                                             .worth_fitting = kWorthFittingWhole,
                                             .looked_at_whole = true};

/// A flow that is not proportional to travel (wear, corroded seat, wrong trim): the process
/// answers to the square and the cube of the travel as well.
class ValveCharacteristic final : public Effect {
 public:
  [[nodiscard]] EffectKind kind() const override { return EffectKind::valve_characteristic; }
  [[nodiscard]] std::size_t column_count() const override { return 2; }
  void add_columns(const Signals& signals, std::vector<Column>& columns) const override;
  /// curvature c of flow = mv + c (mv - 50)^2 / 50, all in %.
  [[nodiscard]] std::vector<Parameter> parameters(const LoopData& data,
                                                  std::span<const double> coefficients,
                                                  double gain) const override;
  [[nodiscard]] std::string words(std::span<const Parameter> parameters) const override;
};

/// A process whose answer is curved behind its dynamics, as conversion and titration are: pv
/// follows the square and the cube of the linear answer as well.
class ProcessNonlinearity final : public Effect {
 public:
  [[nodiscard]] EffectKind kind() const override { return EffectKind::process_nonlinearity; }
  [[nodiscard]] std::size_t column_count() const override { return 2; }
  void add_columns(const Signals& signals, std::vector<Column>& columns) const override;
  /// curvature c of y + c y^2 / 50, y in pv units from the mean.
  [[nodiscard]] std::vector<Parameter> parameters(const LoopData& data,
                                                  std::span<const double> coefficients,
                                                  double gain) const override;
  [[nodiscard]] std::string words(std::span<const Parameter> parameters) const override;
};

}  // namespace loopscope::core::model
