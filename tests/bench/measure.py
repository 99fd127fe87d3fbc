"""Everything that tests/bench/run measures, as a table or as one JSON object (contract.md)."""

import argparse
import json
import os
import re
import signal
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import plant

SOURCE_DIR = plant.SOURCE_DIR
TESTS = SOURCE_DIR / "build/release/tests"
PROGRAM = SOURCE_DIR / "build/release/loopscope"
PARTS = ("kernel", "analysis", "model", "read", "pass")
# Best first: what the program itself would choose.
PATHS = ("avx512", "avx2", "portable")


def say(text):
    print(text, file=sys.stderr, flush=True)


def google_benchmark(program, pattern, repetitions=1):
    """Results by name: every repetition's CPU time in its own unit, and its counters."""
    out = plant.run([TESTS / program, f"--benchmark_filter={pattern}", "--benchmark_format=json",
                     f"--benchmark_repetitions={repetitions}"], stdin=subprocess.DEVNULL)
    results = {}
    for entry in json.loads(out)["benchmarks"]:
        if entry.get("run_type", "iteration") == "iteration":
            # "calibrated/avx2/iterations:1620" is calibrated/avx2.
            name = "/".join(entry["run_name"].split("/")[:2])
            results.setdefault(name, []).append(entry)
    return results


def _cpu_times(entries):
    return [entry["cpu_time"] for entry in entries]


def _write_signal(folder):
    """The window that NumPy gets: white noise, like ours."""
    import numpy
    samples = numpy.random.default_rng(1).standard_normal(plant.WINDOW)
    file = Path(folder, "signal.txt")
    file.write_text("\n".join(repr(float(sample)) for sample in samples) + "\n")
    return file


def measure_kernel(rounds):
    """Ours, NumPy and the floor in turn, so that all see the same machine."""
    times = {}
    numpy_us = []
    with tempfile.TemporaryDirectory() as folder:
        noise = _write_signal(folder)
        for _ in range(rounds):
            found = google_benchmark("hos_benchmark", "^(kernel|floor|calibrated|plant_noise)/")
            for name, entries in found.items():
                times.setdefault(name, []).extend(_cpu_times(entries))
            done = plant.run(["/usr/bin/python3", SOURCE_DIR / "tests/bench/kernel_numpy.py", noise],
                             env={**os.environ, "OPENBLAS_NUM_THREADS": "1", "OMP_NUM_THREADS": "1"})
            numpy_us.append(json.loads(done)["kernel_numpy_us"])
    numpy_us = statistics.median(numpy_us)
    median = {name: statistics.median(values) for name, values in times.items()}
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


def measure_analysis(rounds):
    found = google_benchmark("analysis_benchmark", "^analysis/", rounds)
    return {f"{name.split('/')[1]}_us": statistics.median(_cpu_times(entries))
            for name, entries in found.items()}


def measure_model():
    found = google_benchmark("model_benchmark", "^model/")
    # Its "real time" is the CPU time of explain alone, taken by hand: making the loops is not counted.
    whole = found["model/all"][0]
    kinds = {f"model_{name.split('/')[1]}_ms": entries[0]["real_time"]
             for name, entries in found.items() if name != "model/all"}
    return {"model_ms": whole["median_ms"], "model_mean_ms": whole["real_time"],
            "model_p90_ms": whole["p90_ms"], **kinds}


def measure_reading():
    """Values a second on one connection, beside COPY BINARY of the same rows."""
    server = SOURCE_DIR / "tests/support/postgres"
    environment = SOURCE_DIR / "build/release/postgres.env"
    plant.run([server, "start", environment])
    try:
        found = json.loads(plant.run([TESTS / "read_benchmark", "300", "5"]))
    finally:
        plant.run([server, "stop", environment])
    return {key: found[key] for key in ("read_values_per_s", "read_ratio_copy")}


class RunningProgram:
    """The program at work, and what it took: seconds, CPU seconds, peak memory in MB."""

    def __init__(self, *arguments):
        self.start = time.monotonic()
        self.peak_mb = 0.0
        with open(os.devnull, "w", encoding="ascii") as nowhere:
            self.process = subprocess.Popen([PROGRAM, *map(str, arguments)], stdout=nowhere,
                                            stderr=nowhere)

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


def run_program(*arguments):
    return RunningProgram(*arguments).wait()


def stage_breakdown(results):
    """Milliseconds a loop by stage, summed over the workers."""
    columns = ("claim", "fetch", "prepare", "statistics", "model", "decide", "write", "wait")
    sums = ", ".join(f"1000 * sum({column}_s) / sum(loops)" for column in columns)
    row = results.sql(f"SELECT {sums}, sum(modelled) FROM loopscope.stage_cost")[0]
    return {**{f"{column}_ms": float(value) for column, value in zip(columns, row)},
            "modelled": int(float(row[-1]))}


def measure_once(shop, historian, results_server, loops, rounds):
    """Passes over an empty results database each, after one that warms the caches."""
    runs = []
    for round_number in range(rounds + 1):
        results = plant.Results(results_server, PROGRAM, historian, shop.folder, loops, loops, {})
        before = (historian.cpu_s(), results_server.cpu_s())
        done = run_program("once", "--config", results.settings)
        done["historian_cpu_s"] = historian.cpu_s() - before[0]
        done["results_cpu_s"] = results_server.cpu_s() - before[1]
        done["stages"] = stage_breakdown(results)
        analysed = int(results.sql("SELECT count(*) FROM loopscope.analysis WHERE usable")[0][0])
        if analysed != loops:
            raise RuntimeError(f"{analysed} of {loops} loops were judged")
        results.drop()
        if round_number > 0:
            runs.append(done)
    runs.sort(key=lambda run: run["elapsed_s"])
    return runs[len(runs) // 2] | {"rss_mb": max(run["rss_mb"] for run in runs)}


def measure_passes(loops, rounds):
    with plant.Workshop() as shop:
        historian, results_server = shop.server(), shop.server()
        say(f"a historian of {3 * loops * plant.WINDOW / 1e6:.1f} million rows ...")
        plant.load_recordings(historian, PROGRAM, plant.WINDOW)
        plant.make_history(historian)
        plant.add_history(historian, loops, 0, plant.WINDOW - 1, "date_trunc('day', now())")
        found = {"loops": loops}
        peak = 0.0
        for kind in ("covering", "plain"):
            plant.index_history(historian, kind == "covering")
            run = measure_once(shop, historian, results_server, loops, rounds)
            found[f"pass_loops_per_s_{kind}"] = loops / run["elapsed_s"]
            found[f"pass_{kind}"] = run
            peak = max(peak, run["rss_mb"])
        found["peak_rss_mb"] = peak
        return found


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
    for kind in ("covering", "plain"):
        if f"pass_{kind}" in found:
            run = found[f"pass_{kind}"]
            stages = ", ".join(f"{name[:-3]} {value:.2f}" for name, value in run["stages"].items()
                               if name.endswith("_ms"))
            rows += [(f"pass, {kind} index", f"{found[f'pass_loops_per_s_{kind}']:.0f} loops/s",
                      f"{run['stages']['modelled']} of {found['loops']} with a model"),
                     ("  CPU s: program, historian, results",
                      f"{run['cpu_s']:.1f}, {run['historian_cpu_s']:.1f}, {run['results_cpu_s']:.1f}",
                      f"peak {run['rss_mb']:.0f} MB"), ("  ms a loop", "", stages)]
    return "\n".join(f"{name:42} {value:>24}  {note}" for name, value, note in rows)


def main():
    parser = argparse.ArgumentParser(prog="tests/bench/run", description=__doc__)
    parser.add_argument("--json", action="store_true", help="one JSON object")
    parser.add_argument("--loops", type=int, default=2000, help="of the passes (2000)")
    parser.add_argument("--rounds", type=int, default=3, help="of every measurement (3)")
    parser.add_argument("--only", action="append", choices=PARTS, help="leave the other parts out")
    options = parser.parse_args()
    parts = options.only or PARTS
    found = {}
    for part, measure in (("kernel", lambda: measure_kernel(options.rounds)),
                          ("analysis", lambda: measure_analysis(options.rounds)),
                          ("model", measure_model), ("read", measure_reading),
                          ("pass", lambda: measure_passes(options.loops, options.rounds))):
        if part in parts:
            say(f"{part} ...")
            found |= measure()
    print(json.dumps(found) if options.json else table(found))


if __name__ == "__main__":
    main()
