"""The passes of `once`: a slot more of history, a pass over all loops, what the list then says."""

import dataclasses
import json
import subprocess
import sys
import time

import history
import plant

_RESULTS = "results"
_ANALYZE_EVERY = 25
_TELL_EVERY = 10
_LIST = """SELECT loop_name, code, round(fault_probability::numeric, 3), rank, status
           FROM loopscope.flagged_loop ORDER BY rank"""
# Probabilities as the list has them, by all windows so far; a verdict that late data have replaced
# is not current.
_VERDICTS = """SELECT shown.loop_name, extract(epoch FROM shown.slot_end)::bigint, shown.code,
                      1 - analysis.combined_probabilities[1]
               FROM loopscope.loop_history AS shown
               JOIN loopscope.analysis USING (loop_id, slot_end, analysis_id)
               WHERE shown.is_current ORDER BY 1, 2"""


@dataclasses.dataclass
class Verdict:
    """`fault_probability`: None where nothing was weighed."""
    code: str
    fault_probability: float | None


def _verdict(code, probability):
    return Verdict(code, float(probability) if probability else None)


class Passes:
    def __init__(self, program, server, folder):
        self._program, self._server, self._folder = program, server, folder
        self._settings = folder / "loopscope.json"

    def _command(self, name, *words):
        done = subprocess.run([self._program, name, "--config", self._settings, *words],
                              text=True, capture_output=True, check=False)
        if done.returncode != 0:
            raise RuntimeError(f"loopscope {name}: exit code {done.returncode}\n"
                               f"{done.stdout}{done.stderr}".strip())

    def prepare(self, loops):
        """Results schema, settings as a site would have them, catalogue."""
        self._server.sql(f"CREATE DATABASE {_RESULTS}")
        self._server.make_owner(_RESULTS)
        self._settings.write_text(json.dumps({
            "results": {"connection": self._server.conninfo(_RESULTS, "test_owner")},
            "historians": history.settings_of(self._server.conninfo(history.DATABASE)),
            "schedule": {"default_period_s": plant.SLOT_S}}, indent=2), encoding="utf-8")
        self._command("migrate")
        catalogue = self._folder / "loops.csv"
        history.write_catalogue(loops, catalogue)
        self._command("loops", "load", str(catalogue))

    def run(self, trial, recorded):
        """The list after each pass: by loop, for every slot. `recorded`: the History."""
        began, lists = time.monotonic(), []
        with open(self._folder / "list.tsv", "w", encoding="utf-8") as kept:
            kept.write("slot\tloop\tcode\tfault_probability\trank\tstatus\n")
            for slot in range(trial.slots + 1):
                self._add_slot(recorded, slot)
                self._command("once")
                rows = self._server.sql(_LIST, _RESULTS)
                kept.writelines("\t".join([str(slot), *row]) + "\n" for row in rows)
                lists.append({loop: _verdict(code, odds) for loop, code, odds, *_ in rows})
                if slot % _TELL_EVERY == 0:
                    print(f"slot {slot} of {trial.slots}, {time.monotonic() - began:.0f} s",
                          file=sys.stderr, flush=True)
        return lists

    @staticmethod
    def _add_slot(recorded, slot):
        end_s = plant.slot_end_s(slot) + 1  # the slot's end belongs to it
        if slot > 0:
            recorded.add(end_s - plant.SLOT_S, end_s)
        else:
            for start_s in range(0, end_s, plant.SLOT_S * _ANALYZE_EVERY):
                recorded.add(start_s, min(start_s + plant.SLOT_S * _ANALYZE_EVERY, end_s))
        if slot % _ANALYZE_EVERY == 0:
            recorded.analyze()

    def verdicts(self, recorded):
        """All that was ever said: by loop, then by slot."""
        said = {}
        for loop, end_s, code, odds in self._server.sql(_VERDICTS, _RESULTS):
            slot = (int(end_s) - recorded.start_s - plant.LEAD_S) // plant.SLOT_S
            said.setdefault(loop, {})[slot] = _verdict(code, odds)
        return said
