#pragma once

#include "tests/core/model/field_bases.hpp"

namespace loopscope::tests::model {

/// He's law or Karnopp's equation.
Friction either(Draw& draw);

/// 700 to 1500 samples.
std::size_t short_record(Draw& draw);

/// 6000 to 18000 samples: more than the 4096 of a window.
std::size_t long_record(Draw& draw);

/// Slow beside the recording: temperatures of furnaces and columns, levels of drums.
FieldSettings slow(Draw& draw);

/// Dead time as long as the lag or longer: an analyser behind a pipe.
FieldSettings concentration(Draw& draw);

/// What no simulated process of first order has: actuator, transmitter, trim, late records.
void complicate(FieldSettings& s, Draw& draw);

template <Loop base>
FieldSettings complicated(Draw& draw) {
  FieldSettings s = base(draw);
  complicate(s, draw);
  return s;
}

}  // namespace loopscope::tests::model
