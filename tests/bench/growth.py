"""What an analysis slot costs with more and more loops, and what that says for a million.

Every catalogue gets two slots a day apart. The first, by `once`, finds empty tables; the second, by
the daemon (`run`), is what every later slot costs: rows of a day more in the historian, the slot
before checked for late rows, models for the flagged loops and for a tenth of the others. The
largest catalogues get their first slot only, by the daemon.
"""

import argparse
import datetime
import json
import time

import plant
from builds import OURS, Build, RunningProgram, run_program, say, stage_breakdown

MILLION = 1_000_000
SECONDS_A_DAY = 86400
# Larger catalogues than this get one slot: two would take an hour.
TWO_SLOTS_UP_TO = 10_000
# Larger catalogues than this share of the costs are their loops' own: the law is fitted to them.
LARGE = 1000
LEAST_COST = 1e-3  # a clock tick of CPU time and less
SLOTS = ("first", "later")
# The slots of both phases end at a midnight of UTC; a run may last beyond the next one.
TODAY = f"timestamptz '{datetime.datetime.now(datetime.timezone.utc):%Y-%m-%d} 00:00:00+00'"


def database_bytes(results):
    return int(results.sql("SELECT pg_database_size(current_database())")[0][0])


def wal_position(server):
    return int(server.sql("SELECT pg_wal_lsn_diff(pg_current_wal_lsn(), '0/0')::bigint")[0][0])


class Meter:
    """What a slot takes from the two servers."""

    def __init__(self, historian, results):
        self.historian, self.results = historian, results
        self.start = self._now()

    def _now(self):
        server = self.results.server
        return (self.historian.cpu_s(), server.cpu_s(), database_bytes(self.results),
                wal_position(server))

    def read(self):
        names = ("historian_cpu_s", "results_cpu_s", "results_bytes", "wal_bytes")
        return {name: now - then for name, now, then in zip(names, self._now(), self.start)}


def first_slot(historian, results):
    meter = Meter(historian, results)
    done = run_program(results.build.program, "once", "--config", results.settings)
    done |= meter.read()
    results.sql("VACUUM ANALYZE")
    return done


def left_to_do(results):
    return int(results.sql("SELECT count(*) FROM loopscope.schedule"
                           f" WHERE last_slot_end IS DISTINCT FROM {TODAY}")
               [0][0])


def daemon_slot(historian, results, loops):
    """The daemon from its start until every loop has today's slot, then told to stop."""
    results.sql("UPDATE loopscope.schedule SET visible_at = now();"
                " TRUNCATE loopscope.stage_cost")
    meter = Meter(historian, results)
    daemon = RunningProgram(results.build.program, "run", "--config", results.settings)
    while left_to_do(results) > 0:
        daemon.look()
        if daemon.ended():
            raise RuntimeError("loopscope run ended by itself")
        time.sleep(max(0.5, loops / 4000))  # the look reads the schedule, at the cost of the slot
    daemon.stop()
    done = daemon.wait()
    elapsed = results.sql("SELECT extract(epoch FROM max(analysed_at) - min(analysed_at))"
                          f" FROM loopscope.analysis WHERE slot_end = {TODAY}")[0][0]
    return done | {"elapsed_s": float(elapsed), "stages": stage_breakdown(results)} | meter.read()


def per_loop(slot, loops):
    """Milliseconds of CPU and bytes, a loop."""
    cpu = {key.replace("cpu_s", "cpu_ms"): 1e3 * slot[key] / loops
           for key in ("cpu_s", "historian_cpu_s", "results_cpu_s")}
    return {**cpu, "all_cpu_ms": sum(cpu.values()),
            "results_bytes": slot["results_bytes"] / loops, "wal_bytes": slot["wal_bytes"] / loops}


def fit_law(points):
    """Least squares of cost = fixed + each * loops, every point's relative error alike."""
    points = [(loops, max(cost, LEAST_COST)) for loops, cost in points]
    weight = [1.0 / cost ** 2 for _, cost in points]
    s = sum(weight)
    sx = sum(w * n for w, (n, _) in zip(weight, points))
    sy = sum(w * y for w, (_, y) in zip(weight, points))
    sxx = sum(w * n * n for w, (n, _) in zip(weight, points))
    sxy = sum(w * n * y for w, (n, y) in zip(weight, points))
    each = (s * sxy - sx * sy) / (s * sxx - sx * sx) if len(points) > 1 else sy / sx
    fixed = (sy - each * sx) / s if len(points) > 1 else 0.0
    return {"fixed": fixed, "each": each,
            "largest_error": max(abs(fixed + each * n - y) / y for n, y in points)}


def laws_of(sizes, slot):
    laws = {}
    for key, cost in (("cpu_s", lambda slot: slot["cpu_s"]),
                      ("historian_cpu_s", lambda slot: slot["historian_cpu_s"]),
                      ("results_cpu_s", lambda slot: slot["results_cpu_s"]),
                      ("all_cpu_s", lambda slot: slot["cpu_s"] + slot["historian_cpu_s"]
                       + slot["results_cpu_s"]),
                      ("results_bytes", lambda slot: slot["results_bytes"])):
        laws[key] = fit_law([(size["loops"], cost(size[slot])) for size in sizes if slot in size])
    return laws


def for_a_million(laws, period_s):
    """Cores that are busy all the time, and what the results grow by in a year."""
    slots_a_day = SECONDS_A_DAY / period_s
    cores = {key.replace("_cpu_s", "_cores").replace("cpu_s", "program_cores"):
             laws[key]["each"] * MILLION / period_s
             for key in ("cpu_s", "historian_cpu_s", "results_cpu_s")}
    return {"period_s": period_s, **cores,
            "results_gb_a_year": laws["results_bytes"]["each"] * MILLION * slots_a_day * 365 / 1e9}


def flatness(sizes):
    """Largest over smallest cost a loop, less one, over the catalogues that are large."""
    costs = [per_loop(size["first"], size["loops"])["all_cpu_ms"] for size in sizes
             if size["loops"] >= LARGE]
    return max(costs) / min(costs) - 1.0 if costs else None


def measure(counts, cache_mb):
    schedule = {"model_all_up_to": 0}  # turns at every size, so that sizes can be compared
    more = None if cache_mb is None else {"daemon": {"cache_mb": cache_mb}}
    build = Build(OURS)
    with plant.Workshop() as shop:
        historian, server = shop.server(), shop.server()
        plant.load_recordings(historian, build.program, plant.WINDOW + plant.ROWS_A_DAY)
        plant.make_history(historian)
        yesterday = f"({TODAY} - interval '1 day')"
        plant.add_history(historian, plant.RECORDINGS, 0, plant.WINDOW - 1, yesterday)
        plant.index_history(historian, covering=True)
        plant.warm_history(historian)
        sizes, catalogues = [], []
        for loops in counts:
            say(f"{loops} loops ...")
            results = plant.Results(server, build, historian, shop.folder, loops,
                                    plant.RECORDINGS, schedule, more)
            catalogues.append(results)
            sizes.append({"loops": loops})
            if loops <= TWO_SLOTS_UP_TO:
                sizes[-1]["first"] = first_slot(historian, results)
        plant.add_history(historian, plant.RECORDINGS, plant.WINDOW,
                          plant.WINDOW + plant.ROWS_A_DAY - 1, TODAY)
        plant.index_history(historian, covering=True)
        plant.warm_history(historian)
        for size, results in zip(sizes, catalogues):
            say(f"{size['loops']} loops, by the daemon ...")
            slot = "later" if "first" in size else "first"
            size[slot] = daemon_slot(historian, results, size["loops"])
            results.drop()
    laws = {slot: laws_of(sizes, slot) for slot in SLOTS if any(slot in size for size in sizes)}
    return {"sizes": sizes, "laws": laws, "flatness": flatness(sizes),
            "peak_rss_mb": max(size[slot]["rss_mb"] for size in sizes for slot in SLOTS
                               if slot in size),
            "million": [for_a_million(laws.get("later", laws.get("first")), period)
                        for period in (SECONDS_A_DAY, 3600)]}


def table(found):
    lines = ["| loops | slot | s | loops/s | program ms | historian ms | results ms | all ms |"
             " kB stored | kB of log | peak MB |", "|" + "---|" * 11]
    for size in found["sizes"]:
        for name in (slot for slot in SLOTS if slot in size):
            slot, each = size[name], per_loop(size[name], size["loops"])
            lines.append(
                f"| {size['loops']} | {name} | {slot['elapsed_s']:.1f} |"
                f" {size['loops'] / slot['elapsed_s']:.0f} | {each['cpu_ms']:.2f} |"
                f" {each['historian_cpu_ms']:.2f} | {each['results_cpu_ms']:.2f} |"
                f" {each['all_cpu_ms']:.2f} | {each['results_bytes'] / 1e3:.1f} |"
                f" {each['wal_bytes'] / 1e3:.1f} | {slot['rss_mb']:.0f} |")
    if found["flatness"] is not None:
        lines += ["", f"Cost a loop from {LARGE} loops on: flat within {found['flatness']:.1%}"]
    lines += ["", "| slot | cost | fixed | a loop | largest error of the law |", "|" + "---|" * 5]
    for slot, laws in found["laws"].items():
        for key, law in laws.items():
            lines.append(f"| {slot} | {key} | {law['fixed']:.3g} | {law['each']:.3g} |"
                         f" {law['largest_error']:.1%} |")
    for answer in found["million"]:
        cores = ", ".join(f"{answer[key]:.2f} {key.replace('_', ' ')}" for key in
                          ("program_cores", "historian_cores", "results_cores"))
        lines.append(f"\nA million loops every {answer['period_s']} s: {cores};"
                     f" results {answer['results_gb_a_year']:.0f} GB a year")
    return "\n".join(lines)


def sizes_of(text):
    sizes = text.split(",")
    if not all(count.isdecimal() and int(count) > 0 for count in sizes):
        raise argparse.ArgumentTypeError(
            f"'{text}' is no list of numbers of loops above 0. HINT: --loops 100,1000")
    return [int(count) for count in sizes]


def megabytes_of(text):
    if not (text.isdecimal() and int(text) <= 1_000_000):
        raise argparse.ArgumentTypeError(
            f"'{text}' is no number of MB from 0 to 1000000. HINT: --cache-mb 512")
    return int(text)


def main():
    parser = argparse.ArgumentParser(prog="tests/bench/growth", description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--json", action="store_true", help="one JSON object")
    parser.add_argument("--loops", type=sizes_of, default=[100, 1000, 10_000, 100_000],
                        metavar="N,N,...", help="sizes of the catalogue (100,1000,10000,100000)")
    parser.add_argument("--cache-mb", type=megabytes_of, metavar="N",
                        help="the setting /daemon/cache_mb; 0 = no windows kept")
    options = parser.parse_args()
    found = measure(options.loops, options.cache_mb)
    print(json.dumps(found) if options.json else table(found))


if __name__ == "__main__":
    main()
