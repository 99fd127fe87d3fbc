"""A plant in a real historian, judged by the program, and the score of its flags. See README.md."""

import argparse
import json
import os
import subprocess
import sys
from pathlib import Path

from judged_plant import judge_plant
from server import Server


class Parser(argparse.ArgumentParser):
    """Of the words after tests/plants/run, which has the help."""

    def error(self, message):
        self.exit(2, f"error: {message}\nHINT: see tests/plants/run --help\n")


def read_arguments():
    parser = Parser(add_help=False)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--plants", type=int, default=40)
    parser.add_argument("--repairs", type=int, default=80)
    parser.add_argument("--only", choices=("plant", "sources", "repairs"))
    parser.add_argument("--json", action="store_true")
    parser.add_argument("--keep", type=Path)
    parser.add_argument("--build", type=Path,
                        help="without it the words are looked at and nothing is done")
    arguments = parser.parse_args()
    if min(arguments.seed, arguments.plants - 1, arguments.repairs - 1) < 0:
        parser.error("--seed, --plants or --repairs out of range")
    return arguments


def figures_of(program, words, keys, server):
    """The named figures of another program's JSON; those it does not have are None."""
    if not program.exists():
        print(f"{program.name}: not built, left out", file=sys.stderr)
        return dict.fromkeys(keys)
    done = subprocess.run([program, *words, "--json"], text=True, stdout=subprocess.PIPE,
                          check=True, env={**os.environ, "LOOPSCOPE_TEST_DATABASE": server.conninfo()})
    figures = json.loads(done.stdout)
    return {key: figures.get(key) for key in keys}


def run(arguments):
    wants = lambda part: arguments.only in (None, part)
    programs = arguments.build / "tests" / "plants"
    seed = ["--seed", str(arguments.seed)]
    result = {"seed": arguments.seed}
    with Server() as server:
        if wants("plant"):
            result |= judge_plant(arguments, server)
        if wants("sources"):
            result |= figures_of(programs / "plant_sources",
                                 [*seed, "--plants", str(arguments.plants)],
                                 ("source_first", "plants"), server)
        if wants("repairs"):
            result |= figures_of(programs / "plant_repairs",
                                 [*seed, "--repairs", str(arguments.repairs)],
                                 ("repairs", "repair_words_right"), server)
    return result


def text_of(value):
    return "\n" + "".join(f"    {line}\n" for line in value) if isinstance(value, list) else str(value)


def main():
    arguments = read_arguments()
    if arguments.build is None:
        return 0
    try:
        result = run(arguments)
    except (subprocess.CalledProcessError, RuntimeError, OSError) as fault:
        print(f"error: {fault}", file=sys.stderr)
        return 1
    if arguments.json:
        print(json.dumps(result, indent=2))
    else:
        for key, value in result.items():
            print(f"{key:20} {text_of(value)}".rstrip())
    return 0


if __name__ == "__main__":
    sys.exit(main())
