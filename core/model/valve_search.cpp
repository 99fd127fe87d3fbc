#include "core/model/valve_search.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <span>
#include <stdexcept>
#include <utility>
#include <vector>

#include "core/model/op_swings.hpp"
#include "core/model/valve_records.hpp"
#include "core/model/valve_tracking.hpp"

namespace loopscope::core::model {
namespace {

constexpr std::array kLaws = {ValveLaw::choudhury, ValveLaw::kano, ValveLaw::he};
/// Law and J / S of the first look. Once positions are put right J is nearly flat, but for He's
/// valve, which a wrong J leads astray at every slip.
struct Shape {
  ValveLaw law;
  double jump_share;
};
constexpr std::array<Shape, 9> kShapes = {{{ValveLaw::choudhury, 0.1},
                                           {ValveLaw::choudhury, 0.6},
                                           {ValveLaw::kano, 0.1},
                                           {ValveLaw::kano, 0.5},
                                           {ValveLaw::kano, 1.0},
                                           {ValveLaw::he, 0.1},
                                           {ValveLaw::he, 0.4},
                                           {ValveLaw::he, 0.7},
                                           {ValveLaw::he, 1.0}}};
constexpr double kCoarseStep = 1.08;
constexpr double kBootstrapStep = 1.25;
/// Of op's span: below this a valve hides in any record's noise.
constexpr double kSmallestBand = 0.03;
/// Samples to a row that are tried: fast processes need every sample, slow noisy ones show in
/// means.
constexpr std::array<std::size_t, 3> kRowLengths = {1, 2, 4};
constexpr std::size_t kShortestStretch = 24;
constexpr std::size_t kLongestStretch = 64;
constexpr std::size_t kRefinedPerLaw = 3;
constexpr double kNearBand = 0.1;  ///< of S, in logarithms: trials that lead to the same place
constexpr int kClimbRounds = 3;
constexpr double kScanStep = 1.006;
/// Of the best quick evidence: laws further behind get one refinement only.
constexpr double kFarBehind = 0.3;
constexpr std::size_t kReturnedPerLaw = 2;

struct Trial {
  Valve valve;
  std::size_t samples_per_row = 1;
  double evidence = -1e300;  ///< of the whole record, extrapolated from what was covered
  TrackedValve tracked;
};

bool better(const Trial& a, const Trial& b) {
  return a.evidence > b.evidence;
}

class Search {
 public:
  explicit Search(const ValveSearchInput& input) : records_(input) {}

  ValveSearchResult run() {
    if (!(records_.op_span() > 0.0)) {
      return {};
    }
    list_bands();
    bootstrap();
    if (trials_.empty()) {
      return {};
    }
    look_coarsely();
    return finish();
  }

 private:
  struct Band {
    double width, period;
  };

  void list_bands() {
    for (double width = kSmallestBand * records_.op_span(); width < records_.op_span();
         width *= kCoarseStep) {
      const double period = swing_period(records_.op(), width);
      if (std::isfinite(period)) {
        bands_.push_back({width, period});
      }
    }
  }

  static std::size_t stretch(const ValveRecords::Entry& entry, double period) {
    const double cycle = period / static_cast<double>(entry.samples_per_row);
    return static_cast<std::size_t>(std::clamp(cycle, static_cast<double>(kShortestStretch),
                                               static_cast<double>(kLongestStretch)));
  }

  static bool fittable(const ValveRecords::Entry& entry) {
    return entry.record.rows.rows > 4 * kLaggedColumns && entry.record.linear_residual > 0.0;
  }

  Trial judge(ValveRecords::Entry& entry, const Valve& valve, double period,
              const LaggedModel& start, int passes) {
    Trial trial{.valve = valve, .samples_per_row = entry.samples_per_row};
    if (!fittable(entry)) {
      return trial;
    }
    const double scale =
        static_cast<double>(records_.samples()) / static_cast<double>(entry.samples);
    LaggedModel model = start;
    for (int pass = 0; pass < passes; ++pass) {
      TrackedValve tracked = track_valve(entry.record, valve, model, stretch(entry, period));
      model = tracked.model;
      const double evidence = scale * tracked.evidence;
      if (evidence <= trial.evidence + 0.5) {
        break;
      }
      trial.evidence = evidence;
      trial.tracked = std::move(tracked);
    }
    if (trial.evidence > entry.evidence) {
      entry.evidence = trial.evidence;
      entry.model = trial.tracked.model;
    }
    return trial;
  }

  /// A process to start from, and the rate at which valves show best. Under stiction the linear
  /// fit is far off (it is half the controller's); that of a valve of about the right band is not.
  void bootstrap() {
    double best = -1e300;
    for (const std::size_t samples : kRowLengths) {
      auto& entry = records_.quick(samples);
      const std::vector<Trial> trials = bootstrap_at(entry);
      for (const Trial& trial : trials) {
        if (trial.evidence > best) {
          best = trial.evidence;
          rate_ = samples;
        }
      }
      trials_.insert(trials_.end(), trials.begin(), trials.end());
    }
    std::erase_if(trials_, [&](const Trial& trial) { return trial.samples_per_row != rate_; });
  }

  std::vector<Trial> bootstrap_at(ValveRecords::Entry& entry) {
    std::vector<Trial> trials;
    double next = 0.0;
    for (const Band& band : bands_) {
      if (band.width < next || !fittable(entry)) {
        continue;
      }
      next = band.width * kBootstrapStep;
      for (const double share : {0.1, 0.7}) {
        const Valve valve{ValveLaw::kano, band.width, share * band.width, 1.0};
        trials.push_back(judge(entry, valve, band.period, fit_untracked(entry.record, valve), 2));
      }
    }
    return trials;
  }

  void look_coarsely() {
    auto& entry = records_.quick(rate_);
    for (const Band& band : bands_) {
      for (const auto& [law, share] : kShapes) {
        const Valve valve{law, band.width, share * band.width, 1.0};
        trials_.push_back(judge(entry, valve, band.period, entry.model, 1));
      }
    }
  }

  static bool near(const Trial& a, const Trial& b) {
    const Valve& p = a.valve;
    const Valve& q = b.valve;
    return p.law == q.law &&
           std::abs(std::log(p.stickband_percent / q.stickband_percent)) < kNearBand &&
           std::abs(p.slip_jump_percent / p.stickband_percent -
                    q.slip_jump_percent / q.stickband_percent) < 0.35;
  }

  /// The best of a law that are not the same twice.
  [[nodiscard]] std::vector<Trial> leaders(ValveLaw law, std::size_t count) const {
    std::vector<Trial> chosen;
    const double enough = kFarBehind * trials_.front().evidence;
    for (const Trial& trial : trials_) {
      const bool taken =
          std::ranges::any_of(chosen, [&](const Trial& other) { return near(trial, other); });
      if (trial.valve.law == law && !taken && chosen.size() < count && trial.evidence > -1e299 &&
          (chosen.empty() || trial.evidence > enough)) {
        chosen.push_back(trial);
      }
    }
    return chosen;
  }

  Trial again(const Trial& trial, const Valve& valve, int passes) {
    auto& entry = records_.full(trial.samples_per_row);
    const double period = swing_period(records_.op(), valve.stickband_percent);
    return judge(entry, valve, std::isfinite(period) ? period : 1e9, trial.tracked.model, passes);
  }

  /// One way to go: in S, and in J by four times as much, since J is flatter.
  struct Move {
    double band, jump;
  };
  static constexpr std::array<Move, 6> kAnyMove = {
      {{1.0, 0.0}, {-1.0, 0.0}, {0.0, 4.0}, {0.0, -4.0}, {1.0, 4.0}, {-1.0, -4.0}}};
  static constexpr std::array<Move, 2> kBandMoves = {{{1.0, 0.0}, {-1.0, 0.0}}};

  static Valve moved(const Valve& valve, const Move& move, double step) {
    Valve result = valve;
    const double unit = step * valve.stickband_percent;
    result.stickband_percent += move.band * unit;
    result.slip_jump_percent =
        std::clamp(valve.slip_jump_percent + move.jump * unit, 0.0, result.stickband_percent);
    return result;
  }

  /// Climbs by steps of that share of S as long as it helps.
  void climb(Trial& trial, double step, std::span<const Move> moves) {
    for (int round = 0; round < kClimbRounds; ++round) {
      Trial best = trial;
      for (const Move& move : moves) {
        Trial next = again(trial, moved(trial.valve, move, step), 1);
        best = better(next, best) ? std::move(next) : std::move(best);
      }
      if (!better(best, trial)) {
        return;
      }
      trial = std::move(best);
    }
  }

  ValveSearchResult finish() {
    std::ranges::sort(trials_, better);
    ValveSearchResult result;
    std::vector<Trial> finals;
    for (const ValveLaw law : kLaws) {
      for (Trial& trial : finished(law)) {
        finals.push_back(std::move(trial));
      }
    }
    std::ranges::sort(finals, better);
    for (const Trial& trial : finals) {
      if (trial.evidence > 0.0) {
        result.candidates.push_back(candidate(trial));
      }
    }
    result.deadband = finished_deadband();
    return result;
  }

  /// He's valve rests at every sample, so a cycle that hardly varies hides its S between values a
  /// percent apart, and no climb leads there: every value around the leader is tried on the
  /// stretch.
  void scan(Trial& trial) {
    auto& entry = records_.quick(rate_);
    Trial best = trial;
    best.evidence = -1e300;
    for (double factor = 0.88; factor < 1.2; factor *= kScanStep) {
      Valve valve = trial.valve;
      valve.stickband_percent *= factor;
      valve.slip_jump_percent *= factor;
      const double period = swing_period(records_.op(), valve.stickband_percent);
      if (std::isfinite(period)) {
        Trial next = judge(entry, valve, period, trial.tracked.model, 1);
        best = better(next, best) ? std::move(next) : std::move(best);
      }
    }
    best = again(best, best.valve, 2);
    trial = better(best, trial) ? std::move(best) : std::move(trial);
  }

  std::vector<Trial> finished(ValveLaw law) {
    std::vector<Trial> of_law = leaders(law, kRefinedPerLaw);
    for (Trial& trial : of_law) {
      trial = again(trial, trial.valve, 2);
      climb(trial, 0.03, kAnyMove);
    }
    std::ranges::sort(of_law, better);
    of_law.resize(std::min(of_law.size(), kReturnedPerLaw));
    if (law == ValveLaw::he && !of_law.empty()) {
      scan(of_law.front());
    }
    for (Trial& trial : of_law) {
      climb(trial, 0.01, kAnyMove);
      climb(trial, 0.004, kAnyMove);
    }
    return of_law;
  }

  static bool is_play(const Valve& valve) {
    return valve.law != ValveLaw::choudhury &&
           valve.slip_jump_percent < 0.2 * valve.stickband_percent;
  }

  Trial finished_play(const Trial& start) {
    Trial trial = again(start, {ValveLaw::he, start.valve.stickband_percent, 0.0, 1.0}, 2);
    for (const double step : {0.04, 0.015, 0.005}) {
      climb(trial, step, kBandMoves);
    }
    return trial;
  }

  /// From the best of the first look with hardly any jump, each of another width.
  std::optional<ValveCandidate> finished_deadband() {
    std::vector<double> widths;
    Trial best;
    for (const Trial& trial : trials_) {
      const double width = trial.valve.stickband_percent;
      const bool taken = std::ranges::any_of(
          widths, [&](double other) { return std::abs(std::log(width / other)) < kNearBand; });
      if (is_play(trial.valve) && !taken && widths.size() < kRefinedPerLaw) {
        widths.push_back(width);
        Trial play = finished_play(trial);
        best = better(play, best) ? std::move(play) : std::move(best);
      }
    }
    return best.evidence > 0.0 ? std::optional(candidate(best)) : std::nullopt;
  }

  ValveCandidate candidate(const Trial& trial) {
    ValveCandidate result{.valve = trial.valve,
                          .evidence = trial.evidence,
                          .corrections = trial.tracked.corrections,
                          .restarts = trial.tracked.restarts,
                          .samples_per_row = trial.samples_per_row};
    result.residual_ratio =
        trial.tracked.model.residual / records_.full(trial.samples_per_row).record.linear_residual;
    for (ValveRestart& restart : result.restarts) {
      restart.position_percent += records_.op_level();
    }
    return result;
  }

  ValveRecords records_;
  std::size_t rate_ = 1;  ///< samples per row
  std::vector<Band> bands_;
  std::vector<Trial> trials_;
};

}  // namespace

ValveSearchResult search_valve(const ValveSearchInput& input) {
  if (input.pv.size() != input.op.size() || input.pv.size() != input.fit.size()) {
    throw std::invalid_argument("search_valve: lengths differ");
  }
  return input.pv.empty() ? ValveSearchResult{} : Search(input).run();
}

}  // namespace loopscope::core::model
