"""The plant of the harness: recordings that loops share, a catalogue, settings."""

import json
import math
import time

from shell import run

# Rows lie a second apart; they begin early enough for a whole window and reach into the future,
# where nobody reads them yet.
INTERVAL_S = 1
WINDOW = 1024
SETTLE_S = 2
LEASE_S = 15
POLL_S = 2
BATCH_LOOPS = 8
FAULTY = {0: "sticking_valve", 20: "tight_tuning"}
# Rows come late by so much at most: as many slots back have to be looked at again.
LATEST_S = 40
# Of a historian's standby: queries that are in the way of its primary's log are cancelled at once.
STANDBY_SETTINGS = "max_standby_streaming_delay = 0\nmax_standby_archive_delay = 0\n"
# The plant is kept busy, so that a fault meets work that is under way.
LOOPS_A_SECOND = 11
RESULTS, HISTORIAN = "results", "plant"


def periods_s(loops):
    """They differ, so that loops fall due all the time and not all at once."""
    middle_s = max(9.0, loops / LOOPS_A_SECOND)
    return sorted({round(middle_s * (0.67 + 0.05 * step)) for step in range(14)})


def recordings(loops):
    """Of a large plant many loops share one."""
    return min(40, loops)


def _simulate(program, number, samples):
    scenario = FAULTY.get(number, ("healthy_flow", "paper_5_1")[number % 2])
    text = run([program, "simulate", scenario, "--seed", str(number + 1), "--samples", str(samples),
                "--interval-s", str(INTERVAL_S), "--no-mv"])
    lines = text.splitlines()
    column = {name: i for i, name in enumerate(lines[0].split(","))}
    return [[line.split(",")[column[name]] for name in ("sp", "pv", "op")] for line in lines[1:]]


def fill_historian(server, program, loops, ahead_s):
    """Rows from a window before now to `ahead_s` after it. Returns the first time, seconds."""
    server.sql(f"CREATE DATABASE {HISTORIAN}; CREATE ROLE reader LOGIN")
    server.sql("CREATE TABLE history (tag text NOT NULL, time timestamptz NOT NULL,"
               " value float8, quality smallint); GRANT SELECT ON history TO reader", HISTORIAN)
    first_s = int(time.time()) - 3 * WINDOW
    samples = 3 * WINDOW + int(ahead_s)
    for number in range(recordings(loops)):
        rows = []
        for k, cells in enumerate(_simulate(program, number, samples)):
            rows += [f"R{number}.{role}\t@{first_s + k}\t{cell or chr(92) + 'N'}\t192"
                     for role, cell in zip(("SP", "PV", "OP"), cells)]
        server.sql("CREATE TEMP TABLE came (tag text, at text, value float8, quality smallint);\n"
                   "COPY came FROM STDIN;\n" + "\n".join(rows) + "\n\\.\n"
                   "INSERT INTO history SELECT tag, to_timestamp(substr(at, 2)::float8), value,"
                   " quality FROM came;", HISTORIAN)
    server.sql("CREATE INDEX ON history (tag, time) INCLUDE (value, quality); VACUUM ANALYZE history",
               HISTORIAN)
    return first_s


def make_results(server, program, settings, source_dir, loops, database=RESULTS):
    """A migrated database with the catalogue."""
    server.sql(f"CREATE DATABASE {database}")
    server.sql((source_dir / "deploy/roles.sql").read_text(encoding="utf-8"), database)
    for login, group in (("worker", "loopscope_worker"), ("owner", "loopscope_owner")):
        server.sql(f"DO $$ BEGIN CREATE ROLE {login} LOGIN IN ROLE {group};"
                   " EXCEPTION WHEN duplicate_object THEN NULL; END $$")
    run([program, "migrate", "--config", settings])
    periods, shared = periods_s(loops), recordings(loops)
    server.sql(f"""
        INSERT INTO loopscope.loop (name, source, sp_tag, pv_tag, op_tag, interval_s, period_s,
                                    op_low, op_high, loop_type)
        SELECT 'FC' || i, 'plant', 'R' || i % {shared} || '.SP', 'R' || i % {shared} || '.PV',
               'R' || i % {shared} || '.OP', {INTERVAL_S},
               ('{{{",".join(map(str, periods))}}}'::int[])[1 + i * 7 / {shared} % {len(periods)}],
               0, 100, 'flow'
        FROM generate_series(0, {loops - 1}) AS i""", database)


def write_settings(file, loops, results, historian, workers=1):
    settings = {
        "results": {"connection": results},
        "historians": [{"name": "plant", "connection": historian, "table": "public.history"}],
        "schedule": {"settle_s": SETTLE_S, "lease_s": LEASE_S, "poll_s": POLL_S,
                     "batch_loops": BATCH_LOOPS, 
                     "revise_slots": 1 + math.ceil(LATEST_S / periods_s(loops)[0]),
                     "catch_up_slots": 1000, "model_all_up_to": 1000000},
        "daemon": {"workers": workers, "http_address": "127.0.0.1:9470"},
        "analysis": {"window_samples": WINDOW}}
    file.write_text(json.dumps(settings, indent=1), encoding="utf-8")
