"""Processes, PI settings by the SIMC rules, and how robust the two are together.

Signals are in percent of their span, times in seconds; the controller acts once a second."""

import dataclasses
import math

import numpy

# Below half the sampling rate, above the slowest loop.
_FREQUENCIES = numpy.logspace(-5, math.log10(0.999 * math.pi), 20000)


@dataclasses.dataclass
class Process:
    """What lies between valve and transmitter: two lags, or a vessel that integrates."""
    gain: float = 1.0  # pv per op in the steady state; of a vessel: per second
    lag_s: float = 0.0
    second_lag_s: float = 0.0
    dead_time_s: int = 1
    integrates: bool = False

    @property
    def open_loop_time_s(self):
        return self.lag_s + self.second_lag_s + self.dead_time_s


@dataclasses.dataclass
class PiTuning:
    gain: float
    reset_time_s: float


def simc(process, closed_loop_time_s):
    """Skogestad's rules; the second lag is halved between lag and dead time, the controller's own
    second counts as dead time."""
    half_lag_s = process.second_lag_s / 2
    dead_time_s = process.dead_time_s + 1 + half_lag_s
    total_s = closed_loop_time_s + dead_time_s
    if process.integrates:
        return PiTuning(1 / (process.gain * total_s), 4 * total_s)
    lag_s = process.lag_s + half_lag_s
    return PiTuning(lag_s / (process.gain * total_s), min(lag_s, 4 * total_s))


def sluggish(process, slowness):
    """The closed loop takes `slowness` times as long as the process alone."""
    return PiTuning(process.lag_s / (process.gain * slowness * process.open_loop_time_s),
                    process.lag_s)


def tight(process, tuning, gain_margin):
    """The gain is raised until so much is left below the edge of stability."""
    _, margin = robustness(process, tuning)
    return PiTuning(tuning.gain * margin / gain_margin, tuning.reset_time_s)


def _lag(delay, time_s):
    pole = math.exp(-1 / time_s)
    return (1 - pole) / (1 - pole * delay)


def _open_loop(process, tuning):
    delay = numpy.exp(-1j * _FREQUENCIES)
    response = tuning.gain * (1 + 1 / tuning.reset_time_s / (1 - delay))
    response = response * process.gain * delay ** (1 + process.dead_time_s)
    if process.integrates:
        return response / (1 - delay)
    response = response * _lag(delay, process.lag_s)
    return response * _lag(delay, process.second_lag_s) if process.second_lag_s else response


def robustness(process, tuning):
    """Largest sensitivity Ms, and the gain margin (infinite where the phase never turns over)."""
    response = _open_loop(process, tuning)
    phase = numpy.unwrap(numpy.angle(response))
    crossings = (phase[:-1] > -math.pi) & (phase[1:] <= -math.pi)
    largest = numpy.abs(response[:-1][crossings]).max(initial=0.0)
    margin = 1 / largest if largest > 0 else math.inf
    return float(numpy.max(1 / numpy.abs(1 + response))), float(margin)
