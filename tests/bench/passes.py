"""Whole passes (`once`) over a plant that no build has analysed before."""

import os

import plant
from builds import run_program, say, stage_breakdown


def core_times():
    """(idle, all) ticks of our cores since the machine started, whoever used them: what the kernel
    does for a pass stands in the books of no process."""
    ours = {f"cpu{core}" for core in os.sched_getaffinity(0)}
    with open("/proc/stat", encoding="ascii") as file:
        lines = [line.split() for line in file]
    cores = [[int(word) for word in line[1:9]] for line in lines if line[0] in ours]
    return sum(core[3] + core[4] for core in cores), sum(map(sum, cores))


def busy_share(before, after):
    return 1.0 - (after[0] - before[0]) / (after[1] - before[1])


def cpu_parts(done):
    return {"program": done["cpu_s"], "historian": done["historian_cpu_s"],
            "results": done["results_cpu_s"]}


def note_parts(turns, build, prefix, done):
    parts = cpu_parts(done)
    turns.note(f"{prefix} CPU, all", build, sum(parts.values()))
    for name, value in parts.items():
        turns.note(f"{prefix} CPU, {name}", build, value)


def one_pass(build, shop, historian, server, loops):
    results = plant.Results(server, build, historian, shop.folder, loops, loops, {})
    before, cores = (historian.cpu_s(), server.cpu_s()), core_times()
    done = run_program(build.program, "once", "--config", results.settings)
    done["busy_share"] = busy_share(cores, core_times())
    done["historian_cpu_s"] = historian.cpu_s() - before[0]
    done["results_cpu_s"] = server.cpu_s() - before[1]
    done["stages"] = stage_breakdown(results)
    analysed = int(results.sql("SELECT count(*) FROM loopscope.analysis WHERE usable")[0][0])
    if analysed != loops:
        raise RuntimeError(f"{analysed} of {loops} loops were judged")
    modelled = results.sql("SELECT loop_id FROM loopscope.analysis WHERE model_ms IS NOT NULL")
    done["modelled_loops"] = frozenset(int(row[0]) for row in modelled)
    results.drop()
    return done


def same_loops(turns, where, modelled):
    """The sets of loops with a model, one of each build: other work done cannot be compared."""
    common = frozenset.intersection(*modelled)
    if any(loops != common for loops in modelled):
        counts = " and ".join(str(len(loops)) for loops in modelled)
        turns.differences.append(f"{where}: {counts} loops with a model, {len(common)} of them in both")


def measure_once(turns, kind, shop, historian, servers, loops, rounds):
    """Passes over an empty results database each, after one that warms the caches."""
    runs, last = [], {}
    for round_number in range(rounds + 1):
        for build in turns.of_round(round_number):
            done = one_pass(build, shop, historian, servers[build], loops)
            last[build] = done.pop("modelled_loops")
            if round_number == 0:
                continue
            note_parts(turns, build, f"pass, {kind}", done)
            turns.note(f"pass, {kind} seconds", build, done["elapsed_s"])
            if build is turns.ours:
                runs.append(done)
    same_loops(turns, f"pass, {kind}", [last[build] for build in turns.builds])
    runs.sort(key=lambda run: run["elapsed_s"])
    return runs[len(runs) // 2] | {"rss_mb": max(run["rss_mb"] for run in runs)}


def measure_passes(turns, loops, rounds, kinds=("covering", "plain")):
    with plant.Workshop() as shop:
        historian = shop.server()
        servers = {build: shop.server() for build in turns.builds}
        say(f"a historian of {3 * loops * plant.WINDOW / 1e6:.1f} million rows ...")
        plant.load_recordings(historian, turns.ours.program, plant.WINDOW)
        plant.make_history(historian)
        plant.add_history(historian, loops, 0, plant.WINDOW - 1, "date_trunc('day', now())")
        found = {"loops": loops}
        for kind in kinds:
            say(f"passes, {kind} index ...")
            plant.index_history(historian, kind == "covering")
            run = measure_once(turns, kind, shop, historian, servers, loops, rounds)
            found[f"pass_loops_per_s_{kind}"] = loops / run["elapsed_s"]
            found[f"pass_{kind}"] = run
        found["peak_rss_mb"] = max(found[f"pass_{kind}"]["rss_mb"] for kind in kinds)
        return found


def pass_rows(found):
    rows = []
    for kind in ("covering", "plain"):
        if f"pass_{kind}" not in found:
            continue
        run = found[f"pass_{kind}"]
        stages = ", ".join(f"{name[:-3]} {value:.2f}" for name, value in run["stages"].items()
                           if name.endswith("_ms"))
        rows += [(f"pass, {kind} index", f"{found[f'pass_loops_per_s_{kind}']:.0f} loops/s",
                  f"{run['stages']['modelled']} of {found['loops']} with a model"),
                 ("  CPU s: program, historian, results",
                  f"{run['cpu_s']:.1f}, {run['historian_cpu_s']:.1f}, {run['results_cpu_s']:.1f}",
                  f"cores busy {run['busy_share']:.0%}, peak {run['rss_mb']:.0f} MB"),
                 ("  ms a loop", "", stages)]
    return rows
