#!/usr/bin/env python3
"""Names, statements and comments that anyone reads: no variable is called `of`, a statement does one thing, and no
sentence of a comment begins like a half sentence: with What, Of, Who, Whose, Whether or Which. No function of the C
library is called that goes by the locale, which belongs to the program around the library.

  words_test.py ROOT
  words_test.py --self-test
"""
import re
import sys
from pathlib import Path

HIDDEN = re.compile(r"""//[^\n]*|/\*.*?\*/|R"\((.*?)\)"|"(?:\\.|[^"\\\n])*"|(?<!\w)'(?:\\.|[^'\\\n])+'""", re.S)
DECLARATION = re.compile(r"(const|static|constexpr|constinit|auto|unsigned|using|return|throw|case|default|template|enum|friend|"
                         r"inline|virtual|explicit|mutable|struct|class)\b|[A-Za-z_][\w:]*(<[^;=()]*>)?\s*[&*]*\s+[&*]*(const\s+)?\w+\s*([={(\[:]|$)")
CONTROL = re.compile(r"\s*(else\s+if|if\s+constexpr|if|for|while|switch)\s*(?=\()|\s*(else|do)\b|\s*(case\b[^:]*|default\s*|private\s*|public\s*|protected\s*):(?!:)")


def code_of(text):
    """The text without comments, strings and characters, with the same lines."""
    return HIDDEN.sub(lambda found: re.sub(r"[^\n]", " ", found[0]), text)


def past_parentheses(text, at):
    depth = 0
    for i in range(at, len(text)):
        depth += (text[i] in "([{") - (text[i] in ")]}")
        if depth == 0:
            return i + 1
    return len(text)


def statements(code):
    """Each statement that ends with a semicolon, and where it ends."""
    opened, begin = ["{"], [0]
    for i, sign in enumerate(code):
        if sign in "([{":
            opened.append(sign)
            begin.append(i + 1)
        elif sign in ")]}":
            opened.pop()
            begin.pop()
            # Behind a lambda or a braced value its statement goes on.
            if sign == "}" and opened and opened[-1] == "{" and not re.match(r"\s*([,;).\]*/%?:=&|<>(]|\+[^+]|-[^-])", code[i + 1:i + 20]):
                begin[-1] = i + 1
        elif sign == ";" and opened[-1] == "{":
            yield code[begin[-1]:i], i
            begin[-1] = i + 1


def parts(statement):
    """What commas part, without `if (...)` and the like in front."""
    at = 0
    while found := CONTROL.match(statement, at):
        at = past_parentheses(statement, found.end()) if found[1] else found.end()
    found, depth, last = [], 0, at
    for i in range(at, len(statement)):
        depth += (statement[i] in "([{") - (statement[i] in ")]}")
        if statement[i] == "," and depth == 0:
            found.append(statement[last:i].strip())
            last = i + 1
    return found + [statement[last:].strip()]


def does_something(part):
    sides = re.sub(r"->|<<|>>|[<>]=", "", part)
    if sides.count("<") != sides.count(">"):
        return False  # a comma between the arguments of a template
    return bool(part) and not DECLARATION.match(part) and not part.startswith("#") and bool(re.search(r"=|\+\+|--|\)$", part))


LOCALE = re.compile(r"\b(strto[dfl]\w*|strtou?ll?|sto[ifdl]\w*|stoul\w*|ato[fil]\w*|s?scanf|tolower|toupper|is(?:space|alpha|digit|alnum|punct|print|upper|lower|xdigit)|setlocale)\s*\(")

HALF = re.compile(r"(?:^|[.:] )((?:What|Of|Who|Whose|Whether|Which)\b[^.]*)")


def comments(text):
    """Comments with lines of their own, each as one line, and the number of their first line."""
    for found in re.finditer(r"(?:^[ \t]*//+[^\n]*\n)+", text, re.M):
        lines = [re.sub(r"^\s*//+<?\s*", "", line) for line in found[0].splitlines()]
        yield " ".join(lines), text.count("\n", 0, found.start()) + 1


def offences(name, text):
    code = code_of(text)

    def place(at):
        return f"{name}:{code.count(chr(10), 0, at) + 1}"
    found = [f"{place(m.start())}: a variable is called `of`" for m in re.finditer(r"(?<!::)\bof\b(?!\s*\()", code)]
    if not name.startswith(("tests/", "examples/")):
        found += [f"{place(m.start())}: {m[1]} goes by the locale of the program around us" for m in LOCALE.finditer(code)]
    for comment, line in comments(text):
        found += [f"{name}:{line}: a half sentence: {half[:60]}" for half in HALF.findall(comment)]
    for statement, end in statements(code):
        if len(several := parts(statement)) > 1 and all(map(does_something, several)):
            found.append(f"{place(end)}: a statement does {len(several)} things: {' '.join(statement.split())[:80]}")
    return found


def self_test():
    fine = ["int a = 0, b = f(1, 2);", "std::map<int, int> x, y{1, 2};", "for (i = 0, j = 1; i < j; ++i, --j) f(i, j);", "// of a, of b\nf();",
            'say("of");', "return a, b;", "A::of(x); y = table.of(3);", "f([&] { g(); }, {1, 2});", "const auto [a, b] = c(); d = {1, 2};",
            "UInt<16> energy, heat;", "T *const a = f(), *const b = g();", "sum += Pair<int, kTwo>(a).run();", "char c = 'o', d = ',';"]
    wrong = ["int of = 0;", "f(of);", "a = 0, b = 1;", "if (x) a = 0, ++b;", "f(1), g(2);", "else a.b[3] = 1, c->d += 2;", "f([&] { a = 1, b = 2; });",
             "x = std::stoi(text);", "c = tolower(c);", "d = strtod(a, b);", "case 3: a = 1, b = 2;", "for (int i : x) f(i), g(i);"]
    halves = ["// What it holds.\n", "  // It holds.\n  // Of all, one.\n", "/// Whose bits.\n"]
    for text in halves:
        assert offences("x", text), text
    fine += ["x();  // Of none\n", "// It is what it is.\n"]
    for text in fine:
        assert not offences("x", f"void f() {{ {text} }}"), (text, offences("x", f"void f() {{ {text} }}"))
    for text in wrong:
        assert offences("x", f"void f() {{ {text} }}"), text
    print(f"all {len(wrong) + len(halves)} planted offences caught")


if __name__ == "__main__":
    if sys.argv[1:] == ["--self-test"]:
        self_test()
        sys.exit(0)
    root = Path(sys.argv[1])
    files = [p for top in ("accuracy", "app", "bench", "examples", "hwmodel", "include", "kernel", "library", "measure", "render", "report", "tests")
             for p in sorted((root / top).rglob("*")) if p.suffix in (".h", ".cpp")]
    problems = [line for p in files for line in offences(p.relative_to(root).as_posix(), p.read_text())]
    print("\n".join(problems) or f"{len(files)} files: no variable `of`, and one thing a statement, no half sentence")
    sys.exit(bool(problems))
