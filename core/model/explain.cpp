#include "core/model/explain.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <map>

#include "core/model/baseline.hpp"
#include "core/model/effects/load_step.hpp"
#include "core/model/nominate.hpp"
#include "core/model/trial.hpp"

namespace loopscope::core::model {
namespace {

constexpr std::size_t kDealtSamples = 16;

Structure with(Structure structure, EffectPtr effect) {
  structure.effects.push_back(std::move(effect));
  return structure;
}

/// The rows on which a fit with these effects is judged.
LoopData dealt(LoopData data, const Structure& structure) {
  for (const EffectPtr& effect : structure.effects) {
    if (const auto* step = dynamic_cast<const LoadStep*>(effect.get())) {
      data.rows = seen_by_both(data.rows, step->at() < 2 ? 0 : step->at() - 2, kDealtSamples);
    }
  }
  return data;
}

/// The rows away from gross errors: a load that jumps would bend every fit of the process.
Rows calm(const Rows& rows, const Fit& fit) {
  constexpr double kGross = 6.0;
  constexpr double kDeviation = 1.4826;  // standard deviation over median of the absolute values
  std::vector<double> sizes;
  for (const Range& range : rows.fit)
    for (std::size_t k = range.first; k < range.end; ++k) sizes.push_back(std::abs(fit.innovations[k]));
  const auto middle = sizes.begin() + static_cast<long>(sizes.size() / 2);
  std::nth_element(sizes.begin(), middle, sizes.end());
  const double limit = kGross * kDeviation * *middle;
  Rows result;
  for (const Range& range : rows.fit) {
    std::size_t first = range.first;
    for (std::size_t k = range.first; k < range.end; ++k) {
      if (std::abs(fit.innovations[k]) < limit) continue;
      const std::size_t end = std::max(first, k < 3 ? 0 : k - 3);
      if (end > first) result.fit.push_back({first, end});
      first = std::min(range.end, k + 8);
    }
    if (range.end > first) result.fit.push_back({first, range.end});
  }
  result.score = rows.score;
  return result;
}

struct Trial {
  TwinFit fit;
  Comparison comparison;
};

}  // namespace

Story tell(const LoopData& original) {
  const bool debug = std::getenv("LSDEBUG") != nullptr;
  Story story;
  LoopData data = original;
  Structure start;
  start.noise = {{0.95, 0.0}, {0.3, 0.0}};
  Fit current = search_process(data, start);
  data.rows = calm(original.rows, current);
  if (debug) std::printf("   calm %zu of %zu\n", data.rows.fit_count(), original.rows.fit_count());
  if (data.rows.fit_count() < original.rows.fit_count()) current = search_process(data, current.structure);
  data.rows = original.rows;
  current = evaluate(data, current.structure);
  story.baseline = current;
  TwinFit now = twin(data, current);
  for (int step = 0; step < 5; ++step) {
    std::vector<EffectPtr> candidates;
    for (auto& list : {nominate_static(data, current), nominate_gain_changes(data), nominate_load_steps(data, current), nominate_oscillations(data, current), nominate_valves(data, current)})
      candidates.insert(candidates.end(), list.begin(), list.end());
    std::map<EffectKind, std::vector<Fit>> best;
    for (const EffectPtr& effect : candidates) {
      const bool have = std::ranges::any_of(current.structure.effects, [&](const EffectPtr& e) {
        return e->kind() == effect->kind() && e->kind() != EffectKind::load_step && e->kind() != EffectKind::external_oscillation; });
      if (have) continue;
      const Structure structure = with(current.structure, effect);
      if (effect->kind() == EffectKind::valve_saturation || effect->kind() == EffectKind::valve_stiction || effect->kind() == EffectKind::valve_deadband) {
        Structure s2 = structure; const ProcessGlance g = glance(data, structure); s2.process = g.shape; s2.two_taps = false; s2.second_order = false;
        best[effect->kind()].push_back(evaluate(data, s2)); continue;
      }
      Fit fit = effect->kind() == EffectKind::load_step ? evaluate(dealt(data, structure), structure) : evaluate(data, structure);
      best[effect->kind()].push_back(std::move(fit));
    }
    std::map<EffectKind, Trial> trials;
    for (auto& [kind, fits] : best) {
      std::ranges::sort(fits, {}, [](const Fit& f) { return f.fit_error; });
      const bool valve = kind == EffectKind::valve_saturation || kind == EffectKind::valve_stiction || kind == EffectKind::valve_deadband;
      if (kind == EffectKind::load_step) std::ranges::sort(fits, std::greater{}, [&](const Fit& f) { const LoopData d = dealt(data, f.structure); return fit_gain(d, evaluate(d, current.structure), f); });
      for (std::size_t i = 0; i < std::min<std::size_t>(fits.size(), valve && kind != EffectKind::valve_saturation ? 3 : 1); ++i) {
        Fit& fit = fits[i];
        const LoopData rows = dealt(data, fit.structure);
        const TwinFit before = kind == EffectKind::load_step ? TwinFit{evaluate(rows, now.fit.structure), evaluate(mirrored(rows), now.mirror.structure)} : now;
        const double quick = fit_gain(rows, before.fit, fit);
        if (quick > 8.0 || valve) fit = fit_anew(rows, std::move(fit));
        if (fit_gain(rows, before.fit, fit) <= 8.0) continue;
        Trial trial{twin(rows, fit), {}};
        trial.comparison = compare(rows, before, trial.fit, kind == EffectKind::load_step || kind == EffectKind::valve_stiction || kind == EffectKind::valve_deadband);
        if (kind == EffectKind::load_step || kind == EffectKind::external_oscillation) trial.comparison.p = std::min(1.0, trial.comparison.p * static_cast<double>(data.size()));
        if (debug) {
          std::printf("   step %d %-22s quick %.1f fit gain %.1f held-out evidence %.1f p %.2g cons %.2g steady %.2f", step, std::string(name(kind)).c_str(), quick, fit_gain(rows, before.fit, fit), trial.comparison.evidence, trial.comparison.p, trial.comparison.consistency_p, trial.comparison.steadiness);
          std::size_t off = fit.taps(); for (std::size_t j=0;j+1<fit.structure.effects.size();++j) off += fit.structure.effects[j]->column_count();
          const auto& e = fit.structure.effects.back();
          for (const auto& p : e->parameters(data, std::span(fit.coefficients).subspan(off, e->column_count()), fit.gain())) std::printf(" %s=%.4g", std::string(p.name).c_str(), p.value);
          std::printf(" %s\n", std::string(e->law()).c_str());
        }
        if (!trials.contains(kind) || fit_gain(rows, trials[kind].fit.fit, fit) > 0) trials[kind] = std::move(trial);
      }
    }
    const Trial* winner = nullptr;
    for (auto& [kind, trial] : trials) if (!winner || trial.comparison.evidence > winner->comparison.evidence) winner = &trial;
    if (!winner || winner->comparison.p > 1e-3) break;
    Step taken;
    taken.effect = winner->fit.fit.structure.effects.back()->kind();
    taken.holdout_error_before = winner->comparison.before;
    taken.holdout_error_after = winner->comparison.after;
    taken.evidence = winner->comparison.evidence;
    taken.p = winner->comparison.p;
    story.steps.push_back(taken);
    current = winner->fit.fit;
    data = dealt(original, current.structure);
    { Fit again = search_process(data, current.structure); if (again.fit_error < current.fit_error) current = std::move(again); }
    now = twin(data, current);
  }
  story.final = now.fit;
  story.final_mirror = now.mirror;
  return story;
}

}  // namespace loopscope::core::model
