"""Sends the page for acknowledging what nobody should, and what somebody may.

usage: hostile_forms.py off|on PORT ORIGIN CONNECTION ENGINEER

PORT: of the daemon's pages on 127.0.0.1, which trusts 127.0.0.2 alone and is seen under ORIGIN.
CONNECTION: of a superuser who sees the table of annotations; ENGINEER: the login of the daemon.
Fails when a request that is to change nothing changes a row of it.
"""
import html
import re
import socket
import subprocess
import sys
import threading
import time
import urllib.parse

from running_parts import require_harmless

TRUSTED, OTHER = "127.0.0.2", "127.0.0.1"
FORM = "application/x-www-form-urlencoded"
EVIL = "<script>alert(1)</script>\"><img src=x onerror=alert(1)>'; DROP TABLE loopscope.annotation; --"
EVIL_SHOWN = html.escape(EVIL).replace("&#x27;", "&#39;")
MODE, PORT, ORIGIN, CONNECTION, ENGINEER = sys.argv[1:]


def require(condition, words):
    if not condition:
        raise AssertionError(words)


psql = subprocess.Popen(["psql", "-XAtq", "-d", CONNECTION], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)


def sql(statement):
    psql.stdin.write(statement + ";\n\\echo ~\n")
    psql.stdin.flush()
    return "".join(iter(psql.stdout.readline, "~\n")).strip()


def state():
    return sql("SELECT count(*) || ' ' || coalesce(md5(string_agg(said::text, '|' ORDER BY annotation_id)), '')"
               " FROM loopscope.annotation AS said")


def send(data, source=TRUSTED, wait=10.0):
    """Status (0 = nothing), head and body of what comes back."""
    with socket.create_connection(("127.0.0.1", int(PORT)), timeout=wait, source_address=(source, 0)) as peer:
        answer = b""
        try:
            peer.sendall(data)
            while part := peer.recv(65536):
                answer += part
        except (ConnectionError, socket.timeout):
            pass
    head, _, body = answer.partition(b"\r\n\r\n")
    return int(head.split()[1]) if head else 0, head.decode("latin-1"), body.decode("utf-8", "replace")


def request(method, target, lines, body=b""):
    head = [f"{method} {target} HTTP/1.1", f"Host: 127.0.0.1:{PORT}"] + lines
    return "\r\n".join(head).encode("utf-8", "surrogateescape") + b"\r\n\r\n" + body


def fields(token, **more):
    return {"token": token, "name": "FIC101", "deed": "acknowledge", "code": "", "reason": "seen", "until": "",
            **more}


def user_line(user="anna"):
    return [f"X-Remote-User: {user}"]


def post(form, user="anna", origin=ORIGIN, more=(), source=TRUSTED, kind=FORM, length=True, method="POST"):
    body = form if isinstance(form, bytes) else urllib.parse.urlencode(form).encode()
    lines = (user_line(user) if user else []) + ([f"Origin: {origin}"] if origin else [])
    lines += [f"Content-Type: {kind}"] if kind else []
    lines += [f"Content-Length: {len(body)}"] if length else []
    return send(request(method, "/annotate", lines + list(more), body), source)


def page(name="FIC101", user="anna", more=()):
    return send(request("GET", "/annotate?name=" + urllib.parse.quote(name, safe=""), user_line(user) + list(more)))


def loop_page(source, lines=()):
    while (answer := send(request("GET", "/loop?name=FIC101", list(lines)), source))[0] == 503:
        time.sleep(1)
    require(answer[0] == 200, f"the loop's page: {answer[0]}")
    return answer[2]


def token(name="FIC101", user="anna"):
    return token_of(page(name, user))


def token_of(answer):
    return re.search(r'name="token" value="([0-9a-f]{64})"', answer[2]).group(1)


def unchanged(words, wanted, answer, text=""):
    """A request that is to be refused with one of these statuses, and to leave every row as it is."""
    status, head, body = answer
    require(status == wanted or isinstance(wanted, tuple) and status in wanted,
            f"{words}: {status}, not {wanted}: {head}\n{body[:2000]}")
    require(text in body, f"{words}: does not say {text!r}: {body[:3000]}")
    require(state() == unchanged.before, f"{words}: changed the annotations")


def slow_body():
    """Half a form, then silence: it is closed, and nothing of it counts."""
    lines = user_line() + [f"Origin: {ORIGIN}", f"Content-Type: {FORM}", "Content-Length: 60"]
    begun = time.monotonic()
    answer = send(request("POST", "/annotate", lines, b"token=0"), wait=20.0)
    slow_body.found = answer[0], time.monotonic() - begun


def everything_off():
    lines = user_line() + [f"Origin: {ORIGIN}"]
    unchanged("while off", 404, send(request("GET", "/annotate?name=FIC101", lines)))
    for method in ("POST", "PUT", "DELETE", "PATCH", "OPTIONS"):
        for target in ("/annotate", "/annotate?name=FIC101&deed=acknowledge&reason=x", "/loop?name=FIC101", "/"):
            body = urllib.parse.urlencode(fields("0" * 64)).encode()
            head = lines + [f"Content-Type: {FORM}", f"Content-Length: {len(body)}"]
            answer = send(request(method, target, head, body))
            unchanged(f"{method} {target} while off", 405, answer)
            require("\r\nAllow: GET, HEAD" in answer[1] and "POST" not in answer[1], answer[1])
    require("/annotate" not in loop_page(TRUSTED, lines), "the loop's page has a link")


def who_asks():
    form = fields(token())
    unchanged("from another address", 403, post(form, source=OTHER), "proxy that signs people in")
    unchanged("from another address, forwarded", 403,
              post(form, source=OTHER, more=["X-Forwarded-For: 127.0.0.2", "Forwarded: for=127.0.0.2",
                                             "X-Real-IP: 127.0.0.2"]))
    unchanged("page from another address", 403, send(request("GET", "/annotate?name=FIC101", user_line()), OTHER))
    unchanged("nobody named", 403, post(form, user=None), "did not say")
    unchanged("nobody named on the page", 403, send(request("GET", "/annotate?name=FIC101", [])))
    unchanged("two users", 403, post(form, more=user_line("eve")))
    for name, wanted in (("", 403), ("a\x01b", (400, 403)), ("a\rb", 400), ("a\nb", 400), ("a\0b", 400),
                         ("\udcc0\udca7", 403), ("\udcff", 403), ("\u202eeve", 403), ("a\u200bb", 403),
                         ("n" * 101, 403), ("n" * 10240, 403), ("n" * 20000, 431), ("\x1b[2J", (400, 403))):
        unchanged(f"user {name[:20]!r}", wanted, post(form, user=name) if name else
                  send(request("POST", "/annotate", ["X-Remote-User:", f"Origin: {ORIGIN}"])))
    unchanged("another host", 421, send(request("POST", "/annotate", user_line()).replace(b"127.0.0.1", b"evil.test")))


def where_from():
    form = fields(token())
    for origin in (None, "null", "https://evil.example", ORIGIN + ".evil.example", ORIGIN + "/", ORIGIN.upper()):
        unchanged(f"origin {origin}", 403, post(form, origin=origin), "did not come from a page")
    unchanged("two origins", 403, post(form, more=[f"Origin: {ORIGIN}"]))
    for site in ("cross-site", "same-site", "none", "same-origin\r\nSec-Fetch-Site: cross-site"):
        unchanged(f"site {site}", 403, post(form, more=[f"Sec-Fetch-Site: {site}"]))
    unchanged("as a frame", 403, page(more=["Sec-Fetch-Dest: iframe"]), "no part of another")
    unchanged("token of nobody", 403, post(fields("")), "too old")
    unchanged("token that is guessed", 403, post(fields("0" * 64, reason=EVIL)), EVIL_SHOWN)
    unchanged("token of another user", 403, post(fields(token(user="ben"))))
    unchanged("token of another loop", 403, post(fields(token("PIC200"))))


def what_is_sent():
    form = fields(token())
    query = urllib.parse.urlencode(form)
    for method in ("GET", "HEAD", "PUT", "DELETE", "PATCH", "OPTIONS"):
        unchanged(f"{method} with all fields", 200 if method in ("GET", "HEAD") else 405,
                  send(request(method, "/annotate?" + query, user_line() + [f"Origin: {ORIGIN}"])))
    unchanged("fields in the query", 404, send(request("POST", "/annotate?" + query, user_line() + [
        f"Origin: {ORIGIN}", f"Content-Type: {FORM}", "Content-Length: 0"])))
    for kind in ("text/plain", "multipart/form-data; boundary=x", "application/json", FORM + "x", None):
        unchanged(f"body of {kind}", 415, post(form, kind=kind))
    unchanged("no length", 411, post(form, length=False))
    unchanged("chunked", 411, post(b"0\r\n\r\n", length=False, more=["Transfer-Encoding: chunked"]))
    unchanged("chunked and length", 400, post(form, more=["Transfer-Encoding: chunked"]))
    unchanged("two lengths", 400, post(form, more=["Content-Length: 5"]))
    unchanged("lengths in a list", 400, post(form, length=False, more=["Content-Length: 5, 5"]))
    for length in ("-1", "+5", "0x10", "", "5 5", "99999999999999999999999"):
        unchanged(f"length {length!r}", (400, 411, 413), post(form, length=False, more=["Content-Length: " + length]))
    unchanged("100 kB", 413, post(fields(form["token"], reason="x" * 100_000)))
    unchanged("unknown expectation", 417, post(form, more=["Expect: 200-ok"]))
    unchanged("a field twice", 400, post((query + "&reason=b").encode()))
    unchanged("no text", 400, post((query + "&x=%ff").encode()))
    unchanged("zero byte", 400, post((query + "&x=%00").encode()))


def what_is_refused():
    for more, words in (({"until": "2020-01-01T00:00", "deed": "suppress"}, "has passed"),
                        ({"until": "soon", "deed": "suppress"}, "is not a time"),
                        ({"until": "", "deed": "suppress"}, "choose the time until which it is off the list"),
                        ({"reason": "  "}, "the reason is empty"), ({"reason": "\u00fc" * 501}, "it has 501 characters"),
                        ({"until": "2199-01-01T00:00"}, "a suppression alone"),
                        ({"deed": "drop"}, "nothing was chosen"),
                        ({"code": "valve_sticktion"}, "is not the verdict of a fault"),
                        ({"deed": "withdraw", "annotation": "99999999"}, "does not hold any more")):
        answer = post(fields(token(), **more))
        unchanged(f"refused: {more}"[:80], 422, answer, words)
        require("`" not in answer[2] and "--" not in answer[2].split("</style>")[-1], f"{more}: names a command line")
    for number in ("-1", "1 OR 1=1", "1e3"):
        unchanged(f"annotation {number}", 400, post(fields(token(), deed="withdraw", annotation=number)))
    answer = post(fields(token(), deed="suppress", reason=EVIL, until="soon"))
    unchanged("what is typed stays", 422, answer, EVIL_SHOWN)
    require_harmless(answer[2], "what is typed")
    for name in ("no such loop", "", "a\nb", EVIL + "x"):
        status, _, body = page(name)
        require(status == 404, f"page of {name!r}: {status}")
        require_harmless(body, name)


def require_done(answer, target):
    status, head, body = answer
    there = f"\r\nLocation: {target}\r\n" in head + "\r\n"
    require(status == 303 and there, f"{status}, not 303 to {target}: {head} {body}")


def what_is_done():
    status, head, body = page()
    require("Referrer-Policy: same-origin" in head and "no-store" in head and "frame-ancestors 'none'" in head, head)
    require("Signed in as <bdi>anna</bdi>" in body and "Valve stiction" in body, body)
    require("Withdraw" not in loop_page(OTHER), "something holds already")
    first, second = token(), token(user="ben")
    require_done(post(fields(first, reason=EVIL), more=["Sec-Fetch-Site: same-origin", "Expect: 100-continue"]),
                 "/loop?name=FIC101")
    require(sql("SELECT kind || code || author || on_behalf_of || reason FROM loopscope.annotation_in_force"
                " WHERE loop_name = 'FIC101'") == "acknowledgedvalve_stiction" + ENGINEER + "anna" + EVIL, state())
    body = loop_page(OTHER)
    require(EVIL_SHOWN in body and "Withdraw" in body, "the loop's page does not show it at once")
    require_harmless(body, "the loop's page", scripts=2)
    unchanged.before = state()
    unchanged("token used again", 403, post(fields(first)), "used already")
    require_done(post(fields(second), user="ben"), "/annotate?name=FIC101")
    require(send(request("HEAD", "/annotate?name=FIC101", user_line("ben")))[0] == 200, "HEAD")
    _, _, body = page(user="ben")
    require("Takes the place of what was in force already: acknowledged by anna (login " in body, body)
    require_harmless(body, "whose it replaces")
    require("Takes the place of what was in force" not in page(user="ben")[2], "it is told twice")


def what_comes_after():
    unchanged.before = state()
    number = re.search(r'name="annotation" value="(\d+)"', page()[2]).group(1)
    unchanged("withdrawn of another loop", 422,
              post(fields(token("PIC200"), name="PIC200", deed="withdraw", annotation=number)))
    form = urllib.parse.urlencode(fields(token(), deed="withdraw", annotation=number)).encode()
    again = urllib.parse.urlencode(fields(token(), reason="pipelined")).encode()
    lines = user_line() + [f"Origin: {ORIGIN}", f"Content-Type: {FORM}"]
    both = b"".join(request("POST", "/annotate", lines + [f"Content-Length: {len(body)}"], body)
                    for body in (form, again))
    require_done(send(both), "/loop?name=FIC101")
    require(sql("SELECT withdrawn_on_behalf_of FROM loopscope.annotation_history"
                " WHERE annotation_id = " + number) == "anna", "who withdrew it")
    require(sql("SELECT count(*) FROM loopscope.annotation WHERE reason = 'pipelined'") == "0", "pipelined")
    eve = "<b>eve</b>"
    answer = post(fields(token(EVIL, eve), name=EVIL, deed="false-positive", code="any"), eve)
    require(answer[0] == 303, answer[2])
    require_harmless(page(EVIL, eve)[2], "hostile names")
    unchanged.before = state()
    late = fields(token(), reason="kept")
    sql(f"ALTER ROLE {ENGINEER} NOLOGIN")
    unchanged("no database", 503, post(late), 'value="kept"')
    sql(f"ALTER ROLE {ENGINEER} LOGIN")


def too_much():
    answers = [page(user="script")]
    for _ in range(31):
        answers.append(post(fields(token_of(answers[-1]), deed="none"), user="script"))
    require([answer[0] for answer in answers] == [200] + [422] * 30 + [429], "a script is not held up")
    require("Retry-After: 60" in answers[-1][1] and 'value="seen"' in answers[-1][2], answers[-1][1])
    require(post(fields(token(user="ben")), user="ben")[0] == 303, "another user is held up")


def what_is_locked():
    """Entered, though the loop's page cannot be asked for afterwards."""
    form = fields(token("PIC200", "carl"), name="PIC200", deed="suppress", code="any", until="2199-01-01T00:00")
    sql("BEGIN; LOCK TABLE loopscope.verdict IN ACCESS EXCLUSIVE MODE")
    answer = post(form, user="carl")
    sql("COMMIT")
    require_done(answer, "/annotate?name=PIC200")
    require(sql("SELECT on_behalf_of FROM loopscope.annotation_in_force WHERE loop_name = 'PIC200'") == "carl", state())
    require("Entered: suppressed, whatever the verdict, until 2199-01-01 00:00 UTC." in page("PIC200", "carl")[2],
            "what was entered is not told")


unchanged.before = state()
if MODE == "off":
    everything_off()
else:
    slow = threading.Thread(target=slow_body)
    slow.start()
    for part in (who_asks, where_from, what_is_sent, what_is_refused):
        part()
    slow.join()
    require(slow_body.found[0] == 0 and slow_body.found[1] < 12, f"slow body: {slow_body.found}")
    what_is_done()
    what_comes_after()
    too_much()
    what_is_locked()
print("done")
