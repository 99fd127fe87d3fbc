"""Builds of the program that are measured, their runs, and two of them by turns.

Times on a busy machine are worth nothing by themselves: what two builds differ by is said as the
ratio of what they took in the same round, one right after the other, who begins by turns as well.
"""

import math
import os
import re
import signal
import statistics
import subprocess
import sys
import time
from pathlib import Path

import plant

# Of a median, in standard errors of a mean.
MEDIAN_ERROR = 1.2533
# Between a ratio of 1 and one that is found with a probability of 80 %, 5 % being found by chance.
DETECTABLE_ERRORS = 2.8


def say(text):
    print(text, file=sys.stderr, flush=True)


class Build:
    """A folder of CMake's with the benchmarks in it, and `loopscope` unless that stands elsewhere."""

    def __init__(self, folder, program=None):
        self.folder = Path(folder).resolve()
        self.program = Path(program or self.folder / "loopscope")
        self.tests = self.folder / "tests"
        if not self.program.exists():
            raise SystemExit(f"error: {self.program} is not there\n"
                             "HINT: build it, loopscope and the *_benchmark programs")
        cache = self.folder / "CMakeCache.txt"
        home = re.search(r"^CMAKE_HOME_DIRECTORY:INTERNAL=(.+)$",
                         cache.read_text() if cache.exists() else "", re.MULTILINE)
        self.source = Path(home[1]) if home else plant.SOURCE_DIR


OURS = plant.SOURCE_DIR / "build/release"


class RunningProgram:
    """The program at work, and what it took: seconds, CPU seconds, peak memory in MB."""

    def __init__(self, program, *arguments):
        self.start = time.monotonic()
        self.peak_mb = 0.0
        with open(os.devnull, "w", encoding="ascii") as nowhere:
            self.process = subprocess.Popen([program, *map(str, arguments)], stdout=nowhere,
                                            stderr=nowhere)

    def cpu_s(self):
        return plant.cpu_ticks(self.process.pid)[0] / plant.TICKS_PER_S

    def look(self):
        """Notes the peak so far. Not the kernel's figure at the end: that one begins with the
        memory of this script, whose child the program was for a moment."""
        try:
            status = Path(f"/proc/{self.process.pid}/status").read_text()
            self.peak_mb = max(self.peak_mb, int(re.search(r"VmHWM:\s+(\d+)", status)[1]) / 1024)
        except (FileNotFoundError, TypeError):
            pass  # it has just ended

    def ended(self):
        return self.process.poll() is not None

    def stop(self):
        self.look()
        self.process.send_signal(signal.SIGTERM)

    def wait(self):
        while True:
            self.look()
            pid, status, usage = os.wait4(self.process.pid, os.WNOHANG)
            if pid != 0:
                break
            time.sleep(0.02)
        self.process.returncode = os.waitstatus_to_exitcode(status)
        if self.process.returncode != 0:
            raise RuntimeError(f"loopscope ended with exit code {self.process.returncode}")
        return {"elapsed_s": time.monotonic() - self.start,
                "cpu_s": usage.ru_utime + usage.ru_stime, "rss_mb": self.peak_mb}


def run_program(program, *arguments):
    return RunningProgram(program, *arguments).wait()


def stage_breakdown(results):
    """Milliseconds a loop by stage, summed over the workers."""
    columns = ("claim", "fetch", "prepare", "statistics", "model", "decide", "write", "wait")
    sums = ", ".join(f"1000 * sum({column}_s) / sum(loops)" for column in columns)
    row = results.sql(f"SELECT {sums}, sum(modelled) FROM loopscope.stage_cost")[0]
    return {**{f"{column}_ms": float(value) for column, value in zip(columns, row)},
            "modelled": int(float(row[-1]))}


class Turns:
    """The builds, and what each took in each round: ours is the first, the other may be missing."""

    def __init__(self, builds):
        self.builds = builds
        self.ours = builds[0]
        self.values = {}  # by metric: a list for each build
        self.differences = []  # what makes the comparison void

    def of_round(self, number):
        return self.builds if number % 2 == 0 else self.builds[::-1]

    def note(self, metric, build, value):
        lists = self.values.setdefault(metric, [[] for _ in self.builds])
        lists[self.builds.index(build)].append(value)

    def compared(self):
        """Ratio ours / other by metric, where there are two builds; differences, if any."""
        if len(self.builds) < 2:
            return {}
        ratios = {metric: ratio_of(*lists) for metric, lists in self.values.items()
                  if len(lists[0]) == len(lists[1])}
        return {"against": {"build": str(self.builds[1].folder), "ratios": ratios,
                            "differences": self.differences}}


def ratio_of(ours, other):
    """Median of the ratios of the rounds with its standard error, and which change would be seen."""
    ratios = [one / two for one, two in zip(ours, other) if one > 0.0 and two > 0.0]
    if not ratios:
        return {"ratio": None, "standard_error": None, "detectable": None, "pairs": 0}
    ratio = statistics.median(ratios)
    error = None
    if len(ratios) > 2:
        spread = statistics.stdev(math.log(one) for one in ratios)
        error = ratio * MEDIAN_ERROR * spread / math.sqrt(len(ratios))
    return {"ratio": ratio, "standard_error": error,
            "detectable": None if error is None else DETECTABLE_ERRORS * error / ratio,
            "pairs": len(ratios)}


def compared_rows(found):
    """Lines of the table: what, ratio, note."""
    if "against" not in found:
        return []
    rows = [("ratios to", "", found["against"]["build"])]
    for metric, ratio in found["against"]["ratios"].items():
        if ratio["ratio"] is None:
            continue
        spread = ("" if ratio["standard_error"] is None else
                  f"+- {ratio['standard_error']:.3f}, a change of {ratio['detectable']:.1%} is seen, ")
        rows.append((f"  {metric}", f"{ratio['ratio']:.3f}", f"{spread}{ratio['pairs']} pairs"))
    rows += [("  NOT THE SAME WORK", "", what) for what in found["against"]["differences"]]
    return rows
