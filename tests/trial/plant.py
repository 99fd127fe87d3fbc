"""Which 60 loops the plant has, and how each is drawn.

Places and bounds are written down, everything else comes from the seed. Nothing of the program or
of its other tests is used: what they have in common would not be seen."""

import dataclasses

import numpy

import tuning
from recording import draw_recordings

SLOT_S = 410  # a tenth of a window of 4096 samples, one a second
LEAD_S = 50 * SLOT_S  # before the first pass: a whole window of one sample every 5 s
HEALTHY_MS = 1.8
# Shares of the slots, when faults begin that are not there from the start, when repairs are made.
_ONSET_SHARES = (0.25, 0.55)
REPAIR_SHARE = 0.65
TWELVE_BITS = 100 / 4096  # of the span, a transmitter's grid

_KINDS = {
    "flow": {"gain": (0.7, 1.5), "lag_s": (2, 5), "dead_time_s": (1, 2), "noise": (0.15, 0.4),
             "load": (1, 3), "load_time_s": (100, 600), "closed_loop_time_s": (3.6, 6.4)},
    "pressure": {"gain": (0.7, 1.8), "lag_s": (10, 30), "second_lag_s": (1, 4),
                 "dead_time_s": (1, 4), "noise": (0.05, 0.2), "load": (1, 4),
                 "load_time_s": (200, 1000), "closed_loop_time_s": (7, 13)},
    "temperature": {"gain": (0.6, 1.6), "lag_s": (60, 200), "second_lag_s": (8, 30),
                    "dead_time_s": (6, 24), "noise": (0.03, 0.1), "load": (2, 5),
                    "load_time_s": (600, 2500), "closed_loop_time_s": (27, 48)},
    "level": {"gain": (0.002, 0.008), "dead_time_s": (2, 7), "noise": (0.1, 0.4), "load": (2, 5),
              "load_time_s": (600, 2500), "closed_loop_time_s": (72, 128)},
}


def slot_end_s(slot):
    """Seconds since the plant's start."""
    return LEAD_S + SLOT_S * slot


@dataclasses.dataclass
class Place:
    """A loop as far as the seed does not matter; `bounds` replace those of its kind."""
    kind: str
    fault: str = "healthy"
    note: str = ""
    bounds: dict = dataclasses.field(default_factory=dict)
    sample_interval_s: int = 1
    begins: bool = False  # the fault comes during the trial
    setpoint_rests: bool = False
    pv_step: float | None = None  # None: by lot, twelve bits or none
    op_step: float = 0.0  # what the valve gets
    op_recorded_step: float = 0.0
    position_form: bool = False  # a controller whose integral waits at the limit


@dataclasses.dataclass
class Trial:
    seed: int
    slots: int
    repaired: int

    @property
    def duration_s(self):
        return slot_end_s(self.slots) + 1

    @property
    def repair_s(self):
        return slot_end_s(round(REPAIR_SHARE * self.slots)) + 1


@dataclasses.dataclass
class Loop:
    place: Place
    name: str
    process: tuning.Process
    sound_tuning: tuning.PiTuning
    faulty_tuning: tuning.PiTuning
    figures: dict  # what was drawn within the bounds
    op_at_rest: float
    setpoint: float
    pv_step: float
    setpoint_interval_s: float | None
    recording: object
    onset_s: int | None
    end_s: int | None  # of the fault, where it is repaired
    seed: list

    @property
    def window_s(self):
        return 4096 * self.place.sample_interval_s

    def is_faulty(self, second):
        if self.onset_s is None or second < self.onset_s:
            return False
        return self.end_s is None or second < self.end_s


def _draw_figures(place, random):
    bounds = {**_KINDS[place.kind], **place.bounds}
    figures = {name: float(random.uniform(*pair)) for name, pair in bounds.items()}
    low, high = bounds["dead_time_s"]
    return figures | {"dead_time_s": int(random.integers(low, high + 1))}


def _process(place, figures):
    return tuning.Process(figures["gain"], figures.get("lag_s", 0.0),
                          figures.get("second_lag_s", 0.0), figures["dead_time_s"],
                          place.kind == "level")


def _faulty_tuning(place, process, sound, figures):
    if place.fault == "tight":
        return tuning.tight(process, sound, figures["gain_margin"])
    if place.fault == "sluggish":
        return tuning.sluggish(process, figures["slowness"])
    return sound


def _setpoint_interval_s(place, random):
    moves = place.fault in ("healthy", "stiction", "backlash") and not place.setpoint_rests
    return float(random.uniform(4000, 12000)) if moves and random.random() < 0.5 else None


def _onset_s(place, trial, random):
    if place.fault == "healthy":
        return None
    slot = random.uniform(*_ONSET_SHARES) * trial.slots
    return LEAD_S + int(SLOT_S * slot) if place.begins else 0


def _pv_step(place, random):
    by_lot = TWELVE_BITS if random.random() < 0.4 else 0.0
    return by_lot if place.pv_step is None else place.pv_step


def repaired_places(trial, places):
    """One of each kind before a second of any, by lot; those of 5 s have too few windows left."""
    random = numpy.random.default_rng([trial.seed, 2])
    by_kind = {}
    for index in random.permutation(len(places)):
        place = places[index]
        if place.fault != "healthy" and place.sample_interval_s == 1:
            by_kind.setdefault(place.fault, []).append(int(index))
    in_turn = sorted((turn, index) for same in by_kind.values() for turn, index in enumerate(same))
    order = random.permutation(len(in_turn))
    chosen = sorted((in_turn[i] for i in order), key=lambda pair: pair[0])
    return [index for _, index in chosen][:trial.repaired]


def draw_loop(trial, places, index, attempt=0):
    """`attempt`: which draw of this place, where an earlier one was not as it should be."""
    place, seed = places[index], [trial.seed, 1, index, attempt]
    random = numpy.random.default_rng(seed)
    figures = _draw_figures(place, random)
    process = _process(place, figures)
    sound = tuning.simc(process, figures["closed_loop_time_s"])
    return Loop(
        place=place, name=f"{place.kind[0].upper()}IC{100 + index}", process=process,
        sound_tuning=sound, faulty_tuning=_faulty_tuning(place, process, sound, figures),
        figures=figures, op_at_rest=float(random.uniform(40, 60)),
        setpoint=50 + round(float(random.uniform(-8, 8)), 1), pv_step=_pv_step(place, random),
        setpoint_interval_s=_setpoint_interval_s(place, random),
        recording=draw_recordings(trial.seed, len(places))[index],
        onset_s=_onset_s(place, trial, random),
        end_s=trial.repair_s if index in repaired_places(trial, places) else None, seed=seed)


def is_robust(loop):
    """Of the tuning without a fault."""
    return tuning.robustness(loop.process, loop.sound_tuning)[0] < HEALTHY_MS
