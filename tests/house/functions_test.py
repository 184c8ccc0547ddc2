#!/usr/bin/env python3
"""No function is longer than an eye can hold: at most 60 lines, from its signature to its closing brace.

  functions_test.py ROOT        lists those that are longer
  functions_test.py --self-test

A lambda counts as a part of the function in which it stands. What tests/ has may be longer.
"""
import re
import sys
import tempfile
from pathlib import Path

LONGEST = 60
TOPS = ("kernel", "render", "hwmodel", "include", "library", "python", "examples", "app", "bench", "measure", "report", "accuracy")
# What a brace may belong to where no function is open, by the words before it.
SCOPE = re.compile(r"^(inline\s+)?namespace\b|^extern\s*$|^(typedef\s+)?(class|struct|union|enum)\b(?!.*\)\s*(const|noexcept|override|final)?\s*$)")
TEXT = re.compile(r'R"(?P<mark>[^()\\\s]*)\((?s:.*?)\)(?P=mark)"|"(?:[^"\\\n]|\\.)*"|(?<![0-9a-fA-F])\'(?:[^\'\\\n]|\\.)*\'|//[^\n]*|/\*(?s:.*?)\*/|^[ \t]*#(?:[^\n\\]|\\.|\\\n)*', re.M)


def blank(text):
    """The code with its strings, comments and preprocessor's lines as blanks, line by line."""
    return TEXT.sub(lambda match: re.sub(r"[^\n]", " ", match[0]), text)


def closing(code, opening):
    """Where the brace at `opening` is closed."""
    depth = 0
    for at in range(opening, len(code)):
        depth += (code[at] == "{") - (code[at] == "}")
        if depth == 0:
            return at
    return len(code) - 1


def without_template(head):
    """The words of a signature behind `template <...>`, and how many letters that takes."""
    match = re.match(r"\s*(?:(?:public|private|protected)\s*:\s*)*", head)
    at = match.end()
    while re.match(r"template\s*<", head[at:]):
        at += head[at:].index("<")
        depth = 0
        for at in range(at, len(head)):
            depth += (head[at] == "<") - (head[at] == ">" and head[at - 1] != "-")
            if depth == 0:
                break
        at += 1
        at += len(head[at:]) - len(head[at:].lstrip())
    return head[at:], at


def is_body(head):
    """Does a brace behind these words open a function's body, and no list of values?"""
    if ")" not in head or re.search(r"=\s*$|\breturn\s*$", head):
        return False
    if head.rstrip().endswith((")", "}")):
        return True
    behind = head[head.rindex(")") + 1:]
    members = re.search(r"\)\s*(noexcept\s*)?:(?!:)", head)  # a constructor's list: `: a_{1}, b_(2) {`
    if members and not re.fullmatch(r"\s*(const|noexcept|override|final|try|\s)*", behind):
        return False
    return re.fullmatch(r"\s*(const|noexcept|override|final|try|mutable|&+|->.*|requires.*|\s)*", behind, re.S) is not None


def functions(text):
    """Name, first line and last line of each function that a source defines."""
    code, found = blank(text), []
    at = begin = 0
    while at < len(code):
        if code[at] in ";}":
            begin = at + 1
        elif code[at] == "{":
            head, skipped = without_template(code[begin:at])
            words = " ".join(head.split())
            if SCOPE.search(words):
                begin = at + 1
            elif is_body(head):
                end = closing(code, at)
                first = begin + skipped + len(head) - len(head.lstrip())
                name = re.findall(r"([~\w:]+|operator[^\s(]+)\s*\(", words)
                found.append((name[0] if name else words, text.count("\n", 0, first) + 1, text.count("\n", 0, end) + 1))
                at, begin = end, end + 1
            else:  # a list of values
                at = closing(code, at)
        at += 1
    return found


def offences(root):
    found = []
    for path in sorted(p for top in TOPS for p in (root / top).rglob("*") if p.suffix in (".h", ".cpp")):
        for name, first, last in functions(path.read_text()):
            if last - first + 1 > LONGEST:
                found.append(f"{path.relative_to(root).as_posix()}:{first}: {name} has {last - first + 1} lines; at most {LONGEST}")
    return found


def body(lines):
    return "".join(f"  f({i});\n" for i in range(lines))


def self_test():
    long, short = body(LONGEST - 1), body(LONGEST - 2)  # with two lines around them
    planted = {
        "app/plain.cpp": f"void f() {{\n{long}}}\n",
        "app/method.h": f"class A {{\n public:\n  int g(int a) const override {{\n{long}  }}\n}};\n",
        "app/constructor.cpp": f"A::A(int b) : a_{{b}}, c_(d{{1}}) {{\n{long}}}\n",
        "app/returns.cpp": f"template <class T, class U = std::vector<T>>\nauto h(T t) -> std::vector<T> {{\n{long}}}\n",
        "app/lambda.cpp": f"void f() {{\n  const auto g = [&](int i) {{\n{body(LONGEST - 3)}  }};\n}}\n",
        "app/nested.cpp": f"namespace a {{\nnamespace {{\nstruct S {{\n  S() = default;\n  int a{{3}};\n  void f() {{\n{long}  }}\n}};\n}}\n}}\n",
        "app/texts.cpp": f'void f() {{\n  g("}}", \'}}\', R"x(}})" }}  )x");  // }}\n  /* }} */\n{body(LONGEST - 3)}}}\n',
        "app/signature.cpp": f"void f(int a,\n       int b) {{\n{short}}}\n",
        "app/tried.cpp": f"int main() try {{\n{long}}} catch (...) {{\n}}\n",
        "app/big.cpp": f"void f() {{\n  g(100'000);\n  g(1'0);\n{body(LONGEST - 3)}}}\n",
        "app/returning.cpp": f"struct S make(int a) {{\n{long}}}\n",
    }
    fine = {
        "app/short.cpp": f"void f() {{\n{short}}}\nvoid g() {{\n{short}}}\n",
        "app/template.cpp": f"template <class T>\nvoid f() {{\n{short}}}\n",
        "app/table.cpp": "const std::vector<int> kTable{\n" + "    1,\n" * 100 + "};\nint k = f({\n" + "    1,\n" * 100 + "});\n",
        "app/class.h": "struct S {\n" + "  int f() { return 1; }\n" * 100 + "};\nenum class E {\n" + "  a,\n" * 99 + "};\n",
        "app/space.cpp": "namespace a::b {\n" + "void f();\n" * 100 + "}\nextern \"C\" {\n" + "void g();\n" * 100 + "}\n",
        "tests/long.cpp": f"void f() {{\n{long}}}\n",
    }
    with tempfile.TemporaryDirectory() as folder:
        root = Path(folder)
        for name, text in {**planted, **fine}.items():
            (root / name).parent.mkdir(parents=True, exist_ok=True)
            (root / name).write_text(text)
        found = offences(root)
    caught = sorted(offence.split(":")[0] for offence in found)
    if caught != sorted(planted):
        sys.exit(f"missed: {sorted(set(planted) - set(caught))}; wrongly reported: {sorted(set(caught) - set(planted))}; {found}")
    if not all(f"has {LONGEST + 1} lines" in offence for offence in found):
        sys.exit(f"wrongly counted: {found}")
    print(f"all {len(planted)} planted offences caught")


if __name__ == "__main__":
    if sys.argv[1:] == ["--self-test"]:
        self_test()
        sys.exit(0)
    problems = offences(Path(sys.argv[1]))
    print("\n".join(problems) if problems else f"no function has more than {LONGEST} lines")
    sys.exit(1 if problems else 0)
