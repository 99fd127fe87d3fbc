"""Reads the report and the live pages as people do: in Chromium, without a screen.

usage: read_pages.py PAGE.html LIVE_URL SCREENSHOT_FOLDER

Fails when a page says something on the console, asks for anything outside of itself, is wider than
its window, lacks a picture, or cannot be sorted and filtered.
"""
import json
import shutil
import sys
import tempfile
from pathlib import Path

from selenium import webdriver
from selenium.common.exceptions import WebDriverException
from selenium.webdriver.chrome.service import Service
from selenium.webdriver.common.by import By
from selenium.webdriver.support.ui import WebDriverWait

from read_trend import require, require_trend

WINDOWS = {"desktop": (1440, 900), "phone": (390, 844)}
FLAGS = ["--headless", "--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run",
         "--disable-background-networking", "--disable-component-update", "--disable-sync",
         "--disable-dev-shm-usage", "--hide-scrollbars"]

# Of a page that the server makes behind whoever analyses: until then it answers 503 every 4 s, and
# the browser asks again by itself.
COME_AGAIN = 503
PATIENCE_S = 120
PATIENCE = 10


class Reader:
    def __init__(self, profile, flags=()):
        options = webdriver.ChromeOptions()
        options.binary_location = shutil.which("chromium")
        for flag in [*FLAGS, *flags, "--user-data-dir=" + profile]:
            options.add_argument(flag)
        options.set_capability("goog:loggingPrefs", {"browser": "ALL", "performance": "ALL"})
        self.driver = webdriver.Chrome(service=Service(shutil.which("chromedriver")), options=options)
        self.driver.set_page_load_timeout(120)

    def open(self, url, window):
        # A window has a least width; the page is told another one.
        width, height = WINDOWS[window]
        self.driver.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", {
            "width": width, "height": height, "deviceScaleFactor": 1, "mobile": window == "phone"})
        complaints = self.load(url)
        for _ in range(PATIENCE):
            if not any(f"status of {COME_AGAIN}" in words for words in complaints):
                break
            # The page that asked to come again has no icon, and is not what is read here: the one
            # that came is at hand.
            complaints = self.load(url)
        require(not complaints, f"{url}: the console says {complaints}")
        asked = list(self.requests())
        require(asked == [url], f"{url} asks for {asked}")
        self.require_width(url, window)

    def load(self, url):
        """What is said on the console until the page is there."""
        self.driver.get_log("browser")
        self.driver.get_log("performance")
        self.driver.get(url)
        self.arrive(lambda address: address == url, url)
        return self.complaints()

    def arrive(self, is_right, words):
        """Waits until a page at an address that is_right is there whole, and is not the one that
        asks to come again. No element of the page before is looked at: between two pages such a
        question fails in many ways."""
        def arrived(_):
            try:
                state, status, address = self.run(
                    "[document.readyState, "
                    "performance.getEntriesByType('navigation')[0].responseStatus, location.href]")
            except WebDriverException:  # between two pages
                return False
            return state == "complete" and status != COME_AGAIN and is_right(address)

        WebDriverWait(self.driver, PATIENCE_S).until(arrived, f"{words} does not come")

    def complaints(self):
        """What was said on the console since it was asked."""
        return [entry["message"] for entry in self.driver.get_log("browser")]

    def requests(self):
        for entry in self.driver.get_log("performance"):
            message = json.loads(entry["message"])["message"]
            if message["method"] == "Network.requestWillBeSent":
                url = message["params"]["request"]["url"]
                if not url.startswith("data:"):
                    yield url

    def run(self, script, *arguments):
        return self.driver.execute_script("return " + script, *arguments)

    def require_width(self, url, window):
        wide = self.run("document.documentElement.scrollWidth")
        require(wide <= WINDOWS[window][0], f"{url} is {wide} wide on a {window}")

    def shoot(self, file):
        self.driver.save_screenshot(str(file))

    def all(self, selector):
        return self.driver.find_elements(By.CSS_SELECTOR, selector)


def require_pictures(reader, place):
    for section in reader.all("section.loop"):
        name = section.find_element(By.CSS_SELECTOR, "h2").text
        images = section.find_elements(By.CSS_SELECTOR, "img")
        require(len(images) >= 6, f"{place}: {name} has {len(images)} pictures")
        for image in images:
            drawn = reader.run("arguments[0].complete && arguments[0].naturalWidth > 0", image)
            require(drawn, f"{place}: {name}: {image.get_attribute('alt')} is not drawn")
            require(image.get_attribute("alt"), f"{place}: {name}: a picture without words")


def column(reader, number):
    return reader.run("Array.from(document.querySelectorAll('table.sortable tbody tr'))"
                      ".map(r => r.cells[arguments[0]]).map(c => c.dataset.sort === undefined ? "
                      "c.textContent.trim() : Number(c.dataset.sort))", number)


def require_sorting(reader, place):
    headers = reader.all("table.sortable th button")
    require(headers, f"{place}: nothing can be sorted")
    for number, header in enumerate(headers):
        header.click()
        rising = column(reader, number)
        header.click()
        falling = column(reader, number)
        if all(isinstance(value, (int, float)) for value in rising):
            require(rising == sorted(rising), f"{place}: column {number} does not rise: {rising}")
            require(falling == sorted(falling, reverse=True), f"{place}: column {number} falls: {falling}")
        require(sorted(map(str, rising)) == sorted(map(str, falling)), f"{place}: rows are lost")
    headers[0].click()


def require_order_of_cards(reader, place):
    """On a phone: the first column falling, then rising."""
    require(reader.all(".sorter select")[0].is_displayed(), f"{place}: no order to choose")

    def order(number):
        # A tap on a phone's list is its own program's: what the page is told of it is this.
        reader.driver.execute_script(
            "const list = document.querySelector('.sorter select'); list.selectedIndex = arguments[0];"
            "list.dispatchEvent(new Event('input', {bubbles: true}));", number)
        return column(reader, 0)

    falling, rising = order(2), order(1)
    require(rising == falling[::-1], f"{place}: cards in order {falling}, then {rising}")


def names(reader):
    return reader.run("Array.from(document.querySelectorAll("
                      "'table.loops td.loop-name bdi:first-of-type')).map(b => b.textContent)")


def go(reader, element):
    """To the page that the element leads to, which has another address."""
    before = reader.run("location.href")
    element.click()
    reader.arrive(lambda address: address != before, f"the page behind {before}")


def ask(reader, name, value):
    """Takes a choice of the form of /loops and sends it."""
    field = reader.all(f"form.filters [name={name}]")[0]
    if field.tag_name == "select":
        reader.run("arguments[0].value = arguments[1]", field, value)
    else:
        field.send_keys(value)
    go(reader, reader.all("form.filters button")[0])


def require_questions(reader, base):
    """Order and choice of /loops are the server's, on a phone as well."""
    reader.open(base + "/loops", "desktop")
    header = "table.loops th:first-child a"
    go(reader, reader.all(header)[0])
    rising = names(reader)
    require(rising == sorted(rising, key=str.lower) and len(rising) > 2, f"/loops by name: {rising}")
    go(reader, reader.all(header)[0])
    require(names(reader) == rising[::-1], f"/loops backwards: {names(reader)}")
    reader.open(base + "/loops", "phone")
    ask(reader, "state", "flagged")
    some = names(reader)
    require(0 < len(some) < len(rising), f"/loops that are flagged: {some}")
    ask(reader, "q", some[0])
    require(names(reader) == [some[0]], f"/loops with {some[0]}: {names(reader)}")
    ask(reader, "q", " nowhere")
    require(not names(reader) and reader.all("main .note a"), "/loops: something fits what does not")


def shown(reader):
    return len([row for row in reader.all("table.filterable tbody tr") if row.is_displayed()])


def require_filtering(reader, place):
    rows = shown(reader)
    search = reader.all(".filters input")[0]
    search.send_keys("stiction")
    some = shown(reader)
    require(0 < some < rows, f"{place}: the filter shows {some} of {rows}")
    search.send_keys(" nowhere")
    require(shown(reader) == 0, f"{place}: the filter shows what does not fit")
    search.clear()
    search.send_keys(" ")
    require(shown(reader) == rows, f"{place}: the filter does not give back its rows")
    verdict = reader.all(".filters select")[0].find_elements(By.CSS_SELECTOR, "option")[1]
    verdict.click()
    require(0 < shown(reader) <= rows, f"{place}: no row has the verdict {verdict.text}")
    reader.all(".filters select")[0].find_elements(By.CSS_SELECTOR, "option")[0].click()


def read_static(reader, url, folder):
    for window in WINDOWS:
        reader.open(url, window)
        require_pictures(reader, "report on a " + window)
        reader.shoot(folder / f"report_{window}.png")
    require_order_of_cards(reader, "report")
    reader.open(url, "desktop")
    require_sorting(reader, "report")
    require_filtering(reader, "report")
    require(reader.all("section.loop"), "the report tells of no loop")
    for link in reader.all("table.ranking td.loop-name a"):
        target = link.get_attribute("href").split("#")[1]
        require(reader.all("#" + target), f"no section {target}")


def read_live(reader, base, folder):
    for window in WINDOWS:
        for path in ["/", "/loops"]:
            reader.open(base + path, window)
            reader.shoot(folder / f"live_{path.strip('/') or 'plant'}_{window}.png")
    require_questions(reader, base)
    reader.open(base + "/", "desktop")
    require_filtering(reader, "/")
    links = [link.get_attribute("href") for link in reader.all("table.ranking td.loop-name a")]
    require(links, "the plant's page links to no loop")
    for number, link in enumerate(links):
        for window in WINDOWS:
            reader.open(link, window)
            require_pictures(reader, link)
            if number == 0:
                require_trend(reader, link, window, folder)
    reader.shoot(folder / "live_loop_phone.png")


def main():
    page, base, folder = sys.argv[1], sys.argv[2], Path(sys.argv[3])
    folder.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory() as profile:
        reader = Reader(profile)
        try:
            read_static(reader, Path(page).resolve().as_uri(), folder)
            read_live(reader, base, folder)
        finally:
            reader.driver.quit()
    print("read")


if __name__ == "__main__":
    main()
