#include "tests/plants/flags.hpp"

#include <algorithm>
#include <cstddef>
#include <limits>

#include "core/plant/false_discovery.hpp"
#include "core/plant/list_by_odds.hpp"

namespace loopscope::tests::plants {
namespace {

bool is_shown(const DiagnosedLoop& loop, const FlagRule& rule) {
  return loop.verdict != "healthy" && loop.verdict != "insufficient_data" &&
         loop.verdict != "not_controlling" && loop.confidence >= rule.min_confidence;
}

/// Of the loops that may be shown; NaN for the others.
std::vector<double> fault_probabilities(const std::vector<DiagnosedLoop>& loops,
                                        const FlagRule& rule) {
  std::vector<double> result;
  for (const DiagnosedLoop& loop : loops) {
    const bool counts = is_shown(loop, rule) && loop.fault_probability;
    result.push_back(counts ? *loop.fault_probability : std::numeric_limits<double>::quiet_NaN());
  }
  return result;
}

/// Each loop's own p, of the tests that it may have been picked from; 1 where it is not shown.
std::vector<double> questions(const std::vector<DiagnosedLoop>& loops, const FlagRule& rule) {
  std::vector<double> family;
  for (const DiagnosedLoop& loop : loops) {
    const auto tests = static_cast<double>(loop.tests);
    const bool asked = is_shown(loop, rule) && loop.p;
    family.push_back(loop.tests == 0 ? std::numeric_limits<double>::quiet_NaN()
                                     : (asked ? std::min(1.0, *loop.p * tests) : 1.0));
  }
  return family;
}

}  // namespace

std::vector<bool> flagged(const std::vector<DiagnosedLoop>& loops, const FlagRule& rule) {
  const core::plant::FalseDiscovery control =
      core::plant::control_false_discovery(questions(loops, rule), rule.false_discovery_rate);
  const std::vector<bool> listed = core::plant::list_by_odds(
      fault_probabilities(loops, rule), rule.list_false_share, rule.list_least_probability);
  std::vector<bool> result;
  for (std::size_t k = 0; k < loops.size(); ++k) {
    const bool probable = !loops[k].fault_probability || listed[k];
    const bool rare = !loops[k].p || control.flagged[k] || rule.false_discovery_rate >= 1.0 ||
                      loops[k].windows >= rule.enough_windows;
    result.push_back(is_shown(loops[k], rule) && probable && rare);
  }
  return result;
}

std::vector<bool> flagged_after(const std::vector<DiagnosedLoop>& loops,
                                const std::vector<bool>& on_list, const FlagRule& rule) {
  std::vector<bool> result = flagged(loops, rule);
  std::vector<double> probability = fault_probabilities(loops, rule);
  for (std::size_t k = 0; k < on_list.size(); ++k)
    if (on_list[k] && loops[k].fault_probability) probability[k] = *loops[k].fault_probability;
  const std::vector<bool> stays =
      core::plant::list_by_odds(probability, rule.list_leave_share,
                                std::max(rule.min_confidence, rule.list_leave_probability));
  for (std::size_t k = 0; k < on_list.size(); ++k) {
    const bool silent = loops[k].verdict == "insufficient_data" ||
                        (!loops[k].fault_probability && is_shown(loops[k], rule));
    result[k] =
        result[k] || (on_list[k] && loops[k].verdict != "not_controlling" && (stays[k] || silent));
  }
  return result;
}

Flags flags_of(const std::vector<PlantLoop>& plant, const std::vector<DiagnosedLoop>& loops,
               const FlagRule& rule) {
  const std::vector<bool> on_the_list = flagged(loops, rule);
  Flags flags;
  for (std::size_t k = 0; k < plant.size(); ++k)
    if (on_the_list[k]) flags[plant[k].name] = loops[k].verdict;
  return flags;
}

}  // namespace loopscope::tests::plants
