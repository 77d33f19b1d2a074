"""What figures of a case share: what a drawing is, its files, and the words in it."""
import dataclasses
import re
import typing

from command import write

PROLOGUE = '<?xml version="1.0" encoding="utf-8"?>\n'  # of an SVG that is a file of its own


@dataclasses.dataclass
class Drawing:
    kind: str
    case: dict
    title: str
    caption: str
    draw: typing.Callable[[typing.Any], typing.Any]  # a wide screen? or on paper its width in points -> Canvas
    tab: str = ""  # of several drawings of which one is shown at a time: what this one is called
    printed: bool = False  # it is drawn for papers too

    @property
    def name(self):
        """The file name without its ending; a drawing of one run has no case."""
        return f"{self.kind}_{slug(self.case)}" if self.case else self.kind


def saved(drawings, target, small=False):
    """Draw them as files of the directory; [(drawing, wide SVG, narrow SVG)] for a page. With `small`, the first one, as narrow
    screens have it, is small.svg too, for the index."""
    target.mkdir(exist_ok=True)
    out = []
    for drawing in drawings:
        sheet = drawing.draw(True)
        write(target / f"{drawing.name}.svg", PROLOGUE + sheet.svg(f"{drawing.name}-wide", coloured=True))
        if drawing.kind == "animation":  # scales by itself, and has no picture that stands still
            out.append((drawing, sheet.svg(f"{drawing.name}-moving"), ""))
            continue
        write(target / f"{drawing.name}.png", sheet.png())
        narrow = drawing.draw(False)
        if small and not out:
            write(target / "small.svg", PROLOGUE + narrow.svg("small", coloured=True))
        out.append((drawing, sheet.svg(f"{drawing.name}-wide"), narrow.svg(f"{drawing.name}-narrow")))
    return out


def slug(case):
    return re.sub(r"[^A-Za-z0-9._-]+", "-", case["name"])


def heading(case):
    return case.get("title") or case["name"]


def with_unit(label, unit):
    return f"{label} [{unit}]" if unit and unit != "1" else label


def time_label(case, what="t"):
    """The label of an axis of times, which are those since the start where the runs of the case go back."""
    return with_unit(what.replace("t", "−t", 1) if str(case.get("time", "")).startswith("-") else what, case.get("time_unit") or "")


def step_text(step, case):
    return f"step {step:.4g} {case.get('time_unit') or ''}".strip()


def sentences(*parts):
    return " ".join(p for p in parts if p)


def limits(tracks, frame, exact=()):
    """[(low, high)] of both axes: of all tracks (x, y) but those that leave the exact ones, or where there are none the middle one,
    by `frame` of its widths."""
    found = []
    for k in (0, 1):
        spans = sorted((min(t[k]), max(t[k])) for t in tracks)
        known = [(min(t[k]), max(t[k])) for t in exact] or [spans[len(spans) // 2]]
        low, high = min(s[0] for s in known), max(s[1] for s in known)
        size = frame * ((high - low) or 1)
        kept = known + [s for s in spans if s[0] >= low - size and s[1] <= high + size]
        found.append((min(s[0] for s in kept), max(s[1] for s in kept)))
    return found
