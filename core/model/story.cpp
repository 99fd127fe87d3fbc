#include "core/model/story.hpp"

#include <utility>

#include "core/model/baseline.hpp"
#include "core/model/calm_rows.hpp"
#include "core/model/contest.hpp"
#include "core/model/intake.hpp"

namespace loopscope::core::model {
namespace {

constexpr std::size_t kMostEffects = 6;

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
      return take_in(hold_contest(round), {original, tests, answers}, story);
    };
    bool found = seek(false);
    if (!found && !after_a_step && original.without.has(Mechanism::cheap_look)) found = seek(true);
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
