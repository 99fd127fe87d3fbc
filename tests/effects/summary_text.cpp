#include <algorithm>
#include <iomanip>
#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/effects/summary.hpp"

namespace loopscope::tests::effects {
namespace {

using Counts = std::map<std::string, std::size_t>;
using Json = nlohmann::ordered_json;

std::string figure(const std::optional<double>& value, int digits) {
  if (!value) return "-";
  std::ostringstream text;
  text << std::fixed << std::setprecision(digits) << *value;
  return text.str();
}

/// "valve_stiction 17, - 3": the most frequent first.
std::string words_of(const Counts& counts) {
  std::vector<std::pair<std::string, std::size_t>> sorted(counts.begin(), counts.end());
  std::stable_sort(sorted.begin(), sorted.end(),
                   [](const auto& a, const auto& b) { return a.second > b.second; });
  std::string text;
  for (const auto& [word, count] : sorted)
    text += (text.empty() ? "" : ", ") + word + " " + std::to_string(count);
  return text;
}

void add_row(std::ostringstream& text, const std::vector<std::string>& cells) {
  text << std::left << std::setw(32) << cells.front() << std::right;
  for (std::size_t i = 1; i + 1 < cells.size(); ++i) text << std::setw(9) << cells[i];
  text << "  " << cells.back() << "\n";
}

void add_kind(std::ostringstream& text, const KindSummary& kind) {
  add_row(text, {kind.kind, std::to_string(kind.draws), figure(kind.named_right, 2),
                 figure(kind.verdict_right, 2), figure(kind.all_found, 2),
                 figure(kind.parameter_error, 3), figure(kind.explainable, 3),
                 figure(kind.error_before, 3), figure(kind.error_after, 3),
                 figure(kind.model_floor, 3), figure(kind.explained, 2), words_of(kind.verdicts)});
  if (!kind.named.empty())
    text << std::string(34, ' ') << "named: " << words_of(kind.named) << "\n";
}

Json number(const std::optional<double>& value) {
  return value ? Json(*value) : Json(nullptr);
}

Json json_of(const KindSummary& kind) {
  return {{"draws", kind.draws},
          {"named_right", number(kind.named_right)},
          {"verdict_right", kind.verdict_right},
          {"all_found", number(kind.all_found)},
          {"parameter_error", number(kind.parameter_error)},
          {"parameter_errors", kind.parameter_errors},
          {"explainable", number(kind.explainable)},
          {"error_before", number(kind.error_before)},
          {"error_after", number(kind.error_after)},
          {"floor", 1.0},  // the unit of the errors
          {"model_floor", number(kind.model_floor)},
          {"explained", number(kind.explained)},
          {"named", kind.named},
          {"verdicts", kind.verdicts}};
}

Json json_of(const std::string& kind, std::uint64_t seed, const Outcome& outcome) {
  return {{"kind", kind},
          {"seed", seed},
          {"verdict", outcome.verdict},
          {"confidence", outcome.confidence},
          {"verdict_right", outcome.verdict_right},
          {"accuses_hardware", outcome.accuses_hardware},
          {"misleads", outcome.misleads},
          {"steps", outcome.steps},
          {"asked_for", outcome.asked_for},
          {"first_rank", outcome.first_rank},
          {"named_right", outcome.named_right},
          {"all_found", outcome.all_found},
          {"explainable", outcome.explainable},
          {"error_before", number(outcome.error_before)},
          {"error_after", number(outcome.error_after)},
          {"milliseconds", outcome.milliseconds}};
}

}  // namespace

std::string table_of(const Summary& summary) {
  std::ostringstream text;
  add_row(text, {"kind", "draws", "named", "verdict", "all", "par.err", "explnbl", "before",
                 "after", "floor~", "expl.", "verdicts"});
  for (const KindSummary& kind : summary.kinds) add_kind(text, kind);
  text << "\nexplnbl: median of what the effects add to the error of a linear model, by the floor\n"
       << "before, after: median one-step error by the true floor; floor~: the model's own "
          "estimate"
          " of it; expl.: median share of the excess that the steps explain\n"
       << "accuracy (verdict, catalogue)     " << figure(summary.accuracy, 3) << "\n"
       << "first step right                  " << figure(summary.named_accuracy, 3) << "\n"
       << "both found (pairs)                " << figure(summary.both_found, 3) << "\n"
       << "false on healthy                  " << figure(summary.false_on_healthy, 3) << "\n"
       << "overconfident on unknown          " << figure(summary.overconfident_unknown, 3) << "\n"
       << "right verdicts above 0.6          " << figure(summary.confident_right, 3) << "\n"
       << "Brier score of confidence         " << figure(summary.brier, 3) << "\n"
       << "median ms of a diagnosis          " << figure(summary.model_ms, 0) << "\n";
  return text.str();
}

std::string lines_of(const Plan& plan, const std::vector<std::vector<Outcome>>& outcomes) {
  std::string text;
  for (std::size_t kind = 0; kind < plan.kinds.size(); ++kind) {
    for (std::size_t draw = 0; draw < plan.draws; ++draw)
      text += json_of(plan.kinds[kind], plan.seed + draw, outcomes[kind][draw]).dump() + "\n";
  }
  return text;
}

std::string json_of(const Summary& summary) {
  Json kinds = Json::object();
  for (const KindSummary& kind : summary.kinds) kinds[kind.kind] = json_of(kind);
  const Json all = {{"kinds", kinds},
                    {"accuracy", number(summary.accuracy)},
                    {"named_accuracy", number(summary.named_accuracy)},
                    {"both_found", number(summary.both_found)},
                    {"false_on_healthy", number(summary.false_on_healthy)},
                    {"overconfident_unknown", number(summary.overconfident_unknown)},
                    {"confident_right", number(summary.confident_right)},
                    {"brier", number(summary.brier)},
                    {"model_ms", number(summary.model_ms)}};
  return all.dump(2) + "\n";
}

}  // namespace loopscope::tests::effects
