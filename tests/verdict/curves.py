"""Additive logistic regression: the log odds of a cause as a sum of one curve per figure.

A curve is a chain of ramps between knots; where physics says so it rises or falls throughout. A
figure that was not computed has a weight of its own. Ridge keeps curves flat where little is known.
"""

import numpy
from scipy.optimize import minimize

# Of the values that are no ties with the commonest one: 2 % at either end are left level.
KNOT_SHARES = (0.02, 0.15, 0.4, 0.65, 0.85, 0.95, 0.99)
# Differences of equal samples.
ROUNDING = 1e-9
# In records: a ramp that moves the odds by e costs as much as half of so many log scores of 1.
RIDGE = 10.0


def knots_of(values):
    """Where the curve may bend; the commonest value, as 0 of a step that is not there, is one."""
    values = values[~numpy.isnan(values)]
    values = numpy.where(numpy.abs(values) < ROUNDING, 0.0, values)
    if values.size == 0:
        return numpy.array([])
    several, counts = numpy.unique(values, return_counts=True)
    commonest = several[counts.argmax()]
    tied = counts.max() > 0.2 * values.size
    others = values[values != commonest] if tied else values
    knots = list(numpy.quantile(others, KNOT_SHARES)) if others.size else []
    if tied:
        knots.append(commonest)
    # Printed with six digits in the table: the fit works on what is printed.
    return numpy.unique([float(f"{knot:.6g}") for knot in knots])


class Basis:
    """Ramps of one figure; a last column marks what was not computed."""

    def __init__(self, name, direction, values):
        self.name = name
        self.direction = direction
        self.knots = knots_of(values)

    @property
    def size(self):
        return max(0, self.knots.size - 1) + 1

    def columns(self, values):
        missing = numpy.isnan(values)
        columns = numpy.zeros((values.size, self.size))
        columns[missing, -1] = 1.0
        shown = numpy.where(missing, 0.0, values)
        for k in range(self.knots.size - 1):
            low, high = self.knots[k], self.knots[k + 1]
            columns[:, k] = numpy.where(missing, 0.0, numpy.clip((shown - low) / (high - low), 0, 1))
        return columns

    def bounds(self):
        ramp = {1: (0, None), -1: (None, 0), 0: (None, None)}[self.direction]
        return [ramp] * (self.size - 1) + [(None, None)]


class Fit:
    """Curves of one cause, fitted to `truth` (0, 1) of the records."""

    def __init__(self, figures, directions, truth, ridge=RIDGE):
        self.bases = [Basis(name, sign, figures[name]) for name, sign in directions.items()]
        design = self.design(figures)
        count = design.shape[1]

        def loss(beta):
            odds = beta[0] + design @ beta[1:]
            grade = 1 / (1 + numpy.exp(-odds)) - truth
            value = numpy.logaddexp(0, odds).sum() - truth @ odds
            value += 0.5 * ridge * beta[1:] @ beta[1:]
            slope = numpy.concatenate([[grade.sum()], design.T @ grade + ridge * beta[1:]])
            return value / truth.size, slope / truth.size

        share = numpy.clip(truth.mean(), 1e-4, 1 - 1e-4)
        start = numpy.zeros(count + 1)
        start[0] = numpy.log(share / (1 - share))
        bounds = [(None, None)] + [b for basis in self.bases for b in basis.bounds()]
        found = minimize(loss, start, jac=True, method="L-BFGS-B", bounds=bounds,
                         options={"maxiter": 2000, "maxfun": 4000, "ftol": 1e-10, "gtol": 1e-7})
        self.share = float(truth.mean())
        self.beta = found.x
        self.means = design.mean(axis=0)

    def design(self, figures):
        return numpy.hstack([basis.columns(figures[basis.name]) for basis in self.bases])

    def log_odds(self, figures):
        return self.beta[0] + self.design(figures) @ self.beta[1:]

    def curves(self):
        """(figure, weight where not computed, [(value, weight)]), each with the mean 0, and the
        log odds that are left."""
        rest, place, result = self.beta[0], 1, []
        for basis in self.bases:
            own = self.beta[place:place + basis.size]
            mean = float(self.means[place - 1:place - 1 + basis.size] @ own)
            heights = numpy.concatenate([[0.0], numpy.cumsum(own[:-1])])[:basis.knots.size]
            points = [(knot, height - mean) for knot, height in zip(basis.knots, heights)]
            result.append((basis.name, own[-1] - mean, points))
            rest += mean
            place += basis.size
        return rest, result
