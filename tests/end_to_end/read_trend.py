"""Looks closer at the trend of a loop's live page, as people do: with mouse, keys and fingers."""
import base64
import json
import re
import struct
from datetime import datetime, timezone

from selenium.webdriver.common.action_chains import ActionChains
from selenium.webdriver.common.keys import Keys
from selenium.webdriver.support.ui import WebDriverWait


def require(condition, words):
    if not condition:
        raise AssertionError(words)


class Trend:
    def __init__(self, reader, place):
        self.reader, self.place = reader, place
        self.figure, self.canvas = (reader.all(name)[0] for name in ["figure.trend", "figure.trend canvas"])
        self.window = json.loads(self.figure.get_attribute("data-window"))

    def text(self, name):
        return self.reader.all(".trend-" + name)[0].text

    def shown(self):
        """How many samples, of how many."""
        return tuple(map(int, re.search(r"(\d+) of (\d+) samples$", self.text("range")).groups()))

    def require_shown(self, is_right, words):
        shown = self.shown()
        require(is_right(shown[0]), f"{self.place}: {words}: {self.text('range')}")
        return shown[0]

    def require_whole(self, words):
        self.require_shown(lambda count: count == self.window["samples"], words)

    def press(self, *keys):
        ActionChains(self.reader.driver).send_keys(*keys).perform()

    def button(self, words):
        self.figure.find_element("css selector", f"button[title='{words}']").click()

    def drag(self, begin_px, end_px, modifier=None):
        """From one place to another, counted from the middle."""
        chain = ActionChains(self.reader.driver)
        if modifier:
            chain.key_down(modifier)
        chain.move_to_element_with_offset(self.canvas, begin_px, 0).click_and_hold()
        chain.move_by_offset((end_px - begin_px) // 2, 5).move_by_offset((end_px - begin_px + 1) // 2, 0).release()
        if modifier:
            chain.key_up(modifier)
        chain.perform()

    def series(self, name):
        """As the page holds it."""
        coded = self.window[name]
        if isinstance(coded, str):
            return [value for (value,) in struct.iter_unpack("<f", base64.b64decode(coded))]
        return [value for k in range(0, len(coded), 2) for value in [coded[k + 1]] * coded[k]]

    def sample_read(self):
        """Number of the sample and what is said of it."""
        when, values = re.match(r"(.*?) UTC: (.*)$", self.text("reading")).groups()
        form = "%Y-%m-%d %H:%M:%S.%f" if "." in when else "%Y-%m-%d %H:%M:%S"
        time_s = datetime.strptime(when, form).replace(tzinfo=timezone.utc).timestamp()
        number = (time_s - self.window["start_us"] / 1e6) / self.window["interval_s"]
        return round(number), {part.split()[0]: float(part.split()[1]) for part in values.split(", ")}


def require_reading(trend):
    """What is said at the cursor is what the page holds of that sample."""
    ActionChains(trend.reader.driver).move_to_element_with_offset(trend.canvas, 37, 0).perform()
    number, values = trend.sample_read()
    require({"sp", "pv", "op"} <= set(values), f"{trend.place}: the cursor reads {values}")
    for name, value in values.items():
        stored = trend.series(name)[number]
        require(abs(value - stored) <= 1e-6 * abs(stored), f"{trend.place}: {name} {stored} is read as {value}")
    ActionChains(trend.reader.driver).key_down(Keys.SHIFT).send_keys(Keys.ARROW_RIGHT).key_up(Keys.SHIFT).perform()
    require(trend.sample_read()[0] == number + 1, f"{trend.place}: Shift and arrow: {trend.text('reading')}")


def require_desktop(reader, place, folder):
    trend = Trend(reader, place)
    require(trend.figure.is_displayed(), f"{place}: no trend")
    require(not any(f.is_displayed() for f in reader.all("figure.whole-window")), f"{place}: the window is there twice")
    trend.require_whole("at first")
    reader.run("arguments[0].scrollIntoView({block: 'center'})", trend.canvas)
    reader.shoot(folder / "trend_whole.png")
    trend.drag(-100, 100)
    dragged = trend.require_shown(lambda count: 3 < count < trend.window["samples"] / 2, "dragged over")
    require_reading(trend)
    trend.press("+")
    zoomed = trend.require_shown(lambda count: abs(count - dragged / 2) <= 2, "by a key")
    before = trend.text("range")
    trend.press(Keys.ARROW_LEFT)
    trend.require_shown(lambda count: abs(count - zoomed) <= 1, "moved by a key")
    require(trend.text("range") != before, f"{place}: an arrow moves nothing")
    before = trend.text("range")
    trend.drag(60, 0, Keys.SHIFT)
    require(trend.text("range") != before, f"{place}: Shift and drag moves nothing")
    reader.shoot(folder / "trend_close.png")
    trend.press("0")
    trend.require_whole("reset by a key")
    trend.button("A few cycles")
    trend.require_shown(lambda count: count < trend.window["samples"], "a few cycles")
    ActionChains(reader.driver).double_click(trend.canvas).perform()
    trend.require_whole("reset by a double click")


def require_phone(reader, place, folder):
    """Two fingers that go apart."""
    trend = Trend(reader, place)
    reader.run("arguments[0].scrollIntoView({block: 'center'})", trend.canvas)
    x, y = reader.run("(box => [box.x + box.width / 2, box.y + box.height / 2])"
                      "(arguments[0].getBoundingClientRect())", trend.canvas)
    for kind, apart in [("touchStart", 40), ("touchMove", 60), ("touchMove", 100), ("touchEnd", None)]:
        fingers = [] if apart is None else [{"x": x - apart, "y": y, "id": 0}, {"x": x + apart, "y": y, "id": 1}]
        reader.driver.execute_cdp_cmd("Input.dispatchTouchEvent", {"type": kind, "touchPoints": fingers})
    WebDriverWait(reader.driver, 10).until(lambda _: trend.shown()[0] < trend.window["samples"],
                                           f"{place}: pinching shows {trend.text('range')}")
    reader.shoot(folder / "trend_phone.png")
    trend.button("Whole window")
    trend.require_whole("reset by a button")


def require_trend(reader, place, window, folder):
    (require_phone if window == "phone" else require_desktop)(reader, place, folder)
    complaints = reader.complaints()
    require(not complaints, f"{place}: the console says {complaints}")
    reader.require_width(place, window)
