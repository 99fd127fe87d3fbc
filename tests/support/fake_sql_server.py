"""A stand-in for SQL Server: one table of (tag, time, value, quality), over TDS 7.2 or later.

fake_sql_server.py ROWS FOLDER: ROWS has a row a line, columns by tabs. Writes FOLDER/port, and each
batch that comes into FOLDER/batches. It answers a SELECT of columns with the tag, bounds of the time
and perhaps an order, and an error to whatever else has a SELECT, as SQL Server would to a wrong one. The
time is a DATETIME2, which clients of TDS 7.2 are sent as text.
"""

import datetime
import re
import socket
import struct
import sys
import threading

TYPES = {
    "tag": b"\xe7\xa0\x00\x09\x04\xd0\x00\x34",  # nvarchar(80)
    "time": b"\x2a\x07",  # datetime2(7)
    "time as text": b"\xe7\x36\x00\x09\x04\xd0\x00\x34",  # nvarchar(27)
    "value": b"\x6d\x08",  # float
    "quality": b"\x26\x04",  # int
}
LITERAL = r"'((?:[^']|'')*)'"
SELECT = re.compile(
    r"SELECT (?P<columns>\[\w+\](?:, \[\w+\])*) FROM \[dbo\]\.\[history\]"
    r"(?: WHERE (?P<where>.*?))?(?P<order> ORDER BY \[time\] (?:DESC|ASC))?",
    re.DOTALL,
)
CONDITION = re.compile(
    r"\(\(\[(tag|time)\] (=|>=|<=|<|>|IS NOT NULL)(?: " + LITERAL + r")?\)\)(?: AND |$)"
)


def time_of(text):
    return datetime.datetime.fromisoformat(text)


def read_rows(path):
    rows = []
    for line in open(path, encoding="utf-8"):
        tag, time, value, quality = line.rstrip("\n").split("\t")
        rows.append({"tag": tag, "time": time_of(time), "value": float(value), "quality": int(quality)})
    return rows


def holds(row, column, operator, value):
    if operator == "IS NOT NULL":
        return True
    have, want = row[column], time_of(value) if column == "time" else value
    if operator == "=":
        return have == want
    return {">=": have >= want, "<=": have <= want, "<": have < want, ">": have > want}[operator]


def packets(data):
    size = 4088
    parts = [data[k : k + size] for k in range(0, len(data), size)] or [b""]
    out = b""
    for k, part in enumerate(parts):
        out += struct.pack(">BBHHBB", 4, k == len(parts) - 1, len(part) + 8, 1, k % 255 + 1, 0) + part
    return out


def long_text(text):
    return struct.pack("<H", len(text)) + text.encode("utf-16le")


def short_text(text):
    return struct.pack("B", len(text)) + text.encode("utf-16le")


def token(kind, body):
    return kind + struct.pack("<H", len(body)) + body


def done(status=0, rows=0):
    return b"\xfd" + struct.pack("<HHQ", status, 0xC1, rows)


def logged_in(tds):
    version = b"\x01" + tds[::-1] + short_text("Microsoft SQL Server") + b"\x0f\x00\x07\xd0"
    changes = token(b"\xe3", b"\x01" + short_text("plant") + short_text("master"))
    changes += token(b"\xe3", b"\x04" + short_text("4096") + short_text("4096"))
    return changes + token(b"\xad", version) + done()


def error(words):
    body = struct.pack("<IBB", 102, 1, 15) + long_text(words) + short_text("fake") + short_text("")
    return token(b"\xaa", body + struct.pack("<I", 1)) + done(0x02)


def cell(kind, value):
    if kind == "time as text":
        return cell("tag", value.isoformat(" ", "microseconds") + "0")
    if kind == "tag":
        text = value.encode("utf-16le")
        return struct.pack("<H", len(text)) + text
    if kind == "time":
        since = value - value.replace(hour=0, minute=0, second=0, microsecond=0)
        ticks = (since.seconds * 1_000_000 + since.microseconds) * 10
        return b"\x08" + ticks.to_bytes(5, "little") + (value.toordinal() - 1).to_bytes(3, "little")
    return b"\x08" + struct.pack("<d", value) if kind == "value" else b"\x04" + struct.pack("<i", value)


def table(columns, kinds, rows):
    data = b"\x81" + struct.pack("<H", len(columns))
    for column, kind in zip(columns, kinds):
        data += struct.pack("<IH", 0, 1) + TYPES[kind] + short_text(column)
    for row in rows:
        data += b"\xd1" + b"".join(cell(kind, row[column]) for column, kind in zip(columns, kinds))
    return data + done(0x10, len(rows))


def plan():
    """What SHOWPLAN_ALL says of any statement: a hundred rows."""
    return table(["Parent", "EstimateRows"], ["quality", "value"], [{"Parent": 0, "EstimateRows": 100.0}])


def answer(sql, rows, time):
    found = SELECT.fullmatch(sql.strip())
    if not found:
        return error("Incorrect syntax") if "SELECT" in sql else done()
    where = found["where"] or ""
    if CONDITION.sub("", where):
        return error("Incorrect syntax near " + CONDITION.sub("", where))
    for column, operator, value in CONDITION.findall(where):
        value = value.replace("''", "'")
        rows = [row for row in rows if holds(row, column, operator, value)]
    if found["order"]:
        rows = sorted(rows, key=lambda row: row["time"], reverse="DESC" in found["order"])
    columns = re.findall(r"\w+", found["columns"])
    kinds = [time if column == "time" else column for column in columns]
    return table(columns, kinds, rows)


def receive(client):
    """Type and content of a message; None at the end."""
    content, last = b"", False
    while not last:
        try:
            head = client.recv(8, socket.MSG_WAITALL)
        except ConnectionResetError:
            return None
        if len(head) < 8:
            return None
        kind, status, length = struct.unpack(">BBH", head[:4])
        content += client.recv(length - 8, socket.MSG_WAITALL)
        last = status & 1
    return kind, content


def serve(client, rows, batches):
    time, explains = "time", False
    while message := receive(client):
        kind, content = message
        if kind == 0x12:  # no encryption
            reply = b"\x00\x00\x0b\x00\x06\x01\x00\x11\x00\x01\xff\x0f\x00\x07\xd0\x00\x00\x02"
        elif kind == 0x10:
            time = "time as text" if content[7] < 0x73 else "time"
            reply = logged_in(content[4:8])
        else:
            sql = content[struct.unpack("<I", content[:4])[0] :].decode("utf-16le")
            batches.write(sql.strip().replace("\n", " ") + "\n")
            batches.flush()
            if "SHOWPLAN_ALL" in sql:
                explains = sql.strip().endswith("ON")
            reply = plan() if explains and "SELECT" in sql else answer(sql, rows, time)
        client.sendall(packets(reply))


def main():
    rows, folder = read_rows(sys.argv[1]), sys.argv[2]
    listener = socket.create_server(("127.0.0.1", 0))
    batches = open(folder + "/batches", "w", encoding="utf-8")
    with open(folder + "/port", "w", encoding="utf-8") as port:
        port.write(str(listener.getsockname()[1]) + "\n")
    while True:
        client, _ = listener.accept()
        threading.Thread(target=serve, args=(client, rows, batches), daemon=True).start()


main()
