#include "daemon/service/shared/compare_clocks.hpp"

#include <algorithm>
#include <exception>
#include <fmt/format.h>
#include <string>
#include <vector>

#include "daemon/service/historians/source_gate.hpp"

namespace loopscope::daemon {
namespace {

using Results = ClockJudgement::Results;

constexpr const char* kResultsSubject = "clock of the results server";

bool all_agree(const ClockJudgement& judgement) {
  return judgement.results == Results::believed && !judgement.host_is_wrong &&
         judgement.wrong_historians.empty();
}

bool is_among(const ClockReading& reading, const std::vector<ClockReading>& readings) {
  return std::ranges::find(readings, reading.clock, &ClockReading::clock) != readings.end();
}

void tell(const ClockReading& reading, bool is_wrong, const char* consequence,
          SharedServices& tools) {
  const std::string subject = "clock of " + reading.clock;
  if (!is_wrong) return tools.faults.recovered(subject);
  tools.faults.fault(subject, fmt::format("it is wrong, {}; {} HINT: set it right (NTP)",
                                          difference_text(reading.ahead_s), consequence));
}

void tell(const KnownClocks::State& state, SharedServices& tools) {
  const ClockJudgement& judgement = state.judgement;
  if (const auto why = refusal(state)) {
    tools.faults.fault(kResultsSubject, std::string(why->what()) + " HINT: " + why->hint());
  } else {
    tools.faults.recovered(kResultsSubject);
  }
  tell(state.host, judgement.host_is_wrong, "it decides nothing", tools);
  std::vector<ClockFigure> figures{{"results", 0.0, judgement.results != Results::believed},
                                   {"host", state.host.ahead_s, judgement.host_is_wrong}};
  for (const ClockReading& historian : state.historians) {
    const bool is_wrong = is_among(historian, judgement.wrong_historians);
    tell(historian, is_wrong, "its windows end at its newest rows", tools);
    figures.push_back({historian.clock, historian.ahead_s, is_wrong});
  }
  tools.metrics.set_clocks(figures);
}

}  // namespace

void ask_historians(const config::Settings& settings, SharedServices& tools) {
  for (const config::HistorianSettings& source : settings.historians) {
    try {
      tools.clocks.note_historian(
          source.name, tools.historians.with_reader(
                           source, source_terms(settings.schedule),
                           [](storage::HistorianReader& historian) { return historian.clock(); }));
    } catch (const std::exception&) {
      // Whoever wants its rows says so; as a witness it is missing.
    }
  }
}

KnownClocks::State look_at_clocks(const config::Settings& settings, SharedServices& tools,
                                  const std::function<storage::ServerClock()>& results_clock) {
  KnownClocks::State state = tools.clocks.note_results(results_clock());
  if (all_agree(state.judgement)) return state;
  ask_historians(settings, tools);
  return tools.clocks.note_results(results_clock());
}

std::optional<storage::DatabaseError> compare_clocks(const config::Settings& settings,
                                                     SharedServices& tools, ResultsLink& results) {
  tools.clocks.accept(
      results.with([](storage::ResultsDatabase& database) { return database.accepted_clocks(); }));
  const KnownClocks::State state = look_at_clocks(settings, tools, [&] {
    return results.with([](storage::ResultsDatabase& database) { return database.clock(); });
  });
  tell(state, tools);
  return refusal(state);
}

}  // namespace loopscope::daemon
