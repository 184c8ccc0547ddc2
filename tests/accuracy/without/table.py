"""The page of rules: which gate fails without each, and which rules no gate needs."""
import json
import textwrap

HEAD = """<!-- Written by tests/accuracy/without/run.py -->
# What each rule of the viscous law is for

Each rule of sections 10 and 11 of [automaton.md](../automaton.md) was taken out of the reference.
The table says which gate of `voxmelt accuracy` then fails, or which test of `kernel/` that holds a
property. A test that compares with a value by hand is no reason for a rule, and none counts there.
What has no other says which of those fails: a state by hand, or a random scene beside the oracle.

Run it yourself: `python3 tests/accuracy/without/run.py`. The replacements lie beside it.
"""


def number(value):
    if value is None:
        return "nothing"
    return f"{value:.4g}"


def size(row):
    """How far beyond its gate a row is; a row without a number comes first."""
    if "ends" in row or not row["gate"] or row["error"] is None:
        return float("inf")
    return abs(row["error"]) / row["gate"]


def error(row, key):
    value = row[key]
    if value is None:
        return "-"
    return f"{100 * value:+.3g} %" if row["error_is"] == "relative" else number(value)


def gate(row):
    return f"{100 * row['gate']:.3g} %" if row["error_is"] == "relative" else number(row["gate"])


def cells(missed, test):
    """The last four cells of a line of the table, by the rows that a gate missed, or the test that failed."""
    if missed:
        row = max(missed, key=size)
        if "ends" in row:
            return f"the program {row['ends']} | | | `{row['case']}` "
        more = len(missed) - 1
        of = f", and {more} more" if more else ""
        return (f"{row['setting']}: {row['quantity']}{of} | {error(row, 'error')} (with it {error(row, 'with')}) "
                f"| {gate(row)} | `{row['case']}` ")
    program, _, test = test.partition(" ")
    return f"{test} | | | `{program}` " if test else "**no gate needs it** | | | "


def verdict(result):
    if result["error"]:
        return "error: " + result["error"]
    return result["cells"].replace("|", "").strip() + (f"; a value: {result['value']}" if result.get("value") else "")


def stored(rules, results):
    """The text of what is kept: a line for each rule, in the order of the page."""
    lines = [f"{json.dumps(r['name'])}: {json.dumps(results[r['name']])}" for r in rules if r["name"] in results]
    return "{\n" + ",\n".join(lines) + "\n}\n"


def short(run):
    """A case or a test as the page says it."""
    program, _, chosen = run.partition(" ")
    return f"`{program}`" if program == "full" or not chosen else f"{chosen.split(':')[0]} and so on" if ":" in chosen else chosen


def page(rules, results):
    ran = [r for r in rules if r["name"] in results]
    found = [r for r in ran if results[r["name"]]["found"]]
    needless = [r for r in ran if r not in found and results[r["name"]]["whole"]]
    by_gate = sum(results[r["name"]]["found"] == "gate" for r in found)
    commits = sorted({results[r["name"]]["commit"].removesuffix("-dirty") for r in ran})
    unfinished = sum(r["name"] not in results or not results[r["name"]]["whole"] for r in rules)
    by_value = sum(bool(results[r["name"]].get("value")) for r in ran if r not in found)
    sums = (f"Of {len(rules)} rules a gate needs {by_gate}, and a test of a property alone {len(found) - by_gate}. Without {by_value} "
            f"of the other {len(rules) - len(found)} a test by value fails." + (f" For {unfinished} not all has run yet." if unfinished else "")
            + f" Commits of the runs: {', '.join(commits)}.")
    lines = [HEAD, *textwrap.wrap(sums, 100)]
    for section in sorted({r["section"] for r in found}):
        lines += ["", f"## Section {section}", "", "| rule | what it says | without it: the gate that fails | error | gate | case or test |",
                  "|---|---|---|---|---|---|"]
        lines += [f"| {r['name']} | {r['says'].replace('|', '/')} | {results[r['name']]['cells']}|" for r in found if r["section"] == section]
    head = ["", "| rule | what it says | which value differs without it | what passes without it | what to do |", "|---|---|---|---|---|"]
    line = lambda r: (f"| {r['name']} | {r['says'].replace('|', '/')} | {results.get(r['name'], {}).get('value') or '-'} | {', '.join(map(short, results.get(r['name'], {}).get('ran', []))) or '-'} "
                      f"| {r.get('verdict', '')} |")
    lines += ["", "## What no gate needs"] + head + list(map(line, needless))
    rest = [r for r in rules if r not in found and r not in needless]
    if rest:
        lines += ["", "## What has not run to its end", "", "The command goes on with these."] + head + list(map(line, rest))
    return "\n".join(lines) + "\n"
