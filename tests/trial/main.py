"""The long run: an independent plant through historian, daemon and list, scored. See README.md."""

import contextlib
import dataclasses
import json
import shutil
import subprocess
import sys
import tempfile
import time
from pathlib import Path

_HERE = Path(__file__).resolve().parent
# Server and command are those of the other simulated plants.
sys.path.append(str(_HERE.parent / "plants"))
try:
    from command import Fault, Parser, tell_fault
    from history import History
    from passes import Passes
    from places import PLACES
    from plant import Trial, repaired_places
    from score import score
    from server import Server
    from simulate import simulate_plant
except ImportError as missing:
    sys.exit(f"error: {missing}\nHINT: apt-get install python3-numpy; tests/trial/run takes"
             " /usr/bin/python3")

_FEWEST_SLOTS = 20  # two windows of the loops of 1 s


def read_arguments():
    parser = Parser("tests/trial/run")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--slots", type=int, default=200)
    parser.add_argument("--repaired", type=int, default=0)
    parser.add_argument("--json", action="store_true")
    parser.add_argument("--keep", type=Path)
    parser.add_argument("--program", type=Path,
                        help="without it the words are looked at and nothing is done")
    arguments = parser.parse_args()
    if arguments.seed < 0 or arguments.slots < _FEWEST_SLOTS:
        parser.error(f"--seed below 0, or --slots below {_FEWEST_SLOTS}")
    most = len(repaired_places(Trial(0, arguments.slots, len(PLACES)), PLACES))
    if not 0 <= arguments.repaired <= most:
        parser.error(f"--repaired out of range, 0 to {most}")
    return arguments


@contextlib.contextmanager
def folder_of(arguments):
    if arguments.keep is None:
        with tempfile.TemporaryDirectory(prefix="loopscope-trial.") as folder:
            yield Path(folder)
    else:
        arguments.keep.mkdir(parents=True, exist_ok=True)
        yield arguments.keep


@contextlib.contextmanager
def told_seconds(what):
    start = time.monotonic()
    yield
    print(f"{what}: {time.monotonic() - start:.0f} s", file=sys.stderr, flush=True)


def simulated(trial, folder):
    """The loops; what was drawn stands in plant.json, for whoever keeps the folder."""
    (folder / "signals").mkdir(exist_ok=True)
    with told_seconds("signals"):
        loops = simulate_plant(trial, folder / "signals")
    drawn = json.dumps([dataclasses.asdict(loop) for loop in loops], indent=1, default=float)
    (folder / "plant.json").write_text(drawn, encoding="utf-8")
    return loops


def run(arguments):
    if not arguments.program.is_file():
        raise Fault(f"no program, {arguments.program}", "build it, or leave TRIAL_RUN out")
    trial = Trial(arguments.seed, arguments.slots, arguments.repaired)
    with folder_of(arguments) as folder, Server() as server:
        loops = simulated(trial, folder)
        history = History(server, loops, folder / "signals", trial.duration_s, time.time())
        # A copy: a build beside the trial must not change what is tried.
        program = shutil.copy2(arguments.program, folder / "loopscope")
        passes = Passes(program, server, folder)
        passes.prepare(loops)
        with told_seconds("passes"):
            lists = passes.run(trial, history)
        return score(trial, loops, lists, passes.verdicts(history))


def words_of(value):
    if isinstance(value, dict):
        return "  ".join(f"{name} {words_of(part)}" for name, part in value.items())
    return "-" if value is None else str(value)


def rows_of(value):
    """Of what has several; else none."""
    if isinstance(value, list):
        return [words_of(part) for part in value]
    if isinstance(value, dict) and all(isinstance(part, dict) for part in value.values()):
        return [f"{name:10} {words_of(part)}" for name, part in value.items()]
    return None


def print_result(result, arguments):
    if arguments.json:
        print(json.dumps(result, indent=2))
        return
    for key, value in result.items():
        rows = rows_of(value)
        shown = f" {words_of(value)}" if rows is None else "".join(f"\n    {row}" for row in rows)
        print(f"{key}{shown}")


def main():
    arguments = read_arguments()
    if arguments.program is None:
        return 0
    try:
        result = run(arguments)
    except (Fault, subprocess.CalledProcessError, RuntimeError, OSError, ValueError) as fault:
        tell_fault(fault, arguments, "tests/trial/README.md")
        return 1
    print_result(result, arguments)
    return 0


if __name__ == "__main__":
    sys.exit(main())
