#!/usr/bin/python3
"""What the daemon's pages do in a crowd: readers ask for every page with every Accept-Encoding,
slow clients hang, and one prober measures how long /livez and /metrics take.

  crowd.py ADDRESS:PORT [--readers N] [--slow N] [--seconds N] [--page PATH]...

Prints one JSON object. Readers, slow clients and prober are processes of their own, so that none
waits for another's interpreter.
"""

import argparse
import collections
import json
import multiprocessing
import select
import socket
import sys
import threading
import time

PROBED = ("/livez", "/metrics")
PROBE_EVERY_S = 0.02
# A probe that takes longer counts as unanswered.
PATIENCE_S = 20
# None: no such header. Among them those that refuse what a server would rather send.
ENCODINGS = (None, "", "identity", "gzip", "br", "deflate", "gzip, deflate, br", "*", "gzip;q=0",
             "br;q=1.0, gzip;q=0.8, *;q=0.1", "identity;q=0, gzip", "identity;q=0", "*;q=0")
# A reader that is told to come again does so, but does not spin.
PAUSE_AFTER_REFUSAL_S = 0.1


def request(path, encoding=None):
    accept = "" if encoding is None else f"Accept-Encoding: {encoding}\r\n"
    return f"GET {path} HTTP/1.1\r\nHost: localhost\r\n{accept}\r\n".encode()


def status_of(address, wanted):
    """Sends the request and reads the whole answer; its status and size, or None."""
    try:
        with socket.create_connection(address, PATIENCE_S) as connection:
            connection.sendall(wanted)
            head = connection.recv(65536)
            size = len(head)
            while piece := connection.recv(65536):
                size += len(piece)
            return (int(head.split(b" ", 2)[1]), size) if head else None
    except (OSError, ValueError, IndexError):
        return None


def read_pages(address, pages, number, end, found):
    turn = number
    while time.monotonic() < end:
        encoding = ENCODINGS[turn % len(ENCODINGS)]
        answer = status_of(address, request(pages[turn // len(ENCODINGS) % len(pages)], encoding))
        found[str(answer[0]) if answer else "none"] += 1
        found["bytes"] += answer[1] if answer else 0
        if not answer or answer[0] != 200:
            time.sleep(PAUSE_AFTER_REFUSAL_S)
        turn += 1


def readers(address, pages, count, seconds, results):
    found = collections.Counter()
    end = time.monotonic() + seconds
    threads = [threading.Thread(target=read_pages, args=(address, pages, number, end, found))
               for number in range(count)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    results.put(dict(found))


def slow_client(address, page, number):
    """Says nothing; half a request; a request whose answer it never reads."""
    connection = socket.create_connection(address, PATIENCE_S)
    connection.sendall((b"", b"GET /livez HTTP/1.1\r\nX-Slow: ", request(page))[number % 3])
    return connection


def slow_clients(address, page, count, ready, done):
    """Holds the number open: what the server closes is opened again."""
    poll, held = select.poll(), {}

    def add(number):
        client = slow_client(address, page, number)
        held[client.fileno()] = (client, number)
        poll.register(client, select.POLLRDHUP)

    for number in range(count):
        add(number)
    ready.set()
    while not done.is_set():
        for descriptor, _ in poll.poll(50):
            client, number = held.pop(descriptor)
            poll.unregister(descriptor)
            client.close()
            add(number)


def probe(address, seconds):
    taken = {path: [] for path in PROBED}
    unanswered = 0
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        for path in PROBED:
            start = time.monotonic()
            answer = status_of(address, request(path))
            taken[path].append(1e3 * (time.monotonic() - start))
            unanswered += 0 if answer and answer[0] in (200, 503) else 1
            time.sleep(PROBE_EVERY_S)
    return {"unanswered": unanswered,
            **{f"{path[1:]}_ms": summary(sorted(taken[path])) for path in PROBED}}


def summary(times):
    at = lambda share: times[min(len(times) - 1, int(share * len(times)))]
    return {"probes": len(times), "p50": at(0.5), "p90": at(0.9), "p99": at(0.99), "max": times[-1]}


def measure(address, pages, reader_count, slow_count, seconds):
    """What a prober finds for so many seconds beside so many readers and slow clients."""
    results, ready, done = multiprocessing.Queue(), multiprocessing.Event(), multiprocessing.Event()
    slow = multiprocessing.Process(target=slow_clients, daemon=True,
                                   args=(address, pages[0], slow_count, ready, done))
    slow.start()
    if not ready.wait(60):
        raise RuntimeError("the slow clients cannot connect")
    reading = multiprocessing.Process(target=readers, daemon=True,
                                      args=(address, pages, reader_count, seconds, results))
    reading.start()
    found = probe(address, seconds)
    found["pages"] = results.get(timeout=3 * PATIENCE_S)
    done.set()
    reading.join()
    slow.join()
    return {"readers": reader_count, "slow": slow_count, **found}


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("address", help="ADDRESS:PORT")
    parser.add_argument("--readers", type=int, default=50)
    parser.add_argument("--slow", type=int, default=200)
    parser.add_argument("--seconds", type=float, default=20)
    parser.add_argument("--page", action="append", help="path that readers ask for (/loops, /)")
    options = parser.parse_args()
    host, port = options.address.rsplit(":", 1)
    json.dump(measure((host, int(port)), options.page or ["/loops", "/"], options.readers,
                      options.slow, options.seconds), sys.stdout)


if __name__ == "__main__":
    main()
