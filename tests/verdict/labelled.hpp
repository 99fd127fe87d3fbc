#pragma once

#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "core/diagnosis/analysis_settings.hpp"
#include "core/diagnosis/verdicts/verdict.hpp"
#include "core/signal/loop_window.hpp"

namespace loopscope::tests::verdict {

/// Of pv's standard deviation: what a sensor's grid may be without being a fault, where its
/// generator does not say that it is one. A converter of twelve bits on a quiet loop is no defect.
inline constexpr double kCoarse = 1.0 / 3.0;

/// What is wrong with a simulated loop.
struct Truth {
  std::set<core::diagnosis::VerdictCode> causes;  ///< there, from faint to gross
  /// Neither there nor absent: a tuning between good and bad, a bend that op hardly travels. Left
  /// out where the cause is fitted or scored.
  std::set<core::diagnosis::VerdictCode> doubtful;
  std::string family;  ///< what made it
};

/// A simulated loop before a historian has seen it: op and mv in %, one value an interval.
struct SimulatedLoop {
  std::vector<double> sp, pv, op;
  std::vector<double> mv;  ///< empty = the generator does not tell
  double interval_s = 1.0;
  bool integrating = false;
  std::optional<double> pv_span;  ///< width of the transmitter's range, pv units
  core::signal::OpRange limits;   ///< of op, %: those of its range, or within it
  Truth truth;
};

/// The loop that a generator recorded; what else it tells of it is left as it is.
template <typename Record>
[[nodiscard]] SimulatedLoop loop_of(Record record, bool integrating, Truth truth) {
  SimulatedLoop loop;
  loop.sp = std::move(record.sp);
  loop.pv = std::move(record.pv);
  loop.op = std::move(record.op);
  loop.mv = std::move(record.mv);
  loop.integrating = integrating;
  loop.truth = std::move(truth);
  return loop;
}

/// What the diagnosis is given of it.
struct LabelledRecord {
  core::signal::LoopWindow window;
  core::LoopFacts facts;
  Truth truth;
};

}  // namespace loopscope::tests::verdict
