"""Numbers, times and lists in words and in HTML. What is HTML is said to be; the rest is plain text."""
import html
import math
import re


def text(value):
    return html.escape(str(value))


def plain_text(markup):
    """The words of a sentence in HTML, as <desc> and captions take them."""
    markup = re.sub(r"<sup>([^<]*)</sup>", r"^\1", markup)
    return html.unescape(re.sub(r"<[^>]*>", "", markup))


def number(x):
    """Three digits: 0.123, 1200, 1.23e-6; a dash where there is no number."""
    if math.isnan(x):
        return "–"
    if x == 0 or 0.01 <= abs(x) < 999.5 or math.isinf(x):
        return f"{x:.3g}"
    if 999.5 <= abs(x) < 1e6:
        return f"{x:.0f}"
    mantissa, _, exponent = f"{x:.2e}".partition("e")
    return f"{float(mantissa):g}e{int(exponent)}"


def duration(ns):
    for size, unit in ((1e9, "s"), (1e6, "ms"), (1e3, "µs")):
        if ns >= size:
            return f"{number(ns / size)} {unit}"
    return "–" if math.isnan(ns) else f"{number(ns)} ns"


def two_digits(x):
    """2.8, 17, 0.063, 1200: two digits of a number of ordinary size."""
    return f"{x:.0f}" if abs(x) >= 9.95 else f"{x:.1f}" if abs(x) >= 0.995 else f"{x:.2g}"


def short_time(ns):
    """A duration with two digits."""
    for size, unit in ((1e9, "s"), (1e6, "ms"), (1e3, "µs")):
        if ns >= 0.9995 * size:
            return f"{two_digits(ns / size)} {unit}"
    return "–" if math.isnan(ns) else f"{ns:.0f} ns"


def tick_time(ns):
    """A time that stands at an axis: 1, 2, 3 or 5 times a power of ten."""
    for size, unit in ((1e9, "s"), (1e6, "ms"), (1e3, "µs")):
        if ns >= 0.9995 * size:
            return f"{ns / size:.3g} {unit}"
    return f"{ns:.3g} ns"


def short_count(n):
    return f"{n:.0f}" if n < 99950 else f"{two_digits(n / 1e6)} million" if n >= 999500 else f"{n / 1e3:.0f} 000"


def power(exponent):
    """HTML: a power of ten."""
    return f"10<sup>{minus(exponent)}</sup>"


def minus(x):
    return str(x).replace("-", "−")


def hundredths(x):
    """Two digits behind the point, of a power of time among others; what rounds to zero has no sign."""
    return minus(f"{round(x, 2) + 0.0:.2f}")


def size(x):
    """HTML: the size of an error, with one digit: 3·10^−8, 0.05, 0; a dash where there is none."""
    if math.isnan(x):
        return "–"
    if math.isinf(x):
        return "∞"
    if x == 0 or 0.01 <= abs(x) < 99.5:
        return minus(f"{x:.2g}")
    mantissa, _, exponent = f"{x:.0e}".partition("e")
    return f"{minus(mantissa)}·{power(int(exponent))}"


def raised(markup):
    """HTML: powers of units raised, m^2/s^2."""
    return re.sub(r"\^(-?[0-9]+)", lambda m: f"<sup>{minus(m[1])}</sup>", markup)


def listed(items):
    """One, two and three; between semicolons where there are commas in an item."""
    items = list(items)
    if len(items) > 2 and any("," in x for x in items):
        return "; ".join(items[:-1]) + " and " + items[-1]
    return items[0] if len(items) == 1 else ", ".join(items[:-1]) + " and " + items[-1] if items else "none"


def counted(n, noun):
    return f"{n} {noun}" + ("" if n == 1 else "s")
