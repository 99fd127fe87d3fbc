"""The 60 places of the plant: 30 healthy loops and 30 with a fault of eight kinds.

Sizes are in percent of span (op: of its travel), large enough for an engineer to see in a trend."""

from plant import TWELVE_BITS, Place

# A valve's cycle is seen where the load does not hide it.
_QUIET = {"load": (0.3, 0.5)}


def _averaging(low_s, high_s, sample_interval_s=1):
    """A vessel as buffer: its level may move so that the flow behind it does not."""
    return Place("level", note="averaging", sample_interval_s=sample_interval_s,
                 bounds={"load": (1.0, 1.4), "closed_loop_time_s": (low_s, high_s)})


def _whole_percent(kind, **more):
    return Place(kind, note="op recorded in whole percent", op_recorded_step=1.0, **more)


def _calm(kind, noise, load):
    # No grid: that of twelve bits would be as coarse as what there is to see.
    return Place(kind, note="calm", setpoint_rests=True, pv_step=0.0,
                 bounds={"noise": noise, "load": load})


def _rounded(kind, noise, load, **more):
    bounds = {"noise": noise, "load": load, **more.pop("bounds", {})}
    return Place(kind, note="op in steps of 0.1 %, pv of twelve bits", op_step=0.1,
                 pv_step=TWELVE_BITS, setpoint_rests=True, bounds=bounds, **more)


def _healthy():
    return [
        *(Place("flow") for _ in range(7)), *(Place("pressure") for _ in range(5)),
        *(Place("temperature") for _ in range(3)),
        *(Place("temperature", sample_interval_s=5) for _ in range(2)),
        _averaging(270, 330), _averaging(450, 550),
        _averaging(270, 330, sample_interval_s=5), _averaging(450, 550, sample_interval_s=5),
        Place("level", bounds={"closed_loop_time_s": (55, 70)}),
        _whole_percent("flow"), _whole_percent("temperature", sample_interval_s=5),
        _whole_percent("level", bounds={"closed_loop_time_s": (130, 170)}),
        _calm("flow", (0.04, 0.06), (0.15, 0.25)),
        _calm("temperature", (0.015, 0.025), (0.25, 0.35)),
        _rounded("pressure", (0.08, 0.12), (0.6, 1.0)),
        _rounded("temperature", (0.08, 0.12), (0.6, 1.0), sample_interval_s=5),
        _rounded("level", (0.08, 0.12), (0.4, 0.7), bounds={"closed_loop_time_s": (90, 110)}),
    ]


def _faulty(kind, fault, note="", sizes=None, **more):
    return Place(kind, fault, note, bounds=sizes or {}, **more)


def _frozen():
    """pv stands still. op runs to a limit when the operator wants another value, or works on after
    the setpoint of a master."""
    def winds_up(sign):
        return {"asked": tuple(sorted((2.0 * sign, 4.0 * sign)))}

    master = {"master": (0.5, 0.8)}
    return [
        _faulty("flow", "frozen", "op at its limit all the time", {"wound_error": (1.5, 3.0)}),
        _faulty("pressure", "frozen", "op winds up", winds_up(+1), begins=True),
        _faulty("temperature", "frozen", "op winds down", winds_up(-1), begins=True),
        _faulty("flow", "frozen", "below a master", master, begins=True),
        _faulty("temperature", "frozen", "below a master", master, sample_interval_s=5),
        _faulty("level", "frozen", "op winds up", winds_up(+1), begins=True, op_recorded_step=1.0),
    ]


def _manual_and_saturated():
    above, below, load = (104.0, 110.0), (-10.0, -5.0), (3.5, 4.5)
    return [
        _faulty("flow", "manual", begins=True), _faulty("pressure", "manual"),
        _faulty("temperature", "manual", "the operator moves op", {"hand_move": (2.0, 5.0)},
                begins=True),
        _faulty("flow", "saturated", "", {"needed_op": above, "load": load}, position_form=True),
        _faulty("pressure", "saturated", "", {"needed_op": below, "load": load}, begins=True),
        _faulty("temperature", "saturated", "", {"needed_op": above, "load": load,
                "load_time_s": (700, 1100)}, begins=True, position_form=True),
    ]


def _valves():
    def sticks(band, jump_share, **more):
        return {"stick_band": band, "jump_share": jump_share, **_QUIET, **more}

    vessel = {"gain": (0.005, 0.007), "noise": (0.1, 0.18)}
    return [
        _faulty("flow", "stiction", "", sticks((3.5, 4.5), (0.3, 0.4), noise=(0.1, 0.15))),
        _faulty("flow", "stiction", "", sticks((2.5, 3.5), (0.45, 0.55), noise=(0.12, 0.18)),
                begins=True, pv_step=0.0),
        _faulty("pressure", "stiction", "", sticks((2.5, 3.5), (0.4, 0.5)), begins=True,
                pv_step=0.0),
        _faulty("pressure", "stiction", "", sticks((2.2, 2.8), (0.45, 0.55)), pv_step=0.0),
        _faulty("temperature", "stiction", "", sticks((2.0, 2.6), (0.55, 0.7)), begins=True,
                pv_step=0.0),
        _faulty("level", "stiction", "", sticks((3.5, 4.5), (0.25, 0.35),
                closed_loop_time_s=(55, 65), **vessel), sample_interval_s=5, pv_step=0.0),
        _faulty("flow", "backlash", "", {"play": (4.5, 5.5), "noise": (0.1, 0.15)}, begins=True),
        _faulty("level", "backlash", "", {"play": (4.5, 5.5), "closed_loop_time_s": (45, 55),
                                          **vessel}),
        _faulty("temperature", "backlash", "", {"play": (5.5, 6.5)}, begins=True,
                sample_interval_s=5),
    ]


def _tunings_and_waves():
    def wave(period_s, size):
        return {"wave_period_s": period_s, "wave": size}

    margin = {"gain_margin": (1.1, 1.18)}
    slow = {"slowness": (15, 21), "load": (2.5, 4.0)}
    return [
        _faulty("flow", "tight", "", {**margin, "dead_time_s": (4, 4), "lag_s": (5, 7)}),
        _faulty("pressure", "tight", "", margin),
        _faulty("temperature", "tight", "", margin, sample_interval_s=5),
        _faulty("flow", "external", "", wave((110, 170), (5, 7))),
        _faulty("pressure", "external", "", wave((270, 370), (8, 12)), begins=True),
        _faulty("temperature", "external", "", wave((1300, 1700), (7, 9)), begins=True,
                sample_interval_s=5),
        _faulty("pressure", "sluggish", "", {**slow, "load_time_s": (350, 450)}),
        _faulty("temperature", "sluggish", "", {**slow, "load_time_s": (1300, 1700)},
                sample_interval_s=5),
        _faulty("flow", "sluggish", "", {**slow, "load_time_s": (170, 230)}),
    ]


PLACES = _healthy() + _frozen() + _manual_and_saturated() + _valves() + _tunings_and_waves()
assert len(PLACES) == 60 and sum(place.fault == "healthy" for place in PLACES) == 30
