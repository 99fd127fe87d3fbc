#include "core/model/story.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "core/model/baseline.hpp"
#include "core/model/calm_rows.hpp"
#include "core/model/effects/load_step.hpp"
#include "core/model/nominate.hpp"
#include "core/model/nominate_valves.hpp"
#include "core/model/simulation_error.hpp"

namespace loopscope::core::model {
namespace {

/// One healthy loop in a thousand and kind of effect.
constexpr double kEnterP = 1e-3;
constexpr std::size_t kMostEffects = 6;
/// An effect that does not gain so much (n ln) where it was fitted gains nothing on unseen rows.
constexpr double kWorthFitting = 8.0;
/// A sudden step is seen by fit and score over so many samples from two before it on.
constexpr std::size_t kStepBefore = 2;
constexpr std::size_t kStepSamples = 16;

bool is_valve(EffectKind kind) {
  return kind == EffectKind::valve_stiction || kind == EffectKind::valve_deadband;
}

/// What it gains is counted once: where it sits (a step) or where pv puts it right (a valve) was
/// taken from the fit rows, so that the mirrored fit has nothing unseen to be scored on.
bool scored_once(EffectKind kind) {
  return kind == EffectKind::load_step || is_valve(kind);
}

/// Found by looking through all places, frequencies or bands on all rows, which count as tries.
bool sought_everywhere(EffectKind kind) {
  return kind == EffectKind::load_step || kind == EffectKind::external_oscillation ||
         is_valve(kind);
}

/// How often one kind may come.
std::ptrdiff_t most_of(EffectKind kind) {
  if (kind == EffectKind::load_step) return 3;
  return kind == EffectKind::external_oscillation ? 2 : 1;
}

bool has_room(const Structure& structure, EffectKind kind) {
  const auto same = [&](const EffectPtr& effect) {
    return effect->kind() == kind || (is_valve(kind) && is_valve(effect->kind()));
  };
  return std::ranges::count_if(structure.effects, same) < most_of(kind);
}

Structure with(Structure structure, EffectPtr effect) {
  structure.effects.push_back(std::move(effect));
  return structure;
}

LoopData judged_on(LoopData data, const Structure& structure) {
  for (const EffectPtr& effect : structure.effects) {
    if (const auto* step = dynamic_cast<const LoadStep*>(effect.get())) {
      const std::size_t from = step->at() < kStepBefore ? 0 : step->at() - kStepBefore;
      data.rows = seen_by_both(data.rows, from, kStepSamples);
    }
  }
  return data;
}

TwinFit reevaluated(const LoopData& rows, const TwinFit& fit) {
  return {evaluate(rows, fit.fit.structure), evaluate(mirrored(rows), fit.mirror.structure)};
}

/// One round: what is to be explained, and on which rows.
struct Round {
  const LoopData& original;
  const LoopData& data;
  const TwinFit& now;
  const std::vector<EffectPtr>& valves;  ///< nominated once: they rest on op and pv alone
  bool limits_called_for;  ///< a first look at a limit, by the wrong process, may see nothing of it
};

struct Candidate {
  EffectPtr effect;
  Fit fit;            ///< a first look: process and noise as they are, or by glance()
  double gain = 0.0;  ///< n ln on the fit rows
};

std::vector<EffectPtr> nominees(const Round& round) {
  std::vector<EffectPtr> all = nominate_static(round.data, round.now.fit);
  for (const auto& more :
       {nominate_gain_changes(round.data), nominate_load_steps(round.data, round.now.fit),
        nominate_oscillations(round.data, round.now.fit)}) {
    all.insert(all.end(), more.begin(), more.end());
  }
  if (has_room(round.now.fit.structure, EffectKind::valve_stiction)) {
    all.insert(all.end(), round.valves.begin(), round.valves.end());
  }
  return all;
}

bool bends_flow(EffectKind kind) {
  return is_valve(kind) || kind == EffectKind::valve_saturation;
}

Candidate look_at(const Round& round, const EffectPtr& effect) {
  Structure structure = with(round.now.fit.structure, effect);
  if (bends_flow(effect->kind())) {
    structure.process = glance(round.data, structure).shape;
    structure.two_taps = false;
    structure.second_order = false;
  }
  const LoopData rows = judged_on(round.original, structure);
  Candidate candidate{effect, evaluate(rows, structure), 0.0};
  const Fit before = effect->kind() == EffectKind::load_step
                         ? evaluate(rows, round.now.fit.structure)
                         : round.now.fit;
  candidate.gain = fit_gain(rows, before, candidate.fit);
  return candidate;
}

using Candidates = std::map<EffectKind, std::vector<Candidate>>;

/// The valve's two kinds go under one name: which it is shows when its jump has been fitted.
Candidates looked_at(const Round& round) {
  Candidates result;
  for (const EffectPtr& effect : nominees(round)) {
    const EffectKind kind = is_valve(effect->kind()) ? EffectKind::valve_stiction : effect->kind();
    if (has_room(round.now.fit.structure, kind)) result[kind].push_back(look_at(round, effect));
  }
  for (auto& [kind, list] : result) std::ranges::sort(list, std::greater{}, &Candidate::gain);
  return result;
}

struct Trial {
  TwinFit fit;
  Comparison comparison;
  LoopData rows;
  TwinFit before;
  [[nodiscard]] EffectKind kind() const { return fit.fit.structure.effects.back()->kind(); }
};

Structure without_last(Structure structure) {
  structure.effects.pop_back();
  return structure;
}

/// A trial searches the process again, and may leave a local optimum that the model without the
/// effect sits in. What that gains is not the effect's: it is compared with the better of both.
void compare_fairly(Trial& trial) {
  const bool once = scored_once(trial.kind());
  trial.comparison = compare(trial.rows, trial.before, trial.fit, once);
  const TwinFit bare = twin(trial.rows, polish(trial.rows, without_last(trial.fit.fit.structure)));
  const Comparison fair = compare(trial.rows, bare, trial.fit, once);
  if (fair.evidence >= trial.comparison.evidence) return;
  trial.comparison = fair;
  trial.before = bare;
}

Trial finished(const Round& round, Trial trial, Fit fit) {
  trial.fit = twin(trial.rows, std::move(fit));
  compare_fairly(trial);
  if (sought_everywhere(trial.kind())) {
    trial.comparison.p = std::min(1.0, trial.comparison.p * static_cast<double>(round.data.size()));
  }
  return trial;
}

/// The best valve once more by the other laws.
void try_other_laws(const Round& round, std::optional<Trial>& best) {
  if (!best || !is_valve(best->kind())) return;
  Fit fit = cross_laws(best->rows, best->fit.fit);
  if (fit.fit_error >= best->fit.fit.fit_error) return;
  Trial trial = finished(round, {{}, {}, best->rows, best->before}, std::move(fit));
  if (trial.comparison.evidence > best->comparison.evidence) best = std::move(trial);
}

std::optional<Trial> try_candidate(const Round& round, const Candidate& candidate) {
  const EffectKind kind = candidate.effect->kind();
  const bool called_for =
      is_valve(kind) || (kind == EffectKind::valve_saturation && round.limits_called_for);
  if (!called_for && candidate.gain < kWorthFitting) return std::nullopt;
  Trial trial{{}, {}, judged_on(round.original, candidate.fit.structure), round.now};
  if (candidate.effect->kind() == EffectKind::load_step)
    trial.before = reevaluated(trial.rows, round.now);
  Fit fit = fit_anew(trial.rows, candidate.fit);
  if (fit_gain(trial.rows, trial.before.fit, fit) < kWorthFitting) return std::nullopt;
  return finished(round, std::move(trial), std::move(fit));
}

/// The law as far as a candidate has one: of the three valve laws and plain play each is tried.
std::string_view law_of(const Candidate& candidate) {
  return is_valve(candidate.effect->kind()) ? candidate.effect->law() : std::string_view("none");
}

/// The best candidate of each law; of load steps all, since the error of one that is still to come
/// hides what another gains.
std::vector<Candidate> worth_trying(const std::vector<Candidate>& list) {
  if (!list.empty() && list.front().effect->kind() == EffectKind::load_step) return list;
  std::vector<Candidate> chosen;
  for (const Candidate& candidate : list) {
    const auto same = [&](const Candidate& other) { return law_of(other) == law_of(candidate); };
    if (std::ranges::none_of(chosen, same)) chosen.push_back(candidate);
  }
  return chosen;
}

/// The best trial of each kind, most evidence first.
std::vector<Trial> trials_of(const Round& round) {
  std::vector<Trial> result;
  for (const auto& [kind, list] : looked_at(round)) {
    std::optional<Trial> best;
    for (const Candidate& candidate : worth_trying(list)) {
      std::optional<Trial> trial = try_candidate(round, candidate);
      if (trial && (!best || trial->comparison.evidence > best->comparison.evidence))
        best = std::move(trial);
    }
    try_other_laws(round, best);
    if (best) result.push_back(std::move(*best));
  }
  std::ranges::sort(result, std::greater{},
                    [](const Trial& trial) { return trial.comparison.evidence; });
  return result;
}

double rival_evidence(const std::vector<Trial>& trials) {
  for (const Trial& trial : trials) {
    if (!same_cause(trial.kind(), trials.front().kind()))
      return std::max(0.0, trial.comparison.evidence);
  }
  return 0.0;
}

Chapter chapter_of(const std::vector<Trial>& trials) {
  const Trial& winner = trials.front();
  Chapter chapter{winner.fit, winner.comparison, rival_evidence(trials), 1.0};
  chapter.simulation_ratio = simulation_error(winner.rows, winner.fit.fit) /
                             simulation_error(winner.rows, winner.before.fit);
  return chapter;
}

TwinFit linear_baseline(const LoopData& data) {
  Structure start;
  Fit first = search_process(data, start);
  LoopData calm = data;
  calm.rows = calm_rows(data.rows, first);
  if (calm.rows.fit_count() == data.rows.fit_count()) return twin(data, std::move(first));
  return twin(data, evaluate(data, search_process(calm, first.structure).structure));
}

/// The process once more with the effect in its place: it may have been bent by its absence.
void settle_chapter(const LoopData& rows, Chapter& chapter) {
  Fit again = search_process(rows, chapter.fit.fit.structure);
  if (again.fit_error < chapter.fit.fit.fit_error) chapter.fit = twin(rows, std::move(again));
}

/// Hysteresis shows in how the residual follows op's direction and its travel since it turned.
bool calls_for(const std::vector<Answer>& answers, std::string_view question) {
  constexpr double kSuspicious = 0.05;
  return std::ranges::any_of(answers, [&](const Answer& answer) {
    return answer.question.name == question && answer.question.p <= kSuspicious;
  });
}

}  // namespace

Story begin_story(const LoopData& data) {
  return {data, linear_baseline(data), {}};
}

void continue_story(Story& story, const std::vector<Answer>& answers) {
  const LoopData original = story.data;
  const std::vector<EffectPtr> valves =
      calls_for(answers, "op_direction") ? nominate_valves(original) : std::vector<EffectPtr>{};
  while (story.chapters.size() < kMostEffects) {
    const std::vector<Trial> trials =
        trials_of({original, story.data, story.last(), valves, calls_for(answers, "op_level")});
    if (trials.empty() || trials.front().comparison.p > kEnterP) break;
    Chapter chapter = chapter_of(trials);
    story.data = judged_on(original, chapter.fit.fit.structure);
    settle_chapter(story.data, chapter);
    story.chapters.push_back(std::move(chapter));
  }
}

}  // namespace loopscope::core::model
