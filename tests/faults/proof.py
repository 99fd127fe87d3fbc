"""What SQL proves afterwards: every slot has its row, none has two, and every result is the one that
an undisturbed run finds."""

import hashlib

import plant

# What tells when, how often and how fast something was done, and not what was found.
CIRCUMSTANCES = {"loop_id", "analysis_id", "fence", "analysed_at", "input_revision", "fetch_ms",
                 "analyse_ms", "prepare_ms", "statistics_ms", "model_ms", "decided_at",
                 # What was known of pv when the slot was judged, and with it what the slot tells the
                 # next: they follow from the visits before, and late ones leave slots out.
                 "past_pv_flat_s", "past_pv_step", "pv_flat_s", "pv_step"}
TABLES = ("analysis", "verdict", "bicoherence_peak", "explanation_step")


def slots(server, database=plant.RESULTS):
    """{loop name: (first slot, last slot, period)} in seconds, of what was completed."""
    rows = server.sql("""
        SELECT loop.name, extract(epoch FROM min(analysis.slot_end))::bigint,
               extract(epoch FROM max(schedule.last_slot_end))::bigint, period_s::bigint
        FROM loopscope.loop JOIN loopscope.schedule USING (loop_id)
        JOIN loopscope.analysis USING (loop_id) GROUP BY 1, 4 ORDER BY 1""", database)
    return {name: tuple(map(int, numbers)) for name, *numbers in
            (row.split("|") for row in rows.splitlines())}


def expected(found):
    return {(name, slot) for name, (first, last, period) in found.items()
            for slot in range(first, last + 1, period)}


def stored(server, database=plant.RESULTS):
    """Every analysis row as (loop name, slot)."""
    rows = server.sql("SELECT loop.name, extract(epoch FROM slot_end)::bigint"
                      " FROM loopscope.analysis JOIN loopscope.loop USING (loop_id)", database)
    return [(name, int(slot)) for name, slot in (row.split("|") for row in rows.splitlines())]


def too_early(server, wrong_times, database=plant.RESULTS):
    """Analyses of slots that had not settled by the database's clock, but for those that were
    written while it was wrong."""
    right = "".join(f" AND extract(epoch FROM analysed_at) NOT BETWEEN {begun} AND {ended}"
                    for begun, ended in wrong_times)
    return int(server.sql("SELECT count(*) FROM loopscope.analysis WHERE analysed_at"
                          f" < slot_end + interval '{plant.SETTLE_S} s'{right}", database))


def duplicated(server, database=plant.RESULTS):
    """Slots with two analyses, and analyses whose verdicts are not one for each revision."""
    return int(server.sql("""
        SELECT (SELECT count(*) FROM (SELECT FROM loopscope.analysis GROUP BY loop_id, slot_end
                                      HAVING count(*) > 1) AS twice)
             + (SELECT count(*) FROM loopscope.analysis AS a WHERE input_revision <>
                  (SELECT count(*) FROM loopscope.verdict AS v WHERE v.loop_id = a.loop_id
                     AND v.slot_end = a.slot_end AND v.algorithm_revision = a.algorithm_revision))"""
                          , database))


def _columns(server, table, database):
    rows = server.sql("SELECT attname FROM pg_attribute WHERE attrelid ="
                      f" 'loopscope.{table}'::regclass AND attnum > 0 AND NOT attisdropped", database)
    return [name for name in rows.splitlines() if name not in CIRCUMSTANCES]


def findings(server, database=plant.RESULTS):
    """{(table, loop name, slot): digest of the rows of its newest revision, every column}."""
    digests = {}
    for table in TABLES:
        columns = ", ".join(f"row.{name}" for name in _columns(server, table, database))
        rows = server.sql(f"""
            SELECT loop.name, extract(epoch FROM row.slot_end)::bigint,
                   md5(string_agg(ROW({columns})::text, ';' ORDER BY ROW({columns})::text))
            FROM loopscope.{table} AS row JOIN loopscope.loop USING (loop_id)
            JOIN loopscope.analysis AS newest
              USING (loop_id, slot_end, algorithm_revision, input_revision)
            GROUP BY 1, 2""", database)
        for row in rows.splitlines():
            name, slot, digest = row.split("|")
            digests[table, name, int(slot)] = digest
    return digests


def digest_of_all(digests):
    return hashlib.sha256(repr(sorted(digests.items())).encode()).hexdigest()[:16]
