"""What a sentence of the first screen asserts, as data beside its words, so that it can be evaluated on the CSV files.

subject, relation   whom the words are about, by labels of methods, and what they say of them
columns, rows       of which files: {label: ["results.csv, line 7"]}, as runs are named everywhere
more                what else the relation needs: numbers as they were said, who is excluded, of whom it is not known
A property has three values, yes, no and not known. Words are made of yes and no alone.
"""
import dataclasses

from wording import plain_text


@dataclasses.dataclass
class Clause:
    words: str  # HTML
    relation: str
    subject: list
    columns: list
    rows: dict
    more: dict = dataclasses.field(default_factory=dict)
    joined: str = "; "  # to what stands before it

    def data(self):
        return {"words": plain_text(self.words), "relation": self.relation, "subject": self.subject,
                "columns": self.columns, "rows": self.rows} | self.more


def said(clauses):
    """HTML: the clauses as one sentence, with a full stop; empty where there is none."""
    out = ""
    for clause in clauses:
        out += (clause.joined if out else "") + clause.words
    return capital(out) + "." if out else ""


def capital(markup):
    """The first letter of a sentence, large unless it begins with a name."""
    return markup[:1].upper() + markup[1:]


def three(rows, value):
    """(rows for which it is so, for which it is not, of which it is not known)"""
    values = [(r, value(r)) for r in rows]
    return ([r for r, x in values if x is True], [r for r, x in values if x is False], [r for r, x in values if x is None])


def labels(rows):
    return [r.label for r in rows]
