#include "daemon/service/batches/analyse_window.hpp"

#include <fmt/format.h>

#include "core/hos/bicoherence/triple_sums.hpp"
#include "core/signal/grid.hpp"
#include "core/signal/window_digest.hpp"
#include "daemon/output/analysis_json.hpp"
#include "daemon/output/model_json.hpp"
#include "daemon/service/observe/stopwatch.hpp"

namespace loopscope::daemon {

namespace {

using core::signal::LoopWindow;

/// core::diagnose(), each stage timed.
core::Diagnosis timed_diagnosis(const LoopInput& input, const core::AnalysisSettings& settings,
                                const core::LoopFacts& facts, const ModelPolicy& wish,
                                storage::AnalysisRecord& record) {
  // What a first look threw, it throws again.
  const std::optional<core::FirstLook> again =
      input.first ? std::nullopt : std::optional(core::first_look(input.at_slot.window, settings));
  const LoopWindow* longer = input.long_window ? &*input.long_window : nullptr;
  Stopwatch watch;
  core::ModelPlan plan{.cause = wish.cause, .traces = false, .done = {}};
  plan.done = [&](core::Stage stage) {
    if (stage == core::Stage::statistics) record.statistics_ms = watch.lap_ms();
    if (stage == core::Stage::model) record.model_ms = watch.lap_ms();
  };
  return core::diagnose(input.first ? *input.first : *again, settings, facts, longer, plan);
}

std::optional<double> pv_span_of(const storage::CatalogueEntry& loop) {
  if (!loop.pv_range) return std::nullopt;
  return loop.pv_range->high - loop.pv_range->low;
}

void describe_window(const LoopWindowAtSlot& at_slot, storage::AnalysisRecord& record) {
  const LoopWindow& window = at_slot.window;
  const core::signal::Grid grid{window.start_us, window.sample_interval_s, window.size()};
  record.slot_end_us = at_slot.slot_end_us;
  record.window_start_us = window.size() > 0 ? grid.start_us : at_slot.slot_end_us;
  record.window_end_us = window.size() > 0 ? grid.time_us(window.size() - 1) : at_slot.slot_end_us;
  record.samples = window.size();
  record.sample_interval_s = window.size() > 1 ? window.sample_interval_s : 0.0;
}

}  // namespace

std::string digest_of(const storage::CatalogueEntry& loop, const LoopInput& input,
                      const std::string& settings_json) {
  std::string facts = settings_json + loop.loop_type;
  if (loop.pv_range) facts += fmt::format("{} {}", loop.pv_range->low, loop.pv_range->high);
  std::string digest = core::signal::window_digest(input.at_slot.window, facts);
  return input.long_window ? core::signal::window_digest(*input.long_window, digest) : digest;
}

storage::AnalysisRecord analyse_window(const storage::CatalogueEntry& loop, const LoopInput& input,
                                       const core::AnalysisSettings& settings,
                                       const std::string& settings_json, const ModelPolicy& wish) {
  Stopwatch watch;
  storage::AnalysisRecord record;
  describe_window(input.at_slot, record);
  record.input_digest = digest_of(loop, input, settings_json);
  // Verdicts are reproducible to the last digit on one processor path only.
  record.program_version =
      std::string(LOOPSCOPE_VERSION " ") + std::string(core::hos::processor_path());
  record.settings_json = settings_json;
  record.pv_past = input.at_slot.window.pv_past;
  record.diagnosis = timed_diagnosis(input, settings,
                                     {.integrating = core::is_integrating_type(loop.loop_type),
                                      .seed = core::signal::window_seed(input.at_slot.window),
                                      .pv_span = pv_span_of(loop)},
                                     wish, record);
  if (const auto& slow = record.diagnosis.evidence.hos_slow) {
    record.hos_slow_json = slow_look_json(*slow, record.diagnosis.evidence.tested_on).dump();
  }
  if (record.diagnosis.evidence.model) {
    record.model_json = json_text(model_json(record.diagnosis.evidence.model));
  }
  record.prepare_ms = input.first_look_ms;
  record.analyse_ms = input.first_look_ms + watch.lap_ms();
  return record;
}

}  // namespace loopscope::daemon
