"""What pages of a large catalogue take, and /livez and /metrics while people read them and others hang.

A daemon over some thousands of judged loops: first its pages one after the other, right after its
start and later; `tests/support/crowd.py` plays the readers, the slow
clients and the prober. Each crowd is measured twice: while the daemon rests, and while it analyses
all loops again on every core.
"""

import argparse
import json
import os
import socket
import sys
import time
import urllib.error
import urllib.request

import plant
from builds import OURS, Build, RunningProgram, say

sys.path.insert(0, str(plant.SOURCE_DIR / "tests/support"))
import crowd  # noqa: E402

PAGES = ("/", "/loops", "/loops?state=flagged", "/loops?order=name&dir=desc&page=20", "/loops?q=c12",
         "/loop?name=FC0")
CROWDS = ((0, 0), (50, 0), (0, 200), (50, 200))
BOUND_MS = 100  # of /livez at the 99th percentile
BOUND_PAGE_S, BOUND_PAGE_BYTES = 0.3, 200_000  # of a page of the plant, once the daemon has begun
SETTLED_S = 60
TODAY = "date_trunc('day', now())"


def free_port():
    with socket.socket() as listener:
        listener.bind(("127.0.0.1", 0))
        return listener.getsockname()[1]


def serve(results, port):
    """Starts the daemon with its pages at the port."""
    settings = json.loads(results.settings.read_text())
    settings["daemon"] = {"http_address": f"127.0.0.1:{port}"}
    results.settings.write_text(json.dumps(settings))
    daemon = RunningProgram(results.build.program, "run", "--config", results.settings)
    while crowd.status_of(("127.0.0.1", port), crowd.request("/livez")) is None:
        if daemon.ended():
            raise RuntimeError("loopscope run ended by itself")
        time.sleep(0.2)
    return daemon


def judge_all(results):
    """Waits until every loop has a verdict."""
    while int(results.sql("SELECT count(*) FROM loopscope.schedule"
                          " WHERE last_slot_end IS NULL")[0][0]) > 0:
        time.sleep(1)


def analyse_again(results):
    """All loops are due that are not in hand, and what is stored of them no longer counts as done."""
    results.sql("""
        UPDATE loopscope.analysis SET input_digest = 'outdated' WHERE (loop_id, slot_end) IN
          (SELECT loop_id, slot_end FROM loopscope.analysis FOR UPDATE SKIP LOCKED);
        UPDATE loopscope.schedule SET visible_at = now() WHERE loop_id IN
          (SELECT loop_id FROM loopscope.schedule WHERE owner IS NULL FOR UPDATE SKIP LOCKED)""")


def read_page(port, path):
    """As a browser does: 503 asks to come again, and the wait counts."""
    begun = time.monotonic()
    while True:
        try:
            with urllib.request.urlopen(f"http://127.0.0.1:{port}{path}") as answer:
                body = answer.read()
            return {"path": path, "bytes": len(body), "s": time.monotonic() - begun}
        except urllib.error.HTTPError as refusal:
            if refusal.code != 503 or time.monotonic() - begun > 60:
                raise
            time.sleep(2)


def measure_pages(port):
    """The first page waits for the first reading of the results; the others are new to the server."""
    first = {**read_page(port, "/"), "path": "/, the first page after the start"}
    time.sleep(10)  # what is at hand is no longer
    return [first] + [read_page(port, path) for path in PAGES]


def measure_crowds(results, port, seconds):
    pages = ["/loops", "/", "/loop?name=FC0", "/loop?name=FC20", "/loop?name=FC40"]
    found = []
    for analysing in (False, True):
        for readers, slow in CROWDS:
            say(f"{readers} readers, {slow} slow clients, {'analysing' if analysing else 'at rest'} ...")
            if analysing:
                analyse_again(results)
            once = crowd.measure(("127.0.0.1", port), pages, readers, slow, seconds)
            say(f"/livez p99 {once['livez_ms']['p99']:.1f} ms")
            found.append({"analysing": analysing, **once})
    return found


def measure_readers(build, loops, seconds):
    with plant.Workshop() as shop:
        historian, server = shop.server(), shop.server()
        say(f"{loops} loops ...")
        plant.load_recordings(historian, build.program, plant.WINDOW)
        plant.make_history(historian)
        plant.add_history(historian, plant.RECORDINGS, 0, plant.WINDOW - 1, TODAY)
        plant.index_history(historian, covering=True)
        results = plant.Results(server, build, historian, shop.folder, loops,
                                plant.RECORDINGS, {"settle_s": SETTLED_S, "model_all_up_to": 0})
        port = free_port()
        daemon = serve(results, port)
        try:
            judge_all(results)
            daemon.stop()
            daemon.wait()
            daemon = serve(results, port)
            pages = measure_pages(port)
            crowds = measure_crowds(results, port, seconds)
        finally:
            daemon.stop()
        return {"loops": loops, "seconds": seconds, "pages": pages, "crowds": crowds,
                "daemon": daemon.wait()}


def table(found):
    lines = ["| page | kB | ms |", "|---|---|---|"]
    lines += [f"| `{one['path']}` | {one['bytes'] / 1e3:.0f} | {1e3 * one['s']:.1f} |"
              for one in found["pages"]]
    lines += ["", f"{found['loops']} loops, {found['seconds']:g} s each; ms",
             "| readers | slow | daemon | /livez p50 | p99 | max | /metrics p99 | unanswered |"
             " pages: 200 | 503 | 406 | none | MB |", "|" + "---|" * 13]
    for one in found["crowds"]:
        pages, livez = one["pages"], one["livez_ms"]
        counts = " | ".join(str(pages.get(key, 0)) for key in ("200", "503", "406", "none"))
        lines.append(f"| {one['readers']} | {one['slow']} |"
                     f" {'analyses' if one['analysing'] else 'rests'} | {livez['p50']:.1f} |"
                     f" {livez['p99']:.1f} | {livez['max']:.1f} | {one['metrics_ms']['p99']:.1f} |"
                     f" {one['unanswered']} | {counts} | {pages.get('bytes', 0) / 1e6:.0f} |")
    return "\n".join(lines)


def main():
    parser = argparse.ArgumentParser(prog="tests/bench/readers", description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--json", action="store_true", help="one JSON object")
    parser.add_argument("--loops", type=int, default=5000, help="of the catalogue (5000)")
    parser.add_argument("--seconds", type=float, default=20, help="of each crowd (20)")
    options = parser.parse_args()
    build = Build(OURS, os.environ.get("LOOPSCOPE_PROGRAM"))
    found = measure_readers(build, options.loops, options.seconds)
    print(json.dumps(found) if options.json else table(found))
    worst = max(one["livez_ms"]["p99"] for one in found["crowds"])
    if worst > BOUND_MS:
        say(f"/livez at the 99th percentile: {worst:.0f} ms, above {BOUND_MS}")
        sys.exit(1)
    too_much = [one for one in found["pages"][1:] if not one["path"].startswith("/loop?") and
                (one["bytes"] > BOUND_PAGE_BYTES or one["s"] > BOUND_PAGE_S)]
    if too_much:
        say(f"above {BOUND_PAGE_BYTES} bytes or {BOUND_PAGE_S} s: {too_much}")
        sys.exit(1)


if __name__ == "__main__":
    main()
