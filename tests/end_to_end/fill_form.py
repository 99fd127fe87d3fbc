"""Acknowledges a finding as people do: in Chromium, by way of a proxy that says who is signed in.

usage: fill_form.py LIVE_URL LOOP SCREENSHOT_FOLDER

The daemon trusts 127.0.0.1 and is seen as http://loopscope.localhost, where the browser finds the
proxy; http://evil.localhost is a page of somebody else's. Fails when the form does not do what it
says, or when that page gets anything done.
"""
import http.client
import sys
import tempfile
import threading
import urllib.parse
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path

from selenium.common.exceptions import StaleElementReferenceException, WebDriverException
from selenium.webdriver.support.expected_conditions import staleness_of
from selenium.webdriver.support.ui import WebDriverWait

from read_pages import WINDOWS, Reader, require

OURS, EVIL = "http://loopscope.localhost", "http://evil.localhost"
USER = "J. M\u00fcller <b>'\"&"
REASON = "order 4712 <script>alert(1)</script>\"'>"
TRAP = """<title>trap</title><form method="post" enctype="{kind}" action="{to}/annotate">
<input name="name" value="{loop}">
<input name="deed" value="false-positive"><input name="code" value="any"><input name="reason" value="trapped">
<button>Win</button></form>"""


class Proxy(BaseHTTPRequestHandler):
    """Signs everybody in as USER, whatever a browser says in that header."""
    daemon, loop, kind, no_referrer, posts = "", "", "", False, []

    def log_message(self, *_):
        pass

    def do_GET(self):
        if self.headers["Host"] == "evil.localhost":
            self.reply(200, [("Content-Type", "text/html")],
                       TRAP.format(kind=Proxy.kind, to=OURS, loop=Proxy.loop).encode())
        else:
            self.forward()

    def do_POST(self):
        Proxy.posts.append(dict(self.headers))
        self.forward()

    def forward(self):
        asked = http.client.HTTPConnection(Proxy.daemon, timeout=60)
        body = self.rfile.read(int(self.headers.get("Content-Length", 0)))
        kept = {name: value for name, value in self.headers.items()
                if name.lower() not in ("x-remote-user", "host", "connection", "accept-encoding")}
        asked.request(self.command, self.path, body or None,
                      {**kept, "Host": Proxy.daemon, "X-Remote-User": USER.encode("utf-8").decode("latin-1")})
        answer = asked.getresponse()
        text, lines = answer.read(), answer.getheaders()
        if Proxy.no_referrer:
            text = text.replace(b'content="same-origin"', b'content="no-referrer"')
            lines = [(name, "no-referrer" if name == "Referrer-Policy" else value) for name, value in lines]
        self.reply(answer.status, [line for line in lines if line[0] not in ("Connection", "Content-Length")], text)

    def reply(self, status, lines, body):
        self.send_response(status)
        for name, value in [*lines, ("Content-Length", str(len(body)))]:
            self.send_header(name, value)
        self.end_headers()
        self.wfile.write(body)


def go(reader, element):
    """To the page that comes of it, which may have the same address."""
    element.click()
    # While one page gives way to the next, chromedriver may know neither.
    patient = WebDriverWait(reader.driver, 60, ignored_exceptions=[WebDriverException])
    patient.until(staleness_of(element))
    patient.until(lambda _: reader.run("document.readyState") == "complete")


def enter(reader, deed, reason, until=None):
    reader.all(f"form.say input[value={deed}]")[0].click()
    field = reader.all("form.say input[name=reason]")[0]
    field.clear()
    field.send_keys(reason)
    if until:
        reader.driver.execute_script("arguments[0].value = arguments[1]",
                                     reader.all("form.say input[name=until]")[0], until)
    go(reader, reader.all("form.say button")[0])


def texts(reader, selector):
    return [element.text for element in reader.all(selector)]


def typed_reason(reader):
    return reader.all("form.say input[name=reason]")[0].get_attribute("value")


def acknowledge(reader, loop, folder):
    page = f"{OURS}/annotate?name={urllib.parse.quote(loop)}"
    for window in WINDOWS:
        reader.open(page, window)
        reader.driver.execute_script("document.querySelector('form.say').scrollIntoView()")
        reader.shoot(folder / f"annotate_{window}.png")
    reader.open(f"{OURS}/loop?name={urllib.parse.quote(loop)}", "desktop")
    go(reader, [link for link in reader.all("a") if link.text.startswith("Acknowledge")][0])
    require(USER in texts(reader, ".facts")[0], f"signed in as: {texts(reader, '.facts')}")
    enter(reader, "acknowledge", REASON)
    reached = reader.driver.current_url
    require(reached.startswith(OURS + "/loop?"), f"not at the loop's page: {reached}")
    # A busy server asks the browser to come again.
    WebDriverWait(reader.driver, 60, ignored_exceptions=[StaleElementReferenceException]).until(
        lambda _: any(USER in text and REASON in text for text in texts(reader, ".findings dd")),
        "the loop's page does not say it")
    reader.shoot(folder / "loop_acknowledged.png")
    sent = Proxy.posts[-1]
    require(sent["Origin"] == OURS and sent["Sec-Fetch-Site"] == "same-origin", f"{sent}")
    reader.open(page, "desktop")
    enter(reader, "suppress", "turnaround", "2020-01-01T00:00")
    require("has passed" in texts(reader, ".trouble")[0], "a time that has passed")
    require(typed_reason(reader) == "turnaround", "what was typed is lost")
    enter(reader, "suppress", "turnaround", "2199-01-01T00:00")
    require("Stands beside what is in force" in reader.all("main")[0].text, "what it stands beside is not told")
    for window in WINDOWS:
        reader.open(page, window)
        reader.shoot(folder / f"annotate_said_{window}.png")
    require(len(reader.all("table.annotated tbody tr")) == 2, "two hold")


def go_wrong(reader, loop, folder):
    """What a page of somebody else's sends, a page that is too old, and one under no-referrer."""
    for Proxy.kind in ("application/x-www-form-urlencoded", "text/plain", "multipart/form-data"):
        reader.driver.get(EVIL + "/")
        go(reader, reader.all("button")[0])
        require("nothing was entered" in reader.driver.page_source, f"trapped: {reader.driver.page_source}")
        require(Proxy.posts[-1]["Origin"] == EVIL, f"a foreign page sends {Proxy.posts[-1]}")
    page = f"{OURS}/annotate?name={urllib.parse.quote(loop)}"
    reader.driver.get(page)
    enter(reader, "false-positive", "once")
    reader.driver.back()
    reader.driver.execute_script("document.querySelector('form.say input[name=token]').value = '0'")
    enter(reader, "false-positive", "<i>kept</i>")
    require("too old" in texts(reader, ".trouble")[0], "an old page is taken")
    require(typed_reason(reader) == "<i>kept</i>", "typed text is lost")
    reader.shoot(folder / "annotate_too_old.png")
    Proxy.no_referrer = True
    reader.driver.get(page)
    enter(reader, "false-positive", "no referrer")
    Proxy.no_referrer = False
    require(Proxy.posts[-1]["Origin"] == "null" and "nothing was entered" in reader.driver.page_source,
            f"under no-referrer {Proxy.posts[-1]['Origin']} is sent")


def withdraw(reader, loop):
    page = f"{OURS}/annotate?name={urllib.parse.quote(loop)}"
    for left in (2, 1, 0):
        reader.driver.get(page)
        go(reader, reader.all("table.annotated button")[0])
        reader.driver.get(page)
        require(len(reader.all("table.annotated tbody tr")) == left, f"not {left} hold")


def main():
    Proxy.daemon, Proxy.loop, folder = sys.argv[1].removeprefix("http://"), sys.argv[2], Path(sys.argv[3])
    folder.mkdir(parents=True, exist_ok=True)
    server = ThreadingHTTPServer(("127.0.0.1", 0), Proxy)
    threading.Thread(target=server.serve_forever, daemon=True).start()
    with tempfile.TemporaryDirectory() as profile:
        reader = Reader(profile, [f"--host-resolver-rules=MAP *.localhost 127.0.0.1:{server.server_port}"])
        try:
            acknowledge(reader, Proxy.loop, folder)
            go_wrong(reader, Proxy.loop, folder)
            withdraw(reader, Proxy.loop)
        finally:
            reader.driver.quit()
    print("acknowledged")


if __name__ == "__main__":
    main()
