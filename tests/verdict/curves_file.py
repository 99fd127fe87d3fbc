"""The fitted table as core/diagnosis reads it."""

HEAD = """// Written by tests/verdict/train; not edited by hand.
// {records} simulated records, seeds {first} to {last}; algorithm revision {revision}; ridge {ridge:g}.
// Held-out families: {figures}.
// Each curve: the figure, its weight where it was not computed, and (value, weight) at its bends.
// Weights are natural logarithms of odds.
// clang-format off

"""

# Smaller weights than this change odds by a thousandth.
LEAST = 5e-4


def number(value):
    return f"{value:.6g}"


def weight(value):
    return f"{0.0 if abs(value) < LEAST else value:.4g}"


def curve_text(figure, not_computed, points):
    return f'        {{"{figure}", {weight(not_computed)}, {points_text(points)}}},\n'


def is_flat(not_computed, points):
    return abs(not_computed) < LEAST and all(abs(w) < LEAST for _, w in points)


def points_text(points):
    return "{" + ", ".join(f"{{{number(v)}, {weight(w)}}}" for v, w in points) + "}"


def beside_text(fit):
    """Scale of its own odds, offset, the curves over the rivals' odds and any nonlinearity's; None for one
    that stands alone."""
    if fit is None:
        return "1, 0, {}, {}"
    return (f"{fit.scale:.4g}, {fit.offset:.4g}, {points_text(fit.rival)},\n"
            f"       {points_text(fit.nonlinear)}")


def table_text(name, fits):
    """`fits`: by cause, its curves and what it is beside the others."""
    text = f"std::vector<CauseCurves> {name}() {{\n  return {{\n"
    for cause, (fit, beside) in fits.items():
        rest, curves = fit.curves()
        text += f'      {{"{cause}", {number(fit.share)}, {rest:.4g},\n'
        text += f"       {{{beside_text(beside)}}},\n       {{\n"
        text += "".join(curve_text(*curve) for curve in curves if not is_flat(*curve[1:]))
        text += "       }},\n"
    return text + "  };\n}\n"


def write(folder, facts, fits):
    """`fits`: by name of the table, by cause. A file for each."""
    for name, by_cause in fits.items():
        with open(folder / f"curves_{name}.inc", "w", encoding="utf-8") as file:
            file.write(HEAD.format(figures=facts[name], **facts))
            file.write(table_text(f"curves_{name}", by_cause))
