"""Real PostgreSQL servers, each on a host of its own. The harness itself talks to them through a
socket in their folder, which works whatever happens to the network."""

import os
import shutil
import signal
import subprocess
from pathlib import Path

import plant
from session import Session
from shell import run, wait_until
from workers import faketime

PORT = 5432
PROGRAMS = sorted(Path("/usr/lib/postgresql").glob("*/bin"), key=lambda p: int(p.parts[-2]))[-1]
# Recovery of the pair of servers shall not hide that of the workers: they notice each other's
# absence within seconds. Commits are on disk and, while there is a standby, on that as well.
SETTINGS = """
port = 5432
shared_buffers = 128MB
max_connections = 100
max_wal_size = 256MB
min_wal_size = 64MB
wal_keep_size = 64MB
hot_standby = on
wal_sender_timeout = 3s
wal_receiver_timeout = 3s
wal_retrieve_retry_interval = 500ms
tcp_keepalives_idle = 60
log_min_messages = warning
include_if_exists = 'sync.conf'
"""
ACCESS = "local all all trust\nhost all all 10.77.0.0/24 trust\nhost replication all 10.77.0.0/24 trust\n"


class Server:
    """One cluster on one host; `size_mb` of disk, of its own, where given."""

    def __init__(self, network, host, folder, size_mb=None):
        self.network, self.host, self.folder = network, host, Path(folder, host)
        self.disk_mb = size_mb
        self.folder.mkdir()
        if size_mb:
            run(["mount", "-t", "tmpfs", "-o", f"size={size_mb}m", "tmpfs", self.folder])
        shutil.chown(self.folder, "postgres", "postgres")
        self.data = self.folder / "data"
        self.clock = None  # a file that says how far its clock is wrong

    def _as_postgres(self, *command):
        # PostgreSQL refuses root, and pg_ctl a working directory that it cannot read.
        return run([*self.network.inside(self.host), "runuser", "-u", "postgres", "--", *command],
                   cwd="/")

    def create(self):
        self._as_postgres(PROGRAMS / "initdb", f"--pgdata={self.data}", "--username=postgres",
                          "--auth=trust", "--encoding=UTF8", "--no-locale", "--no-instructions")
        self._configure()
        self.start()

    def _configure(self):
        address = self.network.address[self.host]
        with open(self.data / "postgresql.conf", "a", encoding="utf-8") as settings:
            settings.write(SETTINGS + f"listen_addresses = '{address}'\n"
                           f"unix_socket_directories = '{self.folder}'\n")
        (self.data / "pg_hba.conf").write_text(ACCESS, encoding="utf-8")

    def follow(self, primary, synchronous=True):
        """Becomes a standby of the primary, from nothing."""
        shutil.rmtree(self.data, ignore_errors=True)
        self._as_postgres(PROGRAMS / "pg_basebackup", f"--pgdata={self.data}", "--write-recovery-conf",
                          "--checkpoint=fast", "--wal-method=stream", "--username=postgres",
                          f"--host={primary.network.address[primary.host]}")
        (self.data / "sync.conf").unlink(missing_ok=True)
        self._configure()
        if not synchronous:
            with open(self.data / "postgresql.conf", "a", encoding="utf-8") as settings:
                settings.write(plant.STANDBY_SETTINGS)
        self.start()
        wait_until(lambda: primary.sql("SELECT count(*) FROM pg_stat_replication"
                                       " WHERE state = 'streaming'") == "1",
                   60, f"{self.host} streams")
        primary.set_synchronous(synchronous)

    def set_synchronous(self, wanted):
        (self.data / "sync.conf").write_text(
            "synchronous_standby_names = '*'\n" if wanted else "", encoding="utf-8")
        self._as_postgres(PROGRAMS / "pg_ctl", "reload", f"--pgdata={self.data}", "--silent")

    def restart_with_clock(self, movable):
        """From then on set_clock() moves its clock, or no longer. No time-out is to be relied upon
        meanwhile: those of PostgreSQL do not fire under libfaketime."""
        self.stop("fast")
        self.clock = self.folder.parent / f"{self.host}.clock" if movable else None
        if movable:
            self.set_clock(0)
        self.start()

    def set_clock(self, offset_s):
        self.clock.write_text(f"{offset_s:+d}s", encoding="utf-8")
        self.clock.chmod(0o644)

    def start(self):
        environment = [f"{key}={value}" for key, value in faketime(self.clock).items()] \
            if self.clock else []

        # As a supervisor does: a server that cannot start yet is tried again.
        def try_start():
            try:
                self._as_postgres("env", *environment, PROGRAMS / "pg_ctl", "start", f"--pgdata={self.data}", "--wait",
                                  "--timeout=20", "--silent", f"--log={self.folder}/server.log")
            except RuntimeError:
                return self.answers()
            return self.answers()

        wait_until(try_start, 90, f"{self.host} starts")

    def stop(self, mode="immediate"):
        if self.runs():
            self._as_postgres(PROGRAMS / "pg_ctl", "stop", f"--pgdata={self.data}", f"--mode={mode}",
                              "--silent", "--timeout=60")

    def promote(self):
        self.set_synchronous(False)
        self._as_postgres(PROGRAMS / "pg_ctl", "promote", f"--pgdata={self.data}", "--wait",
                          "--timeout=60", "--silent")
        wait_until(lambda: self.sql("SELECT pg_is_in_recovery()") == "f", 60, "promoted")

    def conflicts(self):
        """Queries of this standby that were cancelled for what came from its primary."""
        return int(self.sql("SELECT sum(confl_snapshot + confl_lock + confl_bufferpin)"
                            " FROM pg_stat_database_conflicts"))

    def postmaster(self):
        return int((self.data / "postmaster.pid").read_text(encoding="utf-8").split()[0])

    def runs(self):
        try:
            os.kill(self.postmaster(), 0)
        except (FileNotFoundError, ProcessLookupError, IndexError, ValueError):
            return False
        return True

    def answers(self):
        return self.runs() and subprocess.run(
            ["psql", "-XAtqc", "SELECT 1", self.conninfo()], check=False,
            capture_output=True).returncode == 0

    def processes(self):
        """The postmaster and its children."""
        pid = self.postmaster()
        children = Path(f"/proc/{pid}/task/{pid}/children").read_text(encoding="utf-8")
        return [pid, *map(int, children.split())]

    def freeze(self):
        for pid in self.processes():
            os.kill(pid, signal.SIGSTOP)

    def thaw(self):
        for pid in self.processes():
            os.kill(pid, signal.SIGCONT)

    def conninfo(self, database="postgres", user="postgres"):
        return f"host={self.folder} port={PORT} user={user} dbname={database} connect_timeout=5"

    def sql(self, text, database="postgres"):
        """What psql prints: columns separated by |."""
        return run(["psql", "--no-psqlrc", "--quiet", "--set", "ON_ERROR_STOP=1", "--no-align",
                    "--tuples-only", self.conninfo(database)], input=text).strip()

    def session(self, database="postgres"):
        """One that stays open."""
        return Session(self.conninfo(database))

    def fill_disk(self):
        """Takes all that is left of its disk, and keeps what it has."""
        with open(self.folder / "ballast", "ab", buffering=0) as ballast:
            try:
                while True:
                    ballast.write(bytes(1 << 16))
            except OSError:
                pass
        disk = os.statvfs(self.folder)
        if disk.f_bavail * disk.f_frsize > 1 << 20:
            raise RuntimeError(f"the disk of {self.host} could not be filled")

    def free_disk(self):
        (self.folder / "ballast").unlink(missing_ok=True)

    def remove(self):
        try:
            self.thaw()
        except (FileNotFoundError, ProcessLookupError, IndexError, ValueError):
            pass
        try:
            self.stop()
        finally:
            if self.disk_mb:
                subprocess.run(["umount", "--lazy", self.folder], check=False)
