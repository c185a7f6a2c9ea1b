#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Fits the polynomials of src/core/lane_math.h and src/core/lane_hyperbolic.h and prints their coefficients as floats, lowest power first.

Each row is the minimax polynomial p of a given degree for target(x) on [a, b], with the error weighted by weight(x). It is computed with
the Remez exchange algorithm in 50 digits. The weight converts the error of p to the relative error of the function that lane_math.h
builds from it, which is printed next to the name. Needs mpmath; takes no arguments and about 10 seconds.
"""
import struct

from mpmath import asin, atan, cos, cospi, exp, fabs, linspace, log, lu_solve, matrix, mp, mpf, polyval, sign, sin, sinh, sqrt, tanh

mp.dps = 50
LN2 = log(2)


def remez(target, weight, a, b, degree, rounds=12, grid=600):
    """Returns the coefficients (lowest first) and the largest weighted error."""
    n = degree + 2
    points = [(a + b) / 2 - (b - a) / 2 * cospi(mpf(i) / (n - 1)) for i in range(n)]
    for _ in range(rounds):
        rows = [[x**k for k in range(degree + 1)] + [(-1) ** i / weight(x)] for i, x in enumerate(points)]
        solution = lu_solve(matrix(rows), matrix([target(x) for x in points]))
        c = [solution[k] for k in range(degree + 1)]
        error = lambda x: weight(x) * (target(x) - polyval(c[::-1], x))
        points = extrema(error, a, b, n, grid)
    return c, max(fabs(error(x)) for x in points)


def extrema(error, a, b, n, grid):
    """Returns the n alternating extrema of error: the point with the largest error in each interval of constant sign."""
    runs = []
    for x in linspace(a, b, grid):
        e = error(x)
        if runs and sign(e) == sign(runs[-1][0]):
            if fabs(e) > fabs(runs[-1][0]):
                runs[-1] = (e, x)
        elif e != 0:
            runs.append((e, x))
    while len(runs) > n:
        runs.pop(0 if fabs(runs[0][0]) < fabs(runs[-1][0]) else -1)
    assert len(runs) == n, "the error does not alternate often enough"
    return [x for _, x in runs]


def nearest_float(x):
    return struct.unpack("f", struct.pack("f", float(x)))[0]


def show(name, fit):
    c, error = fit
    digits = ", ".join("%.9gf" % nearest_float(x) for x in c)
    print("%-12s relative error 2^%.1f\n  {%s}" % (name, float(log(error) / LN2), digits))


def float_sum(name, x, bits=24):
    """Prints x as a sum of three floats, the first of which has only `bits` significant bits."""
    parts = []
    for keep in (bits, 24, 24):
        e = int(mp.floor(log(fabs(x)) / LN2)) + 1 - keep
        high = mp.nint(x * mpf(2) ** -e) * mpf(2) ** e
        parts.append("%.9gf" % nearest_float(high))
        x -= high
    print("%-10s {%s}" % (name, ", ".join(parts)))


# Intervals that contain 0, where the targets are 0/0, are shifted slightly so that no grid point is exactly 0.
tiny = mpf(10) ** -12
third = mpf("0.50001")  # pow calls exp2 with fractions slightly beyond one half
show("exp2", remez(lambda f: (2**f - 1) / f, lambda f: fabs(f) / 2**f, -third, third + tiny, 5))
h = LN2 / 2 * mpf("1.00001")
show("exp", remez(lambda f: (exp(f) - 1 - f) / f**2, lambda f: f**2 / exp(f), -h, h + tiny, 4))
lo, hi = sqrt(mpf(1) / 2) - 1, sqrt(mpf(2)) - 1
show("log2", remez(lambda f: (log(1 + f) - f) / LN2 / f**2, lambda f: f**2 / fabs(log(1 + f) / LN2), lo, hi, 8))
show("log", remez(lambda f: (log(1 + f) - f) / f**2, lambda f: f**2 / fabs(log(1 + f)), lo, hi, 8))
float_sum("1/ln 2", 1 / LN2)
float_sum("2/ln 2", 2 / LN2)
top = ((sqrt(mpf(2)) - 1) / (sqrt(mpf(2)) + 1)) ** 2
half_log = lambda z: (log((1 + sqrt(z)) / (1 - sqrt(z))) / LN2 / sqrt(z) - 2 / LN2) / z
fit = remez(half_log, lambda z: z * LN2 / 2, tiny, top, 3)
show("pow: log2", fit)
float_sum("its first", fit[0][0])
float_sum("ln 2", LN2, 15)
z4 = (mp.pi / 4 * mpf("1.001")) ** 2
show("sin", remez(lambda z: (sin(sqrt(z)) / sqrt(z) - 1) / z, lambda z: z * sqrt(z) / sin(sqrt(z)), tiny, z4, 2))
show("cos", remez(lambda z: (cos(sqrt(z)) - 1 + z / 2) / z**2, lambda z: z**2 / cos(sqrt(z)), tiny, z4, 2))
float_sum("pi/2", mp.pi / 2)
show("atan", remez(lambda z: (atan(sqrt(z)) / sqrt(z) - 1) / z, lambda z: z * sqrt(z) / atan(sqrt(z)), tiny, mpf(1), 8))
show("asin", remez(lambda z: (asin(sqrt(z)) / sqrt(z) - 1) / z, lambda z: z * sqrt(z) / asin(sqrt(z)), tiny, mpf(1) / 4, 4))
show("sinh", remez(lambda z: (sinh(sqrt(z)) / sqrt(z) - 1) / z, lambda z: z * sqrt(z) / sinh(sqrt(z)), tiny, mpf(1), 3))
show("tanh", remez(lambda z: (tanh(sqrt(z)) / sqrt(z) - 1) / z, lambda z: z * sqrt(z) / tanh(sqrt(z)), tiny, mpf("0.36"), 4))
# For the initial guess y of inverse_sqrt, r = 1 - x*y^2 is in [-0.0691, 0.0676].
guess = remez(lambda r: (1 / sqrt(1 - r) - 1) / r, lambda r: fabs(r) * sqrt(1 - r), mpf("-0.0691"), mpf("0.0676") + tiny, 3)
show("inverse_sqrt", guess)
# Lower degrees for unit_pow and the level of detail, whose logarithms and powers of two do not need full precision.
log2_over_f = (lambda f: log(1 + f) / LN2 / f, lambda f: fabs(f * LN2 / log(1 + f)), lo, hi)
show("unit_pow: log2", remez(*log2_over_f, 6))
show("unit_pow: exp2", remez(lambda f: (2**f - 1) / f, lambda f: fabs(f) / 2**f, -third, third + tiny, 4))
show("level of detail: log2", remez(*log2_over_f, 4))
