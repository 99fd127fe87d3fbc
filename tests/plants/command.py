"""What the long runs over simulated plants have in common as commands."""

import argparse
import json
import sys


class Fault(Exception):
    """What keeps something from being run, and what to do."""

    def __init__(self, what, hint):
        super().__init__(what)
        self.hint = hint


class Parser(argparse.ArgumentParser):
    """Of the words after `prog`, which has the help."""

    def __init__(self, prog):
        super().__init__(prog=prog, add_help=False)

    def error(self, message):
        self.exit(2, f"error: {message}\nHINT: see {self.prog} --help\n")


def tell_fault(fault, arguments, readme, **result):
    """The fault in words; as JSON also what can be mistaken for a result by nobody. `result`: what
    else the object says then."""
    hint = fault.hint if isinstance(fault, Fault) else f"see {readme}"
    print(f"error: {fault}\nHINT: {hint}", file=sys.stderr)
    if arguments.json:
        print(json.dumps({"seed": arguments.seed, **result, "error": str(fault)}, indent=2))
