"""Faults from a seed against workers that share a plant, and the proof that nothing was lost, nothing
done twice and nothing computed otherwise. See README.md."""

import argparse
import json
import random
import signal
import statistics
import sys
import time
from pathlib import Path

import injections
import plant
import proof
import remains
from cluster import Cluster
from shell import say, wait_until
from watch import FenceWatch, overdue_at, recovery_s

# Between two faults, so that each meets a plant that works.
QUIET_S = (1.0, 4.0)
# How long a recovery is waited for before it counts as none.
GIVE_UP_S = 120


class Parser(argparse.ArgumentParser):
    """Of the words after tests/faults/run, which has the help."""

    def error(self, message):
        hint = "" if "HINT:" in message else "\nHINT: see tests/faults/run --help"
        self.exit(2, f"error: {message}{hint}\n")


def read_arguments():
    parser = Parser(add_help=False)
    parser.add_argument("--seed", type=int, default=1, help="of the faults and their victims")
    parser.add_argument("--faults", type=int, default=100)
    parser.add_argument("--loops", type=int, default=1000)
    parser.add_argument("--kinds", default="", help="only these, separated by commas")
    parser.add_argument("--json", action="store_true")
    parser.add_argument("--keep-logs", type=Path, help="folder for the logs of workers and servers")
    parser.add_argument("program", type=Path, nargs="?",
                        help="loopscope; without it the words are looked at and nothing is done")
    arguments = parser.parse_args()
    arguments.kinds = [kind for kind in arguments.kinds.split(",") if kind]
    unknown = set(arguments.kinds) - set(injections.KINDS)
    if unknown or arguments.faults < 0 or not 1 <= arguments.loops <= 100000:
        parser.error(f"no such kinds: {', '.join(sorted(unknown))}\nHINT: there are "
                     f"{', '.join(injections.KINDS)}" if unknown else
                     "--faults or --loops out of range\nHINT: at least 0 faults, 1 to 100000 loops")
    return arguments


def inject(cluster, kinds, rng):
    """One fault after the other; [(kind, victim, recovery)]. Recovered is the plant, all of it; and
    every worker has to sign in again."""
    events = []
    for number, kind in enumerate(kinds, 1):
        time.sleep(rng.uniform(*QUIET_S))
        victim, afterwards = injections.KINDS[kind](cluster, rng)
        seconds = recovery_s(cluster, GIVE_UP_S)
        events.append((kind, victim, seconds))
        say(f"{number}/{len(kinds)} {kind}, {victim}: "
            + ("no recovery" if seconds is None else f"recovered in {seconds:.1f} s"))
        if afterwards:
            afterwards()
        cluster.revive()
        since_s = time.time()
        wait_until(lambda: cluster.all_work(since_s), GIVE_UP_S, "every worker signs in", 0.5)
    return events


def settle(cluster):
    """Until every loop has been visited once more, so that late rows have been looked for."""
    wait_until(lambda: cluster.sql(overdue_at(time.time())) == "0", GIVE_UP_S, "work is done")
    last = cluster.sql("SELECT extract(epoch FROM now())")
    say("waiting for one more slot of every loop")
    wait_until(lambda: cluster.sql("SELECT count(*) FROM loopscope.schedule"
                                   f" WHERE last_slot_end < to_timestamp({last})") == "0",
               4 * plant.periods_s(cluster.loops)[-1] + GIVE_UP_S, "one more slot", 1.0)


def slots_since(cluster, begun):
    """What was completed, from the first slots that were there when the faults began."""
    return {name: (begun[name][0], last, period) if name in begun else (first, last, period)
            for name, (first, last, period) in proof.slots(cluster.primary).items()}


def judge(cluster, events, fences, begun, exit_codes):
    found = slots_since(cluster, begun)
    rows = proof.stored(cluster.primary)
    say(f"{len(rows)} rows; the same slots undisturbed")
    reference = cluster.reference(found)
    wanted = proof.expected(found)
    ours, theirs = (
        {key: value for key, value in proof.findings(cluster.primary, database).items()
         if key[1:] in wanted} for database in (plant.RESULTS, reference))
    different = [key for key in ours.keys() | theirs.keys() if ours.get(key) != theirs.get(key)]
    for key in sorted(different)[:10]:
        say(f"differs: {key}")
    recoveries = [seconds for _, _, seconds in events]
    known = [seconds for seconds in recoveries if seconds is not None]
    kinds = {kind: [s for k, _, s in events if k == kind] for kind, _, _ in events}
    return {
        "faults": {kind: len(seconds) for kind, seconds in kinds.items()},
        "loops": cluster.loops, "workers": len(cluster.workers), "slots": len(wanted),
        "lost": len(wanted - set(rows)) + cluster.loops - len(found),
        "duplicated": len(rows) - len(set(rows)) + proof.duplicated(cluster.primary),
        "surplus": len(set(rows) - wanted), "too_early": proof.too_early(cluster.primary, cluster.wrong_times),
        "identical": not different, "different": len(different),
        "digest": proof.digest_of_all(ours),
        "revised": int(cluster.sql("SELECT count(*) FROM loopscope.analysis"
                                   " WHERE input_revision > 1")),
        "fence_regressions": fences.regressions, "fence_looks": fences.looks,
        "late_lists": cluster.late_lists, "abandoned": cluster.abandoned, "conflicts": cluster.conflicts,
        "deaths": cluster.deaths, "exit_codes": exit_codes,
        "leases_left": int(cluster.sql("SELECT count(*) FROM loopscope.schedule"
                                       " WHERE owner IS NOT NULL")),
        "not_recovered": len(recoveries) - len(known),
        "max_recovery_s": round(max(known, default=0.0), 2),
        "median_recovery_s": round(statistics.median(known), 2) if known else 0.0,
        "recovery_s": {kind: {"median": round(statistics.median(s or [0.0]), 2),
                              "max": round(max(s, default=0.0), 2)}
                       for kind, all_s in kinds.items()
                       for s in [[x for x in all_s if x is not None]]},
        "lease_s": plant.LEASE_S, "poll_s": plant.POLL_S}


def passed(result):
    nothing = ("lost", "duplicated", "surplus", "too_early", "fence_regressions", "leases_left",
               "deaths", "not_recovered", "late_lists")
    took_over = result["abandoned"] > 0 or not {"kill_worker", "stop_worker"} & set(result["faults"])
    return (all(result[key] == 0 for key in nothing) and result["identical"] and took_over
            and result["fence_looks"] > 0 and set(result["exit_codes"]) == {0}
            and result["max_recovery_s"] <= result["lease_s"] + result["poll_s"])


def print_table(result):
    print("| fault | times | recovery, median s | longest s |\n|---|---|---|---|")
    for kind, times in sorted(result["faults"].items()):
        seconds = result["recovery_s"][kind]
        print(f"| {kind} | {times} | {seconds['median']:.1f} | {seconds['max']:.1f} |")
    for key in ("loops", "workers", "slots", "lost", "duplicated", "surplus", "too_early",
                "identical", "revised", "fence_regressions", "late_lists", "abandoned", "conflicts", "deaths",
                "exit_codes", "leases_left", "not_recovered", "max_recovery_s", "lease_s", "poll_s"):
        print(f"{key}: {result[key]}")


def keep_logs(cluster, folder):
    folder.mkdir(parents=True, exist_ok=True)
    for log in [*cluster.folder.glob("*.log"), *cluster.folder.glob("*/server.log")]:
        name = log.name if log.parent == cluster.folder else f"{log.parent.name}-server.log"
        (folder / name).write_bytes(log.read_bytes())


def main():
    arguments = read_arguments()
    if arguments.program is None:
        return 0
    for number in (signal.SIGTERM, signal.SIGHUP):
        signal.signal(number, lambda number, _: sys.exit(128 + number))  # everything is removed
    remains.remove()
    rng = random.Random(arguments.seed)
    kinds = injections.plan(arguments.faults, rng, arguments.kinds)
    # A fault and its recovery take 20 s on the average, never more than a minute.
    cluster = Cluster(arguments.program, arguments.loops, 600 + 45 * arguments.faults)
    try:
        cluster.start_workers()
        wait_until(lambda: cluster.sql(overdue_at(time.time())) == "0", 600, "the first slots")
        begun = proof.slots(cluster.primary)
        say("every loop has a row: the faults begin")
        fences = FenceWatch(cluster)
        events = inject(cluster, kinds, rng)
        settle(cluster)
        fences.stop()
        exit_codes = cluster.stop_workers()
        result = {"seed": arguments.seed} | judge(cluster, events, fences, begun, exit_codes)
    finally:
        try:
            if arguments.keep_logs:
                keep_logs(cluster, arguments.keep_logs)
        finally:
            cluster.remove()
    print(json.dumps(result)) if arguments.json else print_table(result)
    return 0 if passed(result) else 1


if __name__ == "__main__":
    sys.exit(main())
