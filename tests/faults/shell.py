"""Commands, and the words that the harness says on standard error."""

import shlex
import subprocess
import sys
import time

START = time.monotonic()


def say(text):
    print(f"[{time.monotonic() - START:7.1f} s] {text}", file=sys.stderr, flush=True)


def run(command, **options):
    command = [str(word) for word in command]
    done = subprocess.run(command, text=True, capture_output=True, check=False, **options)
    if done.returncode != 0:
        raise RuntimeError(f"{shlex.join(command)}: exit code {done.returncode}\n"
                           f"{done.stdout}{done.stderr}")
    return done.stdout


def wait_until(condition, timeout_s, what, pause_s=0.1):
    """Seconds that it took; RuntimeError when it never came true."""
    start = time.monotonic()
    while not condition():
        if time.monotonic() - start > timeout_s:
            raise RuntimeError(f"{what}: not within {timeout_s} s")
        time.sleep(pause_s)
    return time.monotonic() - start
