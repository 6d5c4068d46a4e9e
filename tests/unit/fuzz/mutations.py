"""Ways in which files go wrong: cut, joined, swapped, mistyped, re-encoded, hostile."""

from __future__ import annotations

import random
import re

HOSTILE = (
    b"nan", b"inf", b"-inf", b"1e999", b"-1", b"0", b"", b"1e-320", b"1,5", b"0x10", b"1_000", b"true", b"null", b"~",
    b"[]", b"{}", b"*", b"**", b"#", b"=", b"\t", b"\x00", b"\xff\xfe", b"\xef\xbb\xbf", "µ٣".encode(), b"'", b'"',
    b"../../etc/passwd", b"!!python/object/apply:os.system ['true']", b"&a [*a]", b"9" * 400, b"NoValue", b"1.5.2",
    b"-0.0", b"1e5", b"1e-5", b"1D3",
)  # fmt: skip
NUMBER = re.compile(rb"[-+]?\d+\.?\d*(?:[eE][-+]?\d+)?")


def mutate(seed: bytes, rng: random.Random, other: bytes) -> bytes:
    """Return `seed` with one to four faults; `other` is a file of another kind to mix in."""
    data = seed
    for _ in range(rng.choice((1, 1, 1, 2, 3, 4))):
        data = rng.choice(FAULTS)(data, rng, other)
    return data


def _cut(data: bytes, rng: random.Random, other: bytes) -> bytes:
    return data[: rng.randrange(len(data) + 1)]


def _flip(data: bytes, rng: random.Random, other: bytes) -> bytes:
    if not data:
        return data
    at = rng.randrange(len(data))
    return data[:at] + bytes([rng.randrange(256)]) + data[at + 1 :]


def _insert(data: bytes, rng: random.Random, other: bytes) -> bytes:
    at = rng.randrange(len(data) + 1)
    return data[:at] + rng.choice(HOSTILE) + data[at:]


def _number(data: bytes, rng: random.Random, other: bytes) -> bytes:
    found = list(NUMBER.finditer(data))
    if not found:
        return data
    where = rng.choice(found)
    return data[: where.start()] + rng.choice(HOSTILE) + data[where.end() :]


def _lines(data: bytes, rng: random.Random, other: bytes) -> bytes:
    """Drop, double, swap or blank lines."""
    rows = data.split(b"\n")
    at, to = rng.randrange(len(rows)), rng.randrange(len(rows))
    kind = rng.randrange(4)
    if kind == 0:
        del rows[at]
    elif kind == 1:
        rows.insert(to, rows[at])
    elif kind == 2:
        rows[at], rows[to] = rows[to], rows[at]
    else:
        rows[at] = b""
    return b"\n".join(rows)


def _fields(data: bytes, rng: random.Random, other: bytes) -> bytes:
    """Drop, double or swap fields of one line."""
    rows = data.split(b"\n")
    at = rng.randrange(len(rows))
    parts = rows[at].split(b",")
    i, j = rng.randrange(len(parts)), rng.randrange(len(parts))
    kind = rng.randrange(3)
    if kind == 0:
        del parts[i]
    elif kind == 1:
        parts.insert(j, parts[i])
    else:
        parts[i], parts[j] = parts[j], parts[i]
    rows[at] = b",".join(parts)
    return b"\n".join(rows)


def _mix(data: bytes, rng: random.Random, other: bytes) -> bytes:
    at, cut = rng.randrange(len(data) + 1), rng.randrange(len(other) + 1)
    return data[:at] + other[cut : cut + 400] + data[at:]


def _ends(data: bytes, rng: random.Random, other: bytes) -> bytes:
    kind = rng.randrange(4)
    if kind == 0:
        return data.replace(b"\n", b"\r\n")
    if kind == 1:
        return data.replace(b"\n", b"\r")
    if kind == 2:
        return data.decode("latin-1").encode("utf-16")
    return data.replace(b",", rng.choice((b";", b"\t", b" ")))


FAULTS = (_cut, _flip, _insert, _number, _number, _lines, _fields, _mix, _ends)
