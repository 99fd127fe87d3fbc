#include "tests/effects/residual_tests.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <span>

#include "core/diagnosis/diagnose.hpp"
#include "core/model/baseline_analysis.hpp"
#include "core/model/residual_tests/run_residual_tests.hpp"
#include "tests/effects/window_of.hpp"
#include "tests/support/in_threads.hpp"

namespace loopscope::tests::effects {
namespace {

using core::model::TestOutcome;

std::vector<std::string> tests_of(const std::vector<std::vector<TestOutcome>>& draws) {
  std::vector<std::string> names;
  for (const std::vector<TestOutcome>& answers : draws) {
    for (const TestOutcome& answer : answers)
      if (std::ranges::find(names, answer.question.name) == names.end())
        names.emplace_back(answer.question.name);
  }
  return names;
}

/// A share of 100.0 has to fit.
std::size_t width_of(const std::string& test) {
  return std::max<std::size_t>(5, test.size());
}

std::string line_of(const std::string& kind, std::span<const std::vector<TestOutcome>> draws,
                    const std::vector<std::string>& tests) {
  std::string line = fmt::format("{:32}", kind);
  for (const std::string& test : tests) {
    const auto passes = std::ranges::count_if(draws, [&](const std::vector<TestOutcome>& answers) {
      return p_of(answers, test) <= core::model::kNominates;
    });
    const double share = 100.0 * static_cast<double>(passes) / static_cast<double>(draws.size());
    line += fmt::format(" {:>{}.1f}", share, width_of(test));
  }
  return line + "\n";
}

}  // namespace

std::vector<TestOutcome> answers_of(const std::string& kind, std::uint64_t seed, const Plan& plan) {
  const Record record = generate(kind, seed, plan.size, plan.noise);
  const core::FirstLook first = core::first_look(window_of(record, record.interval_s), {});
  return core::model::analyse_baseline(core::model_input(first, {.seed = seed})).answers;
}

std::string passing_table(const Plan& plan) {
  std::vector<std::vector<TestOutcome>> draws(plan.kinds.size() * plan.draws);
  in_threads(draws.size(), plan.threads, [&](std::size_t job) {
    draws[job] = answers_of(plan.kinds[job / plan.draws], plan.seed + job % plan.draws, plan);
  });
  const std::vector<std::string> tests = tests_of(draws);
  std::string table = fmt::format("{:32}", "kind");
  for (const std::string& test : tests) table += fmt::format(" {:>{}}", test, width_of(test));
  table += "\n";
  for (std::size_t kind = 0; kind < plan.kinds.size(); ++kind)
    table +=
        line_of(plan.kinds[kind], std::span(draws).subspan(kind * plan.draws, plan.draws), tests);
  return table;
}

}  // namespace loopscope::tests::effects
