"""Reference numbers of closed shapes and of water: by energies, balances and integration."""
import math

from numerics import integral, integrate, minimum, root

PI = math.pi
RT = 8.314462618 * 310.15 / 1000.0  # kPa/mM


def shocked(time):
    """V/V_t of a sphere of 6 um, 30 % inactive, permeability 1e-3 um/(s kPa), `time` after 300 mM became 150 mM."""
    start = 4.0 / 3.0 * PI * 6.0 ** 3
    inactive = 0.3 * start
    solutes = 300.0 * (start - inactive)

    def rate(y):
        area = (36.0 * PI) ** (1.0 / 3.0) * y[0] ** (2.0 / 3.0)
        return [1e-3 * area * RT * (solutes / (y[0] - inactive) - 150.0)]
    return integrate(rate, [start], time, 4000)[0] / start


def rest_of_a_tense_cell(outside, tension=0.5, bulk=2.5):
    """(V, V0) over the target volume where water and the Laplace pressure of a sphere are in balance."""
    target = 4.0 / 3.0 * PI * 6.0 ** 3
    inactive = 0.3 * target
    solutes = 300.0 * (target - inactive)
    laplace = lambda v: 2.0 * tension / (0.75 * v / PI) ** (1.0 / 3.0)
    v = root(lambda v: RT * (solutes / (v - inactive) - outside) - laplace(v), 0.5 * target, 3.0 * target)
    return v / target, v / target * math.exp(laplace(v) / bulk)


def maugis_pull_off(parameter):
    """Largest pull over pi R W: for every ratio m of the radii the contact radius from its condition, by bisection."""
    def pull(m):
        def condition(a):
            s, t = math.sqrt(m * m - 1.0), math.acos(1.0 / m)
            return 0.5 * parameter * a * a * ((m * m - 2.0) * t + s) + 4.0 / 3.0 * parameter ** 2 * a * (s * t - m + 1.0) - 1.0
        a = root(condition, 0.0, 1e9)
        return a ** 3 - parameter * a * a * (math.sqrt(m * m - 1.0) + m * m * math.acos(1.0 / m))
    grid = [1.0 + math.exp(-9.0 + 0.05 * k) for k in range(500)]
    best = min(range(len(grid)), key=lambda k: pull(grid[k]))
    # weak adhesion of long range pulls most where the contact is a point: the grid ends there
    return -pull(minimum(pull, grid[max(0, best - 1)], grid[min(len(grid) - 1, best + 1)]))


def critical_aspiration(tension, pipette, cell):
    """2 T (1/R_p - 1/R_c), R_c such that the part outside, a ball without the cap in the opening, and the hemisphere inside have the cell's volume."""
    volume = 4.0 / 3.0 * PI * cell ** 3

    def left(radius):
        opening = math.sqrt(radius ** 2 - pipette ** 2)
        outside = integral(lambda x: PI * (radius ** 2 - x ** 2), -radius, opening, 8)
        inside = integral(lambda x: PI * (pipette ** 2 - x ** 2), 0.0, pipette, 8)
        return outside + inside - volume
    outer = root(left, pipette, 2.0 * cell)
    return 2.0 * tension * (1.0 / pipette - 1.0 / outer)


def cap(adhesion):
    """A fluid cell on a plane, adhesion in units of its tension: shape of least energy among the caps of one volume.
    (angle, radius, contact radius, height, contact part of 4 pi R0^2, pressure R0/(2 T)), lengths in units of R0."""
    volume = 4.0 / 3.0 * PI

    def shape(cosine):  # ball cut at a height `cosine` times its radius below the centre
        of_unit = integral(lambda x: PI * (1.0 - x * x), -cosine, 1.0, 8)
        radius = (volume / of_unit) ** (1.0 / 3.0)
        return radius, 2.0 * PI * radius ** 2 * (1.0 + cosine), PI * radius ** 2 * (1.0 - cosine ** 2)

    def energy(cosine):
        _, free, contact = shape(cosine)
        return free + (1.0 - adhesion) * contact
    # where the energy is flat its slope is what tells the place
    slope = lambda c: energy(c + 1e-5) - energy(c - 1e-5)
    cosine = root(slope, -0.999, 0.9999)
    radius, _, contact = shape(cosine)
    return math.degrees(math.acos(cosine)), radius, math.sqrt(contact / PI), radius * (1.0 + cosine), contact / (4.0 * PI), 1.0 / radius


def doublet_row(ratio):
    """By column of scenarios/library/doublet/doublet_equilibrium.csv; ratio: W/T."""
    angle, radius, contact_radius, height, contact, pressure = cap(0.5 * ratio)
    free = 0.5 * radius * height  # 2 pi R h over 4 pi
    return {"contact_angle_deg": angle, "cap_radius_over_R0": radius, "contact_radius_over_R0": contact_radius, "doublet_length_over_R0": 2.0 * height,
            "doublet_width_over_R0": 2.0 * radius, "contact_fraction_of_cell_surface": contact / (contact + free),
            "pressure_times_R0_over_T": 2.0 * pressure}


def spreading_row(ratio):
    """By column of scenarios/library/spreading/spreading_equilibrium.csv, whose angle is measured through the cell."""
    angle, radius, contact_radius, height, contact, pressure = cap(ratio)
    return {"contact_angle_deg": 180.0 - angle, "cap_radius_over_R0": radius, "contact_radius_over_R0": contact_radius, "height_over_R0": height,
            "contact_area_over_initial_surface": contact, "pressure_times_R0_over_T": 2.0 * pressure}


TABLES = {"scenarios/library/doublet/doublet_equilibrium.csv": doublet_row, "scenarios/library/spreading/spreading_equilibrium.csv": spreading_row}


def philox(counter, key):
    """Philox4x32-10 of Salmon et al. 2011 in integers of any size."""
    c, k = list(counter), list(key)
    for _ in range(10):
        a, b = 0xD2511F53 * c[0], 0xCD9E8D57 * c[2]
        c = [(b >> 32) ^ c[1] ^ k[0], b % 2 ** 32, (a >> 32) ^ c[3] ^ k[1], a % 2 ** 32]
        k = [(k[0] + 0x9E3779B9) % 2 ** 32, (k[1] + 0xBB67AE85) % 2 ** 32]
    return c


def values():
    out = {f"T6.5 | volume {time} s after a shock from 300 to 150 mM, relative": shocked(float(time)) for time in (1, 2, 5, 10, 20, 60)}
    rest, reference = rest_of_a_tense_cell(300.0)
    out["T6.6 | volume at rest of a shell of tension 0.5 nN/um in 300 mM over its target, 162 nodes"] = rest
    out["T6.6 | its V0 over the target volume"] = reference
    out["T6.6 | volume of the shell 10 min after a shock to 150 mM over its target"] = rest_of_a_tense_cell(150.0)[0]
    out |= {f"Maugis: pull-off at {x:g}": maugis_pull_off(x) for x in (0.01, 0.1, 0.5, 1.0, 2.0, 5.0)}
    out |= {f"aspiration: tension {t:g}, pipette {p:g}, cell 6": critical_aspiration(t, p, 6.0) for t, p in ((0.1, 2.5), (0.1, 4.0), (0.4, 2.0))}
    for w in (0.1, 0.2, 0.3, 0.5, 0.75, 0.9, 1.0):
        names = ("angle", "R/R0", "a/R0", "H/R0", "contact part", "pressure")
        out |= {f"cap at w = {w:g}: {name}": value for name, value in zip(names, cap(w))}
    words = philox((1, 0, 0, 0), (0, 0)), philox((0, 0, 0, 0), (0x2A, 7))
    out |= {f"Philox: answer {n}, word {k}": float(word) for n, answer in enumerate(words) for k, word in enumerate(answer)}
    first, second = (((answer[1] * 2 ** 32 + answer[0]) >> 12) + 0.5 for answer in (words[1], words[1][2:]))
    u, v = first / 2.0 ** 52, second / 2.0 ** 52
    far = math.sqrt(-2.0 * math.log(u))
    out |= {"Philox: uniform 0": u, "Philox: uniform 1": v, "Philox: normal 0": far * math.cos(2.0 * PI * v), "Philox: normal 1":
            far * math.sin(2.0 * PI * v)}
    return out
