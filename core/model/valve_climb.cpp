#include "core/model/valve_climb.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace loopscope::core::model {
namespace {

constexpr std::array<ValveMove, 6> kAnyMove = {
    {{1.0, 0.0}, {-1.0, 0.0}, {0.0, 4.0}, {0.0, -4.0}, {1.0, 4.0}, {-1.0, -4.0}}};
constexpr std::array<ValveMove, 2> kBandMoves = {{{1.0, 0.0}, {-1.0, 0.0}}};
constexpr int kRounds = 3;
constexpr double kLowestFactor = 0.88;
constexpr double kHighest = 1.2;
constexpr double kScanStep = 1.006;

Valve moved(const Valve& valve, const ValveMove& move, double step) {
  Valve result = valve;
  const double unit = step * valve.stickband_percent;
  result.stickband_percent += move.band * unit;
  result.slip_jump_percent =
      std::clamp(valve.slip_jump_percent + move.jump * unit, 0.0, result.stickband_percent);
  return result;
}

/// J at the end of its range.
bool leads_nowhere(const Valve& from, const Valve& to) {
  return from.stickband_percent == to.stickband_percent &&
         from.slip_jump_percent == to.slip_jump_percent;
}

bool leads_back(const ValveMove& last, const ValveMove& move) {
  return move.band == -last.band && move.jump == -last.jump;
}

}  // namespace

std::span<const ValveMove> any_move() {
  return kAnyMove;
}

std::span<const ValveMove> band_moves() {
  return kBandMoves;
}

void climb(const ValveRecords& records, ValveRecords::Entry& entry, Trial& trial, double step,
           std::span<const ValveMove> moves) {
  const ValveMove* last = nullptr;
  for (int round = 0; round < kRounds; ++round) {
    Trial best = trial;
    const ValveMove* chosen = nullptr;
    for (const ValveMove& move : moves) {
      const Valve valve = moved(trial.valve, move, step);
      if (leads_nowhere(trial.valve, valve) || (last != nullptr && leads_back(*last, move))) {
        continue;
      }
      Trial next = judge(records, entry, valve, trial.tracked.model, 1);
      if (better(next, best)) {
        best = std::move(next);
        chosen = &move;
      }
    }
    if (chosen == nullptr) {
      return;
    }
    trial = std::move(best);
    last = chosen;
  }
}

Trial best_band_around(const ValveRecords& records, ValveRecords::Entry& entry,
                       const Trial& trial) {
  Trial best;
  best.valve = trial.valve;
  best.tracked = trial.tracked;
  for (double factor = kLowestFactor; factor < kHighest; factor *= kScanStep) {
    Valve valve = trial.valve;
    valve.stickband_percent *= factor;
    valve.slip_jump_percent *= factor;
    if (std::isfinite(period_of(records, valve))) {
      Trial next = judge(records, entry, valve, trial.tracked.model, 1);
      best = better(next, best) ? std::move(next) : std::move(best);
    }
  }
  return best;
}

}  // namespace loopscope::core::model
