"""The devices of one loop that runs, and which of them a fault or a repair replaces."""

import numpy

import devices


class Apparatus:
    def __init__(self, loop, random):
        self._loop, self._random = loop, random
        self._transmitter = devices.Transmitter(loop.pv_step)
        self._controller = self._automatic(self._first_op())
        self._valve = devices.Valve(self._controller.op)
        kind = devices.Vessel if loop.process.integrates else devices.Lags
        self._process = kind(loop.process, loop.setpoint, loop.op_at_rest)
        self._pv = loop.setpoint

    def _first_op(self):
        """Where a fault that is there from the start has brought it."""
        figures = self._loop.figures
        if "wound_error" in figures:
            return 100.0
        if "needed_op" in figures and self._loop.onset_s == 0:
            return min(100.0, max(0.0, figures["needed_op"]))
        return self._loop.op_at_rest

    def _automatic(self, op):
        kind = devices.PositionPi if self._loop.place.position_form else devices.VelocityPi
        return kind(self._loop.sound_tuning, op, self._loop.place.op_step)

    def _hand(self):
        return devices.Hand(self._controller.op, self._loop.place.op_step,
                            self._loop.figures.get("hand_move"), self._loop.process.gain,
                            self._random)

    def _dead_transmitter(self):
        figures = self._loop.figures
        if "master" in figures:
            # Where the mean error is 0, so that op works on within its range.
            return devices.DeadTransmitter(self._loop.setpoint)
        return devices.DeadTransmitter(self._pv - figures.get("wound_error", 0.0))

    def begin_fault(self):
        fault, figures, stem = self._loop.place.fault, self._loop.figures, self._valve.stem
        if fault == "frozen":
            self._transmitter = self._dead_transmitter()
        elif fault == "manual":
            self._controller = self._hand()
        elif fault == "stiction":
            self._valve = devices.StickingValve(stem, figures["stick_band"], figures["jump_share"])
        elif fault == "backlash":
            self._valve = devices.ValveWithPlay(stem, figures["play"])
        elif fault in ("tight", "sluggish"):
            self._controller.tuning = self._loop.faulty_tuning

    def end_fault(self):
        self._transmitter = devices.Transmitter(self._loop.pv_step)
        self._valve = devices.Valve(self._valve.stem)
        if self._loop.place.fault == "manual":
            self._controller = self._automatic(self._controller.op)
        self._controller.tuning = self._loop.sound_tuning

    def run(self, setpoints, loads, noise):
        """pv and op of as many seconds; arrays."""
        read, output = self._transmitter.read, self._controller.output
        follow, process = self._valve.follow, self._process
        rows = numpy.empty((len(setpoints), 2))
        driving = zip(setpoints.tolist(), loads.tolist(), noise.tolist())
        for second, (setpoint, load, noise_now) in enumerate(driving):
            pv = read(process.pv + noise_now)
            op = output(setpoint, pv)
            process.advance(follow(op), load)
            rows[second] = pv, op
        if len(rows):
            self._pv = float(rows[-1, 0])
        return rows.T
