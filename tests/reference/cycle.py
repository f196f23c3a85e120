"""Populations of cells that cycle through phases, computed apart from the program: rates of growth and parts of the cells in each phase."""

from math import erf, exp, log, pi, sqrt

from numerics import root

HOURS = (7.0, 6.0, 3.0, 2.0)  # G1, S, G2, M


def fixed(rate, time):
    return exp(-rate * time)


def erlang(stages):
    return lambda rate, time: (1.0 + rate * time / stages) ** -stages


def gaussian(spread):
    """E[e^(-rate T)] of a Gaussian that is cut at three deviations: the whole integral is that of a shifted Gaussian."""

    def discount(rate, time):
        shift = rate * time * spread
        phi = lambda x: 0.5 * (1.0 + erf(x / sqrt(2.0)))
        return exp(-rate * time + 0.5 * shift * shift) * (phi(3.0 + shift) - phi(-3.0 + shift)) / (phi(3.0) - phi(-3.0))

    return discount


def growth_rate(discount):
    """alpha [1/h] of the product of E[e^(-alpha T)] over the phases = 1/2."""
    return root(lambda rate: sum(log(discount(rate, hours)) for hours in HOURS) + log(2.0), 1e-3, 1.0)


def fractions(discount):
    """2 (1 - M_p) times the product of M_q over the phases before."""
    rate, behind, out = growth_rate(discount), 1.0, []
    for hours in HOURS:
        kept = discount(rate, hours)
        out.append(2.0 * behind * (1.0 - kept))
        behind *= kept
    return out


LAWS = {"fixed": fixed, "erlang 1": erlang(1), "erlang 10": erlang(10), "erlang 100": erlang(100), "gaussian 10 %": gaussian(0.1)}


def values():
    out = {}
    for name, law in LAWS.items():
        out[f"cycle {name}: rate [1/h]"] = growth_rate(law)
        for phase, part in zip(("G1", "S", "G2", "M"), fractions(law)):
            out[f"cycle {name}: part in {phase}"] = part
    return out


if __name__ == "__main__":
    for name, value in values().items():
        print(f"{name}: {value:.7f}")
