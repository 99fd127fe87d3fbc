"""The signals of every loop, one second a step, and that they are healthy where no fault is."""

import dataclasses
import multiprocessing
from pathlib import Path

import numpy

import driving
import plant
from apparatus import Apparatus
from places import PLACES

_SETTLED_AFTER_REPAIR_S = 4096
_WINDOW_SAMPLES = 4096
_COARSEST_PV_STEP = 1 / 3  # of pv's standard deviation: what is coarser is a fault of the sensor
_MOST_DRAWS = 40


@dataclasses.dataclass
class Signals:
    """One value a second, in percent; `automatic`: 0 while in manual."""
    setpoint: numpy.ndarray
    pv: numpy.ndarray
    op: numpy.ndarray
    automatic: numpy.ndarray

    def save(self, folder, name):
        numpy.savez(Path(folder) / f"{name}.npz", **vars(self))

    @staticmethod
    def load(folder, name):
        with numpy.load(Path(folder) / f"{name}.npz") as file:
            return Signals(**file)


def _fault_span_s(loop, duration_s):
    """First second with the fault and the first without it again; the loop goes on at both."""
    onset_s = duration_s if loop.onset_s is None else loop.onset_s
    return onset_s, duration_s if loop.end_s is None else loop.end_s


def _pv_and_op(loop, drawn, duration_s, random):
    """`drawn`: setpoint, load and noise."""
    apparatus = Apparatus(loop, random)
    onset_s, end_s = _fault_span_s(loop, duration_s)
    before, during, after = (slice(0, onset_s), slice(onset_s, end_s), slice(end_s, duration_s))
    parts = [apparatus.run(*(signal[before] for signal in drawn))]
    apparatus.begin_fault()
    parts.append(apparatus.run(*(signal[during] for signal in drawn)))
    apparatus.end_fault()
    parts.append(apparatus.run(*(signal[after] for signal in drawn)))
    return numpy.concatenate(parts, axis=1)


def simulate(loop, duration_s):
    random = numpy.random.default_rng([*loop.seed, 1])
    drawn = [draw(loop, duration_s, random)
             for draw in (driving.draw_setpoint, driving.draw_load, driving.draw_noise)]
    pv, op = _pv_and_op(loop, drawn, duration_s, random)
    automatic = numpy.ones(duration_s, dtype=numpy.int8)
    if loop.place.fault == "manual":
        automatic[slice(*_fault_span_s(loop, duration_s))] = 0
    return Signals(drawn[0], pv, op, automatic)


def _is_at_a_limit(loop, op):
    """Ever, while the loop has no fault and has settled after one."""
    onset_s, end_s = _fault_span_s(loop, len(op))
    sound = numpy.concatenate([op[:onset_s], op[end_s + _SETTLED_AFTER_REPAIR_S:]])
    return bool(((sound <= 0) | (sound >= 100)).any())


def _is_coarse(loop, pv):
    """In any whole window, as the program will see it."""
    sampled = pv[::loop.place.sample_interval_s]
    windows = sampled[:len(sampled) // _WINDOW_SAMPLES * _WINDOW_SAMPLES]
    deviation = windows.reshape(-1, _WINDOW_SAMPLES).std(axis=1).min()
    return loop.pv_step > _COARSEST_PV_STEP * deviation


def _is_sound(loop, signals):
    """A limit or a coarse pv that belongs to the fault is no objection."""
    coarse = loop.place.fault == "healthy" and _is_coarse(loop, signals.pv)
    return not coarse and not _is_at_a_limit(loop, signals.op)


def _simulate_place(trial, index, folder):
    for attempt in range(_MOST_DRAWS):
        loop = plant.draw_loop(trial, PLACES, index, attempt)
        if not plant.is_robust(loop):
            continue
        signals = simulate(loop, trial.duration_s)
        if _is_sound(loop, signals):
            signals.save(folder, loop.name)
            return loop
    raise RuntimeError(f"no healthy loop in {_MOST_DRAWS} draws of place {index}: {PLACES[index]}")


def simulate_plant(trial, folder):
    """The loops; the signals of each stand in a file of its name in `folder`."""
    with multiprocessing.Pool() as pool:
        return pool.starmap(_simulate_place,
                            [(trial, index, folder) for index in range(len(PLACES))], chunksize=1)
