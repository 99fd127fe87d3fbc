"""What came of it: faults that were listed, false entries, and whether probabilities hold."""

import math
import statistics

import plant

_RIGHT = {"frozen": "sensor_fault", "manual": "not_controlling", "saturated": "valve_saturation",
          "stiction": "valve_stiction", "tight": "tight_tuning", "external": "external_disturbance",
          "backlash": "valve_deadband", "sluggish": "sluggish_tuning"}
_NOT_WEIGHED = ("not_controlling", "insufficient_data")
_BANDS = 10
# Behind a repair the odds of several windows still speak of the time before: not counted.
_FORGOTTEN_WINDOWS = 2


def stays_of(slots):
    """Of the slots in which a loop is listed: first and last of each stay."""
    result = []
    for slot in slots:
        if result and slot == result[-1][1] + 1:
            result[-1][1] = slot
        else:
            result.append([slot, slot])
    return result


class Watched:
    """A loop with its truth, and what was said of it slot by slot."""

    def __init__(self, loop, lists, said):
        self.loop, self.said, self.last_slot = loop, said, len(lists) - 1
        self.entries = {slot: shown[loop.name] for slot, shown in enumerate(lists)
                        if loop.name in shown}
        self.stays = stays_of(self.entries)
        self.slots_a_window = loop.window_s / plant.SLOT_S
        faulty = [slot for slot in range(len(lists)) if loop.is_faulty(plant.slot_end_s(slot))]
        # First and last slot of the fault; none in a healthy loop.
        self.first, self.last = (faulty[0], faulty[-1]) if faulty else (math.inf, -math.inf)

    @property
    def fault_stays(self):
        """Those that the fault has met."""
        return [stay for stay in self.stays if stay[0] <= self.last and stay[1] >= self.first]

    @property
    def false_stays(self):
        """Those that began while there was no fault."""
        return [stay for stay in self.stays if not self.first <= stay[0] <= self.last]

    @property
    def is_right_at_the_end(self):
        """Of the fault. The list has no loops in manual: of these the newest verdict counts."""
        shown = self.entries.get(self.last)
        if self.loop.place.fault == "manual":
            known = [slot for slot in self.said if slot <= self.last]
            shown = self.said[max(known)] if known else None
        return shown is not None and shown.code == _RIGHT[self.loop.place.fault]

    @property
    def has_left(self):
        return any(end < self.last for _, end in self.fault_stays)

    @property
    def delay_windows(self):
        """From the onset, or from the first pass; infinite: never came. None: already listed."""
        if not self.fault_stays:
            return math.inf
        first = self.fault_stays[0][0]
        if first < self.first:
            return None
        onset_slot = max(0.0, (self.loop.onset_s - plant.LEAD_S) / plant.SLOT_S)
        return (first - onset_slot) / self.slots_a_window

    @property
    def left_after_windows(self):
        """From the repair until the list no longer had it; None: it was not listed, or stays."""
        ends = [end for start, end in self.fault_stays if end >= self.last]
        if not ends or ends[0] == self.last_slot:
            return None
        return (plant.slot_end_s(ends[0] + 1) - self.loop.end_s) / self.loop.window_s


def _median(values):
    middle = statistics.median(values) if values else math.inf
    return None if math.isinf(middle) else round(middle, 2)


def _fault_counts(watched):
    delays = [loop.delay_windows for loop in watched]
    return {"loops": len(watched),
            "right_at_the_end": sum(loop.is_right_at_the_end for loop in watched),
            "ever_listed": sum(bool(loop.fault_stays) for loop in watched),
            "entries": sum(len(loop.fault_stays) for loop in watched),
            "left_before_the_end": sum(loop.has_left for loop in watched),
            "delay_windows": _median([delay for delay in delays if delay is not None])}


def _healthy_counts(watched, slots):
    entries = sum(len(loop.stays) for loop in watched)
    windows = sum(slots / loop.slots_a_window for loop in watched)
    return {"loops": len(watched), "ever_listed": sum(bool(loop.stays) for loop in watched),
            "false_entries_per_1000_windows": round(1000 * entries / windows, 2)}


def _what_it_is(watched):
    place, note = watched.loop.place, watched.loop.place.note
    words = f"{'healthy ' if place.fault == 'healthy' else ''}{place.kind}"
    if place.sample_interval_s > 1:
        words += f" of {place.sample_interval_s} s"
    words += f", {note}" if note else ""
    if watched.first > 0 and place.fault != "healthy":
        words += f", {place.fault} from slot {watched.first}"
    elif place.fault != "healthy":
        words += f", {place.fault} from the start"
    return words + (f", repaired after slot {watched.last}" if watched.loop.end_s else "")


def _wrong(watched):
    for first, last in watched.false_stays:
        entry = watched.entries[first]
        odds = entry.fault_probability
        probability = "none" if odds is None else f"{odds:.2f}"
        yield (f"{watched.loop.name}, {_what_it_is(watched)}: slot {first} to {last}, {entry.code},"
               f" probability {probability}")


def _truth(loop, end_s):
    """Whether a window that ends here is faulty; None if it is partly, or remembers a repair."""
    if loop.onset_s is None or end_s < loop.onset_s:
        return False
    if loop.end_s is not None and end_s >= loop.end_s:
        return None if end_s < loop.end_s + _FORGOTTEN_WINDOWS * loop.window_s else False
    began_before = loop.onset_s == 0 or end_s >= loop.onset_s + loop.window_s
    return True if began_before else None


def _calibration(watched):
    """The share that is really faulty by bands of the probability that the list goes by."""
    bands = [[] for _ in range(_BANDS)]
    for one in watched:
        for slot, verdict in one.said.items():
            truth = _truth(one.loop, plant.slot_end_s(slot))
            odds = verdict.fault_probability
            if truth is not None and odds is not None and verdict.code not in _NOT_WEIGHED:
                bands[min(int(odds * _BANDS), _BANDS - 1)].append((truth, one.loop.name))
    return [_band(number, verdicts) for number, verdicts in enumerate(bands)]


def _band(number, verdicts):
    faulty = sum(truth for truth, _ in verdicts)
    return {"from": number / _BANDS, "to": (number + 1) / _BANDS, "verdicts": len(verdicts),
            "loops": len({name for _, name in verdicts}), "faulty": faulty,
            "share": round(faulty / len(verdicts), 3) if verdicts else None}


def _after_repair(watched):
    left = watched.left_after_windows
    return {"loop": watched.loop.name, "fault": watched.loop.place.fault,
            "was_listed": watched.last in watched.entries,
            "windows": None if left is None else round(left, 2)}


def score(trial, loops, lists, verdicts):
    """`lists`: of each slot, by loop; `verdicts`: by loop, then by slot."""
    watched = [Watched(loop, lists, verdicts.get(loop.name, {})) for loop in loops]
    by_kind = {}
    for one in watched:
        by_kind.setdefault(one.loop.place.fault, []).append(one)
    healthy = by_kind.pop("healthy")
    return {"seed": trial.seed, "slots": trial.slots,
            "faults": {kind: _fault_counts(of_kind) for kind, of_kind in by_kind.items()},
            "healthy": _healthy_counts(healthy, trial.slots),
            "wrong": [line for one in watched for line in _wrong(one)],
            "calibration": _calibration(watched),
            "left_after_repair_windows": [_after_repair(one) for one in watched
                                          if one.loop.end_s is not None]}
