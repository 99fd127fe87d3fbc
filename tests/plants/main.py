"""Plants, sources and repairs: what the program makes of simulated ones. See README.md."""

import json
import subprocess
import sys
from pathlib import Path

from command import Fault, Parser, tell_fault
from judged_plant import judge_plant
from server import Server


def read_arguments():
    parser = Parser("tests/plants/run")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--plants", type=int, default=40)
    parser.add_argument("--repairs", type=int, default=80)
    parser.add_argument("--windows", type=int)
    parser.add_argument("--only", choices=("plant", "sources", "repairs", "list"))
    parser.add_argument("--json", action="store_true")
    parser.add_argument("--keep", type=Path)
    parser.add_argument("--build", type=Path,
                        help="without it the words are looked at and nothing is done")
    arguments = parser.parse_args()
    if min(arguments.seed, arguments.plants - 1, arguments.repairs - 1) < 0:
        parser.error("--seed, --plants or --repairs out of range")
    if arguments.windows is not None and arguments.windows < 4:
        parser.error("--windows out of range: the faults begin after three")
    if arguments.only == "list" and arguments.windows is None:
        parser.error("--only list wants --windows N")
    if arguments.only is None and arguments.windows is not None:
        arguments.only = "list"
    return arguments


class Part:
    """What --only may name: its program under tests/plants, and the keys of its own JSON."""

    def __init__(self, name, program, keys=()):
        self.name, self.program, self.keys = name, program, keys


PARTS = (Part("plant", "plant_faults"),
         Part("sources", "plant_sources", ("source_first", "plants")),
         Part("repairs", "plant_repairs", ("repairs", "repair_words_right")),
         # An hour on two cores: only where it is asked for.
         Part("list", "plant_list", ("standing_faults", "listed_faults", "sure_faults",
                                     "sure_listed", "entries_per_fault", "false_entries",
                                     "false_entries_with_saturated",
                                     "delay_windows", "delay_windows_p90",
                                     "listed_as_another", "wrong", "saturated", "missed",
                                     "right")))


def parts_of(arguments):
    return [part for part in PARTS
            if part.name == arguments.only or arguments.only is None and part.name != "list"]


def require_programs(arguments):
    """Before anything is run: a part that was asked for is never left out."""
    folder = arguments.build / "tests" / "plants"
    missing = [part.program for part in parts_of(arguments)
               if not (folder / part.program).is_file()]
    if missing:
        raise Fault(f"not built, {folder}: {', '.join(missing)}",
                    "cmake --build FOLDER --target plants_programs, or leave PLANTS_BUILD out")


def figures_of(part, words, arguments):
    """The figures of a part's own program, all that it has to tell."""
    command = [arguments.build / "tests" / "plants" / part.program,
               "--seed", str(arguments.seed), *words, "--json"]
    done = subprocess.run(command, text=True, stdout=subprocess.PIPE, check=False)
    if done.returncode != 0:
        raise Fault(f"{part.program}: exit code {done.returncode}", "its words stand above")
    figures = json.loads(done.stdout)
    missing = [key for key in part.keys if key not in figures]
    if missing:
        raise Fault(f"{part.program} does not tell {', '.join(missing)}",
                    "program and tests/plants/main.py are of different versions: build it anew")
    return {key: figures[key] for key in part.keys}


def run_part(part, arguments, server):
    if part.name == "plant":
        return judge_plant(arguments, server)
    if part.name == "list":
        return figures_of(part, ["--windows", str(arguments.windows)], arguments)
    if part.name == "sources":
        return figures_of(part, ["--plants", str(arguments.plants)], arguments)
    server.sql(f"CREATE DATABASE {part.name}")
    server.make_owner(part.name)
    return figures_of(part, ["--repairs", str(arguments.repairs),
                             "--database", server.conninfo(part.name, "test_owner")], arguments)


def run(arguments):
    require_programs(arguments)
    result = {"seed": arguments.seed}
    with Server() as server:
        for part in parts_of(arguments):
            result |= run_part(part, arguments, server)
    return result


def text_of(value):
    if isinstance(value, list):
        return "\n" + "".join(f"    {line}\n" for line in value)
    return str(value)


def main():
    arguments = read_arguments()
    if arguments.build is None:
        return 0
    try:
        result = run(arguments)
    except (Fault, subprocess.CalledProcessError, RuntimeError, OSError, ValueError) as fault:
        tell_fault(fault, arguments, "tests/plants/README.md", holds=False)
        return 1
    if arguments.json:
        print(json.dumps(result, indent=2))
    else:
        for key, value in result.items():
            print(f"{key:20} {text_of(value)}".rstrip())
    return 0


if __name__ == "__main__":
    sys.exit(main())
