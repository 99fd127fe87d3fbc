#include "daemon/report/evidence/loop_evidence.hpp"

#include <utility>

#include "core/diagnosis/steady_error.hpp"
#include "core/hos/bicoherence/bicoherence.hpp"
#include "core/hos/slow/decimate.hpp"
#include "core/hos/slow_look.hpp"
#include "core/signal/prepare.hpp"
#include "daemon/service/windows/loop_facts.hpp"

namespace loopscope::daemon {
namespace {

using core::AnalysisSettings;
using core::signal::LoopWindow;

std::optional<BicoherenceMap> map_of(const core::signal::Samples& error,
                                     const core::hos::Settings& settings, double interval_s,
                                     const std::vector<core::hos::Peak>& peaks) {
  core::hos::Bicoherence bicoherence(settings);
  const auto bic2 = bicoherence.estimate(error);
  if (bic2.empty()) return std::nullopt;
  return BicoherenceMap{{bic2.begin(), bic2.end()}, settings.dft_length, interval_s, peaks, false};
}

/// The signal that the slow look has seen.
core::signal::Samples slow_error(const LoopInput& input, const AnalysisSettings& settings,
                                 std::uint64_t seed) {
  if (!input.long_window) return core::steady_error(input.first.loop, settings.hos, seed).error;
  core::signal::PrepareSettings prepare = settings.prepare;
  prepare.window_samples = input.long_window->size();
  return core::steady_error(core::signal::prepare(*input.long_window, prepare), settings.hos, seed)
      .error;
}

std::optional<BicoherenceMap> slow_map(const LoopInput& input, const core::hos::SlowLook& look,
                                       const AnalysisSettings& settings, std::uint64_t seed) {
  const auto error = core::hos::decimate(slow_error(input, settings, seed), look.decimation);
  auto map = map_of(error, core::hos::slow_settings(settings.hos),
                    input.first.loop.sample_interval_s * static_cast<double>(look.decimation),
                    look.result.peaks);
  if (map) map->slow = true;
  return map;
}

/// Where a slow oscillation wanted a second look, that one is what was judged by.
std::optional<BicoherenceMap> find_map(const LoopInput& input, const core::Evidence& evidence,
                                       const AnalysisSettings& settings, std::uint64_t seed) {
  if (!evidence.hos) return std::nullopt;
  if (evidence.hos_slow) {
    if (auto slow = slow_map(input, *evidence.hos_slow, settings, seed)) return slow;
  }
  return map_of(core::steady_error(input.first.loop, settings.hos, seed).error, settings.hos,
                input.first.loop.sample_interval_s, evidence.hos->peaks);
}

}  // namespace

LoopEvidence rediagnose(const storage::CatalogueEntry& loop, const LoopInput& input,
                        const AnalysisSettings& settings) {
  const core::LoopFacts facts = loop_facts(loop, input.at_slot.window);
  const LoopWindow* longer = input.long_window ? &*input.long_window : nullptr;
  LoopEvidence seen{loop, input.at_slot, input.first.loop, {}, std::nullopt, std::nullopt};
  seen.diagnosis = core::diagnose(input.first, settings, facts, longer,
                                  {.cause = {}, .traces = true, .done = {}});
  seen.traces = std::move(seen.diagnosis.traces);
  seen.map = find_map(input, seen.diagnosis.evidence, settings, facts.seed);
  return seen;
}

}  // namespace loopscope::daemon
