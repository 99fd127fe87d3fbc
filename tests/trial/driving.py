"""What drives a loop from outside: load on the process, setpoint, noise of the measurement."""

import math

import numpy

_LOAD_SMOOTHING_S = 20  # loads do not jump
_ONSET_RAMP_S = 300  # nor do faults that come through the load
_ASKED_AFTER_S = 600  # what the operator asks of a dead measurement
_LEAST_SETPOINT_INTERVAL_S = 1200
_SETPOINT_STEP = 3.0
# A master's setpoint comes back, so that the integral of a loop with a dead pv does so, too.
_MASTER_S, _MASTER_RETURN_S = 100, 300


def _lagged(values, time_s):
    pole, state, result = math.exp(-1 / time_s), 0.0, []
    for value in values.tolist():
        state += (1 - pole) * (value - state)
        result.append(state)
    return numpy.array(result)


def _wandering(time_s, duration_s, random):
    """Mean 0, standard deviation 1, forgotten after `time_s`."""
    pole = math.exp(-1 / time_s)
    drive = random.standard_normal(duration_s) * math.sqrt((1 + pole) / (1 - pole))
    drive[0] = random.standard_normal() / (1 - pole)
    return _lagged(drive, time_s)


def _during_fault(loop, seconds):
    """1 during the fault and 0 elsewhere, with ramps where it begins or ends on the way."""
    share = numpy.ones(len(seconds))
    if loop.onset_s:
        share = numpy.clip((seconds - loop.onset_s) / _ONSET_RAMP_S, 0, 1)
    if loop.end_s:
        share -= numpy.clip((seconds - loop.end_s) / _ONSET_RAMP_S, 0, 1)
    return share


def _wave(loop, seconds, random):
    phase = random.uniform(0, 2 * math.pi)
    angle = 2 * math.pi * seconds / loop.figures["wave_period_s"] + phase
    return loop.figures["wave"] * numpy.sin(angle)


def draw_load(loop, duration_s, random):
    """In percent of op: what op has to make up for."""
    figures, seconds = loop.figures, numpy.arange(duration_s)
    wandering = _wandering(figures["load_time_s"], duration_s, random) * figures["load"]
    load = _lagged(wandering, _LOAD_SMOOTHING_S)
    if "needed_op" in figures:
        load += (loop.op_at_rest - figures["needed_op"]) * _during_fault(loop, seconds)
    if "wave" in figures:
        load += _wave(loop, seconds, random) * _during_fault(loop, seconds)
    return load


def _steps(loop, setpoint, random):
    start_s = random.exponential(loop.setpoint_interval_s)
    while start_s < len(setpoint):
        step = random.uniform(-_SETPOINT_STEP, _SETPOINT_STEP)
        setpoint[int(start_s):] = loop.setpoint + round(float(step), 1)
        interval_s = random.exponential(loop.setpoint_interval_s)
        start_s += max(_LEAST_SETPOINT_INTERVAL_S, interval_s)


def draw_setpoint(loop, duration_s, random):
    setpoint = numpy.full(duration_s, loop.setpoint)
    if loop.setpoint_interval_s:
        _steps(loop, setpoint, random)
    if "master" in loop.figures:
        wandering = _wandering(_MASTER_S, duration_s, random)
        moves = wandering - _lagged(wandering, _MASTER_RETURN_S)
        setpoint += numpy.round(loop.figures["master"] * moves, 2)
    if "asked" in loop.figures:
        setpoint[loop.onset_s + _ASKED_AFTER_S:] += round(loop.figures["asked"], 1)
    return setpoint


def draw_noise(loop, duration_s, random):
    return random.standard_normal(duration_s) * loop.figures["noise"]
