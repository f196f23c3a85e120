"""Icospheres and what can be measured on them, without a formula for a derivative: slopes come from complex steps, angles from inverse cosines."""
import cmath
import functools
import math


def sub(a, b):
    return (a[0] - b[0], a[1] - b[1], a[2] - b[2])


def dot(a, b):
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def norm(a):
    return math.sqrt(dot(a, a))


def unit(a):
    length = norm(a)
    return (a[0] / length, a[1] / length, a[2] / length)


@functools.lru_cache(maxsize=None)
def icosphere(level):
    """(nodes on the unit sphere, faces): an icosahedron whose faces are split into four `level` times."""
    golden = 0.5 * (1.0 + math.sqrt(5.0))
    nodes = [unit(p) for s in (1, -1) for t in (golden, -golden) for p in ((0, s, t), (s, t, 0), (t, 0, s))]
    near = 1.1 * min(norm(sub(nodes[0], p)) for p in nodes[1:])
    faces = []
    for a in range(12):
        for b in range(a + 1, 12):
            for c in range(b + 1, 12):
                if max(norm(sub(nodes[a], nodes[b])), norm(sub(nodes[b], nodes[c])), norm(sub(nodes[c], nodes[a]))) < near:
                    outward = dot(cross(sub(nodes[b], nodes[a]), sub(nodes[c], nodes[a])), nodes[a]) > 0.0
                    faces.append((a, b, c) if outward else (a, c, b))
    for _ in range(level):
        middle, finer = {}, []

        def between(i, j):
            key = (min(i, j), max(i, j))
            if key not in middle:
                middle[key] = len(nodes)
                nodes.append(unit(tuple(0.5 * (x + y) for x, y in zip(nodes[i], nodes[j]))))
            return middle[key]
        for a, b, c in faces:
            ab, bc, ca = between(a, b), between(b, c), between(c, a)
            finer += [(a, ab, ca), (ab, b, bc), (ca, bc, c), (ab, bc, ca)]
        faces = finer
    return nodes, faces


def scaled(nodes, factor):
    return [(factor * p[0], factor * p[1], factor * p[2]) for p in nodes]


def area_of(a, b, c):
    n = cross(sub(b, a), sub(c, a))
    return 0.5 * cmath.sqrt(dot(n, n)) if isinstance(n[0], complex) else 0.5 * math.sqrt(dot(n, n))


def volume_of(a, b, c):
    return dot(a, cross(b, c)) / 6.0


def total(function, nodes, faces):
    return sum(function(nodes[a], nodes[b], nodes[c]) for a, b, c in faces)


def gradient(function, nodes, faces):
    """The slope of a sum over faces at every node, by complex steps."""
    out = [[0.0, 0.0, 0.0] for _ in nodes]
    tiny = 1e-30
    for face in faces:
        corner = [nodes[i] for i in face]
        for k in range(3):
            for axis in range(3):
                moved = list(corner)
                moved[k] = tuple(complex(x, tiny if axis == m else 0.0) for m, x in enumerate(corner[k]))
                out[face[k]][axis] += function(*moved).imag / tiny
    return out


def node_areas(nodes, faces):
    out = [0.0] * len(nodes)
    for face in faces:
        share = area_of(*(nodes[i] for i in face)) / 3.0
        for i in face:
            out[i] += share
    return out


def edges(faces):
    """{(i, j): [opposite nodes]} with i < j."""
    out = {}
    for a, b, c in faces:
        for i, j, k in ((a, b, c), (b, c, a), (c, a, b)):
            out.setdefault((min(i, j), max(i, j)), []).append(k)
    return out


def turning_angle(xi, xj, xk, xl):
    """Between the normals of the faces at the edge i-j with k and l opposite; of a convex surface."""
    n1, n2 = cross(sub(xj, xi), sub(xk, xi)), cross(sub(xl, xi), sub(xj, xi))
    return math.acos(max(-1.0, min(1.0, dot(n1, n2) / (norm(n1) * norm(n2)))))


def hessian(energy, points):
    """Second derivatives of a function of points, row by row: a complex step along one coordinate, a central difference along the other."""
    tiny, step = 1e-30, 1e-5
    flat = [x for p in points for x in p]
    n = len(flat)

    def slope(at, along):
        moved = [complex(x, tiny if along == m else 0.0) for m, x in enumerate(at)]
        return energy([tuple(moved[3 * k:3 * k + 3]) for k in range(n // 3)]).imag / tiny
    out = [[0.0] * n for _ in range(n)]
    for b in range(n):
        ahead, behind = list(flat), list(flat)
        ahead[b] += step
        behind[b] -= step
        for a in range(b, n):
            out[a][b] = out[b][a] = (slope(ahead, a) - slope(behind, a)) / (2.0 * step)
    return out
