"""How the historian keeps each loop: layout, units, mode tag, and what the catalogue knows."""

import dataclasses

import numpy

_OP_RANGES = ((0, 100), (0, 1), (4, 20))
_OP_DECIMALS = {100: 2, 1: 4, 20: 3}


@dataclasses.dataclass
class Recording:
    layout: str  # "narrow": a row a value, "row": a row a loop and time
    op_low: float
    op_high: float
    op_range_is_set: bool  # in the catalogue; else the program has to infer it
    has_mode: bool
    setpoint_on_change: bool  # else with every sample; narrow only
    is_late: bool  # rows come up to 80 ms behind the full second; narrow only

    def op_recorded(self, op, step):
        """`op` in percent, in the units and with the decimals of the historian."""
        steps = numpy.round(op / step) * step if step else op
        span = self.op_high - self.op_low
        return numpy.round(self.op_low + steps / 100 * span, _OP_DECIMALS[self.op_high])


def draw_recordings(seed, count):
    """Half of the loops of each layout, a third of each range, in any order."""
    random = numpy.random.default_rng([seed, 0])
    layouts, ranges = random.permutation(count) % 2, random.permutation(count) % len(_OP_RANGES)
    set_, mode, on_change, late = random.random((4, count)) < [[0.45], [0.5], [0.35], [0.35]]
    return [Recording("row" if row else "narrow", *_OP_RANGES[ranges[i]], bool(set_[i]),
                      bool(mode[i]), bool(on_change[i] and not row), bool(late[i] and not row))
            for i, row in enumerate(layouts)]
