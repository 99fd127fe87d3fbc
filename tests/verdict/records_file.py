"""Records as `verdict_records` prints them."""

import csv

import numpy


# Beside the figures.
LEADING = ["seed", "family", "causes", "doubtful"]


class Records:
    """Columns of figures (NaN = not computed) and the truth of each record."""

    def __init__(self, lines):
        rows = csv.reader(lines, delimiter="\t")
        heading = next(rows)
        if heading[:4] != LEADING:
            raise ValueError(f"its heading does not begin with {', '.join(LEADING)}")
        body = [row for row in rows if len(row) == len(heading)]
        if not body:
            raise ValueError("no records stand in it")
        self.names = [name.rstrip("*") for name in heading[4:]]
        self.of_model = [name.rstrip("*") for name in heading[4:] if name.endswith("*")]
        self.seeds = [row[0] for row in body]
        self.families = numpy.array([row[1] for row in body])
        self.causes = [set(filter(None, row[2].split(","))) for row in body]
        self.doubtful = [set(filter(None, row[3].split(","))) for row in body]
        values = numpy.array([[float(v) if v else numpy.nan for v in row[4:]] for row in body])
        self.figures = {name: values[:, k] for k, name in enumerate(self.names)}

    def counted(self, times):
        """The same with each record as often as the rarest of its causes counts."""
        often = [max([times.get(cause, 1) for cause in causes or {"healthy"}])
                 for causes in self.causes]
        order = numpy.repeat(numpy.arange(len(self)), often)
        result = object.__new__(Records)
        result.names, result.of_model = self.names, self.of_model
        result.seeds = [self.seeds[k] for k in order]
        result.families = self.families[order]
        result.causes = [self.causes[k] for k in order]
        result.doubtful = [self.doubtful[k] for k in order]
        result.figures = {name: values[order] for name, values in self.figures.items()}
        return result

    def __len__(self):
        return len(self.causes)

    def without_model(self):
        """The same records as a loop without a model shows them."""
        nothing = numpy.full(len(self), numpy.nan)
        figures = {n: nothing if n in self.of_model else v for n, v in self.figures.items()}
        # Where no model tells how fast the process is.
        return figures | {"error.memory_unmodelled": self.figures["error.memory"]}

    def truth(self, cause):
        """1, 0, or NaN where the generator leaves it open."""
        return numpy.array([self._truth(k, cause) for k in range(len(self))])

    def _truth(self, k, cause):
        own, open_ones = self.causes[k], self.doubtful[k]
        if cause == "healthy":
            return 0.0 if own else numpy.nan if open_ones else 1.0
        if cause == "nonlinear_unexplained":
            return 1.0 if own & NONLINEAR else numpy.nan if open_ones & NONLINEAR else 0.0
        return 1.0 if cause in own else numpy.nan if cause in open_ones else 0.0


NONLINEAR = {"valve_stiction", "valve_deadband", "valve_saturation", "valve_characteristic",
             "process_nonlinearity"}


def rows(figures, kept):
    return {name: values[kept] for name, values in figures.items()}
