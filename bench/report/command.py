"""What the scripts share that the program starts: arguments, files that are whole wherever they are, and how a script ends.

A script that is done prints an object of JSON as its last line on standard output, with what the program asks for.
"""
import csv
import io
import json
import os
import sys

from files import InputError

FIGURES = ("--figures", "--width", "--style")  # options about figures for papers


def write(path, content):
    """Write to a temporary name beside `path`, then rename: a reader never sees half a file."""
    temporary = path.with_name(f".{path.name}.{os.getpid()}")
    with open(temporary, "xb") as file:  # a new file: what a link of this name leads to is not ours
        try:
            file.write(content.encode("utf-8") if isinstance(content, str) else content)
            file.flush()
            temporary.replace(path)
        finally:
            temporary.unlink(missing_ok=True)


def table(rows):
    """The text of a CSV file of rows, which are dictionaries with the same keys."""
    out = io.StringIO()
    writer = csv.DictWriter(out, list(rows[0]), lineterminator="\n")
    writer.writeheader()
    writer.writerows(rows)
    return out.getvalue()


def parsed(arguments, what, known):
    """(the one argument that is no option, {option: value} of the `known` ones); `what` says what that is, None that there is none."""
    options, rest = {}, list(arguments)
    for option in known:
        if option in rest:
            at = rest.index(option)
            if at + 1 == len(rest):
                raise InputError(f"{option}: expected a value")
            options[option] = rest[at + 1]
            del rest[at:at + 2]
    if len(rest) != (what is not None) or any(r.startswith("--") for r in rest):
        raise InputError(f"expected {f'one argument, {what}, and ' if what else ''}options {', '.join(known)}")
    if {"--width", "--style"} & set(options) and "--figures" not in options:
        raise InputError("--width and --style are about the figures that --figures names")
    return (rest[0] if rest else None), options


def ended(script, about, work, arguments):
    """The exit status of a script, which is done by `work`: 0 fine, 2 wrong usage or input, with one line on stderr."""
    if arguments in (["-h"], ["--help"]):
        print(about.strip())
        return 0
    try:
        print(json.dumps(work(arguments)))
    except (InputError, OSError) as error:
        print(f"{script}: {' '.join(str(error).split())}", file=sys.stderr)
        return 2
    except ImportError as error:
        print(f"{script}: {error.name} is missing; on Debian, install python3-matplotlib", file=sys.stderr)
        return 2
    return 0
