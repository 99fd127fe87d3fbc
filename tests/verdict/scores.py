"""How good probabilities are."""

import numpy


def brier(probability, truth):
    return float(numpy.mean((probability - truth) ** 2))


def any_of(*probabilities):
    """Of causes that hardly stand together: a valve is told to stick or to have play."""
    return numpy.minimum(1.0, numpy.sum(probabilities, axis=0))


def log_score(probability, truth):
    p = numpy.clip(probability, 1e-12, 1 - 1e-12)
    return float(-numpy.mean(truth * numpy.log(p) + (1 - truth) * numpy.log(1 - p)))


def calibration_error(probability, truth, bins=10):
    """Mean distance between probability and frequency over bins of equal count."""
    order = numpy.argsort(probability, kind="stable")
    parts = [part for part in numpy.array_split(order, bins) if part.size]
    return float(sum(part.size * abs(probability[part].mean() - truth[part].mean())
                     for part in parts) / len(order))


def auc(score, truth):
    order = numpy.argsort(score, kind="stable")
    ranks = numpy.empty(len(order))
    ranks[order] = numpy.arange(1, len(order) + 1)
    for value in numpy.unique(score):
        same = score == value
        ranks[same] = ranks[same].mean()
    yes = truth > 0.5
    if yes.all() or not yes.any():
        return float("nan")
    return float((ranks[yes].sum() - yes.sum() * (yes.sum() + 1) / 2) / (yes.sum() * (~yes).sum()))


def shares(said, truth):
    """Sensitivity and specificity of a yes or no."""
    yes = truth > 0.5
    return (float(said[yes].mean()) if yes.any() else None,
            float((~said[~yes]).mean()) if (~yes).any() else None)
