#include "tests/effects/summary.hpp"

#include <algorithm>
#include <cmath>

#include "tests/effects/kinds.hpp"

namespace loopscope::tests::effects {
namespace {

constexpr double kConfident = 0.6;

using Optional = std::optional<double>;

Optional median(std::vector<double> values) {
  if (values.empty()) return std::nullopt;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

template <typename Value>
Optional mean_of(const std::vector<Outcome>& outcomes, const Value& value) {
  if (outcomes.empty()) return std::nullopt;
  double sum = 0.0;
  for (const Outcome& outcome : outcomes) sum += static_cast<double>(value(outcome));
  return sum / static_cast<double>(outcomes.size());
}

template <typename Value>
Optional median_of(const std::vector<Outcome>& outcomes, const Value& value) {
  std::vector<double> values;
  for (const Outcome& outcome : outcomes)
    if (const Optional one = value(outcome)) values.push_back(*one);
  return median(std::move(values));
}

template <typename Keep>
std::vector<Outcome> only(const std::vector<Outcome>& outcomes, const Keep& keep) {
  std::vector<Outcome> kept;
  std::copy_if(outcomes.begin(), outcomes.end(), std::back_inserter(kept), keep);
  return kept;
}

bool modelled(const Outcome& outcome) {
  return outcome.modelled;
}

/// nullopt where the linear model already stands within a hundredth of the floor.
Optional explained(const Outcome& outcome) {
  if (!outcome.error_before || *outcome.error_before < 1.01) return std::nullopt;
  return (*outcome.error_before - *outcome.error_after) / (*outcome.error_before - 1.0);
}

void add_parameter_errors(KindSummary& summary, const std::vector<Outcome>& outcomes) {
  std::map<std::string, std::vector<double>> errors;
  std::vector<double> all;
  for (const Outcome& outcome : outcomes)
    for (const auto& [name, error] : outcome.parameter_errors) {
      errors[name].push_back(error);
      all.push_back(error);
    }
  for (const auto& [name, values] : errors) summary.parameter_errors[name] = *median(values);
  summary.parameter_error = median(std::move(all));
}

KindSummary summarise_kind(const std::string& kind, const std::vector<Outcome>& outcomes) {
  const std::vector<Outcome> with_model = only(outcomes, modelled);
  KindSummary summary;
  summary.kind = kind;
  summary.group = recipe_of(kind).info.group;
  summary.draws = outcomes.size();
  summary.named_right = mean_of(with_model, [](const Outcome& o) { return o.named_right; });
  summary.verdict_right =
      mean_of(outcomes, [](const Outcome& o) { return o.verdict_right; }).value_or(0.0);
  summary.all_found = mean_of(with_model, [](const Outcome& o) { return o.all_found; });
  add_parameter_errors(summary, outcomes);
  summary.explainable =
      median_of(outcomes, [](const Outcome& o) { return Optional(o.explainable); });
  summary.error_before = median_of(outcomes, [](const Outcome& o) { return o.error_before; });
  summary.error_after = median_of(outcomes, [](const Outcome& o) { return o.error_after; });
  summary.model_floor = median_of(outcomes, [](const Outcome& o) { return o.model_floor; });
  summary.explained = median_of(outcomes, explained);
  for (const Outcome& outcome : outcomes) ++summary.verdicts[outcome.verdict];
  for (const Outcome& outcome : with_model)
    ++summary.named[outcome.steps.empty() ? "-" : outcome.steps.front()];
  return summary;
}

/// Outcomes of all kinds of the groups.
std::vector<Outcome> of_groups(const Plan& plan, const std::vector<std::vector<Outcome>>& outcomes,
                               std::initializer_list<Group> groups) {
  std::vector<Outcome> all;
  for (std::size_t i = 0; i < plan.kinds.size(); ++i) {
    const Group group = recipe_of(plan.kinds[i]).info.group;
    if (std::find(groups.begin(), groups.end(), group) != groups.end())
      all.insert(all.end(), outcomes[i].begin(), outcomes[i].end());
  }
  return all;
}

double squared_surprise(const Outcome& outcome) {
  const double miss = outcome.confidence - (outcome.verdict_right ? 1.0 : 0.0);
  return miss * miss;
}

}  // namespace

Summary summarise(const Plan& plan, const std::vector<std::vector<Outcome>>& outcomes) {
  using enum Group;
  const auto part = [&](std::initializer_list<Group> groups) {
    return of_groups(plan, outcomes, groups);
  };
  const auto right = [](const Outcome& o) { return o.verdict_right; };
  const auto everything = part({healthy, single, pair, unknown});
  const auto catalogue = part({healthy, single, pair});
  Summary summary;
  for (std::size_t i = 0; i < plan.kinds.size(); ++i)
    summary.kinds.push_back(summarise_kind(plan.kinds[i], outcomes[i]));
  summary.accuracy = mean_of(catalogue, right);
  summary.named_accuracy =
      mean_of(only(part({single, pair}), modelled), [](const Outcome& o) { return o.named_right; });
  summary.false_on_healthy =
      mean_of(part({healthy}), [](const Outcome& o) { return o.accuses_hardware; });
  summary.both_found =
      mean_of(only(part({pair}), modelled), [](const Outcome& o) { return o.all_found; });
  summary.overconfident_unknown = mean_of(
      part({unknown}), [](const Outcome& o) { return o.misleads && o.confidence > kConfident; });
  summary.confident_right =
      mean_of(only(catalogue, right), [](const Outcome& o) { return o.confidence > kConfident; });
  summary.brier = mean_of(everything, squared_surprise);
  summary.model_ms =
      median_of(everything, [](const Outcome& o) { return Optional(o.milliseconds); });
  return summary;
}

}  // namespace loopscope::tests::effects
