#pragma once

#include "core/model/effects/effect.hpp"
#include "core/model/effects/effect_traits.hpp"

namespace loopscope::core::model {

/// The best change gains more than 18 on all rows in one healthy loop of ten. The moves of op right
/// after it lie in one half only: the other would shift the change to behind them. A gain that
/// changes about another level leaves a level, which its test does not always see.
inline constexpr EffectTraits kGainChange{.kind = EffectKind::gain_change,
                                          .word = "gain_change",
                                          .cause = EffectKind::gain_change,
                                          .place = Place::process,
                                          .cheap_look = CheapLook::always,
                                          .worth_fitting = 18.0,
                                          .looked_at_whole = true,
                                          .everywhere = true,
                                          .on_own_rows = true,
                                          .put_in_place = true,
                                          .moves_on_half = false};

/// A process gain that changes once, or drifts over the rest of the record. The flow that it
/// multiplies is none at a working point of its own: about the mean of op a level comes with it.
class GainChange final : public Effect {
 public:
  /// Of a sudden change, samples: before it too little is seen of the gain as it was, and a process
  /// that is not at rest when the record begins passes for another one.
  static constexpr std::size_t kEarliest = 100;

  /// Samples; until >= at, equal = sudden.
  GainChange(std::size_t at, std::size_t until) : at_(at), until_(until) {}

  /// Of a sudden change.
  [[nodiscard]] std::optional<std::size_t> moment() const override {
    return sudden() ? std::optional(at_) : std::nullopt;
  }
  [[nodiscard]] EffectKind kind() const override { return EffectKind::gain_change; }
  [[nodiscard]] std::size_t column_count() const override { return 2; }
  void add_columns(const Signals& signals, std::vector<Column>& columns) const override;
  [[nodiscard]] std::vector<EffectPtr> neighbours(double scale) const override;
  /// at (s), ratio of the gain after by before; of a drift also rate (of the ratio, 1/h).
  [[nodiscard]] std::vector<Parameter> parameters(const LoopData& data,
                                                  std::span<const double> coefficients,
                                                  double gain) const override;
  /// A load that moves at the same time, before the process or behind it.
  [[nodiscard]] std::vector<EffectPtr> plainer() const override;
  /// From a fifth to five times: a gain that falls to nothing or turns its sign is that of an op
  /// which has lost its hold, at a limit or by hand. The working point lies where op can be.
  [[nodiscard]] bool plausible(std::span<const double> coefficients, double gain) const override;
  [[nodiscard]] std::string words(std::span<const Parameter> parameters) const override;

 private:
  [[nodiscard]] bool sudden() const { return until_ == at_; }

  std::size_t at_;     ///< sample of the change, or where it begins
  std::size_t until_;  ///< where it ends; at_ = sudden
};

}  // namespace loopscope::core::model
