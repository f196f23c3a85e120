"""Reference numbers of spheres: JKR by bisection of the law in its own form, packing by lattices and quadrature, motion by Runge and Kutta."""
import math

from numerics import integral, integrate, minimum, root, solve

PI = math.pi


class Jkr:
    """F(a) = 4 E a^3/(3 R) - sqrt(8 pi W E a^3), overlap(a) = a^2/R - sqrt(2 pi W a/E), with reduced modulus and radius."""

    def __init__(self, radius, modulus, adhesion):
        self.radius, self.modulus, self.adhesion = radius, modulus, adhesion
        # the branch folds back where the overlap is least
        self.fold = minimum(self.overlap_of, 0.0, 2.0 * radius)

    @staticmethod
    def pair(r1, r2, e1, e2, nu1, nu2, adhesion):
        return Jkr(1.0 / (1.0 / r1 + 1.0 / r2), 1.0 / ((1.0 - nu1 ** 2) / e1 + (1.0 - nu2 ** 2) / e2), adhesion)

    def overlap_of(self, a):
        return a * a / self.radius - math.sqrt(2.0 * PI * self.adhesion * a / self.modulus)

    def force_of(self, a):
        return 4.0 * self.modulus * a ** 3 / (3.0 * self.radius) - math.sqrt(8.0 * PI * self.adhesion * self.modulus * a ** 3)

    def contact_radius(self, overlap):
        return root(lambda a: self.overlap_of(a) - overlap, self.fold, 10.0 * self.radius)

    def force(self, overlap):
        return self.force_of(self.contact_radius(overlap))

    def slope(self, overlap, step=1e-4):
        f = lambda x: self.force(overlap + x)
        return (f(-2 * step) - 8.0 * f(-step) + 8.0 * f(step) - f(2 * step)) / (12.0 * step)

    def rest(self):
        """Contact radius without load."""
        return root(self.force_of, self.fold, 10.0 * self.radius)

    def pull_off(self):
        return -self.force_of(minimum(self.force_of, 0.0, self.rest()))

    def length(self):
        """X: the fold is at -0.75 X."""
        return -self.overlap_of(self.fold) / 0.75

    def work(self, low, high):
        """Of the pair from one contact radius to another: the integral of F d(overlap)."""
        step = 1e-6
        return integral(lambda a: self.force_of(a) * (self.overlap_of(a + step) - self.overlap_of(a - step)) / (2.0 * step), low, high)


def jkr_values():
    out = {}
    law = Jkr.pair(5.0, 5.0, 0.45, 0.45, 0.4, 0.4, 0.1)
    name = "JKR reference pair: "
    x, unit = law.length(), PI * law.adhesion * law.radius
    out |= {name + "reduced modulus": law.modulus, name + "X": x, name + "a_s": math.sqrt(x * law.radius), name + "pi W R*": unit,
            name + "pull-off force": law.pull_off(), name + "contact radius at rest": law.rest(), name + "overlap at rest":
            law.overlap_of(law.rest()), name + "area at rest": PI * law.rest() ** 2, name + "slope at rest": law.slope(law.overlap_of(law.rest())),
            name + "slope at first touch": law.slope(0.0), name + "slope at 2 um": law.slope(2.0),
            name + "contact radius at the fold": law.fold, name + "force at the fold": law.force_of(law.fold)}
    for ratio in (-0.7, -0.6, -0.5, 0.0, 0.25, 0.3, 0.5, 0.75, 1.0, 1.5, 2.0, 3.0):
        a = law.contact_radius(ratio * x)
        out |= {f"{name}contact radius at {ratio:g} X": a, f"{name}force at {ratio:g} X": law.force_of(a), f"{name}area at {ratio:g} X": PI * a * a}
    for overlap in (-1.0, -0.5, 0.5, 1.0, 1.5, 2.0, 3.0):
        a = law.contact_radius(overlap)
        out |= {f"{name}contact radius at {overlap:g} um": a, f"{name}force at {overlap:g} um": law.force_of(a)}
    touch = law.contact_radius(0.0)
    out[name + "energy lost in a cycle over pi W R* X"] = law.work(law.fold, touch) / (unit * x) * -1.0
    out[name + "work to separate from rest over pi W R* X"] = law.work(law.fold, law.rest()) / (unit * x) * -1.0
    out[name + "energy lost in a cycle"] = -law.work(law.fold, touch)
    for friction, times in ((50.0, (1, 10, 30, 100, 300, 1000, 3000, 10000)), (0.0, (1, 10, 30, 100))):
        def rate(state):
            a = law.contact_radius(state[0])
            return [-2.0 * law.force_of(a) / (31.41593 + 2.0 * friction * PI * a * a)]
        state, now = [0.0], 0.0
        for time in times:
            state = integrate(rate, state, time - now, max(20, int((time - now) / (5.0 if friction else 0.25))))
            now = time
            out[f"{name}overlap {time} s after touching, friction {friction:g}"] = state[0]
    law = Jkr.pair(5.0, 6.5, 0.45, 1.0, 0.4, 0.3, 0.05)
    out |= {"JKR unequal pair: " + what: value for what, value in {
        "reduced radius": law.radius, "reduced modulus": law.modulus, "X": law.length(), "pull-off force": law.pull_off(), "contact radius at rest":
        law.rest(), "overlap at rest": law.overlap_of(law.rest()), **{f"force at {d:g} um": law.force(d) for d in (-0.3, 0.0, 0.5, 1.0)}}.items()}
    law = Jkr(5.0, 0.45 / (1.0 - 0.16), 0.1)
    out |= {"JKR on a plane: " + what: value for what, value in {
        "X": law.length(), "pull-off force": law.pull_off(), "contact radius at rest": law.rest(), "overlap at rest": law.overlap_of(law.rest()),
        **{f"force at {d:g} um": law.force(d) for d in (-0.5, 0.0, 0.5, 1.0)}}.items()}
    return out


# --- packing ------------------------------------------------------------------------------------------------------------------------------------


def cap(radius, other, distance):
    """Volume of the part of a ball that lies behind the plane it shares with another: by discs."""
    plane = root(lambda x: (radius ** 2 - x ** 2) - (other ** 2 - (distance - x) ** 2), -10.0 * radius, 10.0 * radius)
    return integral(lambda x: PI * (radius ** 2 - x ** 2), plane, radius, 4)


def cap_slope(radius, other, distance, step=1e-2):
    at = lambda k: cap(radius, other, distance + k * step)
    return (at(-2) - 8.0 * at(-1) + 8.0 * at(1) - at(2)) / (12.0 * step)


def packing_values():
    out = {"cbm 3 | cap of a sphere of 6 um behind the plane it shares with one of 5 um at 9.5 um [um^3]": cap(6.0, 5.0, 9.5),
           "cbm 3 | its change with the distance [um^2]": cap_slope(6.0, 5.0, 9.5), "cap of a sphere of 5 um behind one of 6 um at 9.5 um":
           cap(5.0, 6.0, 9.5), "change of the cap of 5 um": -cap_slope(5.0, 6.0, 9.5), "change of the cap of 6 um": -cap_slope(6.0, 5.0, 9.5),
           "cap of equal spheres of 5 um at 8 um": cap(5.0, 5.0, 8.0)}
    radius, young, poisson, bulk = 6.0, 0.45, 0.4, 2.5
    modulus, ball = young / (2.0 * (1.0 - poisson ** 2)), 4.0 / 3.0 * PI * radius ** 3
    # the twelve neighbours of a site of a face-centred cubic lattice of spacing d; a cell of it has d^3/sqrt(2)
    cell = lambda d: d ** 3 / math.sqrt(2.0)

    def hertz(d):  # virial: p = sum of half of each pair's d F over three times the volume
        force = 4.0 / 3.0 * modulus * math.sqrt(0.5 * radius) * (2.0 * radius - d) ** 1.5
        return 12 * 0.5 * d * force / (3.0 * cell(d))
    filled = lambda d: bulk * math.log(ball / cell(d)) if cell(d) < ball else 0.0
    spacing = lambda s: 2.0 * radius * (1.0 - s)
    packing = lambda d: 12.0 * cap(radius, radius, d) / ball
    onset = root(lambda d: filled(d) - hertz(d), spacing(0.12), spacing(0.09))
    out["cbm 3 | packing at which an ideal filled cell presses, E 450 Pa, K_V 2.5 kPa"] = packing(onset)
    for s in (0.05, 0.115, 0.12, 0.2):
        out[f"cbm 3 | pressure of cubic close packed filled cells at overlap {s:g} of the diameter [kPa]"] = max(hertz(spacing(s)), filled(spacing(s)))
    out["overlap of the diameter at which close packed spheres fill space"] = 1.0 - root(lambda d: cell(d) - ball, radius, 2.0 * radius) / (2.0 * radius)
    for s in (0.10, 0.11, 0.12, 0.14, 0.16, 0.20, 0.25):
        d = spacing(s)
        # what one unit of pressure of packing gives by virial, with the slope of the caps: 12 neighbours, each pair pressed on from both sides
        unit = 12 * 0.5 * d * -2.0 * cap_slope(radius, radius, d) / (3.0 * cell(d))
        out[f"packing of close packed spheres at overlap {s:g}"] = packing(d)
        out[f"pressure of packing of an ideal filled cell at overlap {s:g} [Pa]"] = 1000.0 * (filled(d) - hertz(d)) / unit
    return out


# --- motion -------------------------------------------------------------------------------------------------------------------------------------


def motion_values():
    modulus, reduced, friction = 0.45 / (2.0 * (1.0 - 0.16)), 2.5, 0.1 * 4.0 * PI * 25.0
    hertz = lambda overlap: 4.0 / 3.0 * modulus * math.sqrt(reduced) * overlap ** 1.5 if overlap > 0.0 else 0.0
    push = 5.2359878
    out = {"cbm 7.2 | rest": 10.0 - root(lambda x: hertz(x) - push, 0.0, 9.0)}
    for time in (6, 12, 30):
        overlap = integrate(lambda y: [2.0 * (push - hertz(y[0])) / friction], [0.0], float(time), 4000)[0]
        out[f"cbm 7.2 | study: their overlap {time} s after they met, step to 0 [um]"] = overlap

    def chain(x):
        out = [0.0] * len(x)
        for i in range(len(x)):
            for j in range(i + 1, len(x)):
                force = hertz(10.0 - (x[j] - x[i]))
                out[i] -= force / friction
                out[j] += force / friction
        return out
    x, now = [5.0 * (i - 5) for i in range(11)], 0.0
    for time in (20, 60, 120):
        x = integrate(chain, x, time - now, int((time - now) / 0.05))
        now = time
        out["cbm 7.1 | study: width of a chain of 11 spheres of Hertz, half a diameter apart at first, after "
            f"{time} s, step to 0 [um]"] = x[-1] - x[0]
    out["Hertz reference pair: force at 0.5 um"], out["Hertz reference pair: force at 1 um"] = hertz(0.5), hertz(1.0)
    out["Hertz reference pair: force at 2 um"] = hertz(2.0)
    return out


def friction_values():
    """Velocities of a few cells: the linear systems of docs/physics/cbm.md, written out and solved by elimination."""
    def velocities(count, pairs, force, medium=45.0):
        """`pairs`: (i, j, normal, tangential, n)."""
        matrix = [[medium if r == c else 0.0 for c in range(3 * count)] for r in range(3 * count)]
        for i, j, normal, tangential, n in pairs:
            for a in range(3):
                for b in range(3):
                    block = (normal - tangential) * n[a] * n[b] + (tangential if a == b else 0.0)
                    for p, q, sign in ((i, i, 1), (j, j, 1), (i, j, -1), (j, i, -1)):
                        matrix[3 * p + a][3 * q + b] += sign * block
        return solve(matrix, force)
    along = (1.0, 0.0, 0.0)
    chain = lambda count: [(i, i + 1, 600.0, 600.0, along) for i in range(count - 1)]
    pulled = lambda count: [1.0] + [0.0] * (3 * count - 1)
    out = {"friction: two cells pulled apart": velocities(2, chain(2), [1.0, 0, 0, -1.0, 0, 0])[0]}
    for what, count, pairs in (("two cells", 2, chain(2)), ("chain of three", 3, chain(3)), ("triangle", 3, chain(3) + [(0, 2, 600.0, 600.0, along)]),
                               ("chain of ten", 10, chain(10))):
        v = velocities(count, pairs, pulled(count))
        out |= {f"friction: {what}, cell {i}": v[3 * i] for i in range(count)}
    v = velocities(2, [(0, 1, 400.0, 150.0, (math.sqrt(0.5), math.sqrt(0.5), 0.0))], pulled(2))
    out |= {"friction: oblique pair, " + what: v[k] for what, k in (("0 x", 0), ("0 y", 1), ("1 x", 3), ("1 y", 4))}
    return out


def values():
    return jkr_values() | packing_values() | motion_values() | friction_values()
