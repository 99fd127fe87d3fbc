"""What is done to the plant. Each fault happens, ends, and leaves the world as it was; `cluster` is
what main.py puts together. A fault's function returns when the fault has ended; what has to be put
back in order after the recovery was measured is done by `afterwards`, where it is given."""

import signal
import time

import plant
from shell import wait_until

LONGER_THAN_LEASE_S = plant.LEASE_S + 3


def busy_worker(cluster, random):
    """One that holds loops in this moment."""
    worker = random.choice(cluster.workers)
    wait_until(lambda: cluster.claims(worker), 60, f"{worker.host} holds loops", 0.01)
    return worker


def stopped_with_claims(cluster, random):
    """One that was stopped while it held loops, and how many: a look and a signal are not one
    moment, and a quick worker has given everything back between them."""
    while True:
        worker = busy_worker(cluster, random)
        worker.send(signal.SIGSTOP)
        time.sleep(0.1)  # a commit that is on its way arrives
        if held := cluster.claims(worker):
            return worker, len(held)
        worker.send(signal.SIGCONT)


def kill_worker(cluster, random):
    """kill -9 in the middle of a batch; it comes back only after the others have taken over."""
    worker, held = stopped_with_claims(cluster, random)
    worker.kill()
    cluster.abandoned += held
    return f"{worker.host} ({held} loops)", worker.start


def stop_worker(cluster, random):
    """SIGSTOP beyond the lease: it wakes up as a zombie whose loops others have."""
    worker, held = stopped_with_claims(cluster, random)
    cluster.abandoned += held
    time.sleep(random.uniform(plant.LEASE_S + 1, LONGER_THAN_LEASE_S))
    worker.send(signal.SIGCONT)
    return worker.host, None


def crash_results(cluster, random):
    """pg_ctl stop -m immediate, and started again."""
    cluster.primary.stop("immediate")
    time.sleep(random.uniform(1, 8))
    cluster.primary.start()
    return cluster.primary.host, None


def crash_historian(cluster, random):
    """It and its standby: nobody else has the rows."""
    cluster.mirror.stop("immediate")
    cluster.historian.stop("immediate")
    time.sleep(random.uniform(1, 12))
    cluster.historian.start()
    return cluster.historian.host, cluster.mirror.start


def conflict_on_standby(cluster, random):
    """Rows vanish under the queries of the historian's standby, which are cancelled for it."""
    cluster.historian.sql("CREATE TABLE IF NOT EXISTS gone (one int)", plant.HISTORIAN)
    before = cluster.mirror.conflicts()
    until = time.monotonic() + random.uniform(5, 10)
    while time.monotonic() < until:
        cluster.historian.sql("INSERT INTO gone VALUES (1);\nDELETE FROM gone;\nVACUUM gone;\n" * 20,
                              plant.HISTORIAN)
    cancelled = cluster.mirror.conflicts() - before
    cluster.conflicts += cancelled
    return f"{cluster.mirror.host} ({cancelled} queries)", None


def promote_standby(cluster, random):
    """The primary dies for good; its synchronous standby takes over, and gets a new standby."""
    cluster.primary.stop("immediate")
    time.sleep(random.uniform(0.5, 4))
    cluster.primary, cluster.standby = cluster.standby, cluster.primary
    cluster.primary.promote()
    return cluster.primary.host, lambda: cluster.standby.follow(cluster.primary)


def pull_cable(cluster, random):
    host = random.choice(list(cluster.network.address))
    cluster.network.pull_cable(host)
    time.sleep(random.uniform(2, LONGER_THAN_LEASE_S))
    cluster.network.plug_cable(host)
    return host, None


def lose_packets(cluster, random):
    host = random.choice(list(cluster.network.address))
    cluster.network.lose_packets(host, random.randint(5, 40))
    time.sleep(random.uniform(5, 15))
    cluster.network.lose_nothing(host)
    return host, None


def fill_disk(cluster, random):
    """The primary's disk is full for a while; the server may die of it."""
    cluster.primary.fill_disk()
    until = time.monotonic() + random.uniform(4, 12)
    while time.monotonic() < until:
        # Whatever a checkpoint gives back is taken as well.
        cluster.primary.fill_disk()
        time.sleep(0.5)
    cluster.primary.free_disk()
    if not cluster.primary.answers():
        cluster.primary.start()
    return cluster.primary.host, None


def move_clock(cluster, random):
    """The wall clock of a worker's host jumps, and stays wrong."""
    worker = random.choice(cluster.workers)
    worker.set_clock(random.choice((-1, 1)) * random.randint(60, 7200))
    time.sleep(2)  # it looks once a second
    return worker.host, None


def move_server_clock(cluster, random):
    """The clock of the results server is wrong for five seconds, by seconds up to months. The list
    of flagged loops has to be what it was within two polls."""
    cluster.primary.restart_with_clock(True)
    wait_until(lambda: any(cluster.claims(worker) for worker in cluster.workers), 60, "work", 0.05)
    wait_until(lambda: len(cluster.flagged()) > 0, 60, "flagged loops", 0.5)
    before = cluster.flagged()
    days, hours = 86400, 3600
    size_s = random.choice((random.randint(20, 50), random.randint(1, 12) * hours, 30 * days, 200 * days))
    offset_s = random.choice((-1, 1)) * size_s
    from_s = time.time() + offset_s
    cluster.primary.set_clock(offset_s)
    time.sleep(5)
    cluster.primary.set_clock(0)
    time.sleep(1)  # it looks once a second
    cluster.wrong_times.append((from_s - 1, time.time() + offset_s + 1))
    ended = time.monotonic()
    wait_until(lambda: cluster.flagged() == before, 60, "the list of before", 0.2)
    list_s = time.monotonic() - ended
    cluster.late_lists += list_s > 2 * plant.POLL_S
    return (f"{cluster.primary.host} ({offset_s:+d} s; list after {list_s:.1f} s)",
            lambda: cluster.primary.restart_with_clock(False))


def poisoned_row(cluster, random):
    """A thief of the worker's password spoils rows: what would stop every claim is refused, what is
    allowed stops its loop no longer than a lease."""
    loop = "WHERE loop_id = (SELECT loop_id FROM loopscope.loop ORDER BY random() LIMIT 1)"
    for poison in ("fence = 9223372036854775807", "fence = 0", "last_slot_end = 'infinity'",
                   "attempts = 2147483647"):
        try:
            cluster.primary.sql(f"SET ROLE worker; UPDATE loopscope.schedule SET {poison} {loop}", plant.RESULTS)
        except RuntimeError:
            continue
        raise RuntimeError(f"not refused: {poison}")
    owner = random.choice(("NULL", "'thief/1/0'"))
    cluster.primary.sql(
        "SET ROLE worker; UPDATE loopscope.schedule SET visible_at = now() + interval '10 years',"
        " last_slot_end = now() + interval '10 years', result_slot_end = now() + interval '10 years',"
        f" owner = {owner} {loop}", plant.RESULTS)
    return f"owner {owner}", None


def done_meanwhile(cluster, slots, what):
    """Every loop gets so many slots further while the fault lasts, without being late."""
    periods = plant.periods_s(cluster.loops)
    for _ in range(slots):
        begun_s = time.time()
        wait_until(lambda: cluster.sql("SELECT count(*) FROM loopscope.schedule WHERE enabled AND"
                                       f" last_slot_end < to_timestamp({begun_s})") == "0",
                   2 * periods[-1] + plant.LEASE_S, f"every loop goes on {what}", 0.5)


def old_snapshot(cluster, random):
    """A dump of the results takes as long as six slots of every loop: nothing dead can be removed
    meanwhile."""
    with cluster.primary.session(plant.RESULTS) as dump:
        dump.run("BEGIN ISOLATION LEVEL REPEATABLE READ READ ONLY")
        tables = dump.run("SELECT string_agg(oid::regclass::text, ', ') FROM pg_class WHERE relnamespace ="
                          " 'loopscope'::regnamespace AND relkind IN ('r', 'p')")
        dump.run(f"LOCK TABLE {tables} IN ACCESS SHARE MODE")
        dump.run("SELECT count(*) FROM loopscope.schedule")
        slots = 6
        done_meanwhile(cluster, slots, "under an old snapshot")
    return f"{cluster.primary.host} ({slots} slots of every loop)", None


def open_owner_transaction(cluster, random):
    """Somebody of the owner's changes the catalogue and forgets to commit."""
    with cluster.primary.session(plant.RESULTS) as owner:
        owner.run("BEGIN; SET LOCAL ROLE loopscope_owner")
        owner.run("UPDATE loopscope.loop SET importance = importance; UPDATE loopscope.parameter SET value = value")
        done_meanwhile(cluster, 2, "beside an open transaction of the owner")
        end = random.choice(("COMMIT", "ROLLBACK"))
        owner.run(end)
    return end, None


def end_sessions(cluster, random):
    """All sessions of all workers at one of the servers."""
    server = random.choice((cluster.primary, cluster.mirror))
    ended = server.sql("SELECT count(pg_terminate_backend(pid)) FROM pg_stat_activity"
                       " WHERE usename IN ('worker', 'reader')")
    return f"{server.host} ({ended})", None


def freeze_server(cluster, random):
    """It stands still without dying: connections stay open and nothing answers."""
    server = random.choice((cluster.primary, cluster.mirror))
    server.freeze()
    time.sleep(random.uniform(4, 12))
    server.thaw()
    return server.host, None


def late_rows(cluster, random):
    """Rows of one recording come late, some of them twice."""
    number = random.randrange(plant.recordings(cluster.loops))
    where = f"tag LIKE 'R{number}.%' AND time > now() + interval '1 s' AND time <= now() + interval '9 s'"
    cluster.historian.sql(
        "CREATE TABLE IF NOT EXISTS late (LIKE history); TRUNCATE late;"
        f" WITH held AS (DELETE FROM history WHERE {where} RETURNING *)"
        " INSERT INTO late SELECT * FROM held", plant.HISTORIAN)
    time.sleep(random.uniform(12, 25))
    cluster.historian.sql(
        "INSERT INTO history SELECT * FROM late; INSERT INTO history SELECT * FROM late"
        " WHERE random() < 0.5; TRUNCATE late", plant.HISTORIAN)
    return f"recording {number}", None


KINDS = {function.__name__: function for function in (
    kill_worker, stop_worker, crash_results, crash_historian, conflict_on_standby, promote_standby,
    pull_cable,
    lose_packets, fill_disk, move_clock, move_server_clock, poisoned_row, old_snapshot,
    open_owner_transaction, end_sessions, freeze_server, late_rows)}


def plan(faults, random, only=()):
    """Every kind equally often, in any order."""
    names = list(only or KINDS)
    kinds = []
    while len(kinds) < faults:
        kinds += random.sample(names, len(names))
    return kinds[:faults]
