"""Everything that tests/bench/run measures, as a table or as one JSON object (contract.md)."""

import argparse
import json
import os
import re
import statistics
import subprocess
import sys
import tempfile
from pathlib import Path

import plant
from builds import OURS, Build, Turns, compared_rows, say
from passes import measure_passes, pass_rows
from steady import measure_steady, steady_rows

PARTS = ("kernel", "analysis", "model", "read", "pass", "steady")
# Best first: what the program itself would choose.
PATHS = ("avx512", "avx2", "portable")


def google_benchmark(build, program, pattern):
    """The results by name, of a program that knows them."""
    out = plant.run([build.tests / program, f"--benchmark_filter={pattern}",
                     "--benchmark_format=json"], stdin=subprocess.DEVNULL)
    # "calibrated/avx2/iterations:1620" is calibrated/avx2.
    return {"/".join(entry["run_name"].split("/")[:2]): entry
            for entry in json.loads(out)["benchmarks"]}


def benchmark_rounds(turns, program, pattern, rounds, after=lambda: None):
    """The results of ours by name, one of each round; `after` is called with every round."""
    entries = {}
    for number in range(rounds):
        for build in turns.of_round(number):
            for name, entry in google_benchmark(build, program, pattern).items():
                turns.note(name, build, _time(entry))
                if build is turns.ours:
                    entries.setdefault(name, []).append(entry)
        after()
    return entries


def _time(entry):
    """Of the model, "real time" is the CPU time of explain alone, taken by hand: making the loops
    is not counted."""
    return entry["real_time" if entry["name"].startswith("model/") else "cpu_time"]


def _medians(entries):
    return {name: statistics.median(map(_time, of_rounds)) for name, of_rounds in entries.items()}


def _write_signal(folder):
    """The window that NumPy gets: white noise, like ours."""
    import numpy
    samples = numpy.random.default_rng(1).standard_normal(plant.WINDOW)
    file = Path(folder, "signal.txt")
    file.write_text("\n".join(repr(float(sample)) for sample in samples) + "\n")
    return file


def _numpy_us(noise):
    done = plant.run(["/usr/bin/python3", plant.SOURCE_DIR / "tests/bench/kernel_numpy.py", noise],
                     env={**os.environ, "OPENBLAS_NUM_THREADS": "1", "OMP_NUM_THREADS": "1"})
    return json.loads(done)["kernel_numpy_us"]


def measure_kernel(turns, rounds):
    """Ours, NumPy and the floor in turn, so that all see the same machine."""
    numpy_us = []
    with tempfile.TemporaryDirectory() as folder:
        noise = _write_signal(folder)
        pattern = "^(kernel|floor|calibrated|plant_noise)/"
        median = _medians(benchmark_rounds(turns, "hos_benchmark", pattern, rounds,
                                           lambda: numpy_us.append(_numpy_us(noise))))
    numpy_us = statistics.median(numpy_us)
    paths = {}
    for path in PATHS:
        if f"kernel/{path}" not in median:
            say(f"{path}: not measured, this processor does not have it")
            continue
        kernel, floor = median[f"kernel/{path}"], median[f"floor/{path}"]
        calibrated = median.get(f"calibrated/{path}")
        paths[path] = {"kernel_us": kernel, "kernel_numpy_us": numpy_us,
                       "ratio_numpy": numpy_us / kernel, "floor_us": floor,
                       "ratio_floor": kernel / floor, "calibrated_us": calibrated,
                       "ratio_calibrated": calibrated / kernel,
                       "plant_noise_us": median.get(f"plant_noise/{path}")}
    best = next(iter(paths))
    return {**paths[best], "instruction_set": best, "paths": paths}


def measure_analysis(turns, rounds):
    found = _medians(benchmark_rounds(turns, "analysis_benchmark", "^analysis/", rounds))
    return {f"{name.split('/')[1]}_us": value for name, value in found.items()}


def measure_model(turns, rounds):
    entries = benchmark_rounds(turns, "model_benchmark", "^model/", rounds)
    medians, whole = _medians(entries), entries["model/all"]
    kinds = {f"model_{name.split('/')[1]}_ms": value for name, value in medians.items()
             if name != "model/all"}
    return {"model_ms": statistics.median(entry["median_ms"] for entry in whole),
            "model_mean_ms": medians["model/all"],
            "model_p90_ms": statistics.median(entry["p90_ms"] for entry in whole), **kinds}


def measure_reading(turns, rounds):
    """Values a second on one connection, beside COPY BINARY of the same rows."""
    server = plant.SOURCE_DIR / "tests/support/postgres"
    environments = {build: build.folder / "postgres.env" for build in turns.builds}
    ours = []
    for environment in environments.values():
        plant.run([server, "start", environment])
    try:
        for number in range(rounds):
            for build in turns.of_round(number):
                found = json.loads(plant.run([build.tests / "read_benchmark", "300", "5"]))
                turns.note("reading, time a value", build, 1.0 / found["read_values_per_s"])
                if build is turns.ours:
                    ours.append(found)
    finally:
        for environment in environments.values():
            plant.run([server, "stop", environment])
    return {key: statistics.median(found[key] for found in ours)
            for key in ("read_values_per_s", "read_ratio_copy")}


def table(found):
    rows = []
    for path, kernel in found.get("paths", {}).items():
        rows += [(f"kernel, {path}", f"{kernel['kernel_us']:.1f} us",
                  f"NumPy / ours {kernel['ratio_numpy']:.1f}, ours / floor "
                  f"{kernel['ratio_floor']:.2f} ({kernel['floor_us']:.1f} us)"),
                 (f"calibrated tests, {path}", f"{kernel['calibrated_us']:.0f} us",
                  f"{kernel['ratio_calibrated']:.1f} kernels")]
    for name in ("prepare", "statistics", "digest"):
        if f"{name}_us" in found:
            rows.append((f"{name} of a healthy loop", f"{found[f'{name}_us']:.0f} us", ""))
    if "model_ms" in found:
        rows.append(("loop model, all scenarios", f"{found['model_ms']:.1f} ms",
                     f"median; mean {found['model_mean_ms']:.1f}, 90 % {found['model_p90_ms']:.1f}"))
        rows += [(name[:-3].replace("_", ", ", 1), f"{found[name]:.1f} ms", "mean")
                 for name in found if re.fullmatch(r"model_(?!mean|p90)\w+_ms", name)]
    if "read_values_per_s" in found:
        rows.append(("reading", f"{found['read_values_per_s'] / 1e6:.2f} million values/s",
                     f"COPY / ours {found['read_ratio_copy']:.2f}"))
    rows += pass_rows(found) + steady_rows(found) + compared_rows(found)
    return "\n".join(f"{name:42} {value:>24}  {note}".rstrip() for name, value, note in rows)


def parsed():
    parser = argparse.ArgumentParser(prog="tests/bench/run", description=__doc__)
    parser.add_argument("--json", action="store_true", help="one JSON object")
    parser.add_argument("--loops", type=int, default=2000, help="of the passes (2000)")
    parser.add_argument("--steady-loops", type=int, default=500, help="of the steady state (500)")
    parser.add_argument("--rounds", type=int,
                        help="of every measurement (3; 8 with --against; models 1 without)")
    parser.add_argument("--only", action="append", choices=PARTS, help="leave the other parts out")
    parser.add_argument("--against", metavar="BUILD",
                        help="folder of another build, measured by turns: ratios ours / other")
    return parser.parse_args()


def main():
    options = parsed()
    builds = [Build(OURS)] + ([Build(options.against)] if options.against else [])
    turns = Turns(builds)
    rounds = options.rounds or (8 if options.against else 3)
    measures = {"kernel": lambda: measure_kernel(turns, rounds),
                "analysis": lambda: measure_analysis(turns, rounds),
                "model": lambda: measure_model(turns, rounds if options.against else 1),
                "read": lambda: measure_reading(turns, rounds if options.against else 1),
                "pass": lambda: measure_passes(turns, options.loops, rounds),
                "steady": lambda: measure_steady(turns, options.steady_loops)}
    found = {}
    for part in options.only or PARTS:
        say(f"{part} ...")
        found |= measures[part]()
    found |= turns.compared()
    print(json.dumps(found) if options.json else table(found))
    if turns.differences:
        say("error: the builds did not do the same work, their ratios of CPU time mean little: "
            f"{'; '.join(turns.differences)}")
        sys.exit(1)


if __name__ == "__main__":
    main()
