"""What runs of the harness that were killed have left behind: their hosts, what still runs there, and
their folders. A run that lives is left alone."""

import os
import shutil
import signal
import subprocess
from pathlib import Path

import network
from shell import run, say

FOLDERS, FOLDER_PREFIX = Path("/var/tmp"), "loopscope-faults."


def _lives(pid):
    return Path(f"/proc/{pid}").exists()


def _dead_owner(name, prefix, end):
    """Whether `name` is prefix, number of a process that has ended, `end`."""
    number = name.removeprefix(prefix).split(end)[0]
    return name.startswith(prefix) and number.isdigit() and not _lives(number)


def _remove_host(name):
    say(f"removing {name}, left by a run that was killed")
    for pid in run(["ip", "netns", "pids", name]).split():
        os.kill(int(pid), signal.SIGKILL)
    subprocess.run(["ip", "netns", "del", name], check=False)


def remove():
    for line in run(["ip", "netns", "list"]).splitlines():
        if line and _dead_owner(line.split()[0], network.PREFIX, "-"):
            _remove_host(line.split()[0])
    for folder in FOLDERS.glob(f"{FOLDER_PREFIX}*"):
        if _dead_owner(folder.name, FOLDER_PREFIX, "."):
            for inner in folder.iterdir():
                if inner.is_mount():
                    subprocess.run(["umount", "--lazy", inner], check=False)
            shutil.rmtree(folder, ignore_errors=True)
