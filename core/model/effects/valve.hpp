#pragma once

#include "core/model/effects/effect.hpp"
#include "core/model/effects/effect_traits.hpp"
#include "core/model/valve_law/valve_law.hpp"

namespace loopscope::core::model {

/// The two are one fit, told apart by the jump that it ends with.
inline constexpr EffectTraits kStiction{.kind = EffectKind::valve_stiction,
                                        .word = "valve_stiction",
                                        .cause = EffectKind::valve_stiction,
                                        .place = Place::valve,
                                        .worth_fitting = kWorthFitting};
inline constexpr EffectTraits kDeadband{.kind = EffectKind::valve_deadband,
                                        .word = "valve_deadband",
                                        .cause = EffectKind::valve_deadband,
                                        .place = Place::valve,
                                        .worth_fitting = kWorthFitting};

/// A valve that sticks and jumps, or only has play: op -> valve_law -> flow.
class ValveEffect final : public Effect {
 public:
  /// A valve whose slip jump is a smaller share of its band than this has play, and does not stick:
  /// the laws hardly tell the two apart below it.
  static constexpr double kPlay = 0.2;

  explicit ValveEffect(const Valve& valve) : valve_(valve) {}

  [[nodiscard]] const ValveEffect* as_valve() const override { return this; }
  [[nodiscard]] const Valve& valve() const { return valve_; }
  /// The same valve with a slip jump of that share of its band.
  [[nodiscard]] EffectPtr with_jump(double share) const { return with_band(1.0, share); }
  /// The same valve, which comes to where it begins in that direction (+1, -1).
  [[nodiscard]] ValveEffect coming(double direction) const;
  /// The same valve with its band that many times as wide, and a slip jump of that share of it.
  [[nodiscard]] EffectPtr with_band(double times, double jump_share) const;
  [[nodiscard]] EffectKind kind() const override;
  void shape_flow(std::span<double> flow) const override;
  [[nodiscard]] std::vector<EffectPtr> neighbours(double scale) const override;
  /// S and J, or the width of play, % of op.
  [[nodiscard]] std::vector<Parameter> parameters(const LoopData&, std::span<const double>,
                                                  double) const override;
  [[nodiscard]] std::string_view law() const override;
  [[nodiscard]] std::string words(std::span<const Parameter> parameters) const override;

 private:
  void add_between_samples(double scale, std::vector<EffectPtr>& neighbours) const;

  Valve valve_;
};

}  // namespace loopscope::core::model
