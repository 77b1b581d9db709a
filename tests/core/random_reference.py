# SPDX-License-Identifier: BSL-1.0
"""Prints the numbers that random.test.cpp expects: python3 tests/core/random_reference.py

A second implementation of the recurrences in Blackman and Vigna, ACM TOMS 47 (2021) 36, on Python's unbounded
integers, the state update in one simultaneous assignment. It stops unless it reproduces what other codes publish:
splitmix64 from seed 0 begins with 0xe220a8397b1dcdaf, xoshiro256++ from the state (1, 2, 3, 4) with 41943041, 58720359,
3588806011781223, and from splitmix64 seed 0 with 5987356902031041503, 7051070477665621255 (tests of the Rust crate rand).
"""

MASK = 2**64 - 1


def splitmix64(seed, count):
    words = []
    for k in range(1, count + 1):
        z = (seed + k * 0x9E3779B97F4A7C15) & MASK
        z = ((z ^ (z >> 30)) * 0xBF58476D1CE4E5B9) & MASK
        z = ((z ^ (z >> 27)) * 0x94D049BB133111EB) & MASK
        words.append(z ^ (z >> 31))
    return words


def rotate(x, k):
    return ((x << k) & MASK) | (x >> (64 - k))


def xoshiro256pp(state, count):
    a, b, c, d = state
    numbers = []
    for _ in range(count):
        numbers.append((rotate((a + d) & MASK, 23) + a) & MASK)
        c_a, d_b = c ^ a, d ^ b
        a, b, c, d = a ^ d_b, b ^ c_a, c_a ^ ((b << 17) & MASK), rotate(d_b, 45)
    return numbers


if __name__ == "__main__":
    assert splitmix64(0, 1) == [0xE220A8397B1DCDAF]
    assert xoshiro256pp((1, 2, 3, 4), 3) == [41943041, 58720359, 3588806011781223]
    assert xoshiro256pp(splitmix64(0, 4), 2) == [5987356902031041503, 7051070477665621255]
    for seed in (0, 20260, MASK):
        numbers = xoshiro256pp(splitmix64(seed, 4), 4)
        print(seed, numbers, "uniform:", [(x >> 11) * 2.0**-53 for x in numbers[:2]])
        print("   thousandth:", xoshiro256pp(splitmix64(seed, 4), 1000)[-1])
