"""The plant's historian, two tables of different layout filled as time goes by; the catalogue."""

import csv

import numpy

import plant
from simulate import Signals

DATABASE = "plant"
# Data end so long before now, so that nothing of them is in the future while the passes run.
_REST_S = 900
# Slots end at whole multiples of a loop's period, those of 5 s a sample at those of this one.
_LONGEST_PERIOD_S = 5 * plant.SLOT_S
_EVERY_S = 600  # a tag that is kept on change is kept so often, too
_LATEST_MS = 80
_SPAN = {"flow": 200.0, "pressure": 16.0, "temperature": 300.0, "level": 100.0}
_TABLES = """
CREATE TABLE history (tag text NOT NULL, time timestamptz NOT NULL, value double precision,
                      quality integer NOT NULL, PRIMARY KEY (tag, time));
CREATE TABLE looprows (loop text NOT NULL, time timestamptz NOT NULL, sp double precision,
                       pv double precision, op double precision, mode integer,
                       PRIMARY KEY (loop, time));
"""
_GOOD = 192


def settings_of(connection):
    return [{"name": "dcs", "connection": connection, "table": "public.history"},
            {"name": "plc", "connection": connection, "preset": "loop_row",
             "table": "public.looprows"}]


def _catalogue_row(loop):
    recording, is_row = loop.recording, loop.recording.layout == "row"
    roles = [role if is_row else role.upper() for role in ("sp", "pv", "op", "mode")]
    tags = [f"{loop.name}.{role}" for role in roles]
    return {"name": loop.name, "source": "plc" if is_row else "dcs", "sp_tag": tags[0],
            "pv_tag": tags[1], "op_tag": tags[2], "mode_tag": tags[3] if recording.has_mode else "",
            "period_s": plant.SLOT_S * loop.place.sample_interval_s,
            "op_low": recording.op_low if recording.op_range_is_set else "",
            "op_high": recording.op_high if recording.op_range_is_set else "",
            "loop_type": loop.place.kind}


def write_catalogue(loops, path):
    with open(path, "w", encoding="utf-8", newline="") as file:
        writer = csv.DictWriter(file, _catalogue_row(loops[0]))
        writer.writeheader()
        writer.writerows(map(_catalogue_row, loops))


def _is_kept_on_change(values, seconds, interval_s):
    before = values[numpy.maximum(seconds - interval_s, 0)]
    return (seconds % _EVERY_S == 0) | (values[seconds] != before)


class _Record:
    """One loop in the historian's units, as rows for COPY."""

    def __init__(self, loop, signals, start_s):
        self._loop, self._start_ms = loop, start_s * 1000
        scale = _SPAN[loop.place.kind] / 100
        self._values = {
            "sp": numpy.round(signals.setpoint * scale, 4),
            "pv": numpy.round(signals.pv * scale, 5),
            "op": loop.recording.op_recorded(signals.op, loop.place.op_recorded_step),
            "mode": signals.automatic}
        self._random = numpy.random.default_rng([*loop.seed, 2])

    def _times(self, seconds):
        """As texts; never later than the slot's end."""
        late_ms = numpy.zeros(len(seconds), dtype=int)
        if self._loop.recording.is_late:
            late_ms = self._random.integers(0, _LATEST_MS + 1, len(seconds))
            late_ms[seconds % plant.SLOT_S == 0] = 0
        moments = numpy.datetime64(self._start_ms, "ms") + seconds * 1000 + late_ms
        return numpy.datetime_as_string(moments, timezone="UTC").tolist()

    def _loop_rows(self, seconds):
        has_mode = self._loop.recording.has_mode
        columns = [self._values[role][seconds].tolist() for role in ("sp", "pv", "op")]
        columns.append(self._values["mode"][seconds].tolist() if has_mode
                       else ["\\N"] * len(seconds))
        return [f"{self._loop.name}\t{time}\t{sp!r}\t{pv!r}\t{op!r}\t{mode}\n"
                for time, sp, pv, op, mode in zip(self._times(seconds), *columns)]

    def _tag_rows(self, role, seconds):
        tag = f"{self._loop.name}.{role.upper()}"
        return [f"{tag}\t{time}\t{value!r}\t{_GOOD}\n" for time, value
                in zip(self._times(seconds), self._values[role][seconds].tolist())]

    def rows(self, start_s, stop_s):
        interval_s, recording = self._loop.place.sample_interval_s, self._loop.recording
        seconds = numpy.arange(start_s, stop_s)
        seconds = seconds[seconds % interval_s == 0]
        if recording.layout == "row":
            return self._loop_rows(seconds)
        sparse = ["sp"] * recording.setpoint_on_change + ["mode"] * recording.has_mode
        always = ["pv", "op"] + ["sp"] * (not recording.setpoint_on_change)
        rows = [row for role in always for row in self._tag_rows(role, seconds)]
        for role in sparse:
            kept = _is_kept_on_change(self._values[role], seconds, interval_s)
            rows += self._tag_rows(role, seconds[kept])
        return rows


class History:
    """`start_s`: of the first sample, seconds since 1970."""

    def __init__(self, server, loops, folder, duration_s, now_s):
        self._server, self._loops = server, loops
        end_s = int(now_s) - _REST_S - duration_s
        self.start_s = end_s - end_s % _LONGEST_PERIOD_S
        self._records = [_Record(loop, Signals.load(folder, loop.name), self.start_s)
                         for loop in loops]
        server.sql(f"CREATE DATABASE {DATABASE}")
        server.sql(_TABLES, DATABASE)

    def add(self, start_s, stop_s):
        """What the plant recorded within these seconds since its start."""
        for table, layout in (("history", "narrow"), ("looprows", "row")):
            rows = (row for record, loop in zip(self._records, self._loops)
                    if loop.recording.layout == layout for row in record.rows(start_s, stop_s))
            self._server.sql(f"COPY {table} FROM STDIN;\n{''.join(rows)}\\.\n", DATABASE)

    def analyze(self):
        self._server.sql("ANALYZE", DATABASE)
