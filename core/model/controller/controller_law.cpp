#include "core/model/controller/controller_law.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "core/model/controller/controller_moves.hpp"
#include "core/model/controller/move_fit.hpp"
#include "core/signal/order/order_statistic.hpp"
#include "core/text/counted.hpp"
#include "core/text/phrases.hpp"

namespace loopscope::core::model {
namespace {

constexpr std::array<std::size_t, 7> kSpans = {1, 2, 4, 8, 16, 32, 64};
/// Residuals beyond this are jumps that no law makes (six standard deviations of Gaussian ones).
constexpr double kJump = 6.0;
/// A share of jumps that a record may have; with more it is the law that fails, not the record.
constexpr double kMostJumps = 0.01;
/// Share of op's moves below which the law is not op's.
constexpr double kLeastExplained = 0.5;
/// A span that explains this much less than the best explains as much.
constexpr double kAsGood = 0.01;
/// Terms that most controllers lack have to take this share of what is left.
constexpr double kExtraTermTakes = 0.2;

Terms common_terms(const ControllerMoves& recorded) {
  Terms terms;
  terms.set(kGainTerm).set(kIntegralTerm);
  // Without a recorded set point the column holds the unknown offset of the error.
  return terms.set(kSetpointTerm, !recorded.has_setpoint());
}

MoveFit better_lag(const ControllerMoves& recorded, std::size_t span, const Terms& terms) {
  MoveFit same = fit_moves(recorded, span, 0, terms);
  MoveFit before = fit_moves(recorded, span, 1, terms);
  return before.explained > same.explained ? before : same;
}

/// Samples at which op jumps as no law makes it; none when they are too many to be exceptions.
std::vector<std::size_t> find_jumps(const ControllerMoves& recorded) {
  Terms terms = common_terms(recorded);
  terms.set(kSetpointTerm);  // a controller may act on pv alone: then set-point moves are no jumps
  const MoveFit fit = better_lag(recorded, 1, terms);
  if (fit.moves == 0) return {};
  std::vector<std::size_t> at;
  std::vector<double> left, op;
  recorded.visit(1, fit.lag, [&](const Move& move) {
    at.push_back(move.at);
    op.push_back(std::abs(move.op));
    left.push_back(std::abs(move.op - fit.coefficients.dot(move.seen)));
  });
  // A historian that keeps op until it has moved far shows jumps only: they are its moves.
  if (signal::median(std::move(op)) <= 0.0) return {};
  const double limit = kJump * signal::kMadToSigma * signal::median(left);
  std::vector<std::size_t> jumps;
  for (std::size_t k = 0; k < at.size(); ++k) {
    if (left[k] > limit) jumps.push_back(at[k]);
  }
  const bool exceptions =
      static_cast<double>(jumps.size()) <= kMostJumps * static_cast<double>(at.size());
  return exceptions ? jumps : std::vector<std::size_t>{};
}

/// The shortest span that explains as much as the best and shows the integral; without one that
/// does, the shortest.
MoveFit choose(const ControllerMoves& recorded, const Terms& terms) {
  std::vector<MoveFit> fits;
  for (const std::size_t span : kSpans) {
    fits.push_back(better_lag(recorded, span, terms));
    fits.back().shows_integral = counts(fits.back(), terms, kIntegralTerm);
    // Longer spans cannot explain so much more.
    if (fits.back().explained > 1.0 - kAsGood && fits.back().shows_integral) break;
  }
  const double best = std::ranges::max(fits, {}, &MoveFit::explained).explained;
  std::erase_if(fits, [=](const MoveFit& fit) { return fit.explained < best - kAsGood; });
  const auto shows = std::ranges::find_if(fits, &MoveFit::shows_integral);
  return shows != fits.end() ? *shows : fits.front();
}

/// The errors to come explain op better than those before: pv follows op, nothing controls.
bool op_leads(const ControllerMoves& recorded, const MoveFit& fit, const Terms& terms) {
  const MoveFit ahead = fit_moves(recorded, fit.span, -1, terms);
  return 1.0 - ahead.explained < (1.0 - kExtraTermTakes) * (1.0 - fit.explained);
}

/// Adds a term that takes a good part of what is left.
void try_term(MoveFit& fit, Terms& terms, int term) {
  MoveFit wider = fit;
  Terms more = terms;
  refit(wider, more.set(static_cast<std::size_t>(term)));
  const bool takes = 1.0 - wider.explained < (1.0 - kExtraTermTakes) * (1.0 - fit.explained);
  if (!takes || !counts(wider, more, term)) return;
  fit = wider;
  terms = more;
}

void drop_term(MoveFit& fit, Terms& terms, int term) {
  if (counts(fit, terms, term)) return;
  terms.reset(static_cast<std::size_t>(term));
  refit(fit, terms);
}

std::string describe(const ControllerLaw& law, bool op_leads) {
  if (op_leads) return "No control law: op moves before the error does.";
  if (!law.found) {
    return text::sentence("No PI law found: the best explains ", text::whole_percent(law.explained),
                          " % of op's moves.");
  }
  return text::sentence("A law with gain ", law.gain, " % per pv unit and integral ", law.integral,
                        " per sample explains ", text::whole_percent(law.explained),
                        " % of op's moves over ", text::counted(law.span, "sample.", "samples."));
}

ControllerLaw law_of(const MoveFit& fit, const Terms& terms, bool has_setpoint) {
  ControllerLaw law;
  law.gain = fit.coefficients[kGainTerm];
  law.integral = fit.coefficients[kIntegralTerm];
  law.derivative = fit.coefficients[kDerivativeTerm];
  law.gain_error = standard_error(fit, terms, kGainTerm);
  law.integral_error = terms[kIntegralTerm] ? standard_error(fit, terms, kIntegralTerm) : 0.0;
  law.lag = static_cast<std::size_t>(fit.lag);
  law.explained = std::clamp(fit.explained, 0.0, 1.0);
  law.span = fit.span;
  law.rows = fit.moves;
  if (has_setpoint && law.gain != 0.0) {
    law.setpoint_weight = 1.0 + fit.coefficients[kSetpointTerm] / law.gain;
  }
  law.found = law.explained >= kLeastExplained &&
              (counts(fit, terms, kGainTerm) || counts(fit, terms, kIntegralTerm));
  return law;
}

}  // namespace

ControllerLaw find_controller_law(const ControllerRecord& record) {
  ControllerMoves recorded(record);
  recorded.leave_out(find_jumps(recorded));
  Terms terms = common_terms(recorded);
  MoveFit fit = choose(recorded, terms);
  const bool leads = op_leads(recorded, fit, terms);
  if (recorded.setpoint_moves()) try_term(fit, terms, kSetpointTerm);
  try_term(fit, terms, kDerivativeTerm);
  drop_term(fit, terms, kIntegralTerm);
  ControllerLaw law = law_of(fit, terms, recorded.has_setpoint());
  law.found = law.found && !leads;
  law.statement = describe(law, leads);
  return law;
}

std::complex<double> response(const ControllerLaw& law, double w) {
  const std::complex<double> inverse_z = std::polar(1.0, -w);
  const std::complex<double> difference = 1.0 - inverse_z;
  return (law.gain + law.integral / difference + law.derivative * difference) *
         std::polar(1.0, -w * static_cast<double>(law.lag));
}

}  // namespace loopscope::core::model
