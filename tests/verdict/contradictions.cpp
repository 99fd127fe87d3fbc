#include "tests/verdict/contradictions.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/diagnosis/evidence/structure.hpp"
#include "core/diagnosis/verdicts/verdict_catalogue.hpp"
#include "tests/verdict/naming.hpp"

namespace loopscope::tests::verdict {
namespace {

using core::Evidence;
using core::diagnosis::CauseReport;
using core::diagnosis::Verdict;
using Code = core::diagnosis::VerdictCode;
using core::model::EffectKind;

constexpr double kLine = core::diagnosis::DecisionSettings{}.line;
constexpr double kAlpha = 0.05;  // hos::Settings

bool has(const std::string& text, std::string_view words) {
  return text.find(words) != std::string::npos;
}

bool says(const Verdict& verdict, std::string_view words) {
  return has(verdict.summary, words) || has(verdict.action, words) ||
         std::ranges::any_of(verdict.reasons,
                             [&](const std::string& reason) { return has(reason, words); });
}

double probability(const Verdict& verdict, Code code) {
  const auto found = std::ranges::find(verdict.causes, code, &CauseReport::code);
  return found == verdict.causes.end() ? 0.0 : found->probability;
}

void set(Verdict& verdict, Code code, double value) {
  std::ranges::find(verdict.causes, code, &CauseReport::code)->probability = value;
}

double largest(const Verdict& verdict) {
  double most = 0.0;
  for (const CauseReport& cause : verdict.causes) most = std::max(most, cause.probability);
  return most;
}

bool in_command(const Evidence& evidence) {
  return !core::diagnosis::has_flag(evidence, "sp_not_followed");
}

constexpr std::array kAll = {
    Contradiction{"a wave, and no oscillation",
                  [](const Evidence& e, const Verdict& v) {
                    return has(v.summary, "An oscillation reaches") && !e.oscillation.present &&
                           !has_step(e, EffectKind::external_oscillation);
                  },
                  [](Evidence& e, Verdict& v) {
                    e.model.reset();
                    e.oscillation.present = false;
                    v.summary = "An oscillation reaches the loop from outside.";
                  }},
    Contradiction{"an oscillation among the reasons, and none present",
                  [](const Evidence& e, const Verdict& v) {
                    return says(v, "Oscillation of period") && !e.oscillation.present;
                  },
                  [](Evidence& e, Verdict& v) {
                    e.oscillation.present = false;
                    v.reasons.emplace_back("Oscillation of period 60 s");
                  }},
    Contradiction{"the load moved, and no load step",
                  [](const Evidence& e, const Verdict& v) {
                    return has(v.summary, "load moved") && !has_step(e, EffectKind::load_step);
                  },
                  [](Evidence& e, Verdict& v) {
                    e.model.reset();
                    v.summary = "The load moved once within the window.";
                  }},
    Contradiction{"a valve that is too large, and a range unknown",
                  [](const Evidence& e, const Verdict& v) {
                    return v.code == Code::valve_oversized &&
                           !(e.op_range_set && e.valve_gain.pv_span_percent);
                  },
                  [](Evidence& e, Verdict& v) {
                    e.op_range_set = false;
                    v.code = Code::valve_oversized;
                  }},
    Contradiction{"a limit of op's range, and the range unknown",
                  [](const Evidence& e, const Verdict& v) {
                    return says(v, "at a limit of its range in") && !e.op_in_percent;
                  },
                  [](Evidence& e, Verdict& v) {
                    e.op_in_percent = false;
                    v.reasons.emplace_back(
                        "The controller output is at a limit of its range in 12 % of the samples.");
                  }},
    Contradiction{"op at its limit, and op never rests",
                  [](const Evidence& e, const Verdict& v) {
                    return v.code == Code::valve_saturation && is_at_no_limit(e);
                  },
                  [](Evidence& e, Verdict& v) {
                    e.data_quality.saturated_fraction = 0.0;
                    e.op_at_ends.reset();
                    e.model.reset();
                    v.code = Code::valve_saturation;
                  }},
    Contradiction{"sticks, and a recorded position that only has play",
                  [](const Evidence& e, const Verdict& v) {
                    return v.code == Code::valve_stiction &&
                           e.shape.mv_op_width.value_or(0.0) >= 3.0 &&
                           e.shape.mv_slip_jump.value_or(1.0) == 0.0;
                  },
                  [](Evidence& e, Verdict& v) {
                    e.shape.mv_op_width = 4.0;
                    e.shape.mv_slip_jump = 0.0;
                    v.code = Code::valve_stiction;
                  }},
    Contradiction{"a valve or a tuning, and op not recorded or still",
                  [](const Evidence& e, const Verdict& v) {
                    return (is_valve(v.code) || blames(v.code, core::plant::Fault::tuning)) &&
                           !core::diagnosis::op_speaks(e) && !e.control.held_at_limit;
                  },
                  [](Evidence& e, Verdict& v) {
                    e.data_quality.flags = {"op_missing"}, e.control = {};
                    v.code = Code::valve_stiction;
                  }},
    Contradiction{"healthy, and not controlling",
                  [](const Evidence& e, const Verdict& v) {
                    return v.code == Code::healthy && e.data_quality.usable && !in_command(e);
                  },
                  [](Evidence& e, Verdict& v) {
                    e.data_quality.flags = {"sp_not_followed"};
                    v.code = Code::healthy;
                  }},
    Contradiction{"healthy, and a cause that is more probable and may be named",
                  [](const Evidence& e, const Verdict& v) {
                    if (v.code != Code::healthy) return false;
                    return std::ranges::any_of(v.causes, [&](const CauseReport& cause) {
                      return may_be_named(cause.code, e) && cause.probability >= kLine &&
                             cause.probability > v.confidence;
                    });
                  },
                  [](Evidence&, Verdict& v) {
                    v.code = Code::healthy;
                    v.confidence = 0.4;
                    set(v, Code::sensor_fault, 0.9);
                  }},
    Contradiction{"unexplained, and a cause above the line",
                  [](const Evidence& e, const Verdict& v) {
                    return v.code == Code::unexplained && in_command(e) &&
                           probability(v, Code::external_disturbance) >= kLine;
                  },
                  [](Evidence&, Verdict& v) {
                    v.code = Code::unexplained;
                    set(v, Code::external_disturbance, 0.6);
                  }},
    Contradiction{"a cause, and a probability below the line",
                  [](const Evidence& e, const Verdict& v) {
                    return is_fault(v.code) && v.code != Code::unexplained && in_command(e) &&
                           probability(v, v.code) < kLine;
                  },
                  [](Evidence&, Verdict& v) {
                    v.code = Code::process_change;
                    set(v, Code::process_change, 0.1);
                  }},
    Contradiction{"a confidence that is not the probability of the code",
                  [](const Evidence&, const Verdict& v) {
                    if (!is_fault(v.code) && v.code != Code::healthy) return v.confidence != 1.0;
                    if (v.code == Code::unexplained)
                      return std::abs(v.confidence - (1.0 - largest(v))) > 1e-12;
                    return v.confidence != probability(v, v.code);
                  },
                  [](Evidence&, Verdict& v) { v.confidence = 0.123; }},
    Contradiction{"advice on tuning, and a valve or sensor fault that is probable",
                  [](const Evidence&, const Verdict& v) {
                    return has(v.action, "controller gain") &&
                           std::ranges::any_of(v.causes, [](const CauseReport& cause) {
                             return cause.probability >= kLine &&
                                    core::diagnosis::catalogue_entry(cause.code).withholds_tuning;
                           });
                  },
                  [](Evidence&, Verdict& v) {
                    v.action = "Lower the controller gain.";
                    set(v, Code::sensor_fault, 0.8);
                  }},
    Contradiction{"too tight, and too slow",
                  [](const Evidence&, const Verdict& v) {
                    return probability(v, Code::tight_tuning) >= 0.7 &&
                           probability(v, Code::sluggish_tuning) >= 0.7;
                  },
                  [](Evidence&, Verdict& v) {
                    set(v, Code::tight_tuning, 0.9);
                    set(v, Code::sluggish_tuning, 0.9);
                  }},
    Contradiction{"the process is not identified, and a valve's step is reported as found",
                  [](const Evidence& e, const Verdict& v) {
                    return e.model && !e.model->excited && says(v, "includes valve ");
                  },
                  [](Evidence& e, Verdict& v) {
                    e.model.emplace().excited = false;
                    v.reasons.emplace_back("The model includes valve stiction (S 4 %).");
                  }},
    Contradiction{"coupling found, and the tests found none",
                  [](const Evidence& e, const Verdict& v) {
                    const auto none = core::hos::Coupling::none_found;
                    const bool slow = e.hos_slow && e.hos_slow->result.coupling != none;
                    return e.hos && e.hos->coupling == none && !slow &&
                           (says(v, "Quadratic phase coupling:") ||
                            says(v, "Cubic phase coupling"));
                  },
                  [](Evidence& e, Verdict& v) {
                    e.hos.emplace();
                    v.reasons.emplace_back("Quadratic phase coupling: p = 0.2");
                  }},
    Contradiction{"nonlinear, and nothing shows it",
                  [](const Evidence& e, const Verdict& v) {
                    return v.code == Code::nonlinear_unexplained &&
                           !core::diagnosis::shows_nonlinearity(e, kAlpha);
                  },
                  [](Evidence& e, Verdict& v) {
                    e.model.reset();
                    e.hos.emplace().nonlinear_p = 0.6;
                    e.hos_slow.reset();
                    v.code = Code::nonlinear_unexplained;
                  }},
    Contradiction{"the valve is recorded, and no position was",
                  [](const Evidence& e, const Verdict& v) {
                    return says(v, "The mv-op plot is") && !e.shape.mv_op_width;
                  },
                  [](Evidence& e, Verdict& v) {
                    e.shape.mv_op_width.reset();
                    v.reasons.emplace_back("The mv-op plot is 3 % wide");
                  }},
    Contradiction{"cannot be judged, and usable",
                  [](const Evidence& e, const Verdict& v) {
                    return v.code == Code::insufficient_data && e.data_quality.usable && e.hos;
                  },
                  [](Evidence& e, Verdict& v) {
                    e.data_quality.usable = true;
                    e.hos.emplace();
                    v.code = Code::insufficient_data;
                  }},
    Contradiction{"pv is held, and new in every sample",
                  [](const Evidence& e, const Verdict& v) {
                    return says(v, "samples on average") &&
                           e.data_quality.compression_factor.value_or(1.0) < 1.5;
                  },
                  [](Evidence& e, Verdict& v) {
                    e.data_quality.compression_factor = 1.0;
                    v.reasons.emplace_back("pv is renewed only every 1 samples on average.");
                  }},
    Contradiction{"a fact, and a p; or a p that is none",
                  [](const Evidence&, const Verdict& v) {
                    return (!is_fault(v.code) && v.p) || !(v.p.value_or(0.5) >= 0.0) ||
                           v.p.value_or(0.5) > 1.0;
                  },
                  [](Evidence&, Verdict& v) {
                    v.code = Code::healthy;
                    v.p = 0.01;
                  }},
};

}  // namespace

std::span<const Contradiction> contradictions() {
  return kAll;
}

std::vector<std::string> contradictions_in(const Evidence& evidence, const Verdict& verdict) {
  std::vector<std::string> names;
  for (const Contradiction& contradiction : kAll) {
    if (contradiction.stands(evidence, verdict)) names.emplace_back(contradiction.name);
  }
  return names;
}

}  // namespace loopscope::tests::verdict
