#include "core/model/selection/stepwise_model.hpp"

#include <utility>

#include "core/model/fit/baseline.hpp"
#include "core/model/selection/intake.hpp"
#include "core/model/selection/selection_round.hpp"

namespace loopscope::core::model {
namespace {

constexpr std::size_t kMostEffects = 6;

}  // namespace

StepwiseModel start_selection(const LoopData& data) {
  return {data, cross_fit(data, search_process(data, {})), {}};
}

std::vector<TestOutcome> select_effects(StepwiseModel& story, std::vector<TestOutcome> answers,
                                        const ResidualTests& tests) {
  const LoopData original = story.data;
  bool after_a_step = false;
  while (story.chapters.size() < kMostEffects) {
    const Nominations asked(answers);
    bool passed_over = false;
    const auto seek = [&](Reach reach) {
      const Round round{original, story.data, story.last(), asked, after_a_step, reach};
      SelectionOutcome contest = run_selection_round(round);
      passed_over = contest.outdone_by.has_value();
      return take_in(std::move(contest.trials),
                     {original, tests, answers, contest.outdone_by, contest.passed_over}, story);
    };
    bool found = seek(Reach::promising);
    if (!found && passed_over) found = seek(Reach::asked);
    if (!found && !after_a_step && original.without.keeps(Mechanism::cheap_look))
      found = seek(Reach::unasked);
    if (!found && !after_a_step) break;
    if (found) {
      story.chapters.back().promise_rank = asked.rank(story.chapters.back().kind());
      answers = story.chapters.back().left;
    }
    after_a_step = found && story.chapters.back().kind() == EffectKind::load_step;
  }
  return answers;
}

}  // namespace loopscope::core::model
