"""The steady state: slots that move by a quarter of a window, in a historian that grows.

The daemon (`run`) stays alive: what it remembers of a window, it has from its first, whole read.
Before each slot the rows of a quarter of a window are inserted, as they would arrive; nothing but
the daemon's work on the slot is counted, from the moment that the loops are due until the last of
them is done. The samples lie some tens of milliseconds apart, so that slots are due as the clock
says: a slot that ended long ago would have tags that count as dead.
"""

import math
import time

import plant
from builds import RunningProgram, say
from passes import note_parts

SLOTS = 8
MOVE = plant.WINDOW // 4
SETTLE_S = 1
# Between two slots: for their rows to be inserted, and for two builds to analyse them.
LEAST_SLOT_S, SLOT_S_A_LOOP = 16, 1 / 16
LOAD_S_A_LOOP = 1 / 20
# A worker without work looks this often, and wakes when loops are due that it has seen to be.
POLL_S, DUE_IN_S = 2, 3
# As in the passes over thousands of loops: models by turns.
SCHEDULE = {"settle_s": SETTLE_S, "poll_s": POLL_S, "catch_up_slots": 1000, "model_all_up_to": 0}
MORE = {"daemon": {"http_address": "127.0.0.1:0"}}
LONGEST_SLOT_S = 1800
# A loop whose slot is done waits until its next rows have been inserted: on a slow machine the clock
# is ahead of them.
WAIT_FOR_ROWS = """
    CREATE FUNCTION public.wait_for_rows() RETURNS trigger LANGUAGE plpgsql AS
      $$ BEGIN NEW.enabled := false; RETURN NEW; END $$;
    CREATE TRIGGER wait_for_rows BEFORE UPDATE ON loopscope.schedule FOR EACH ROW
      WHEN (NEW.last_slot_end IS DISTINCT FROM OLD.last_slot_end)
      EXECUTE FUNCTION public.wait_for_rows()"""
# Looks every tenth of a second, for five seconds at most.
WAIT_UNTIL_DONE = """
    DO $$ BEGIN FOR look IN 1 .. 50 LOOP
      EXIT WHEN NOT EXISTS (SELECT FROM loopscope.schedule WHERE enabled);
      PERFORM pg_sleep(0.1);
    END LOOP; END $$;
    SELECT count(*) FROM loopscope.schedule WHERE enabled"""


def sql_time(time_us):
    return f"(timestamptz 'epoch' + {time_us} * interval '1 microsecond')"


class Grid:
    """Times of slots: slot 0 is the whole read."""

    def __init__(self, loops):
        period_s = max(LEAST_SLOT_S, loops * SLOT_S_A_LOOP)
        self.interval_us = 1000 * math.ceil(period_s / MOVE * 1000)
        self.interval_s = self.interval_us / 1e6
        self.period_us = MOVE * self.interval_us
        loaded_us = (time.time() + loops * LOAD_S_A_LOOP) * 1e6
        self.first_us = math.ceil(loaded_us / self.period_us) * self.period_us

    def end_us(self, slot):
        return self.first_us + slot * self.period_us

    def wait_for(self, slot):
        """Until the slot is due; returns by how many seconds it is late."""
        late_s = time.time() - (self.end_us(slot) / 1e6 + SETTLE_S)
        time.sleep(max(0.0, -late_s) + 0.1)
        return max(0.0, late_s)


class Plant:
    """A build's daemon over its own results, and what its slots take."""

    def __init__(self, build, shop, historian, loops, grid):
        self.build, self.historian, self.server = build, historian, shop.server()
        self.loops, self.grid = loops, grid
        self.results = plant.Results(self.server, build, historian, shop.folder, loops, loops,
                                     SCHEDULE, MORE, grid.interval_s, grid.period_us / 1e6)
        before_first = sql_time(grid.end_us(-1))
        self.results.sql(f"UPDATE loopscope.schedule SET enabled = false, last_slot_end = {before_first};"
                         + WAIT_FOR_ROWS)
        self.daemon = RunningProgram(build.program, "run", "--config", self.results.settings)

    def _cpu(self):
        return self.daemon.cpu_s(), self.historian.cpu_s(), self.server.cpu_s()

    def analyse(self, slot):
        """The slot of all loops. The workers rest until these are due, and what they ask meanwhile
        does not count."""
        due = float(self.results.sql(
            "WITH due AS (UPDATE loopscope.schedule SET enabled = true,"
            f" visible_at = now() + interval '{DUE_IN_S} seconds' RETURNING visible_at)"
            " SELECT extract(epoch FROM min(visible_at)) FROM due")[0][0])
        time.sleep(max(0.0, due - time.time()))
        before = self._cpu()
        self._await_end()
        cpu_s, historian_cpu_s, results_cpu_s = (
            after - then for after, then in zip(self._cpu(), before))
        ended, usable, modelled = self.results.sql(
            "SELECT extract(epoch FROM max(analysed_at)), count(*) FILTER (WHERE usable),"
            " count(model_ms) FROM loopscope.analysis"
            f" WHERE slot_end = {sql_time(self.grid.end_us(slot))}")[0]
        if int(usable) != self.loops:
            raise RuntimeError(f"{usable} of {self.loops} loops were judged in slot {slot}")
        return {"elapsed_s": float(ended) - due, "modelled": int(modelled), "cpu_s": cpu_s,
                "historian_cpu_s": historian_cpu_s, "results_cpu_s": results_cpu_s}

    def _await_end(self):
        start = time.monotonic()
        while int(self.results.sql(WAIT_UNTIL_DONE)[0][0]) > 0:
            self.daemon.look()
            if self.daemon.ended():
                raise RuntimeError("loopscope run ended by itself")
            if time.monotonic() - start > LONGEST_SLOT_S:
                raise RuntimeError(f"a slot was not done within {LONGEST_SLOT_S} s")

    def stop(self):
        if not self.daemon.ended():
            self.daemon.stop()
            self.daemon.wait()


def whole_and_steady(turns, plants, historian, loops, grid):
    slots, late_s = {build: [] for build in turns.builds}, 0.0
    for slot in range(SLOTS + 1):
        if slot > 0:
            last_k = plant.WINDOW + slot * MOVE - 1
            plant.add_history(historian, loops, last_k - MOVE + 1, last_k,
                              sql_time(grid.end_us(slot)), grid.interval_s)
            plant.tidy_history(historian)
        late_s = max(late_s, grid.wait_for(slot))
        for build in turns.of_round(slot):
            done = plants[build].analyse(slot)
            slots[build].append(done)
            note_parts(turns, build, "steady state" if slot > 0 else "whole read", done)
        counts = [slots[build][-1]["modelled"] for build in turns.builds]
        if len(set(counts)) > 1:
            turns.differences.append(f"steady state, slot {slot}: "
                                     f"{' and '.join(map(str, counts))} loops with a model")
    return slots[turns.ours], late_s


def per_slot_ms(slots, loops):
    return {name: 1e3 * sum(slot[key] for slot in slots) / (loops * len(slots))
            for name, key in (("program", "cpu_s"), ("historian", "historian_cpu_s"),
                              ("results", "results_cpu_s"))}


def summary(slots, loops, late_s):
    whole, steady = per_slot_ms(slots[:1], loops), per_slot_ms(slots[1:], loops)
    analysed = loops * len(slots[1:])
    return {"steady_loops": loops,
            "steady_slots_per_s": analysed / sum(slot["elapsed_s"] for slot in slots[1:]),
            **{f"steady_{name}_ms": value for name, value in steady.items()},
            **{f"whole_{name}_ms": value for name, value in whole.items()},
            "whole_slots_per_s": loops / slots[0]["elapsed_s"],
            "steady_historian_share": steady["historian"] / whole["historian"],
            "steady_modelled_share": sum(slot["modelled"] for slot in slots[1:]) / analysed,
            "whole_modelled_share": slots[0]["modelled"] / loops,
            "steady_late_s": late_s, "steady_slots": slots}


def measure_steady(turns, loops):
    with plant.Workshop() as shop:
        historian = shop.server()
        say(f"a historian of {3 * loops * plant.WINDOW / 1e6:.1f} million rows ...")
        plant.load_recordings(historian, turns.ours.program, plant.WINDOW + SLOTS * MOVE)
        plant.make_history(historian)
        grid = Grid(loops)
        plant.add_history(historian, loops, 0, plant.WINDOW - 1, sql_time(grid.end_us(0)),
                          grid.interval_s)
        plant.index_history(historian, covering=True)
        plants = {}
        try:
            for build in turns.builds:
                plants[build] = Plant(build, shop, historian, loops, grid)
            slots, late_s = whole_and_steady(turns, plants, historian, loops, grid)
            memory = plants[turns.ours].daemon.peak_mb
        finally:
            for one in plants.values():
                one.stop()
        return {**summary(slots, loops, late_s), "steady_rss_mb": memory}


def steady_rows(found):
    if "steady_slots_per_s" not in found:
        return []
    rows = []
    for kind, what in (("whole", "whole read"), ("steady", "a quarter of a window on")):
        rows += [(f"slot, {what}", f"{found[f'{kind}_slots_per_s']:.0f} slots/s",
                  f"{found[f'{kind}_modelled_share']:.1%} with a model"),
                 ("  CPU ms: program, historian, results",
                  ", ".join(f"{found[f'{kind}_{name}_ms']:.2f}"
                            for name in ("program", "historian", "results")), "")]
    rows[-1] = (*rows[-1][:2], f"historian {found['steady_historian_share']:.2f} of a whole read")
    return rows
