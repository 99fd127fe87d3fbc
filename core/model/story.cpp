#include "core/model/story.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/model/baseline.hpp"
#include "core/model/calm_rows.hpp"
#include "core/model/contest.hpp"
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
  if (!data.without.has(Mechanism::calm_rows) || kept == all || kept < (1.0 - kMostUpset) * all)
    return twin(data, std::move(first));
  return twin(data, evaluate(data, search_process(calm, first.structure).structure));
}

/// The process once more with the effect in its place: process and noise may have been bent by its
/// absence, so that they are also sought from a plain noise.
void settle_chapter(const LoopData& rows, Chapter& chapter) {
  if (!rows.without.has(Mechanism::settled_chapter)) return;
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

EffectKind kind_of(const Chapter& chapter) {
  return chapter.fit.fit.structure.effects.back()->kind();
}

/// What an effect has to explain beyond chance where the tests that asked for it still see the
/// same. Of 395 effects that were right half left at most 0.04 of it and nine in ten at most 0.17;
/// 17 that a neighbour's wave was taken for left 0.5 in the median. 12 of the 17 do not enter at
/// this price, nor do 6 of the 395.
double price_of_share_left(double share) {
  constexpr double kPrice = 400.0;  // of evidence, of all that the tests saw
  return kPrice * share * share;
}

/// A test that sees one load step, or one line, sees the next one behind it.
bool comes_alone(EffectKind kind) {
  return !is_from_outside(kind);
}

bool answers_its_tests(const Contestant& trial, const Chapter& chapter) {
  const EffectKind kind = kind_of(chapter);
  if (!comes_alone(kind) || !trial.rows.without.has(Mechanism::share_left)) return true;
  const double left = share_left(asked_by(kind, chapter.asked_for, chapter.left));
  return std::exp(-0.5 * (trial.worth() - price_of_share_left(left))) <= kEnters;
}

/// The first of the trials that enters, explains something further ahead as well and answers the
/// tests that asked for it becomes a chapter.
bool take_in(std::vector<Contestant> trials, const LoopData& original, const ResidualTests& tests,
             const std::vector<Answer>& answers, Story& story) {
  const LoopData data = story.data;
  while (!trials.empty() && trials.front().enters()) {
    if (!foresees(trials.front())) {
      trials.erase(trials.begin());
      continue;
    }
    add_chapter(original, trials, story);
    Chapter& chapter = story.chapters.back();
    chapter.asked_for = answers;
    chapter.left = tests(story.data, chapter.fit.fit);
    if (answers_its_tests(trials.front(), chapter)) return true;
    story.chapters.pop_back();
    story.data = data;
    trials.erase(trials.begin());
  }
  return false;
}

}  // namespace

Story begin_story(const LoopData& data) {
  return {data, linear_baseline(data), {}};
}

std::vector<Answer> continue_story(Story& story, std::vector<Answer> answers,
                                   const ResidualTests& tests) {
  const LoopData original = story.data;
  bool after_a_step = false;
  while (story.chapters.size() < kMostEffects) {
    const Asked asked(answers);
    const auto seek = [&](bool unasked) {
      const Round round{original, story.data, story.last(), asked, after_a_step, unasked};
      return take_in(hold_contest(round), original, tests, answers, story);
    };
    bool found = seek(false);
    if (!found && !after_a_step && original.without.has(Mechanism::cheap_look)) found = seek(true);
    if (!found && !after_a_step) break;
    if (found) {
      story.chapters.back().promise_rank = asked.rank(kind_of(story.chapters.back()));
      answers = story.chapters.back().left;
    }
    after_a_step = found && kind_of(story.chapters.back()) == EffectKind::load_step;
  }
  return answers;
}

}  // namespace loopscope::core::model
