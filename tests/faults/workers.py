"""Workers: the program itself, each on a host of its own, under a clock that can be moved."""

import os
import signal
import subprocess
from pathlib import Path

FAKETIME = next(Path("/usr/lib").glob("*/faketime/libfaketimeMT.so.1"), None)


def faketime(clock):
    """The environment in which the wall clock is what the file `clock` says, looked at once a
    second. A jump of the wall clock leaves the monotonic one alone."""
    return {"LD_PRELOAD": str(FAKETIME), "FAKETIME_DONT_FAKE_MONOTONIC": "1",
            "DONT_FAKE_MONOTONIC": "1", "FAKETIME_TIMESTAMP_FILE": str(clock),
            "FAKETIME_CACHE_DURATION": "1"}


class Worker:
    def __init__(self, network, host, program, settings, folder):
        self.network, self.host, self.program, self.settings = network, host, program, settings
        self.log = Path(folder, f"{host}.log")
        self.clock = Path(folder, f"{host}.clock")
        self.clock.write_text("+0s", encoding="utf-8")
        self.process = None

    def start(self):
        with open(self.log, "ab") as log:
            self.process = subprocess.Popen(
                [*self.network.inside(self.host), "env",
                 *(f"{key}={value}" for key, value in faketime(self.clock).items()),
                 str(self.program), "run", "--config", str(self.settings)],
                stdin=subprocess.DEVNULL, stdout=log, stderr=log)

    def alive(self):
        return self.process is not None and self.process.poll() is None

    def send(self, number):
        if self.alive():
            self.process.send_signal(number)

    def kill(self):
        self.send(signal.SIGKILL)
        self.process.wait()
        # What libfaketime shares between processes outlives one that is killed.
        for left in Path("/dev/shm").glob(f"*faketime_s[he]m_{self.process.pid}"):
            left.unlink(missing_ok=True)

    def name(self):
        """As it signs in loopscope.worker, and, with a worker behind it, in loopscope.schedule."""
        return f"{os.uname().nodename}/{self.process.pid}"

    def set_clock(self, offset_s):
        self.clock.write_text(f"{offset_s:+d}s", encoding="utf-8")

    def stop(self):
        """Gracefully; returns the exit code."""
        if not self.alive():
            return None
        self.send(signal.SIGCONT)
        self.send(signal.SIGTERM)
        try:
            return self.process.wait(timeout=60)
        except subprocess.TimeoutExpired:
            self.kill()
            return None
