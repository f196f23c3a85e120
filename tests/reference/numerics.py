"""Small numerical tools of the reference scripts; standard library only."""
import math

# Abscissas and weights of Gauss and Legendre on [-1, 1], 10 points.
_GAUSS = ((0.1488743389816312, 0.2955242247147529), (0.4333953941292472, 0.2692667193099963), (0.6794095682990244, 0.2190863625159820),
          (0.8650633666889845, 0.1494513491505806), (0.9739065285171717, 0.0666713443086881))


def integral(function, low, high, pieces=40):
    """The integral of a smooth function, by Gauss's rule on equal pieces."""
    total, width = 0.0, (high - low) / pieces
    for k in range(pieces):
        middle = low + (k + 0.5) * width
        total += sum(w * (function(middle + 0.5 * width * x) + function(middle - 0.5 * width * x)) for x, w in _GAUSS)
    return 0.5 * width * total


def root(function, low, high):
    """Where a function that changes its sign between low and high is zero, by bisection."""
    at_low = function(low)
    if at_low * function(high) > 0.0:
        raise ValueError(f"no change of sign between {low} and {high}")
    for _ in range(200):
        middle = 0.5 * (low + high)
        if middle in (low, high):
            break
        if (function(middle) > 0.0) == (at_low > 0.0):
            low = middle
        else:
            high = middle
    return 0.5 * (low + high)


def minimum(function, low, high):
    """The place of the minimum of a function with one minimum, by the golden section."""
    part = 0.5 * (math.sqrt(5.0) - 1.0)
    a, b = high - part * (high - low), low + part * (high - low)
    fa, fb = function(a), function(b)
    for _ in range(120):
        if fa < fb:
            high, b, fb = b, a, fa
            a = high - part * (high - low)
            fa = function(a)
        else:
            low, a, fa = a, b, fb
            b = low + part * (high - low)
            fb = function(b)
    return 0.5 * (low + high)


def integrate(rate, state, end, steps):
    """The state (a list) at the time `end`, from time 0, by the classical Runge-Kutta method in equal steps."""
    dt = end / steps
    for _ in range(steps):
        k1 = rate(state)
        k2 = rate([y + 0.5 * dt * k for y, k in zip(state, k1)])
        k3 = rate([y + 0.5 * dt * k for y, k in zip(state, k2)])
        k4 = rate([y + dt * k for y, k in zip(state, k3)])
        state = [y + dt / 6.0 * (a + 2.0 * b + 2.0 * c + d) for y, a, b, c, d in zip(state, k1, k2, k3, k4)]
    return state


def solve(matrix, right):
    """The solution of a small system of linear equations, by elimination with pivots."""
    n = len(right)
    rows = [list(row) + [b] for row, b in zip(matrix, right)]
    for k in range(n):
        pivot = max(range(k, n), key=lambda i: abs(rows[i][k]))
        rows[k], rows[pivot] = rows[pivot], rows[k]
        for i in range(k + 1, n):
            factor = rows[i][k] / rows[k][k]
            rows[i] = [a - factor * b for a, b in zip(rows[i], rows[k])]
    out = [0.0] * n
    for k in reversed(range(n)):
        out[k] = (rows[k][n] - sum(rows[k][j] * out[j] for j in range(k + 1, n))) / rows[k][k]
    return out


def largest_eigenvalue(times, size, iterations=70):
    """Of a symmetric matrix, given as its product with a vector: by Lanczos, then bisection of the tridiagonal matrix with Sturm's count."""
    state, v = 12345, []
    for _ in range(size):  # a start vector that favours nothing
        state = (1103515245 * state + 12345) % 2147483648
        v.append(state / 1073741824.0 - 1.0)
    norm = math.sqrt(sum(x * x for x in v))
    v, before, beta = [x / norm for x in v], [0.0] * size, 0.0
    diagonal, beside = [], []
    for _ in range(min(iterations, size)):
        w = times(v)
        alpha = sum(a * b for a, b in zip(v, w))
        w = [a - alpha * b - beta * c for a, b, c in zip(w, v, before)]
        diagonal.append(alpha)
        beta = math.sqrt(sum(x * x for x in w))
        if beta < 1e-12 * abs(diagonal[0]):
            break
        beside.append(beta)
        before, v = v, [x / beta for x in w]

    def above(x):
        count, d = 0, 1.0
        for k, a in enumerate(diagonal):
            d = a - x - (beside[k - 1] ** 2 / d if k > 0 else 0.0)
            d = d if d != 0.0 else 1e-300
            count += d > 0.0
        return count
    bound = max(abs(a) for a in diagonal) + 2.0 * max(beside + [0.0])
    low, high = -bound, bound
    for _ in range(100):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if above(middle) > 0 else (low, middle)
    return low
