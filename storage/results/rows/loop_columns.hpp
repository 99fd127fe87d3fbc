#pragma once

/// What read_loop() (loop_row.hpp) takes from a row. Times travel as whole microseconds: extract()
/// is exact, because it is numeric since PostgreSQL 14. An infinite time of one
/// loop would stop whoever reads it among others.
#define LOOPSCOPE_LOOP_COLUMNS                                                                 \
  "loop.loop_id, loop.name, loop.source, loop.sp_tag, loop.pv_tag, loop.op_tag, loop.mv_tag,"  \
  " loop.mode_tag, loop.interval_s, loop.period_s, loop.op_low, loop.op_high, loop.loop_type," \
  " loop.importance, loop.enabled, loop.area, loop.unit, loop.description, loop.pv_unit,"      \
  " loop.owner, loop.pv_low, loop.pv_high,"                                                    \
  " (extract(epoch FROM greatest(least(loop.registered_at, '9999-12-31 UTC'), "                \
  "'4713-01-01 BC')) * 1000000)::bigint AS registered_us"
