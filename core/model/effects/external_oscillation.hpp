#pragma once

#include <complex>

#include "core/model/effects/effect.hpp"
#include "core/model/effects/effect_traits.hpp"

namespace loopscope::core::model {

/// On all rows the best line gains 16 by chance; of 267 that entered one came from 17.7, all others
/// from 22 on. A wave whose phase wanders is spread over the spectrum, where its test may miss it.
inline constexpr EffectTraits kOscillation{.kind = EffectKind::external_oscillation,
                                           .word = "external_oscillation",
                                           .cause = EffectKind::load_step,
                                           .place = Place::outside,
                                           .most = 2,
                                           .cheap_look = CheapLook::always,
                                           .worth_fitting = 17.0,
                                           .looked_at_whole = true,
                                           .everywhere = true,
                                           .fitted_when_asked = true};

/// A periodic wave from outside the loop: a fundamental and its harmonics, each of an amplitude and
/// a phase that are constant or change slowly, along straight lines from knot to knot.
class ExternalOscillation final : public Effect {
 public:
  /// `stretches` between the knots; 0 = constant.
  explicit ExternalOscillation(double period_samples, std::size_t harmonics = 1,
                               std::size_t stretches = 0)
      : period_(period_samples), harmonics_(harmonics), stretches_(stretches) {}

  [[nodiscard]] double period_samples() const { return period_; }
  [[nodiscard]] std::size_t harmonics() const { return harmonics_; }
  [[nodiscard]] bool operator==(const ExternalOscillation& other) const {
    return period_ == other.period_ && harmonics_ == other.harmonics_ &&
           stretches_ == other.stretches_;
  }
  [[nodiscard]] EffectKind kind() const override { return EffectKind::external_oscillation; }
  [[nodiscard]] const ExternalOscillation* as_wave() const override { return this; }
  [[nodiscard]] std::size_t column_count() const override {
    return 2 * harmonics_ * (stretches_ + 1);
  }
  /// By harmonic, then knot: sine, cosine.
  void add_columns(const Signals& signals, std::vector<Column>& columns) const override;
  /// None of fewer than four cycles over a record of 4096 samples, unless it has fewer already.
  [[nodiscard]] std::vector<EffectPtr> neighbours(double scale) const override;

  /// The same wave, constant and on every net of knots on which a change is slow: stretches of four
  /// cycles and more.
  [[nodiscard]] std::vector<EffectPtr> with_knots(std::size_t samples,
                                                  std::size_t samples_per_row = 1) const;
  /// Waves with other harmonics, of which this one is the fundamental or a harmonic itself.
  [[nodiscard]] std::vector<EffectPtr> with_harmonics() const;

  /// Period (s) and amplitude (pv units) of the fundamental, in the mean over the record.
  [[nodiscard]] std::vector<Parameter> parameters(const LoopData& data,
                                                  std::span<const double> coefficients,
                                                  double gain) const override;
  [[nodiscard]] std::string words(std::span<const Parameter> parameters) const override;

 private:
  double period_;
  std::size_t harmonics_;
  std::size_t stretches_;
};

}  // namespace loopscope::core::model
