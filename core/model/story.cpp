#include "core/model/story.hpp"

#include <algorithm>
#include <optional>
#include <string_view>
#include <utility>

#include "core/model/baseline.hpp"
#include "core/model/calm_rows.hpp"
#include "core/model/contest.hpp"
#include "core/model/nominate_valves.hpp"
#include "core/model/put_questions.hpp"
#include "core/model/simulation_error.hpp"

namespace loopscope::core::model {
namespace {

constexpr std::size_t kMostEffects = 6;

/// At the price of the winner's search.
double rival_evidence(const std::vector<Contestant>& trials) {
  const Contestant& winner = trials.front();
  for (const Contestant& trial : trials) {
    if (!same_cause(trial.kind(), winner.kind()))
      return std::max(0.0, trial.worth() + winner.price);
  }
  return 0.0;
}

/// All but its fit.
Chapter chapter_of(const std::vector<Contestant>& trials) {
  const Contestant& winner = trials.front();
  Chapter chapter;
  chapter.comparison = winner.comparison;
  chapter.rival_evidence = rival_evidence(trials);
  chapter.simulation_ratio = simulation_error(winner.rows, winner.fit.fit) /
                             simulation_error(winner.rows, winner.before.fit);
  chapter.judged = {winner.fit, winner.rows.rows, winner.scored_once()};
  return chapter;
}

TwinFit linear_baseline(const LoopData& data) {
  Structure start;
  Fit first = search_process(data, start);
  LoopData calm = data;
  calm.rows = calm_rows(data.rows, first);
  const auto kept = static_cast<double>(calm.rows.fit_count());
  const auto all = static_cast<double>(data.rows.fit_count());
  // What is left out more often is no upset but the loop's own way.
  constexpr double kMostUpset = 0.1;
  if (kept == all || kept < (1.0 - kMostUpset) * all) return twin(data, std::move(first));
  return twin(data, evaluate(data, search_process(calm, first.structure).structure));
}

/// The process once more with the effect in its place: process and noise may have been bent by its
/// absence, so that they are also sought from a plain noise.
void settle_chapter(const LoopData& rows, Chapter& chapter) {
  Structure plain = chapter.fit.fit.structure;
  plain.noise = NoiseModel{};
  for (const Structure& start : {chapter.fit.fit.structure, plain}) {
    Fit again = search_process(rows, start);
    if (again.fit_error < chapter.fit.fit.fit_error && is_plausible(again))
      chapter.fit = twin(rows, std::move(again));
  }
}

void add_chapter(const LoopData& original, std::vector<Contestant>& trials, Story& story) {
  complete(trials.front());
  Chapter chapter = chapter_of(trials);
  const TwinFit& judged = chapter.judged.fit;
  story.data = judged_on(original, judged.fit.structure);
  chapter.fit = reevaluated(story.data, judged);
  settle_chapter(story.data, chapter);
  story.chapters.push_back(std::move(chapter));
}

/// A question whose answer makes a costly search worth while: hysteresis shows in how the residual
/// follows op's direction, a limit in how it follows op's level.
constexpr double kSuspicious = 0.05;
bool calls_for(const std::vector<Answer>& answers, std::string_view question) {
  return p_of(answers, question) <= kSuspicious;
}

/// The same of what the effects found so far have left: an oscillation or a curve that is in the
/// model by now may have been all that looked like hysteresis.
bool still_calls_for_valves(const Story& story) {
  return story.chapters.empty() || p_of_op_direction(story.data, story.last().fit) <= kSuspicious;
}

}  // namespace

Story begin_story(const LoopData& data) {
  return {data, linear_baseline(data), {}};
}

void continue_story(Story& story, const std::vector<Answer>& answers) {
  const LoopData original = story.data;
  std::optional<std::vector<EffectPtr>> tracked;
  const auto track = [&]() -> const std::vector<EffectPtr>& {
    if (!tracked) tracked = nominate_valves(original);
    return *tracked;
  };
  const bool hysteresis = calls_for(answers, "op_direction");
  const bool limits = calls_for(answers, "op_level");
  bool after_a_step = false;
  while (story.chapters.size() < kMostEffects) {
    Round round{original, story.data, story.last(), nullptr, after_a_step, limits};
    if (hysteresis && !after_a_step && still_calls_for_valves(story)) round.tracked_valves = track;
    std::vector<Contestant> trials = hold_contest(round);
    const bool enters = !trials.empty() && trials.front().enters();
    if (enters) add_chapter(original, trials, story);
    if (!enters && !after_a_step) break;
    after_a_step = enters && trials.front().kind() == EffectKind::load_step;
  }
}

}  // namespace loopscope::core::model
