#pragma once

#include "core/model/effect.hpp"
#include "core/model/valve_law.hpp"

namespace loopscope::core::model {

/// A valve that sticks and jumps, or only has play: op -> valve_law -> flow.
class ValveEffect final : public Effect {
 public:
  /// A valve whose slip jump is a smaller share of its band than this has play, and does not stick:
  /// the laws hardly tell the two apart below it.
  static constexpr double kPlay = 0.2;

  /// `restarts`: where pv puts the valve right (valve_search.hpp), positions in % from the mean of
  /// op.
  explicit ValveEffect(const Valve& valve, std::vector<ValveRestart> restarts = {})
      : valve_(valve), restarts_(std::move(restarts)) {}

  [[nodiscard]] const Valve& valve() const { return valve_; }
  [[nodiscard]] const std::vector<ValveRestart>& restarts() const { return restarts_; }
  /// What puts the valve right before this sample is no more than an initial value.
  static constexpr std::size_t kStart = 256;
  /// Whether it follows its law from the start of the record on, wherever it began.
  [[nodiscard]] bool by_law_alone() const {
    return restarts_.empty() || restarts_.back().at_sample < kStart;
  }
  /// The same valve with a slip jump of that share of its band.
  [[nodiscard]] EffectPtr with_jump(double share) const { return with_band(1.0, share); }
  /// The same valve left to its law from the start on, which it comes to in that direction (+1,
  /// -1).
  [[nodiscard]] std::shared_ptr<const ValveEffect> by_law_alone(double direction) const;
  /// The same valve with its band that many times as wide, and a slip jump of that share of it.
  [[nodiscard]] EffectPtr with_band(double times, double jump_share) const;
  [[nodiscard]] EffectKind kind() const override;
  void shape_flow(std::span<double> flow) const override;
  [[nodiscard]] std::vector<EffectPtr> neighbours(double scale) const override;
  [[nodiscard]] std::vector<Parameter> parameters(const LoopData&, std::span<const double>,
                                                  double) const override;
  [[nodiscard]] std::string_view law() const override;
  [[nodiscard]] std::string words(std::span<const Parameter> parameters) const override;

 private:
  void add_between_samples(double scale, std::vector<EffectPtr>& neighbours) const;

  Valve valve_;
  std::vector<ValveRestart> restarts_;
};

}  // namespace loopscope::core::model
