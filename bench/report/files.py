"""JSON and CSV files, checked as they are read. What is wrong raises `InputError`: where, what, what was expected."""
import csv
import json
import math


class InputError(Exception):
    """What is wrong with the input, in one line."""


def parse(text, where):
    """A cell as a float; an empty cell is nan."""
    if text == "":
        return math.nan
    try:
        return float(text)
    except ValueError:
        raise InputError(f"{where}: expected a number, got '{text}'") from None


def require(table, where, **kinds):
    """Refuse what is not a JSON object with these keys, of these types."""
    if not isinstance(table, dict):
        raise InputError(f"{where}: expected an object")
    for key, kind in kinds.items():
        if key not in table:
            raise InputError(f"{where}: key '{key}' is missing")
        allow(table, where, **{key: kind})


def allow(table, where, **kinds):
    """Refuse these keys where they are present, not null and of another type."""
    names = {str: "a string", list: "a list", dict: "an object", bool: "true or false"}
    for key, kind in kinds.items():
        if table.get(key) is not None and not isinstance(table[key], kind):
            raise InputError(f"{where}: expected '{key}' to be {names[kind]}")


def read_json(path):
    try:
        content = json.loads(path.read_text(encoding="utf-8"))
    except (OSError, ValueError) as error:
        raise InputError(f"{path}: expected a JSON file ({error})") from None
    require(content, str(path))
    return content


def read_csv(path, where):
    """(columns, [(line number, cells)]) with as many cells in every row as there are columns."""
    try:
        with open(path, newline="", encoding="utf-8") as file:
            reader = csv.reader(file)
            rows = [(reader.line_num, row) for row in reader if row]
    except (OSError, UnicodeDecodeError, csv.Error) as error:
        raise InputError(f"{where}: expected a CSV file ({error})") from None
    columns = rows[0][1] if rows else []
    for line, row in rows[1:]:
        if len(row) != len(columns):
            raise InputError(f"{where}, line {line}: expected {len(columns)} cells, got {len(row)}")
    return columns, rows[1:]


def read_table(path, needed):
    """(columns, [(where, cells by column)]) of a file that must have the needed columns."""
    columns, rows = read_csv(path, path.name)
    for column in needed:
        if column not in columns:
            raise InputError(f"{path.name}: column '{column}' is missing")
    return columns, [(f"{path.name}, line {line}", dict(zip(columns, row))) for line, row in rows]
