"""All hosts together: workers, a primary with a synchronous standby for the results, a historian."""

import os
import shutil
import tempfile
from pathlib import Path

import plant
import remains
from network import Network
from servers import PORT, Server
from shell import say, wait_until
from workers import Worker

WORKERS = ("worker1", "worker2", "worker3")
# Small, so that it can be filled; large enough for a run.
DISK_MB = 2000
SOURCE_DIR = Path(__file__).resolve().parents[2]


class Cluster:
    def __init__(self, program, loops, ahead_s):
        self.program, self.loops = program, loops
        self.servers, self.workers, self.network = [], [], None
        self.deaths = 0     # of workers, by themselves
        self.conflicts = 0  # queries that a standby cancelled
        self.wrong_times = []  # (from, to) that the results server's clock showed while it was wrong
        self.late_lists = 0  # times that the flagged list was not right again within two polls
        self.abandoned = 0  # loops that a fault took out of a worker's hands
        self.folder = Path(tempfile.mkdtemp(prefix=f"{remains.FOLDER_PREFIX}{os.getpid()}.",
                                            dir=remains.FOLDERS))
        self.folder.chmod(0o755)
        try:
            self._build(ahead_s)
        except BaseException:
            self.remove()
            raise

    def _server(self, host, size_mb=None):
        self.servers.append(Server(self.network, host, self.folder, size_mb))
        return self.servers[-1]

    def _build(self, ahead_s):
        self.network = Network((*WORKERS, "first", "second", "historian", "mirror"))
        self.network.build()
        self.historian, self.mirror = self._server("historian"), self._server("mirror")
        self.historian.create()
        say("rows for the historian")
        plant.fill_historian(self.historian, self.program, self.loops, ahead_s)
        self.mirror.follow(self.historian, synchronous=False)
        self.primary, self.standby = self._server("first", DISK_MB), self._server("second", DISK_MB)
        self.primary.create()
        settings = self.folder / "owner.json"
        plant.write_settings(settings, self.loops, self.primary.conninfo(plant.RESULTS, "owner"),
                             self.historian.conninfo(plant.HISTORIAN))
        plant.make_results(self.primary, self.program, settings, SOURCE_DIR, self.loops)
        self.standby.follow(self.primary)

    def _conninfo(self, servers, database, user, more=""):
        hosts = ",".join(self.network.address[server.host] for server in servers)
        return f"host={hosts} port={PORT} dbname={database} user={user}{more}"

    def start_workers(self):
        settings = self.folder / "worker.json"
        plant.write_settings(settings, self.loops,
                             self._conninfo((self.primary, self.standby), plant.RESULTS, "worker"),
                             self._conninfo((self.mirror, self.historian), plant.HISTORIAN,
                                            "reader", " target_session_attrs=prefer-standby"))
        for host in WORKERS:
            self.workers.append(Worker(self.network, host, self.program, settings, self.folder))
            self.workers[-1].start()

    def stop_workers(self):
        return [worker.stop() for worker in self.workers]

    def revive(self):
        """What has died by itself is a finding, and started again as a supervisor would."""
        for worker in self.workers:
            if not worker.alive():
                say(f"{worker.host} had ended with {worker.process.returncode}")
                self.deaths += 1
                worker.start()

    def claims(self, worker):
        """{(loop_id, fence)} that the worker holds."""
        rows = self.sql("SELECT loop_id, fence FROM loopscope.schedule"
                        f" WHERE owner LIKE '{worker.name()}/%'")
        return {tuple(map(int, row.split("|"))) for row in rows.splitlines()}

    def flagged(self):
        """{loop_id} of the list."""
        return set(self.sql("SELECT loop_id FROM loopscope.flagged_loop").splitlines())

    def all_work(self, since_s):
        """Whether every worker has signed in after that time."""
        return all(self.sql("SELECT count(*) FROM loopscope.worker"
                            f" WHERE worker = '{worker.name()}'"
                            f" AND last_seen > to_timestamp({since_s})") == "1"
                   for worker in self.workers)

    def sql(self, text):
        return self.primary.sql(text, plant.RESULTS)

    def reference(self, found):
        """The same slots, in a database of its own, by one worker that nothing disturbs."""
        database = "reference"
        settings = self.folder / "reference.json"
        plant.write_settings(settings, self.loops, self.primary.conninfo(database, "owner"),
                             self.historian.conninfo(plant.HISTORIAN), workers=2)
        plant.make_results(self.primary, self.program, settings, SOURCE_DIR, self.loops, database)
        values = ",".join(f"('{name}', {first - period}, {last})"
                          for name, (first, last, period) in found.items())
        self.primary.sql(f"""
            CREATE TABLE wanted (name text, before_s bigint, last_s bigint);
            INSERT INTO wanted VALUES {values};
            UPDATE loopscope.schedule AS s SET last_slot_end = to_timestamp(before_s)
            FROM loopscope.loop JOIN wanted USING (name) WHERE loop.loop_id = s.loop_id""", database)
        worker = Worker(self.network, "historian", self.program, settings, self.folder)
        worker.start()
        left = ("SELECT count(*) FROM loopscope.schedule JOIN loopscope.loop USING (loop_id)"
                " JOIN wanted USING (name) WHERE last_slot_end < to_timestamp(last_s)")
        try:
            wait_until(lambda: self.primary.sql(left, database) == "0", 7200, "reference", 2.0)
        finally:
            worker.stop()
        return database

    def remove(self):
        for worker in self.workers:
            if worker.alive():
                worker.kill()
        for server in self.servers:
            try:
                server.remove()
            except (RuntimeError, OSError) as error:
                say(f"{server.host}: {error}")
        if self.network:
            self.network.remove()
        shutil.rmtree(self.folder, ignore_errors=True)
