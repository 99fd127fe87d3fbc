#include "tests/plants/network/diagnosed.hpp"

#include <cmath>

#include "core/diagnosis/diagnose.hpp"
#include "core/diagnosis/evidence/nonlinearity.hpp"
#include "core/diagnosis/verdicts/verdict_catalogue.hpp"
#include "core/model/effects/effect_catalogue.hpp"
#include "tests/effects/window_of.hpp"

namespace loopscope::tests::network {

DiagnosedLoop diagnose(const LoopRecord& record, const TrueLoop& truth, std::uint64_t seed) {
  const core::AnalysisSettings settings;
  const core::LoopFacts facts{.integrating = truth.kind == LoopKind::level, .seed = seed};
  const std::int64_t start_us = std::llround(record.start_s * 1e6);
  const core::FirstLook first =
      core::first_look(effects::window_of(record, record.interval_s, start_us), settings);
  const auto [evidence, verdict, traces] =
      core::diagnose(first, settings, facts, nullptr,
                     {.cause = core::ModelTrigger{}, .traces = false, .done = {}});
  DiagnosedLoop loop;
  loop.name = truth.name;
  loop.interval_s = record.interval_s;
  loop.start_us = start_us;
  loop.error = first.loop.error;
  loop.sp = record.sp;
  loop.pv = first.loop.pv;
  loop.op = first.loop.op_percent;
  loop.own = core::diagnosis::own_findings(verdict);
  loop.nonlinear_p = core::diagnosis::nonlinear_p(evidence);
  if (evidence.hos)
    loop.cubic_p = evidence.hos_slow ? evidence.hos_slow->result.cubic_p : evidence.hos->cubic_p;
  if (evidence.model)
    for (const core::model::Step& step : evidence.model->steps)
      if (core::model::is_valve_hysteresis(step.effect))
        loop.valve_explained += core::model::explained_by(step);
  loop.verdict = name(verdict.code);
  if (evidence.hos) loop.ngi = evidence.hos->ngi;
  return loop;
}

std::vector<core::plant::MemberLoop> members_of(const std::vector<DiagnosedLoop>& loops) {
  std::vector<core::plant::MemberLoop> members;
  for (const DiagnosedLoop& loop : loops) {
    core::plant::MemberLoop member;
    member.id = static_cast<std::int64_t>(members.size() + 1);
    member.name = loop.name;
    member.sample_interval_s = loop.interval_s;
    member.start_us = loop.start_us;
    member.error = loop.error;
    member.sp = loop.sp;
    member.pv = loop.pv;
    member.op = loop.op;
    member.own = loop.own;
    members.push_back(std::move(member));
  }
  return members;
}

}  // namespace loopscope::tests::network
