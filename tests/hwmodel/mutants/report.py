"""What the mutants' results say: sums by class and by list, what verify alone did not find, every mutant."""
import re

CLASSES = ["wrong bits", "wrong cycles", "wrong account", "checker blind", "wrong tool", "equivalent"]
MARKS = "<!-- mutants: written by tests/hwmodel/mutants/run.py -->", "<!-- mutants: end -->"


def verdict(mutant, result):
    if result["error"]:
        return "not built"
    if result["verify"]:
        return "verify"
    if result["tests"]:
        return "tests"
    return "equivalent" if mutant["class"] == "equivalent" else "survives"


def row(name, of):
    count = [verdict(m, r) for m, r in of].count
    return (f"| {name} | {len(of)} | {count('verify') + count('tests')} | {count('verify')} | {count('tests')} "
            f"| {count('equivalent')} | {count('survives')} | {count('not built')} |")


def sums(mutants, results, lists):
    ran = [(m, results[m["name"]]) for m in mutants if m["name"] in results]
    head = "| run | killed | by verify alone | by tests | equivalent | survive | not built |"
    rule = "|---|--:|--:|--:|--:|--:|--:|--:|"
    lines = [f"| class {head}", rule]
    lines += [row(kind, of) for kind in CLASSES if (of := [(m, r) for m, r in ran if m["class"] == kind])]
    lines += [row("**sum**", ran), "", f"| list {head}", rule]
    lines += [row(told.rstrip("."), [(m, r) for m, r in ran if m["name"] in names]) for told, names in lists]
    bits = [(m, r) for m, r in ran if m["class"] == "wrong bits"]
    alone = [(m, r) for m, r in bits if r["verify"]]
    named = [(m, r) for m, r in alone if r["stage_named"] and r["cell"]]
    edge = [m for m, _ in ran if m.get("boundary")]
    commits = sorted({r["commit"].removesuffix("-dirty") for _, r in ran})
    of = lambda part, whole: f"{len(part)} of {len(whole)} ({100 * len(part) / max(1, len(whole)):.1f} %)"
    lines += ["", f"- {len(ran)} of {len(mutants)} mutants have run.", f"- Commits of the runs: {', '.join(commits)}.",
              f"- {len(edge)} of them are faults of side bands or boundaries.",
              f"- Of those with wrong bits `verify` alone finds {of(alone, bits)}.",
              f"- It names the stage and the first wrong cell for {of(named, alone)} of these."]
    return "\n".join(lines) + "\n"


def notable(mutants, results):
    """The wrong bits that verify alone does not find or names elsewhere; survivors; equivalents with reasons."""
    ran = [(m, results[m["name"]]) for m in mutants if m["name"] in results]
    lines = ["", "| not found by verify alone, or named elsewhere | what it is | found by |", "|---|---|---|"]
    for m, r in ran:
        by = verdict(m, r)
        elsewhere = by == "verify" and m["class"] == "wrong bits" and not (r["stage_named"] and r["cell"])
        if by in ("survives", "not built") or by == "tests" and m["class"] == "wrong bits" or elsewhere:
            said = f"{r['verify']} {r.get('where', '')}".strip() if elsewhere else r["tests"] or by
            lines.append(f"| {m['name']} | {m['why']} | {said} |")
    run = {m["name"] for m, _ in ran}
    lines += ["", "| equivalent | why | run on all grounds |", "|---|---|---|"]
    lines += [f"| {m['name']} | {m['why']} | {'yes' if m['name'] in run else 'no'} |" for m in mutants
              if m["class"] == "equivalent"]
    return "\n".join(lines) + "\n"


def every(mutants, results):
    lines = ["", "| mutant | class | killed by | says | stage named | cell | seconds |", "|---|---|---|---|---|---|--:|"]
    for m in mutants:
        if (r := results.get(m["name"])) is None:
            continue
        by = r["verify"] or r["tests"] or verdict(m, r)
        lines.append(f"| {m['name']} | {m['class']} | {by} | {r.get('where', '')} | "
                     f"{'yes' if r['stage_named'] else 'no' if r['verify'] else ''} | {r['cell']} | {r['seconds']} |")
    return "\n".join(lines) + "\n"


def into_page(path, text):
    """Replaces what stands between the two marks of a page."""
    begin, end = map(re.escape, MARKS)
    page, times = re.subn(f"{begin}.*{end}", lambda _: f"{MARKS[0]}\n\n{text}\n{MARKS[1]}", path.read_text(), flags=re.S)
    if times != 1:
        raise SystemExit(f"{path} has not the two marks {MARKS[0]} and {MARKS[1]}")
    path.write_text(page)
