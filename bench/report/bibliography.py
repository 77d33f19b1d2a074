"""The entries of references.bib that an experiment names, as BibTeX and as links."""
import pathlib
import re


def file():
    """The path of references.bib, which stands beside the scripts, or at the root of the sources; None where it does not."""
    here = pathlib.Path(__file__).resolve().parent
    return next((path for path in (here.parent / "references.bib", here.parents[1] / "references.bib") if path.exists()), None)


def entries(keys):
    """{key: entry} of those keys that references.bib has."""
    path = file()
    found = re.findall(r"^(@\w+\{([^,\s]+),.*?^\})", path.read_text(encoding="utf-8"), flags=re.M | re.S) if path else []
    return {key: entry for entry, key in found if key in keys}


def link(entry):
    """The address of a work by its DOI; empty where it has none."""
    found = re.search(r"\bdoi\s*=\s*[{\"]([^}\"]+)", entry or "")
    return f"https://doi.org/{found[1]}" if found else ""


def bibtex(head):
    """The works that an experiment names as BibTeX, and an entry of the program itself."""
    version = (head.get("versions") or {}).get("pfaff", "")
    program = "\n".join(["@software{pfaff,", "  title = {Pfaff},", f"  version = {{{version}}},",
                         f"  note = {{experiment {head['name']}}}", "}"])
    return "\n\n".join([*entries(head.get("reference") or []).values(), program]) + "\n"
