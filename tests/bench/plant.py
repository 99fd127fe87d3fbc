"""A plant for the benchmarks: throw-away servers, a generated historian, a catalogue, settings.

Values come from `loopscope simulate`: 152 healthy loops and 8 with a fault each, 5 % as in a plant
that is looked after. Loop i has the values of recording i modulo 160, under tags of its own or,
where thousands of loops share a historian of bearable size, under the recording's tags.
"""

import json
import os
import shlex
import shutil
import subprocess
import tempfile
from pathlib import Path

SOURCE_DIR = Path(__file__).resolve().parents[2]
WINDOW = 4096
# One analysis a day at one sample a minute: a day later needs 1440 rows more.
INTERVAL_S = 60
PERIOD_S = 86400
ROWS_A_DAY = PERIOD_S // INTERVAL_S
HEALTHY = ("healthy_flow", "paper_5_1", "level_loop", "healthy_flow")
FAULTS = ("sticking_valve", "deadband", "saturated_valve", "oversized_valve", "tight_tuning",
          "outside_oscillation", "process_gain_change", "quantised_sensor")
RECORDINGS = 160
TICKS_PER_S = os.sysconf("SC_CLK_TCK")


def run(command, **options):
    # Slots are counted in UTC, and so are the days of the statements here.
    options["env"] = {**options.get("env", os.environ), "PGTZ": "UTC"}
    done = subprocess.run(command, text=True, capture_output=True, check=False, **options)
    if done.returncode != 0:
        raise RuntimeError(f"{shlex.join(map(str, command))}: exit code {done.returncode}\n"
                           f"{done.stdout}{done.stderr}")
    return done.stdout


class Server:
    """A private PostgreSQL server with full durability, removed at the end."""

    def __init__(self, parent):
        self.folder = tempfile.mkdtemp(prefix="loopscope-bench.", dir=parent)
        self._cluster("start")
        self.postmaster = int(Path(self.folder, "data/postmaster.pid").read_text().split()[0])

    def _cluster(self, action):
        library = SOURCE_DIR / "deploy/lib/private_cluster.sh"
        run(["bash", "-c", f". {shlex.quote(str(library))}; private_cluster_{action} "
             f"{shlex.quote(self.folder)}"])

    def remove(self):
        self._cluster("remove")

    def conninfo(self, database="postgres", user="postgres"):
        return f"host={self.folder} port=5432 user={user} dbname={database}"

    def sql(self, text, database="postgres"):
        """Runs statements; returns the rows of the last as lists of texts."""
        out = run(["psql", "--no-psqlrc", "--quiet", "--set", "ON_ERROR_STOP=1", "--no-align",
                   "--tuples-only", "--field-separator", "\t", self.conninfo(database)], input=text)
        return [line.split("\t") for line in out.splitlines() if line]

    def cpu_s(self):
        """CPU time of the server and of all back ends, those that have ended included."""
        total = sum(cpu_ticks(self.postmaster))
        children = Path(f"/proc/{self.postmaster}/task/{self.postmaster}/children").read_text()
        return (total + sum(cpu_ticks(int(pid))[0] for pid in children.split())) / TICKS_PER_S


def cpu_ticks(pid):
    """Of the process itself, and of its children that have ended."""
    try:
        fields = Path(f"/proc/{pid}/stat").read_text().rsplit(")", 1)[1].split()
    except FileNotFoundError:
        return (0, 0)
    return (int(fields[11]) + int(fields[12]), int(fields[13]) + int(fields[14]))


def _scenario(number):
    faulty = number % (RECORDINGS // len(FAULTS)) == 0
    step = number // (RECORDINGS // len(FAULTS))
    return FAULTS[step] if faulty else HEALTHY[number % len(HEALTHY)]


def _levels():
    return ", ".join(str(n) for n in range(RECORDINGS) if _scenario(n) == "level_loop")


def load_recordings(server, program, samples):
    """Table recording(number, k, sp, pv, op), k = 0 .. samples - 1."""
    server.sql("CREATE TABLE recording (number int, k int, sp float8, pv float8, op float8)")
    rows = []
    for number in range(RECORDINGS):
        text = run([program, "simulate", _scenario(number), "--seed", str(number + 1),
                    "--samples", str(samples), "--no-mv"])
        lines = text.splitlines()
        column = {name: i for i, name in enumerate(lines[0].split(","))}
        for k, line in enumerate(lines[1:]):
            cells = line.split(",")
            rows.append("\t".join([str(number), str(k)] +
                                  [cells[column[name]] or "\\N" for name in ("sp", "pv", "op")]))
    server.sql("COPY recording FROM STDIN;\n" + "\n".join(rows) + "\n\\.\n")
    server.sql("CREATE INDEX ON recording (k, number) INCLUDE (sp, pv, op); VACUUM ANALYZE recording")


def make_history(server):
    # Vacuumed by those who add to it: a server that does so by itself does it while something is timed.
    server.sql("CREATE TABLE history (tag text NOT NULL, time timestamptz NOT NULL, value float8,"
               " quality smallint) WITH (autovacuum_enabled = off)")


def add_history(server, tags, first_k, last_k, end, interval_s=INTERVAL_S):
    """Rows of the given number of sets of tags, in the order of their times, sample last_k at the
    time `end` (SQL)."""
    server.sql(f"""
        DO $$ BEGIN FOR n IN {first_k} .. {last_k} LOOP
          INSERT INTO history
          SELECT 'FC' || i || role.suffix,
                 {end} - ({last_k} - n) * interval '{interval_s} seconds', role.value, 192
          FROM generate_series(0, {tags - 1}) AS i
          JOIN recording ON recording.k = n AND recording.number = i % {RECORDINGS}
          CROSS JOIN LATERAL (VALUES ('.SP', sp), ('.PV', pv), ('.OP', op)) AS role (suffix, value);
        END LOOP; END $$""")


def index_history(server, covering):
    include = " INCLUDE (value, quality)" if covering else ""
    server.sql(f"DROP INDEX IF EXISTS by_tag; CREATE INDEX by_tag ON history (tag, time){include}")
    tidy_history(server)


def tidy_history(server):
    # Pages become all-visible, which index-only scans need, once their commits are on disk.
    server.sql("CHECKPOINT")
    server.sql("VACUUM ANALYZE history")


def warm_history(server):
    """Every value through the server's cache, by the index, and everything written that waits for it:
    what is measured first is not to pay for what all others find."""
    server.sql("SET enable_seqscan = off; SELECT count(value), count(quality) FROM history")
    server.sql("CHECKPOINT")


class Results:
    """A results database of its own with a catalogue of `loops` loops over `tags` sets of tags, as
    the build makes it; `more` are further sections of the settings."""

    def __init__(self, server, build, historian, folder, loops, tags, schedule, more=None,
                 interval_s=INTERVAL_S, period_s=PERIOD_S):
        self.server, self.build = server, build
        self.name = f"results_{loops}"
        server.sql(f"DROP DATABASE IF EXISTS {self.name}")
        server.sql(f"CREATE DATABASE {self.name}")
        # Beside its server's name: two builds have a server each.
        self.settings = Path(folder, f"{Path(server.folder).name}.{self.name}.json")
        self.settings.write_text(json.dumps({
            "results": {"connection": server.conninfo(self.name, "owner")},
            "historians": [{"name": "plant", "connection": historian.conninfo(),
                            "table": "public.history"}],
            "schedule": {"settle_s": 60, **schedule}, **(more or {})}))
        self.sql((build.source / "deploy/roles.sql").read_text(encoding="utf-8"))
        self.sql("DO $$ BEGIN CREATE ROLE owner LOGIN IN ROLE loopscope_owner;"
                 " EXCEPTION WHEN duplicate_object THEN NULL; END $$")
        run([build.program, "migrate", "--config", self.settings])
        self.sql(f"""
            INSERT INTO loopscope.loop (name, source, sp_tag, pv_tag, op_tag, interval_s, period_s,
                                        op_low, op_high, loop_type)
            SELECT 'FC' || i, 'plant', 'FC' || i % {tags} || '.SP', 'FC' || i % {tags} || '.PV',
                   'FC' || i % {tags} || '.OP', {interval_s}, {period_s}, 0, 100,
                   CASE WHEN i % {tags} % {RECORDINGS} IN ({_levels()}) THEN 'level' END
            FROM generate_series(0, {loops - 1}) AS i""")
        self.sql("VACUUM ANALYZE loopscope.loop, loopscope.schedule")

    def sql(self, text):
        return self.server.sql(text, self.name)

    def drop(self):
        self.server.sql(f"DROP DATABASE {self.name}")


class Workshop:
    """A temporary folder and the servers in it, removed at the end."""

    def __enter__(self):
        self.folder = tempfile.mkdtemp(prefix="loopscope-bench.", dir="/var/tmp")
        os.chmod(self.folder, 0o755)
        self.servers = []
        return self

    def server(self):
        # Not inside the folder: the path of a socket has to be short.
        self.servers.append(Server("/var/tmp"))
        return self.servers[-1]

    def __exit__(self, *_):
        for server in self.servers:
            server.remove()
        shutil.rmtree(self.folder, ignore_errors=True)
