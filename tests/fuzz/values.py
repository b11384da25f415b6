"""Numbers and texts that programs stumble over."""

from __future__ import annotations

from random import Random

NUMBERS: tuple[float, ...] = (
    *(0, -0.0, 1, -1, 2, 3, 0.1, -0.1, 0.5, 90, 1000, 65536),
    *(5e-324, 1e-300, 1e-159, 1e-30, 1e-12, 1e-9, 1e-6),
    *(1e6, 1e9, 1e15, 1e30, 1e159, 1e200, -1e200, 1.7e308, -1.7e308),
    *(float("nan"), float("inf"), float("-inf")),
    *(2**31, 2**32, 2**53 + 1, 2**63 - 1, -(2**63), 2**64, 10**30),
)

UNITS = (
    *("mm", "cm", "m", "km", "in", "um", "deg", "rad", "s", "min", "ms", "N", "kN", "g", "kg"),
    *(
        "g/m^2",
        "kg/m",
        "N m^2",
        "N m",
        "m/s",
        "m/s^2",
        "m/s^3",
        "deg/s",
        "Hz",
        "%",
        "",
        "°",
        "mm^9",
    ),
)

TEXTS = (
    *("", " ", "0", "1 mm", "1e999 mm", "-1 mm", "nan mm", "1,5 mm", "mm", "1 furlong", "middle"),
    *("centered", "plane", "../x", "/", ".", "/dev/null", "con", "%s%n", "\x00", "\x1b[31mred\x07"),
    *("\u202eback", "\ufeff", "</script><b>", "]]>", "a'\"b\\", "é\u0301", "\U0001f9f5", "l\nm"),
    *("x" * 300, "x" * 20_000, "\u2028", "scene.toml", "a,b;c\td", "=1+1", "\x7f\x85\x9b1m"),
)


def number(rng: Random, near: float = 1.0) -> float:
    """An awkward number, or one near a sound one."""
    how = rng.random()
    if how < 0.3:
        return rng.choice(NUMBERS)
    if how < 0.7:
        return float(near) * rng.choice((0.5, 0.8, 0.95, 0.99, 1.001, 1.01, 1.05, 1.2, 2))
    if how < 0.8:
        return float(near) * rng.choice((10, 100, 1000, 1e-3, -1))
    if how < 0.9:
        return float(near) + rng.choice((1, -1, 1e-9, -1e-9))
    return rng.uniform(-2, 2) * float(near)


def text(rng: Random) -> str:
    """An awkward text; often a number with some unit."""
    if rng.random() < 0.5:
        return f"{rng.choice((number(rng), rng.randint(-9, 99)))!r} {rng.choice(UNITS)}"
    return rng.choice(TEXTS)


def damaged(rng: Random, content: bytes) -> tuple[bytes, str]:
    """A content with one damage that knows nothing of its meaning, and what it is."""
    at = rng.randrange(len(content) + 1)
    size = rng.choice((1, 1, 1, 2, 4, 16, 200))
    lines = content.split(b"\n")
    line = rng.randrange(len(lines))
    match rng.randrange(9):
        case 0:
            return content[:at], f"cut off at byte {at}"
        case 1:
            return content[:at] + content[at + size :], f"{size} bytes lost at {at}"
        case 2:
            again = content[at : at + size]
            return content[:at] + again + content[at:], f"{size} bytes twice at {at}"
        case 3:
            other = bytes(rng.randrange(256) for _ in range(min(size, 4)))
            return content[:at] + other + content[at + len(other) :], f"{other!r} at {at}"
        case 4:
            strange = rng.choice(TEXTS).encode()
            return content[:at] + strange + content[at:], f"{strange[:40]!r} into {at}"
        case 5:
            deep = rng.choice((b"[", b"(", b"{a=", b"-", b"[[", b'"""', b"a.")) * rng.choice(
                (9, 9999)
            )
            return content[:at] + deep + content[
                at:
            ], f"{len(deep)} bytes of {deep[:3]!r} into {at}"
        case 6:
            lines.insert(rng.randrange(len(lines) + 1), lines[line])
            return b"\n".join(lines), f"line {line + 1} twice"
        case 7:
            del lines[line]
            return b"\n".join(lines), f"line {line + 1} lost"
        case _:
            ends = rng.choice((b"\r\n", b"\r", b"\n\n", b" \n", b"\n\xef\xbb\xbf"))
            return content.replace(b"\n", ends), f"line ends {ends!r}"
