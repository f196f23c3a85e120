#!/usr/bin/env python3
"""check.py MORULA: recompute the reference numbers of the tests, and compare.

- The rows of `morula verify physics` whose source says that the number was computed independently, integrated or written apart: each must have a value
  here, under the name "id | quantity".
- The numbers of numbers.txt: each must stand in its file as it is written there, and have a value here.
- The tables of theory that library studies are judged by (theory.TABLES), column by column.
A number agrees that differs by no more than one unit of its last digit; a row of the program, besides, by no more than the row's tolerance.
A file that says "computed independently" and is in neither list fails, too.

Exit codes: 0 all agree, 1 something differs or is missing, 2 nothing was found to check.
"""
import json
import os
import re
import subprocess
import sys

sys.dont_write_bytecode = True

import cycle  # noqa: E402  (the scripts of this folder)
import shells  # noqa: E402
import spheres  # noqa: E402
import theory  # noqa: E402

HERE = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.join(HERE, "..", "..")
MADE_APART = re.compile(r"(computed|integrated) independently|written apart|radial integration|independent computation", re.I)


def last_unit(text):
    """One unit of the last digit of a number as it is written."""
    if text.startswith("0x"):
        return 0.0
    mantissa, _, exponent = text.lower().partition("e")
    decimals = len(mantissa.partition(".")[2])
    return 10.0 ** (int(exponent or 0) - decimals)


def number(text):
    return float(int(text, 16)) if text.startswith("0x") else float(text)


def told_by(program):
    environment = dict(os.environ, OMP_NUM_THREADS="1", OMPI_ALLOW_RUN_AS_ROOT="1", OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1")
    out = subprocess.run([program, "verify", "physics", "--json"], capture_output=True, text=True, env=environment, check=False).stdout
    return [row for row in json.loads(out)["rows"] if MADE_APART.search(row["source"])]


def listed():
    """(file, number as written, name) of numbers.txt."""
    file, rows = None, []
    with open(os.path.join(HERE, "numbers.txt"), encoding="utf-8") as lines:
        for line in lines:
            if not line.strip() or line.startswith("#"):
                continue
            if not line.startswith(" "):
                file = line.strip()
                continue
            text, _, name = line.strip().partition(" = ")
            rows.append((file, text, name))
    return rows


def text_of(file):
    path = os.path.join(ROOT, file)
    if not os.path.isfile(path):
        return ""
    with open(path, encoding="utf-8") as content:
        return content.read().replace("−", "-")


def compare_rows(rows, values, faults):
    for row in rows:
        name = f"{row['id']} | {row['quantity']}"
        if name not in values:
            faults.append(f"nobody recomputes {name}")
            continue
        written = repr(row["reference"]).removesuffix(".0")
        allowed = float(row["tolerance"])
        if len(re.sub(r"[^0-9]", "", written).lstrip("0")) <= 10:  # longer ones were computed from a shorter one
            allowed = min(allowed, last_unit(written))
        if not abs(values[name] - row["reference"]) <= allowed:
            faults.append(f"{name}: {written} in the program, recomputed {values[name]!r}")


def compare_listed(rows, values, faults):
    for file, text, name in rows:
        if not re.search(r"(?<![\w.])" + re.escape(text) + r"(?![\w.])", text_of(file)):
            faults.append(f"{file} has no number {text} ({name})")
        elif name not in values:
            faults.append(f"nobody recomputes {name} ({text} in {file})")
        elif not abs(values[name] - number(text)) <= last_unit(text) * (1.0 + 1e-9):
            faults.append(f"{name}: {text} in {file}, recomputed {values[name]!r}")


def compare_tables(faults):
    """How many numbers were compared."""
    count = 0
    for file, row_of in theory.TABLES.items():
        names, *rows = [line.split(",") for line in text_of(file).split()]
        for row in rows:
            values = row_of(float(row[0]))
            for name, text in zip(names[1:], row[1:]):
                count += 1
                if name not in values:
                    faults.append(f"nobody recomputes {name} of {file}")
                elif not abs(values[name] - number(text)) <= last_unit(text):
                    faults.append(f"{file}, row {row[0]}: {name} is {text}, recomputed {values[name]!r}")
    return count


def unlisted(files):
    """Sources that say of a number that it was computed apart, and are not in numbers.txt."""
    out = []
    for folder, _, names in os.walk(os.path.join(ROOT, "tests")):
        for name in sorted(names):
            file = os.path.relpath(os.path.join(folder, name), ROOT)
            if name.endswith(".cpp") and file not in files and MADE_APART.search(text_of(file)):
                out.append(file)
    return out


def main():
    if len(sys.argv) != 2:
        sys.exit("usage: check.py MORULA")
    rows, table = told_by(sys.argv[1]), listed()
    if not rows or not table:
        print("check.py: no reference number was found", file=sys.stderr)
        return 2
    values = cycle.values() | shells.values() | spheres.values() | theory.values()
    faults = []
    compare_rows(rows, values, faults)
    compare_listed(table, values, faults)
    in_tables = compare_tables(faults)
    faults += [f"{file} speaks of numbers computed independently and is not in numbers.txt" for file in unlisted({file for file, _, _ in table})]
    for fault in faults:
        print(fault, file=sys.stderr)
    print(f"{len(rows)} numbers of the program and {len(table)} of tests and pages, {in_tables} of tables recomputed: {len(faults)} differ or are missing")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
