#include "tests/effects/field_draws.hpp"

#include <chrono>
#include <nlohmann/json.hpp>
#include <utility>

#include "core/diagnosis/analysis_settings.hpp"
#include "core/diagnosis/diagnose.hpp"
#include "tests/core/model/field_families.hpp"
#include "tests/core/model/field_recordings.hpp"
#include "tests/support/command_words.hpp"
#include "tests/support/in_threads.hpp"

namespace loopscope::tests::effects {
namespace {

void judge(const core::signal::LoopWindow& window, bool level, const Plan& plan,
           FieldOutcome& outcome) {
  using Clock = std::chrono::steady_clock;
  const auto start = Clock::now();
  const core::Diagnosis diagnosis = core::diagnose(
      window, {}, {.integrating = level, .seed = outcome.seed, .without = plan.without});
  outcome.milliseconds = std::chrono::duration<double, std::milli>(Clock::now() - start).count();
  outcome.verdict = name(diagnosis.verdict.code);
  outcome.confidence = diagnosis.verdict.confidence;
  outcome.accuses_valve =
      outcome.verdict == "valve_stiction" || outcome.verdict == "valve_deadband";
}

template <typename Source>
core::signal::LoopWindow window_of(const Source& source) {
  core::signal::LoopWindow window;
  window.sp = source.sp;
  window.pv = source.pv;
  window.op = source.op;
  return window;
}

}  // namespace

std::vector<FieldOutcome> field_draws(const Plan& plan) {
  const auto families = model::field_families();
  std::vector<FieldOutcome> outcomes(families.size() * plan.draws);
  in_threads(outcomes.size(), plan.threads, [&](std::size_t job) {
    const model::FieldFamily& family = families[job / plan.draws];
    FieldOutcome& outcome = outcomes[job];
    outcome.kind = family.name;
    outcome.seed = plan.seed + job % plan.draws;
    outcome.sticks = family.sticks;
    judge(window_of(record_of(family, outcome.seed)), is_level(family), plan, outcome);
  });
  return outcomes;
}

std::vector<FieldOutcome> recorded(const Plan& plan, const std::string& manifest) try {
  std::vector<model::FieldRecording> recordings = model::recordings_of(manifest);
  std::erase_if(recordings, [](const model::FieldRecording& recording) {
    return recording.label != "stiction" && recording.label != "no_stiction";
  });
  if (recordings.empty()) throw WrongUsage("no labelled recordings in " + manifest);
  std::vector<FieldOutcome> outcomes(recordings.size());
  in_threads(outcomes.size(), plan.threads, [&](std::size_t job) {
    const model::FieldRecording& recording = recordings[job];
    FieldOutcome& outcome = outcomes[job];
    outcome.kind = recording.label;
    outcome.seed = job;
    outcome.sticks = recording.label == "stiction";
    judge(window_of(recording), core::is_integrating_type(recording.type), plan, outcome);
  });
  return outcomes;
} catch (const std::invalid_argument& unreadable) {
  throw WrongUsage(unreadable.what());
}

std::string lines_of(const std::vector<FieldOutcome>& outcomes) {
  std::string lines;
  for (const FieldOutcome& outcome : outcomes) {
    const nlohmann::ordered_json line = {{"kind", outcome.kind},
                                         {"seed", outcome.seed},
                                         {"verdict", outcome.verdict},
                                         {"confidence", outcome.confidence},
                                         {"sticks", outcome.sticks},
                                         {"accuses_valve", outcome.accuses_valve},
                                         {"milliseconds", outcome.milliseconds}};
    lines += line.dump() + "\n";
  }
  return lines;
}

}  // namespace loopscope::tests::effects
