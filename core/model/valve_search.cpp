#include "core/model/valve_search.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "core/model/valve_climb.hpp"
#include "core/model/valve_first_look.hpp"

namespace loopscope::core::model {
namespace {

constexpr std::array kLaws = {ValveLaw::choudhury, ValveLaw::kano, ValveLaw::he};
/// The best of a first look that is worth less is chance: of 147 loops that were searched, 56 gave
/// less and no valve to any model; those that gave one began at 49.
constexpr double kWorthRefining = 25.0;
constexpr std::size_t kRefined = 3;  ///< of a law
constexpr std::size_t kReturnedPerLaw = 2;
/// Of the best evidence of the first look: of a law further behind only the best is refined.
constexpr double kFarBehind = 0.3;
/// Of the best evidence: what is further behind, or not among the first, is returned as it is.
constexpr double kWorthFinishing = 0.3;
constexpr std::size_t kFinished = 4;
constexpr std::size_t kPlayRefined = 2;
constexpr int kPlayPasses = 2;
constexpr double kNearJumpShare = 0.35;  ///< J / S: trials closer lead to the same place

/// What is refined, and the record that it is refined on.
class Refinement {
 public:
  Refinement(ValveRecords& records, const FirstLook& look)
      : records_(records),
        look_(look),
        quick_(records.quick(look.samples_per_row)),
        full_(records.full(look.samples_per_row)) {}

  /// The best of a law, roughly.
  std::vector<Trial> of_law(ValveLaw law) {
    std::vector<Trial> trials = leaders(law);
    for (Trial& trial : trials) {
      climb(records_, quick_, trial, 0.03, any_move());
      trial = on_whole_record(std::move(trial));
    }
    std::ranges::sort(trials, better);
    trials.resize(std::min(trials.size(), kReturnedPerLaw));
    return trials;
  }

  /// Once it is known what the best is worth.
  void finish(Trial& trial, double best_evidence) {
    if (trial.evidence < kWorthFinishing * best_evidence) {
      return;
    }
    if (trial.valve.law == ValveLaw::he) {
      Trial scanned = on_whole_record(best_band_around(records_, quick_, trial));
      trial = better(scanned, trial) ? std::move(scanned) : std::move(trial);
    }
    for (const double step : {0.01, 0.004}) {
      climb(records_, full_, trial, step, any_move());
    }
  }

  /// Play has no needle: every other band is looked at, wherever valves that jump were found.
  Trial play() {
    std::vector<Trial> looks;
    for (std::size_t i = 0; i < look_.bands.size(); i += 2) {
      const Valve valve{ValveLaw::he, look_.bands[i], 0.0, 1.0};
      // From its own process: that of a wrong jump would hold it where it is.
      looks.push_back(
          judge(records_, full_, valve, fit_untracked(full_.record, valve), kPlayPasses));
    }
    Trial best;
    for (Trial& trial : leading(looks, kPlayRefined, [](const Trial&) { return true; })) {
      for (const double step : {0.04, 0.015}) {
        climb(records_, full_, trial, step, band_moves());
      }
      best = better(trial, best) ? std::move(trial) : std::move(best);
    }
    return best;
  }

  [[nodiscard]] ValveCandidate candidate(const Trial& trial) const {
    ValveCandidate result;
    result.valve = trial.valve;
    result.evidence = trial.evidence;
    result.residual_ratio = trial.tracked.model.residual / full_.record.linear_residual;
    result.corrections = trial.tracked.corrections;
    result.restarts = trial.tracked.restarts;
    result.samples_per_row = trial.samples_per_row;
    for (ValveRestart& restart : result.restarts) {
      restart.position_percent += records_.op_level();
    }
    return result;
  }

 private:
  static bool near(const Valve& a, const Valve& b) {
    return near_band(a, b) && std::abs(a.slip_jump_percent / a.stickband_percent -
                                       b.slip_jump_percent / b.stickband_percent) < kNearJumpShare;
  }

  /// The best of a law that are not the same twice.
  [[nodiscard]] std::vector<Trial> leaders(ValveLaw law) const {
    std::vector<Trial> chosen;
    for (const Trial& trial : look_.trials) {
      const bool taken = std::ranges::any_of(
          chosen, [&](const Trial& other) { return near(trial.valve, other.valve); });
      const bool strong = trial.evidence > kFarBehind * look_.trials.front().evidence;
      if (trial.valve.law == law && !taken && chosen.size() < kRefined &&
          (chosen.empty() || strong)) {
        chosen.push_back(trial);
      }
    }
    return chosen;
  }

  Trial on_whole_record(Trial trial) {
    if (quick_.samples == full_.samples) {
      return trial;
    }
    return judge(records_, full_, trial.valve, trial.tracked.model, 2);
  }

  ValveRecords& records_;
  const FirstLook& look_;
  ValveRecords::Entry& quick_;
  ValveRecords::Entry& full_;
};

ValveSearchResult refine(ValveRecords& records, const FirstLook& look) {
  Refinement refinement(records, look);
  std::vector<Trial> finals;
  for (const ValveLaw law : kLaws) {
    for (Trial& trial : refinement.of_law(law)) {
      finals.push_back(std::move(trial));
    }
  }
  std::ranges::sort(finals, better);
  const double best_evidence = finals.empty() ? 0.0 : finals.front().evidence;
  for (std::size_t i = 0; i < std::min(finals.size(), kFinished); ++i) {
    refinement.finish(finals[i], best_evidence);
  }
  std::ranges::sort(finals, better);
  ValveSearchResult result;
  for (const Trial& trial : finals) {
    if (trial.evidence > 0.0) {
      result.candidates.push_back(refinement.candidate(trial));
    }
  }
  const Trial play = refinement.play();
  if (play.evidence > 0.0) {
    result.deadband = refinement.candidate(play);
  }
  return result;
}

}  // namespace

ValveSearchResult search_valve(const ValveSearchInput& input) {
  if (input.pv.size() != input.op.size() || input.pv.size() != input.fit.size()) {
    throw std::invalid_argument("search_valve: lengths differ");
  }
  if (input.pv.empty()) {
    return {};
  }
  ValveRecords records(input);
  const FirstLook look = look_first(records);
  if (look.trials.empty() || look.trials.front().evidence < kWorthRefining) return {};
  return refine(records, look);
}

}  // namespace loopscope::core::model
