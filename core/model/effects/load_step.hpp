#pragma once

#include "core/model/effects/effect.hpp"
#include "core/model/effects/effect_traits.hpp"

namespace loopscope::core::model {

/// A step lives in a single one-step error. The best of thousands of places gains 8 by chance in
/// every loop, and has to reach an evidence of 30 with its tries: of 856 steps that entered, scored
/// once, none came from less than 14. A step that its test half sees may be one; where its test
/// sees nothing a cheap look was as often wrong as right.
inline constexpr EffectTraits kLoadStep{.kind = EffectKind::load_step,
                                        .word = "load_step",
                                        .cause = EffectKind::load_step,
                                        .place = Place::outside,
                                        .most = 3,
                                        .cheap_look = CheapLook::where_hinted,
                                        .worth_fitting = 13.5,
                                        .everywhere = true,
                                        .on_own_rows = true,
                                        .scored_once = true};

/// A load that moves once and stays: at once, and through a lag of its own or, where that is not
/// known, the slower one of the process (of a vessel: as a ramp of its level).
class LoadStep final : public Effect {
 public:
  /// Samples: before that the noise model and the process still know of the start of the record,
  /// and a step there stands for what they were at. None moves there.
  static constexpr std::size_t kEarliest = 100;

  /// `at`: sample. `samples_per_row`: how far apart pv is seen, so the least move of a place.
  /// `lag_samples`: 0 = the process's.
  explicit LoadStep(std::size_t at, std::size_t samples_per_row = 1, double lag_samples = 0.0)
      : at_(at), samples_per_row_(samples_per_row), lag_samples_(lag_samples) {}

  [[nodiscard]] std::optional<std::size_t> moment() const override { return at_; }
  [[nodiscard]] EffectKind kind() const override { return EffectKind::load_step; }
  [[nodiscard]] std::size_t column_count() const override { return 2; }
  void add_columns(const Signals& signals, std::vector<Column>& columns) const override;
  [[nodiscard]] std::vector<EffectPtr> neighbours(double scale) const override;
  /// at (s), size (pv units, of both parts together).
  [[nodiscard]] std::vector<Parameter> parameters(const LoopData& data,
                                                  std::span<const double> coefficients,
                                                  double gain) const override;
  [[nodiscard]] std::string words(std::span<const Parameter> parameters) const override;

 private:
  [[nodiscard]] EffectPtr moved(std::size_t at, double lag_samples) const;

  std::size_t at_;
  std::size_t samples_per_row_;
  double lag_samples_;
};

}  // namespace loopscope::core::model
