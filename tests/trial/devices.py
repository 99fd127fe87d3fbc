"""Transmitter, controller, valve and process of a loop, second by second; sound and faulty ones.

Every signal is in percent. A faulty device takes the place of a sound one while the loop runs."""

import collections
import math

_STROKE_TIME_S = 0.7  # of a stem that has come loose
_LOOSE_UNTIL = 0.02
_HAND_INTERVAL_S = (1000, 2600)
_HAND_OP = (15.0, 85.0)


def _on_grid(value, step):
    return round(value / step) * step if step else value


def _clamped(value, low=0.0, high=100.0):
    return low if value < low else high if value > high else value


class Transmitter:
    def __init__(self, step):
        self._step = step

    def read(self, value):
        return _on_grid(value, self._step)


class DeadTransmitter:
    """Says the same for ever."""

    def __init__(self, value):
        self._value = value

    def read(self, _):
        return self._value


class VelocityPi:
    """Adds up increments: at its limit it comes back as soon as the error turns."""

    def __init__(self, tuning, op, step):
        self.tuning, self.op, self._step = tuning, op, step
        self._last_error = None

    def output(self, setpoint, pv):
        error = setpoint - pv
        change = 0.0 if self._last_error is None else error - self._last_error
        self._last_error = error
        tuning = self.tuning
        self.op = _clamped(self.op + tuning.gain * (change + error / tuning.reset_time_s))
        return _on_grid(self.op, self._step)


class PositionPi:
    """Proportional part and integral, which waits while the error pushes op on at its limit."""

    def __init__(self, tuning, op, step):
        self.tuning, self.op, self._step = tuning, op, step
        self._integral = None

    def output(self, setpoint, pv):
        error, tuning = setpoint - pv, self.tuning
        if self._integral is None:
            self._integral = self.op - tuning.gain * error
        asked = tuning.gain * error + self._integral
        if not (asked >= 100 and error > 0 or asked <= 0 and error < 0):
            self._integral += tuning.gain * error / tuning.reset_time_s
        self.op = _clamped(tuning.gain * error + self._integral)
        return _on_grid(self.op, self._step)


class Hand:
    """Manual: op stays, or is moved by an operator who looks in now and then."""

    def __init__(self, op, step, largest_move, process_gain, random):
        self.op, self._step = op, step
        self._largest_move, self._process_gain, self._random = largest_move, process_gain, random
        self._wait_s = self._next_wait_s()

    def _next_wait_s(self):
        return int(self._random.uniform(*_HAND_INTERVAL_S))

    def output(self, setpoint, pv):
        self._wait_s -= 1
        if self._largest_move and self._wait_s <= 0:
            needed = 0.7 * (setpoint - pv) / self._process_gain
            move = _clamped(needed, -self._largest_move, self._largest_move)
            self.op = _clamped(self.op + round(move, 1), *_HAND_OP)
            self._wait_s = self._next_wait_s()
        return _on_grid(self.op, self._step)


class Valve:
    def __init__(self, stem):
        self.stem = stem

    def follow(self, op):
        self.stem = op
        return op


class StickingValve(Valve):
    """Rests until op is `band` away, then slips until it lags by the dynamic friction."""

    def __init__(self, stem, band, jump_share):
        super().__init__(stem)
        self._band, self._lag = band, band * (1 - jump_share)
        self._direction = 0
        self._share = 1 - math.exp(-1 / _STROKE_TIME_S)

    def follow(self, op):
        distance = op - self.stem
        if self._direction == 0 and abs(distance) > self._band:
            self._direction = 1 if distance > 0 else -1
        if self._direction:
            way = distance - self._direction * self._lag
            if way * self._direction <= _LOOSE_UNTIL:
                self._direction = 0
            else:
                self.stem += way * self._share
        return self.stem


class ValveWithPlay(Valve):
    def __init__(self, stem, play):
        super().__init__(stem)
        self._half = play / 2

    def follow(self, op):
        self.stem = _clamped(self.stem, op - self._half, op + self._half)
        return self.stem


class Lags:
    """Dead time and one or two lags around the point of rest."""

    def __init__(self, process, pv, op_at_rest):
        self._at_rest, self._op_at_rest, self._gain = pv, op_at_rest, process.gain
        self._delayed = collections.deque([op_at_rest], maxlen=process.dead_time_s + 1)
        self._first_pole = math.exp(-1 / process.lag_s)
        self._second_pole = math.exp(-1 / process.second_lag_s) if process.second_lag_s else 0.0
        self._first = self._second = 0.0
        self._delayed.extend([op_at_rest] * process.dead_time_s)
        self.pv = pv

    def advance(self, stem, load):
        self._delayed.append(stem)
        drive = self._gain * (self._delayed[0] - self._op_at_rest + load)
        self._first += (1 - self._first_pole) * (drive - self._first)
        self._second += (1 - self._second_pole) * (self._first - self._second)
        self.pv = self._at_rest + self._second


class Vessel:
    """Dead time and an integrator between empty and full."""

    def __init__(self, process, pv, op_at_rest):
        self._op_at_rest, self._gain = op_at_rest, process.gain
        self._delayed = collections.deque([op_at_rest] * (process.dead_time_s + 1),
                                          maxlen=process.dead_time_s + 1)
        self.pv = pv

    def advance(self, stem, load):
        self._delayed.append(stem)
        self.pv = _clamped(self.pv + self._gain * (self._delayed[0] - self._op_at_rest + load))
