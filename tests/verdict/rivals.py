"""Explaining away: how much a cause loses where another explains the same loop.

Curves of one cause do not know what the others say. A second, small regression puts its log odds
beside those of its rivals, that any of them is there were they independent: offset + scale * own + a
curve that falls with the rivals'. It is fitted to log odds by curves that have not seen the record's
family."""

import numpy
from scipy.optimize import minimize

# Log odds of the rivals: from 2 % to 98 %.
KNOTS = numpy.array([-4.0, -3.0, -2.0, -1.0, 0.0, 1.0, 2.0, 4.0])
# Any nonlinearity is no rival of one of them; the oversized valve is known of few loops.
NO_RIVALS = ("nonlinear_unexplained", "valve_oversized")
# In -ln of the probability that none is there; beyond it no double is below 1.
SUREST = 30.0


def any_rival(log_odds, cause):
    """`log_odds`: by cause. That any other cause is there."""
    none = sum(numpy.logaddexp(0.0, odds) for name, odds in log_odds.items()
               if name != cause and name not in NO_RIVALS)
    return numpy.log(numpy.expm1(numpy.minimum(none, SUREST)))


class RivalFit:
    def __init__(self, own, rival, truth):
        design = numpy.column_stack([own, self._ramps(rival)])

        def loss(beta):
            odds = beta[0] + design @ beta[1:]
            grade = 1 / (1 + numpy.exp(-odds)) - truth
            value = numpy.logaddexp(0, odds).sum() - truth @ odds
            return value / truth.size, numpy.concatenate([[grade.sum()],
                                                          design.T @ grade]) / truth.size

        ramps = len(KNOTS) - 1
        # Its own odds count between half and twice; a rival never helps.
        bounds = [(None, None), (0.5, 2.0)] + [(None, 0.0)] * ramps
        found = minimize(loss, numpy.r_[0.0, 1.0, numpy.zeros(ramps)], jac=True,
                         method="L-BFGS-B", bounds=bounds, options={"maxiter": 1000})
        self.offset, self.scale = found.x[0], found.x[1]
        heights = numpy.concatenate([[0.0], numpy.cumsum(found.x[2:])])
        mean = float((heights[0] + self._ramps(rival) @ found.x[2:]).mean())
        self.points = list(zip(KNOTS, heights - mean))
        self.offset += mean

    @staticmethod
    def _ramps(rival):
        return numpy.column_stack([numpy.clip((rival - low) / (high - low), 0, 1)
                                   for low, high in zip(KNOTS[:-1], KNOTS[1:])])

    def log_odds(self, own, rival):
        values, heights = zip(*self.points)
        return self.offset + self.scale * own + numpy.interp(rival, values, heights)


def fit_all(log_odds, truths):
    """By cause; those that are no rivals have none."""
    result = {}
    for cause, own in log_odds.items():
        if cause in NO_RIVALS:
            continue
        known = ~numpy.isnan(truths[cause])
        result[cause] = RivalFit(own[known], any_rival(log_odds, cause)[known],
                                 truths[cause][known])
    return result


def apply_all(fits, log_odds, shifts=None):
    """`shifts`: by cause, of the log odds of priors where they are not those of the fit."""
    shifts = shifts or {}
    here = {cause: odds + shifts.get(cause, 0.0) for cause, odds in log_odds.items()}
    return {cause: shifts.get(cause, 0.0) +
            (fits[cause].log_odds(own, any_rival(here, cause)) if cause in fits else own)
            for cause, own in log_odds.items()}
