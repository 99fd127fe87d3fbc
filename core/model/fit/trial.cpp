#include "core/model/fit/trial.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/model/effects/effect_catalogue.hpp"
#include "core/model/effects/valve.hpp"
#include "core/model/fit/fit_variants.hpp"

namespace loopscope::core::model {
namespace {

constexpr std::size_t kSteadinessParts = 8;

double sum_of_squares(const std::vector<double>& values, const Range& range) {
  double sum = 0.0;
  for (std::size_t k = range.first; k < range.end; ++k) sum += values[k] * values[k];
  return sum;
}

struct ErrorSums {
  double before = 0.0, after = 0.0;
  std::size_t rows = 0;
  std::array<double, kSteadinessParts> part_before{}, part_after{};
};

void add_up(const LoopData& data, const std::vector<Range>& rows, const Fit& before,
            const Fit& after, ErrorSums& sums) {
  for (const Range& range : rows) {
    const double a = sum_of_squares(before.innovations, range);
    const double b = sum_of_squares(after.innovations, range);
    const std::size_t part =
        std::min(kSteadinessParts - 1, range.first * kSteadinessParts / data.size());
    sums.before += a;
    sums.after += b;
    sums.part_before[part] += a;
    sums.part_after[part] += b;
    sums.rows += range.size();
  }
}

/// What of `ranges` the `others` leave; both ascending.
std::vector<Range> without(const std::vector<Range>& ranges, const std::vector<Range>& others) {
  std::vector<Range> result;
  for (Range rest : ranges) {
    for (const Range& other : others) {
      if (other.end <= rest.first || other.first >= rest.end) continue;
      if (other.first > rest.first) result.push_back({rest.first, other.first});
      rest.first = std::min(rest.end, other.end);
    }
    if (rest.first < rest.end) result.push_back(rest);
  }
  return result;
}

}  // namespace

CrossFit cross_fit(const LoopData& data, Fit fit) {
  const LoopData other = on_other_fold(data);
  Fit other_fold = polish(other, fit.structure, 4);
  // A valve's band is a needle: the half that it is scored on stands for the tries of its search.
  const Effect* last = fit.structure.effects.empty() ? nullptr : fit.structure.effects.back().get();
  if (last != nullptr && !is_valve_hysteresis(last->kind()) &&
      traits_of(last->kind()).moves_on_half)
    other_fold = refine_last(other, std::move(other_fold), 0.25);
  return {std::move(fit), std::move(other_fold)};
}

Comparison compare(const LoopData& data, const CrossFit& before, const CrossFit& after, bool once) {
  ErrorSums sums;
  add_up(data, data.rows.score, before.fit, after.fit, sums);
  // Rows that both have seen count once.
  if (!once)
    add_up(data, without(data.rows.fit, data.rows.score), before.other_fold, after.other_fold,
           sums);
  Comparison result;
  if (sums.rows == 0 || sums.after <= 0.0) return result;
  const auto n = static_cast<double>(sums.rows);
  result.before = sums.before / n;
  result.after = sums.after / n;
  result.evidence = n * std::log(result.before / result.after);
  result.p = std::min(1.0, std::exp(-0.5 * result.evidence));
  for (std::size_t part = 0; part < kSteadinessParts; ++part) {
    result.steadiness +=
        sums.part_after[part] < sums.part_before[part] ? 1.0 / kSteadinessParts : 0.0;
  }
  return result;
}

CrossFit reevaluated(const LoopData& rows, const CrossFit& fit) {
  return {evaluate(rows, fit.fit.structure),
          evaluate(on_other_fold(rows), fit.other_fold.structure)};
}

bool is_plausible(const Fit& fit) {
  const std::size_t last = fit.structure.effects.size() - 1;
  return fit.structure.effects[last]->plausible(coefficients_of(fit, last), fit.gain());
}

double gain_of(const LoopData& data, double before, double after) {
  const double gain = static_cast<double>(data.rows.fit_count()) * std::log(before / after);
  return std::isnan(gain) ? -std::numeric_limits<double>::infinity() : gain;
}

double error_after(const LoopData& data, double before, double gain) {
  return before * std::exp(-gain / static_cast<double>(data.rows.fit_count()));
}

double fit_gain(const LoopData& data, const Fit& before, const Fit& after) {
  return gain_of(data, before.fit_error, after.fit_error);
}

Fit refine_last(const LoopData& data, Fit fit, double coarsest) {
  constexpr int kRounds = 3;
  const EffectPtr first = fit.structure.effects.back();
  if (first->neighbours(coarsest).empty()) return fit;
  const FitVariants variants(data, fit.structure);
  BestVariant best{first, variants.fit_error(first)};
  for (double scale = coarsest; scale > 0.05; scale *= 0.5) {
    bool improved = true;
    for (int round = 0; round < kRounds && improved; ++round) {
      improved = best.take(variants, best.effect->neighbours(scale), Digits::full);
    }
  }
  return best.effect == first ? std::move(fit)
                              : evaluate(data, with_last(fit.structure, best.effect));
}

}  // namespace loopscope::core::model
