"""Reference numbers of shells: icospheres of 162, 642 and 2562 nodes with nodes at 6 um, values of Table 1 of docs/physics/dcm.md."""
import cmath
import math

from meshes import (area_of, cross, dot, edges, gradient, hessian, icosphere, node_areas, norm, scaled, sub, total, turning_angle, volume_of)
from numerics import largest_eigenvalue

RADIUS, SHEET, TENSION, BULK, MEDIUM = 6.0, 0.2, 0.5, 2.5, 0.1
PLATE = 1.0 * 0.2 ** 3 / (12.0 * (1.0 - 0.5 ** 2))
SPRING = 0.5 * math.sqrt(3.0) * SHEET
HINGE = 2.0 / math.sqrt(3.0) * PLATE
LEVELS = {42: 1, 162: 2, 642: 3, 2562: 4}
BALL = 4.0 / 3.0 * math.pi * RADIUS ** 3


def sphere(nodes):
    points, faces = icosphere(LEVELS[nodes])
    return scaled(points, RADIUS), faces


def tension_and_pressure(nodes):
    """Pressure that holds the tension best (least squares), the part of the force that it does not hold, and the breathing rate."""
    points, faces = sphere(nodes)
    pull, push = gradient(area_of, points, faces), gradient(volume_of, points, faces)
    square = sum(dot(g, g) for g in push)
    pressure = TENSION * sum(dot(a, v) for a, v in zip(pull, push)) / square
    left = sum((TENSION * a[k] - pressure * v[k]) ** 2 for a, v in zip(pull, push) for k in range(3))
    rate = sum(dot(g, g) / (MEDIUM * a) for g, a in zip(push, node_areas(points, faces)))
    return pressure, math.sqrt(left / sum(TENSION ** 2 * dot(a, a) for a in pull)), BULK / total(volume_of, points, faces) * rate


def cotangent(a, b, c):
    """Of the angle at a."""
    u, v = sub(b, a), sub(c, a)
    n = cross(u, v)
    return dot(u, v) / (cmath.sqrt(dot(n, n)) if isinstance(n[0], complex) else math.sqrt(dot(n, n)))


def helfrich_of_star(center, ring):
    """Half of |sum of (cot + cot)/2 (x - x_j)|^2 over the node's area; `ring`: the neighbours in order."""
    g, area, count = [0.0, 0.0, 0.0], 0.0, len(ring)
    for k in range(count):
        a, b = ring[k], ring[(k + 1) % count]
        at_a, at_b = cotangent(a, b, center), cotangent(b, center, a)
        for m in range(3):
            g[m] += 0.5 * (at_b * (center[m] - a[m]) + at_a * (center[m] - b[m]))
        area += area_of(center, a, b) / 3.0
    return 0.5 * dot(g, g) / area


def rings(count, faces):
    """Neighbours of every node in order around it."""
    following = [{} for _ in range(count)]
    for a, b, c in faces:
        following[a][b], following[b][c], following[c][a] = c, a, b
    out = []
    for after in following:
        ring = [next(iter(after))]
        while after[ring[-1]] != ring[0]:
            ring.append(after[ring[-1]])
        out.append(ring)
    return out


def bending_energies(nodes):
    """Over 8 pi kappa: hinges with flat rest angles, and Helfrich."""
    points, faces = sphere(nodes)
    hinge = sum(turning_angle(points[i], points[j], points[k], points[l]) ** 2 for (i, j), (k, l) in edges(faces).items())
    helfrich = sum(helfrich_of_star(points[i], [points[j] for j in ring]) for i, ring in enumerate(rings(len(points), faces)))
    return 0.5 * 2.0 / math.sqrt(3.0) * hinge / (8.0 * math.pi), helfrich / (8.0 * math.pi)


# --- longest stable steps of explicit Euler: 2/lambda of the element stiffness matrices against the friction of the nodes ----------------------


def stable_step(points, faces, elements):
    """`elements`: (nodes, matrix row by row) of each part of the stiffness."""
    root_friction = [math.sqrt(MEDIUM * a) for a in node_areas(points, faces)]
    index, weighed = [], []
    for members, matrix in elements:
        index.append([3 * i + m for i in members for m in range(3)])
        scale = [1.0 / root_friction[i] for i in members for _ in range(3)]
        weighed.append([[x * a * b for x, b in zip(row, scale)] for row, a in zip(matrix, scale)])

    def times(v):
        out = [0.0] * len(v)
        for places, matrix in zip(index, weighed):
            here = [v[p] for p in places]
            for p, row in zip(places, matrix):
                out[p] += sum(x * y for x, y in zip(row, here))
        return out
    return 2.0 / largest_eigenvalue(times, 3 * len(points))


def springs(points, faces):
    for i, j in edges(faces):
        t = sub(points[i], points[j])
        length2 = dot(t, t)
        block = [[SPRING * t[a] * t[b] / length2 for b in range(3)] for a in range(3)]
        yield (i, j), [[(1 if (r < 3) == (c < 3) else -1) * block[r % 3][c % 3] for c in range(6)] for r in range(6)]


def sheets(points, faces):
    """Plane stress of a face, Young's modulus times thickness SHEET and Poisson ratio 1/2, with the strains of linear elasticity."""
    poisson = 0.5
    c11, c33 = SHEET / (1.0 - poisson ** 2), SHEET / (2.0 * (1.0 + poisson))
    for face in faces:
        x0, x1, x2 = (points[i] for i in face)
        e1 = tuple(x / norm(sub(x1, x0)) for x in sub(x1, x0))
        n = cross(e1, sub(x2, x0))
        e2 = cross(tuple(x / norm(n) for x in n), e1)
        p = [(0.0, 0.0)] + [(dot(sub(x, x0), e1), dot(sub(x, x0), e2)) for x in (x1, x2)]
        area = 0.5 * (p[1][0] * p[2][1] - p[2][0] * p[1][1])
        rows = [[0.0] * 9 for _ in range(3)]  # strains xx, yy, twice xy of the nine displacements
        for k in range(3):
            (xa, ya), (xb, yb) = p[(k + 1) % 3], p[(k + 2) % 3]
            bx, by = (ya - yb) / (2.0 * area), (xb - xa) / (2.0 * area)
            for m in range(3):
                rows[0][3 * k + m] = bx * e1[m]
                rows[1][3 * k + m] = by * e2[m]
                rows[2][3 * k + m] = by * e1[m] + bx * e2[m]
        c = [[c11, poisson * c11, 0.0], [poisson * c11, c11, 0.0], [0.0, 0.0, c33]]
        stress = [[sum(c[a][b] * rows[b][q] for b in range(3)) for q in range(9)] for a in range(3)]
        yield face, [[area * sum(rows[a][r] * stress[a][q] for a in range(3)) for q in range(9)] for r in range(9)]


def tensions(points, faces):
    for face in faces:
        yield face, [[TENSION * x for x in row] for row in hessian(lambda p: area_of(*p), [points[i] for i in face])]


def hinges(points, faces):
    """At rest: the stiffness times the square of the slope of the angle, here of the inverse sine of the turn."""
    def angle(p):
        xi, xj, xk, xl = p
        e, n1, n2 = sub(xj, xi), cross(sub(xj, xi), sub(xk, xi)), cross(sub(xl, xi), sub(xj, xi))
        return cmath.asin(dot(cross(n1, n2), e) / cmath.sqrt(dot(e, e) * dot(n1, n1) * dot(n2, n2)))
    for (i, j), (k, l) in edges(faces).items():
        members, tiny = (i, j, k, l), 1e-30
        flat = [x for m in members for x in points[m]]
        slope = []
        for a in range(12):
            moved = [complex(x, tiny if a == m else 0.0) for m, x in enumerate(flat)]
            slope.append(angle([tuple(moved[3 * q:3 * q + 3]) for q in range(4)]).imag / tiny)
        yield members, [[HINGE * x * y for y in slope] for x in slope]


def helfrichs(points, faces):
    for i, ring in enumerate(rings(len(points), faces)):
        members = [i] + ring
        matrix = hessian(lambda p: helfrich_of_star(p[0], p[1:]), [points[m] for m in members])
        yield members, [[PLATE * x for x in row] for row in matrix]


LAWS = {"springs": springs, "neo-Hookean membrane": sheets, "Skalak's membrane": sheets, "tension": tensions, "hinges": hinges,
        "Helfrich bending": helfrichs}


# --- modes of a sphere: second derivatives of energies along spherical harmonics of degree 2 ----------------------------------------------------


def harmonics(n):
    """The five real ones of degree 2, of norm 1 on the sphere."""
    x, y, z = n
    a, b = math.sqrt(15.0 / (4.0 * math.pi)), math.sqrt(5.0 / (16.0 * math.pi))
    return (0.5 * a * (x * x - y * y), a * x * y, a * x * z, a * y * z, b * (3.0 * z * z - 1.0))


def bulged(points, mode, u):
    """Nodes that go along their radii by 6 um times u times a harmonic."""
    out = []
    for p in points:
        radius = norm(p)
        factor = 1.0 + u * RADIUS / radius * harmonics(tuple(x / radius for x in p))[mode]
        out.append(tuple(factor * x for x in p))
    return out


def curvature(function, points, mode, step=2e-3):
    """d2/du2 of a function of such points."""
    def at(u):
        return function(bulged(points, mode, u))
    return (-at(2 * step) + 16.0 * at(step) - 30.0 * at(0.0) + 16.0 * at(-step) - at(-2 * step)) / (12.0 * step ** 2)


def mode_of_tension(points, faces, mode):
    """Over that of the sphere, 4 R^2, at the pressure that holds the tension."""
    held = total(area_of, points, faces) * 2.0 / (3.0 * total(volume_of, points, faces))  # virial: p = 2 gamma A/(3 V)
    energy = lambda p: total(area_of, p, faces) - held * total(volume_of, p, faces)
    return curvature(energy, points, mode) / (4.0 * RADIUS ** 2)


def mode_of_bending(points, faces, mode):
    """Over that of the sphere, 24 kappa."""
    around = rings(len(points), faces)
    energy = lambda p: sum(helfrich_of_star(p[i], [p[j] for j in ring]) for i, ring in enumerate(around))
    return curvature(energy, points, mode) / 24.0


def seen_amplitude(points, faces, mode, step=1e-3):
    """What the sum over faces of the distance of their middles, in parts of 6 um, times the harmonic and the solid angle sees of a mode of amplitude 1."""
    def at(u):
        moved, seen = bulged(points, mode, u), 0.0
        for a, b, c in faces:
            middle = tuple((x + y + z) / 3.0 for x, y, z in zip(moved[a], moved[b], moved[c]))
            far = norm(middle)
            n = tuple(x / far for x in middle)
            angle = 0.5 * dot(cross(sub(moved[b], moved[a]), sub(moved[c], moved[a])), n) / far ** 2
            seen += harmonics(n)[mode] * far / RADIUS * angle
        return seen
    return (at(step) - at(-step)) / (2.0 * step)


def values():
    out = {}
    for nodes in (162, 642, 2562):
        at = f", {nodes} nodes"
        pressure, left, rate = tension_and_pressure(nodes)
        hinge, helfrich = bending_energies(nodes)
        points, faces = sphere(nodes)
        out["T4.1 | pressure that holds a sphere of tension 0.5 nN/um (2 gamma/R = 0.166667) [kPa]" + at] = pressure
        out["T4.1 | part of the tension's force that it does not hold" + at] = left
        out["T5.5 | rate of the breathing mode [1/s]" + at] = rate
        out["dcm 0 | volume of the mesh over that of its sphere" + at] = total(volume_of, points, faces) / BALL
        out["dcm 3 | hinge energy of a sphere with flat rest angles over 8 pi kappa" + at] = hinge
        out["T3.1 | Helfrich energy of a sphere over 8 pi kappa" + at] = helfrich
        for law, elements in LAWS.items():
            if nodes == 2562 and law in ("Skalak's membrane", "Helfrich bending"):
                continue  # the first as the neo-Hookean; the second would take minutes
            out[f"T1.4 | longest stable explicit step, {law} alone{at} [s]"] = stable_step(points, faces, list(elements(points, faces)))
        out[f"T1.4 | longest stable explicit step, pressure alone{at} [s]"] = 2.0 / rate
    for nodes in LEVELS:
        points, faces = sphere(nodes)
        length = [norm(sub(points[i], points[j])) for i, j in edges(faces)]
        areas = node_areas(points, faces)
        whole = total(area_of, points, faces)
        out |= {f"icosphere {nodes}: {what}": value for what, value in {
            "mean edge": sum(length) / len(length), "least edge": min(length), "largest edge": max(length), "mean node area": whole / len(points),
            "least node area": min(areas), "largest node area": max(areas), "volume over the ball's": total(volume_of, points, faces) / BALL,
            "area over the sphere's": whole / (4.0 * math.pi * RADIUS ** 2), "radius of the nodes for the ball's volume":
            (BALL / total(volume_of, points, faces)) ** (1.0 / 3.0), "mean edge over the radius": sum(length) / len(length) / RADIUS}.items()}
    drag = {nodes: MEDIUM * total(area_of, *sphere(nodes)) for nodes in (162, 642)}
    out["T1.1 | velocity of a cell under 1 nN spread by area, 642 nodes [um/s]"] = 1.0 / drag[642]
    out["T9.2 | drag of a cell with all its laws under 1 nN, 642 nodes [nN s/um]"] = drag[642]
    out["T11.3 | speed of a free cell whose protrusion pulls outside, F_p/(gamma A), F_p 0.2 nN, 162 nodes [um/s]"] = 0.2 / drag[162]
    points, faces = icosphere(5)
    points = scaled(points, RADIUS)
    out["modes of 10242 nodes: tension"] = mode_of_tension(points, faces, 4)
    out["modes of 10242 nodes: bending"] = mode_of_bending(points, faces, 4)
    points, faces = sphere(162)
    points = scaled(points, (BALL / total(volume_of, points, faces)) ** (1.0 / 3.0))
    out["modes of 162 nodes of the ball's volume: tension"] = mode_of_tension(points, faces, 4)
    out["modes of 162 nodes of the ball's volume: seen amplitude"] = seen_amplitude(points, faces, 4)
    return out
