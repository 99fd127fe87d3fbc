"""What is watched while the faults happen: recovery, and fences that must never go back."""

import threading
import time

import plant
from shell import say

LOOK_EVERY_S = 0.25


def overdue_at(end_s):
    """Loops whose newest slot that had settled at that time is not done."""
    return f"""
        SELECT count(*) FROM loopscope.schedule JOIN loopscope.loop USING (loop_id)
        WHERE loop.enabled AND coalesce(extract(epoch FROM last_slot_end), 0)
              < floor(({end_s} - {plant.SETTLE_S}) / period_s) * period_s"""


def recovery_s(cluster, limit_s):
    """Seconds from now, the end of a fault, until everything that was due is done; None = not within
    `limit_s`. The database's clock and the harness's are the same."""
    end_s = time.time()
    while time.time() - end_s < limit_s:
        if cluster.primary.sql(overdue_at(end_s), plant.RESULTS) == "0":
            return time.time() - end_s
        time.sleep(LOOK_EVERY_S)
    return None


class FenceWatch:
    """Compares every loop's fence with the highest that was ever seen."""

    def __init__(self, cluster):
        self.cluster, self.highest, self.regressions = cluster, {}, 0
        self.looks, self.stopping = 0, threading.Event()
        self.thread = threading.Thread(target=self._run, daemon=True)
        self.thread.start()

    def _run(self):
        while not self.stopping.wait(1.0):
            try:
                rows = self.cluster.primary.sql("SELECT loop_id, fence FROM loopscope.schedule",
                                                plant.RESULTS)
            except (RuntimeError, OSError):
                continue  # it is down, or changing places
            self._compare(rows)

    def _compare(self, rows):
        self.looks += 1
        for row in rows.splitlines():
            loop_id, fence = map(int, row.split("|"))
            if fence < self.highest.get(loop_id, 0):
                self.regressions += 1
                say(f"the fence of loop {loop_id} went back from {self.highest[loop_id]} to {fence}")
            self.highest[loop_id] = max(fence, self.highest.get(loop_id, 0))

    def stop(self):
        self.stopping.set()
        self.thread.join()
