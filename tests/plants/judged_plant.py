"""The plant of 500 loops: into the historian, through `once` and `report`, scored."""

import contextlib
import json
import subprocess
import sys
import tempfile
import time
from pathlib import Path

_PLANT, _RESULTS = "plant", "results"
# A window ends at the newest sample; nothing is on its way.
_SETTLE_S = 0
# Slots end at whole multiples of a loop's period, its window of 4096 samples: of all of them those of
# 60 s a sample are the longest, and whole multiples of those of 1, 5 and 10 s.
_LONGEST_PERIOD_S = 4096 * 60


def _run(command, **options):
    done = subprocess.run(command, text=True, capture_output=True, check=False, **options)
    if done.returncode != 0:
        raise RuntimeError(f"{' '.join(map(str, command))}: exit code {done.returncode}\n"
                           f"{done.stdout}{done.stderr}".strip())
    return done.stdout


@contextlib.contextmanager
def _timed(figures, name):
    start = time.monotonic()
    yield
    figures[name] = round(time.monotonic() - start, 1)
    print(f"{name} {figures[name]}", file=sys.stderr)


class _Plant:
    def __init__(self, arguments, server, folder):
        self.server, self.folder = server, folder
        self.loopscope = arguments.build / "loopscope"
        self.faults = [arguments.build / "tests" / "plants" / "plant_faults",
                       "--seed", str(arguments.seed)]
        self.settings = folder / "loopscope.json"
        now_s = int(time.time())
        self.end = ["--end", str(now_s - now_s % _LONGEST_PERIOD_S)]

    def command(self, name, *words):
        return _run([self.loopscope, name, "--config", self.settings, *words])

    def prepare(self):
        for database in (_PLANT, _RESULTS):
            self.server.sql(f"CREATE DATABASE {database}")
        self.server.make_owner(_RESULTS)
        self.server.sql("CREATE TABLE history (tag text NOT NULL, time bigint NOT NULL,"
                        " value double precision)", _PLANT)
        self.settings.write_text(json.dumps({
            "results": {"connection": self.server.conninfo(_RESULTS, "test_owner")},
            "historians": [{"name": "plant", "connection": self.server.conninfo(_PLANT),
                            "time_kind": "epoch_us", "quality_column": "",
                            "quality_rule": "none"}],
            "schedule": {"settle_s": _SETTLE_S}}, indent=2), encoding="utf-8")
        self.command("migrate")

    def fill(self, what):
        """`what`: nothing, or earlier- for the window before of the loops that have one."""
        self.server.copy([*self.faults, f"--{what}history", *self.end], "history", _PLANT)
        self.server.sql("DROP INDEX IF EXISTS by_tag;"
                        " CREATE INDEX by_tag ON history (tag, time) INCLUDE (value);"
                        " VACUUM ANALYZE history", _PLANT)
        catalogue = self.folder / f"{what}loops.csv"
        catalogue.write_text(_run([*self.faults, f"--{what}catalogue"]), encoding="utf-8")
        self.command("loops", "load", str(catalogue))

    def score(self):
        rows = self.server.sql("SELECT loop_name, code FROM loopscope.flagged_loop", _RESULTS)
        lines = "".join(f"{name} {code}\n" for name, code in rows)
        return json.loads(_run([*self.faults, "--score", "--json"], input=lines))["plants"][0]

    def statuses(self):
        """How many flags are confirmed by a second window."""
        return {status: int(count) for status, count in self.server.sql(
            "SELECT status, count(*) FROM loopscope.flagged_loop GROUP BY 1 ORDER BY 1", _RESULTS)}


def _judge(plant):
    figures = {}
    plant.prepare()
    with _timed(figures, "earlier_s"):
        plant.fill("earlier-")
        plant.command("once")
    with _timed(figures, "fill_s"):
        plant.fill("")
    with _timed(figures, "once_s"):
        plant.command("once")
    with _timed(figures, "report_s"):
        plant.command("report", "--pdf", "--out", str(plant.folder / "report"))
    figures["status"] = plant.statuses()
    return plant.score() | figures


def judge_plant(arguments, server):
    if arguments.keep is not None:
        arguments.keep.mkdir(parents=True, exist_ok=True)
        return _judge(_Plant(arguments, server, arguments.keep))
    with tempfile.TemporaryDirectory(prefix="loopscope-plants.") as folder:
        return _judge(_Plant(arguments, server, Path(folder)))
