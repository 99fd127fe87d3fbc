#include <array>

#include "tests/core/model/field_families.hpp"
#include "tests/core/model/healthy_loops.hpp"
#include "tests/core/model/plant_bases.hpp"
#include "tests/core/model/visible_stiction.hpp"

namespace loopscope::tests::model {
namespace {

FieldLoop few_cycles(Draw& draw) {
  constexpr double kMost = 15.0;
  for (;;) {
    const FieldLoop loop = visible_stiction(
        slow, either(draw), draw, [](FieldSettings&, std::size_t) {}, short_record);
    if (static_cast<double>(loop.mv.size()) < kMost * period_of(loop.mv)) return loop;
  }
}

FieldLoop slow_stiction_by_analyser(Draw& draw) {
  return visible_stiction(concentration, either(draw), draw, [](FieldSettings&, std::size_t) {});
}

FieldLoop coarse_stiction(Draw& draw) {
  return visible_stiction(any_loop, either(draw), draw, [&](FieldSettings& s, std::size_t samples) {
    const FieldLoop clear = run_field_loop(s, samples, draw);
    s.recording.pv_grid = standard_deviation(clear.pv) * draw.between(0.2, 0.8);
    s.recording.archive_grid_op = standard_deviation(clear.op) * draw.between(0.1, 0.5);
  });
}

FieldLoop slave_stiction(Draw& draw) {
  return visible_stiction(flow, either(draw), draw, [&](FieldSettings& s, std::size_t samples) {
    const FieldLoop clear = run_field_loop(s, samples, draw);
    s.master = outside(OutsideWave::Shape::sine, false, draw);
    s.master.period_steps =
        period_of(clear.op) * static_cast<double>(s.recording.every) * draw.between(3.0, 12.0);
    s.master.amplitude = standard_deviation(clear.pv) * draw.between(0.3, 2.0);
    s.master_walk = standard_deviation(clear.pv) * draw.between(0.0, 0.3);
  });
}

FieldLoop coming_and_going_stiction(Draw& draw) {
  return visible_stiction(any_loop, either(draw), draw, [&](FieldSettings& s, std::size_t samples) {
    s.valve.stretch_steps = samples * s.recording.every / draw.whole(8, 16);
  });
}

FieldLoop long_stiction(Draw& draw) {
  return visible_stiction(
      any_loop, either(draw), draw, [](FieldSettings&, std::size_t) {}, long_record);
}

template <Loop base>
FieldLoop complicated_stiction(Draw& draw) {
  return visible_stiction(complicated<base>, either(draw), draw,
                          [](FieldSettings&, std::size_t) {});
}

constexpr std::array kPlantStickingFamilies = {
    FieldFamily{"stiction_few_cycles", true, false, few_cycles},
    FieldFamily{"stiction_concentration", true, true, slow_stiction_by_analyser},
    FieldFamily{"stiction_coarse", true, true, coarse_stiction},
    FieldFamily{"stiction_cascade", true, false, slave_stiction},
    FieldFamily{"stiction_now_and_then", true, false, coming_and_going_stiction},
    FieldFamily{"stiction_long", true, false, long_stiction},
    FieldFamily{"stiction_complicated_flow", true, false, complicated_stiction<flow>},
    FieldFamily{"stiction_complicated_level", true, false, complicated_stiction<level>},
    FieldFamily{"stiction_complicated_heat", true, true, complicated_stiction<temperature>},
};

}  // namespace

std::span<const FieldFamily> plant_sticking_families() {
  return kPlantStickingFamilies;
}

}  // namespace loopscope::tests::model
