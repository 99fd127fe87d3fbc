"""Explaining away: how much a cause loses where another explains the same loop.

Curves of one cause do not know what the others say. A second, small regression puts its log odds
beside those of its rivals, that any of them is there were they independent, and those of any
nonlinearity of valve and process: offset + scale * own + a curve that falls with the rivals' + one
that rises with the nonlinearity's for causes that are nonlinear, and falls for those that are not. It
is fitted to log odds by curves that have not seen the record's family."""

import numpy
from scipy.optimize import minimize

from records_file import NONLINEAR, rows

# Log odds, of the rivals and of any nonlinearity: from 2 % to 98 %.
KNOTS = numpy.array([-4.0, -3.0, -2.0, -1.0, 0.0, 1.0, 2.0, 4.0])
ANY_NONLINEARITY = "nonlinear_unexplained"
# Any nonlinearity is no rival of one of them; the oversized valve is known of few loops.
NO_RIVALS = (ANY_NONLINEARITY, "valve_oversized")
# Where little is known a cause keeps its own log odds; as in curves.py.
RIDGE = 10.0
# In -ln of the probability that none is there; beyond it no double is below 1.
SUREST = 30.0


def any_rival(log_odds, cause):
    """`log_odds`: by cause. That any other cause is there."""
    none = sum(numpy.logaddexp(0.0, odds) for name, odds in log_odds.items()
               if name != cause and name not in NO_RIVALS)
    return numpy.log(numpy.expm1(numpy.minimum(none, SUREST)))


class BesideFit:
    def __init__(self, cause, log_odds, truth, ridge):
        own = log_odds[cause]
        ramps = [self._ramps(any_rival(log_odds, cause)), self._ramps(log_odds[ANY_NONLINEARITY])]
        design = numpy.column_stack([own, *ramps])

        def loss(beta):
            odds = beta[0] + design @ beta[1:]
            # The same as 1 / (1 + exp(-odds)), for odds of any size.
            grade = 0.5 * (1 + numpy.tanh(0.5 * odds)) - truth
            apart = beta - start
            value = numpy.logaddexp(0, odds).sum() - truth @ odds + 0.5 * ridge * apart @ apart
            slope = numpy.concatenate([[grade.sum()], design.T @ grade]) + ridge * apart
            return value / truth.size, slope / truth.size

        count = len(KNOTS) - 1
        start = numpy.r_[0.0, 1.0, numpy.zeros(2 * count)]
        # Its own odds count between half and twice; a rival never helps.
        bounds = [(None, None), (0.5, 2.0)] + [(None, 0.0)] * count
        bounds += [(0.0, None) if cause in NONLINEAR else (None, 0.0)] * count
        found = minimize(loss, start, jac=True,
                         method="L-BFGS-B", bounds=bounds, options={"maxiter": 1000})
        self.cause, self.scale = cause, found.x[1]
        self.rival, first = self._curve(ramps[0], found.x[2:2 + count])
        self.nonlinear, second = self._curve(ramps[1], found.x[2 + count:])
        self.offset = found.x[0] + first + second

    @staticmethod
    def _curve(ramps, slopes):
        """Points of a curve with the mean 0 over the records, and what its mean was."""
        heights = numpy.concatenate([[0.0], numpy.cumsum(slopes)])
        mean = float((ramps @ slopes).mean())
        return list(zip(KNOTS, heights - mean)), mean

    @staticmethod
    def _ramps(odds):
        return numpy.column_stack([numpy.clip((odds - low) / (high - low), 0, 1)
                                   for low, high in zip(KNOTS[:-1], KNOTS[1:])])

    def log_odds(self, own, rival, nonlinear):
        return (self.offset + self.scale * own + numpy.interp(rival, *zip(*self.rival)) +
                numpy.interp(nonlinear, *zip(*self.nonlinear)))


def fit_all(log_odds, truths, ridge=RIDGE):
    """By cause; those that are no rivals have none."""
    result = {}
    for cause in log_odds:
        if cause in NO_RIVALS:
            continue
        known = ~numpy.isnan(truths[cause])
        result[cause] = BesideFit(cause, rows(log_odds, known), truths[cause][known], ridge)
    return result


def apply_all(fits, log_odds, shifts=None):
    """`shifts`: by cause, of the log odds of priors where they are not those of the fit."""
    shifts = shifts or {}
    here = {cause: odds + shifts.get(cause, 0.0) for cause, odds in log_odds.items()}
    return {cause: shifts.get(cause, 0.0) +
            (fits[cause].log_odds(own, any_rival(here, cause), here[ANY_NONLINEARITY])
             if cause in fits else own)
            for cause, own in log_odds.items()}
