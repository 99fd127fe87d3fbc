#include "tests/plants/watched_loop.hpp"

#include <string>
#include <utility>

#include "core/diagnosis/odds/combined_odds.hpp"
#include "tests/effects/generator.hpp"
#include "tests/effects/scenario.hpp"
#include "tests/effects/window_of.hpp"

namespace loopscope::tests::plants {
namespace {

namespace diagnosis = core::diagnosis;
using core::signal::Samples;
using effects::kSamples;

constexpr double kInterval_s = 1.0;

core::signal::LoopWindow window_at(const core::signal::LoopWindow& whole, std::size_t first) {
  const auto cut = [&](const Samples& series) {
    const auto begin = series.begin() + static_cast<std::ptrdiff_t>(first);
    return Samples(begin, begin + static_cast<std::ptrdiff_t>(kSamples));
  };
  core::signal::LoopWindow window = whole;
  window.sp = cut(whole.sp);
  window.pv = cut(whole.pv);
  window.op = cut(whole.op);
  return window;
}

/// The windows so far, and what of pv they tell the next.
struct Past {
  std::optional<diagnosis::CombinedOdds> odds;
  std::optional<core::signal::PvPast> pv;
  std::optional<double> first_s;  ///< start of the first window that was judged
};

/// What the results schema would hold of the slot: the newest window's verdict, by all windows.
DiagnosedLoop judged(const core::Diagnosis& found, double start_s, Past& past) {
  DiagnosedLoop result = diagnosed(found);
  past.pv = found.evidence.pv_past;
  const diagnosis::PerCause evidence = diagnosis::evidence_of(found.verdict);
  if (evidence.empty()) return result;
  const diagnosis::JudgedWindow window{start_s, start_s + kInterval_s * kSamples,
                                       found.evidence.model.has_value(), evidence};
  const bool alone = diagnosis::stands_alone(past.odds, window);
  past.odds = diagnosis::combine(past.odds, window);
  if (!past.first_s) past.first_s = start_s;
  result.windows = 1.0 + (start_s - *past.first_s) / (window.end_s - window.start_s);
  if (alone) return result;
  const diagnosis::PerCause all = diagnosis::probabilities_of(*past.odds, found.verdict.priors);
  const auto of = [&](diagnosis::VerdictCode code) -> std::optional<double> {
    const auto place = static_cast<std::size_t>(code);
    return place < all.size() ? all[place] : std::nullopt;
  };
  if (const auto health = of(diagnosis::VerdictCode::healthy))
    result.fault_probability = 1.0 - *health;
  result.confidence = of(found.verdict.code).value_or(result.confidence);
  return result;
}

}  // namespace

WatchedLoop watch_loop(const PlantLoop& loop, const Watch& watch) {
  const std::size_t calm = kSamples * (1 + watch.onset_windows);
  const effects::Record record = effects::generate_onset(
      loop.record, loop.seed, calm, kSamples * (watch.windows - watch.onset_windows));
  const core::signal::LoopWindow whole = effects::window_of(record, kInterval_s);
  WatchedLoop watched;
  watched.from_the_start = loop.is_faulty() && record.truth.effects.empty();
  const std::size_t onset = watched.from_the_start ? 0 : calm;
  Past past;
  for (std::size_t slot = 0; slot <= watch.windows * kSlotsInWindow; ++slot) {
    const std::size_t first = slot * kSamples / kSlotsInWindow;
    core::signal::LoopWindow window = window_at(whole, first);
    window.pv_past = past.pv;
    const core::Diagnosis found = core::diagnose(
        window, {}, {.integrating = record.truth.loop.integrating, .seed = loop.seed + slot});
    if (loop.is_faulty() && first >= onset && !watched.single_probability)
      watched.single_probability = diagnosed(found).fault_probability;
    watched.at_limit.push_back(effects::share_at_limit(window.op));
    watched.slots.push_back(judged(found, kInterval_s * static_cast<double>(first), past));
  }
  return watched;
}

}  // namespace loopscope::tests::plants
