#!/usr/bin/python3
"""The kernel J in NumPy: 4096 samples to squared bicoherence, NGI, NLI and the largest cell.

usage: kernel_numpy.py FILE    FILE holds 4096 samples, one a line or as an array that loadtxt reads

Prints the median time of the fastest of several ways to write it, and what it found, as JSON. One
thread: the kernel that it is compared with has one.
"""

import json
import os
import sys
import time

for _variable in ("OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS", "OMP_NUM_THREADS"):
    os.environ[_variable] = "1"

import numpy as np  # noqa: E402  the number of threads is read when it is loaded

SEGMENT, HOP, DFT, HALF = 64, 32, 128, 64
WINDOW = 0.5 * (1.0 - np.cos(2.0 * np.pi * np.arange(1, SEGMENT + 1) / (SEGMENT + 1)))
NORMAL_95 = 1.6448536269514722
K1 = np.concatenate([np.arange(k2, HALF - k2 + 1) for k2 in range(1, HALF // 2 + 1)])
K2 = np.concatenate([np.full(HALF + 1 - 2 * k2, k2) for k2 in range(1, HALF // 2 + 1)])
ROWS = [(k2, slice(k2, HALF - k2 + 1), slice(2 * k2, HALF + 1)) for k2 in range(1, HALF // 2 + 1)]


def segments_of(signal):
    view = np.lib.stride_tricks.sliding_window_view(signal, SEGMENT)[::HOP]
    return (view - view.mean(axis=1, keepdims=True)) * WINDOW


def spectra(signal):
    """[frequency][segment], contiguous."""
    return np.ascontiguousarray(np.fft.rfft(segments_of(signal), DFT, axis=1).T)


def normalised(triple, power):
    """Squared bicoherence from the triple sums and the power rows: row by row a matrix by a vector,
    which is faster than the matrix product of all rows where the BLAS is the reference's."""
    products = np.concatenate([power[k1] @ power[k2] for k2, k1, _ in ROWS])
    return (triple.real**2 + triple.imag**2) / (products * power.sum(axis=1)[K1 + K2])


def rows_of_einsum(signal):
    x = spectra(signal)
    conjugate = x.conj()
    triple = np.concatenate(
        [np.einsum("s,ks,ks->k", x[k2], x[k1], conjugate[k3]) for k2, k1, k3 in ROWS])
    return normalised(triple, x.real**2 + x.imag**2)


def rows_of_products(signal):
    x = spectra(signal)
    conjugate = x.conj()
    triple = np.concatenate(
        [np.einsum("ks,s->k", x[k1] * conjugate[k3], x[k2]) for k2, k1, k3 in ROWS])
    return normalised(triple, x.real**2 + x.imag**2)


def rows_of_matrix_products(signal):
    """(X(k1) X*(k1 + k2)) X(k2): the product over k1 in one go, the sum as a matrix by a vector."""
    x = spectra(signal)
    conjugate = x.conj()
    triple = np.concatenate([(x[k1] * conjugate[k3]) @ x[k2] for k2, k1, k3 in ROWS])
    return normalised(triple, x.real**2 + x.imag**2)


def rows_of_real_products(signal):
    """The same with real and imaginary rows apart, which vectors of doubles like better."""
    x = spectra(signal)
    re, im = np.ascontiguousarray(x.real), np.ascontiguousarray(x.imag)
    triple = np.empty(K1.size, dtype=complex)
    at = 0
    for k2, k1, k3 in ROWS:
        p = re[k1] * re[k3] + im[k1] * im[k3]
        q = im[k1] * re[k3] - re[k1] * im[k3]
        pairs = np.column_stack((re[k2], im[k2]))
        with_p, with_q = p @ pairs, q @ pairs
        end = at + len(p)
        triple.real[at:end] = with_p[:, 0] - with_q[:, 1]
        triple.imag[at:end] = with_p[:, 1] + with_q[:, 0]
        at = end
    return normalised(triple, re * re + im * im)


def gathered(signal):
    x = spectra(signal)
    triple = np.einsum("ls,ls->l", x[K1] * x[K2], x[K1 + K2].conj())
    return normalised(triple, x.real**2 + x.imag**2)


def found_in(bic2, count):
    cells = bic2.size
    critical = (NORMAL_95 + np.sqrt(4.0 * cells - 1.0)) ** 2 / (4.0 * count * cells)
    mean, largest = bic2.mean(), int(bic2.argmax())
    level = np.log(cells / 0.05) / count
    return {
        "mean_bic2": mean,
        "ngi": mean - critical,
        "nli": abs(bic2[largest] - (mean + 2.0 * bic2.std())),
        "largest": [int(K1[largest]), int(K2[largest]), bic2[largest]],
        "above_peak_level": int((bic2 > level).sum()),
    }


def median_us(job, repetitions=300):
    times = []
    for _ in range(repetitions):
        start = time.perf_counter()
        job()
        times.append(time.perf_counter() - start)
    return 1e6 * float(np.median(times))


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    signal = np.loadtxt(sys.argv[1]).ravel()
    count = (signal.size - SEGMENT) // HOP + 1
    variants = [rows_of_einsum, rows_of_products, rows_of_matrix_products, rows_of_real_products,
                gathered]
    times = {way.__name__: median_us(lambda way=way: found_in(way(signal), count)) for way in variants}
    best = min(variants, key=lambda way: times[way.__name__])
    reference = rows_of_einsum(signal)
    for way in variants:
        assert np.allclose(way(signal), reference, rtol=1e-9, atol=1e-14), way.__name__
    print(json.dumps({"kernel_numpy_us": times[best.__name__], "variant": best.__name__,
                      "all_us": times, **found_in(best(signal), count)}))


if __name__ == "__main__":
    main()
