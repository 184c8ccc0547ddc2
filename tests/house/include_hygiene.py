#!/usr/bin/env python3
"""A file includes the standard headers whose names it uses, and no others.

  include_hygiene.py ROOT           says what is missing or not needed
  include_hygiene.py ROOT --fix     writes it into the files (clang-format sorts it)
  include_hygiene.py --self-test

A source may leave a header to its own one: x.cpp to x.h. A name that the table lacks is an offence: the table gets it.
"""
import re
import sys
import tempfile
from pathlib import Path

NOT_OURS = ("build", "out")
# Header -> its names in namespace std. A name that several headers give is satisfied by each; the first is the usual one.
TABLE = {
    "algorithm": "all_of any_of includes none_of binary_search clamp copy copy_n count count_if equal fill fill_n find find_if for_each is_sorted "
                 "lexicographical_compare lower_bound max max_element min min_element minmax minmax_element mismatch nth_element "
                 "partition remove remove_if replace reverse rotate search sort stable_sort transform unique upper_bound",
    "array": "array get to_array tuple_size",
    "atomic": "atomic atomic_flag atomic_ref memory_order_relaxed memory_order_acquire memory_order_release",
    "barrier": "barrier",
    "bit": "bit_cast bit_ceil bit_floor bit_width countl_one countl_zero countr_one countr_zero endian has_single_bit popcount rotl rotr",
    "cctype": "isalnum isalpha isdigit isprint isspace isupper islower tolower toupper",
    "charconv": "from_chars to_chars chars_format",
    "chrono": "chrono chrono_literals",
    "cmath": "abs acos asin atan atan2 atanh cbrt ceil copysign cos erf erfc exp exp2 floor fma fmod frexp hypot isfinite isinf isnan ldexp llround log log10 "
             "log2 legendre lround nearbyint nextafter pow round sin sqrt tan tgamma trunc",
    "compare": "strong_ordering weak_ordering partial_ordering",
    "concepts": "convertible_to floating_point integral invocable same_as signed_integral unsigned_integral derived_from",
    "condition_variable": "condition_variable",
    "csignal": "sig_atomic_t signal raise",
    "cstddef": "byte max_align_t nullptr_t ptrdiff_t size_t",
    "cstdint": "int8_t int16_t int32_t int64_t uint8_t uint16_t uint32_t uint64_t intptr_t uintptr_t",
    "cstdio": "FILE fclose feof ferror fflush fgets fopen fprintf fputc fputs fread fseek fwrite printf puts remove rename snprintf",
    "cstdlib": "abort abs aligned_alloc atoi atol atoll exit free getenv malloc quick_exit _Exit strtod strtol strtoll strtoul strtoull system",
    "cstring": "memchr memcmp memcpy memmove memset strchr strcmp strerror strlen strncmp strstr",
    "ctime": "clock clock_t time time_t gmtime strftime",
    "deque": "deque erase erase_if",
    "exception": "current_exception exception exception_ptr rethrow_exception terminate uncaught_exceptions",
    "filesystem": "filesystem",
    "future": "async future future_status launch packaged_task",
    "fstream": "fstream ifstream ofstream ios",
    "functional": "bind_front equal_to function greater hash invoke less minus multiplies plus ref reference_wrapper",
    "initializer_list": "initializer_list",
    "iomanip": "setfill setprecision setw",
    "ios": "hex dec ios ios_base streamsize",
    "iostream": "cerr cin clog cout endl flush ostream istream",
    "istream": "istream ws",
    "iterator": "back_inserter begin distance end forward_iterator_tag istreambuf_iterator iterator_traits next prev size ssize",
    "limits": "numeric_limits",
    "locale": "locale numpunct",
    "list": "list",
    "map": "map multimap erase_if",
    "memory": "addressof allocator make_shared make_unique make_unique_for_overwrite shared_ptr static_pointer_cast unique_ptr weak_ptr",
    "mutex": "call_once lock_guard mutex once_flag scoped_lock unique_lock",
    "new": "align_val_t bad_alloc launder nothrow",
    "numbers": "numbers",
    "numeric": "accumulate gcd iota lcm partial_sum reduce transform_reduce",
    "optional": "make_optional nullopt optional",
    "ostream": "endl flush ostream",
    "random": "mt19937 mt19937_64 normal_distribution random_device uniform_int_distribution uniform_real_distribution",
    "regex": "regex regex_match regex_search smatch",
    "set": "multiset set erase_if",
    "span": "as_bytes as_writable_bytes dynamic_extent span",
    "sstream": "istringstream ostringstream stringstream",
    "stdexcept": "domain_error invalid_argument length_error logic_error out_of_range overflow_error range_error runtime_error",
    "string": "getline stod stof stoi stol stoll stoul stoull string to_string erase erase_if",
    "string_view": "string_view",
    "system_error": "errc error_code generic_category make_error_code system_category system_error",
    "stop_token": "stop_callback stop_source stop_token",
    "thread": "jthread this_thread thread",
    "tuple": "apply forward_as_tuple get ignore make_tuple tie tuple tuple_cat tuple_element tuple_element_t tuple_size tuple_size_v",
    "type_traits": "bool_constant common_type_t conditional_t decay_t has_unique_object_representations_v enable_if_t false_type integral_constant invoke_result_t is_arithmetic_v is_base_of_v "
                   "is_const_v is_constant_evaluated is_empty_v is_enum_v is_floating_point_v is_integral_v is_invocable_v is_pointer_v is_same_v is_signed_v "
                   "is_trivially_copyable_v is_trivially_destructible_v is_unsigned_v is_void_v make_signed_t make_unsigned_t remove_const_t "
                   "remove_cvref_t remove_pointer_t remove_reference_t true_type type_identity_t underlying_type_t void_t",
    "unordered_map": "unordered_map erase_if",
    "unordered_set": "unordered_set",
    "utility": "as_const cmp_equal cmp_greater cmp_less exchange forward get in_place in_range index_sequence index_sequence_for integer_sequence "
               "make_index_sequence make_integer_sequence make_pair move pair swap to_underlying tuple_size",
    "variant": "get get_if holds_alternative monostate variant visit",
    "vector": "erase erase_if vector",
}
# The same for names outside of std, macros among them; where a header is needed for these alone.
PLAIN = {"assert": "cassert", "errno": "cerrno", "EINVAL": "cerrno", "EAGAIN": "cerrno", "stdout": "cstdio", "stderr": "cstdio", "stdin": "cstdio", "SIGINT": "csignal", "SIGTERM": "csignal",
         "INT32_MAX": "cstdint", "INT64_MAX": "cstdint", "INT64_MIN": "cstdint", "UINT64_MAX": "cstdint", "SIZE_MAX": "cstdint",
         "EXIT_FAILURE": "cstdlib", "EXIT_SUCCESS": "cstdlib", "PRIu64": "cinttypes", "PRIx64": "cinttypes", "va_list": "cstdarg"}
HEADERS = {}
for header, names in TABLE.items():
    for name in names.split():
        HEADERS.setdefault(name, []).append(header)
HEADERS.update({"abs": ["cmath", "cstdlib"], "get": ["tuple", "utility", "array", "variant"], "ios": ["ios", "fstream"],
                "erase": ["vector", "string", "deque"], "erase_if": ["vector", "string", "map", "set", "deque", "unordered_map"],
                "istream": ["istream", "iostream", "sstream", "fstream"], "ws": ["istream", "iostream", "sstream", "fstream"],
                "ostream": ["ostream", "iostream", "sstream", "fstream"], "flush": ["ostream", "iostream"], "endl": ["ostream", "iostream"],
                "remove": ["cstdio", "algorithm"], "hex": ["ios", "iostream"], "dec": ["ios", "iostream"], "tuple_size": ["tuple", "utility", "array"], "tuple_size_v": ["tuple", "utility", "array"], "swap": ["utility"]})
CHECKED = set(TABLE) | set(PLAIN.values())

DROPPED = re.compile(r'//[^\n]*|/\*.*?\*/|R"(\w*)\(.*?\)\1"|"(?:\\.|[^"\\\n])*"|\'(?:\\.|[^\'\\\n])\'', re.S)
USED = re.compile(r"\bstd::(?:ranges::)?(\w+)")
PLAIN_USED = re.compile(r"(?<![\w:.>])(" + "|".join(PLAIN) + r")\b")
INCLUDED = re.compile(r"^\s*#\s*include\s*<([\w.]+)>", re.M)


def code_of(text):
    return DROPPED.sub(" ", re.sub(r"^\s*#\s*include[^\n]*", "", text, flags=re.M))


def wanted(code):
    """For each name: the headers of which one is enough. None: the table lacks the name."""
    found = {f"std::{name}": HEADERS.get(name) for name in USED.findall(code)}
    found.update({name: [PLAIN[name]] for name in PLAIN_USED.findall(code)})
    return found


def examined(path):
    """Missing headers with a name for each, headers not needed, and names that the table lacks."""
    text = path.read_text()
    own = path.with_suffix(".h")
    included = set(INCLUDED.findall(text))
    given = included | (set(INCLUDED.findall(own.read_text())) if path.suffix == ".cpp" and own.exists() else set())
    names = wanted(code_of(text))
    missing = {}
    for name, headers in sorted(names.items()):
        if headers and not given.intersection(headers):
            missing.setdefault(headers[0], name)
    needed = {header for headers in names.values() for header in headers or []}
    return missing, sorted(included & CHECKED - needed), sorted(name for name, headers in names.items() if headers is None)


def sources(root):
    tops = [p for p in root.iterdir() if p.is_dir() and p.name not in NOT_OURS and not p.name.startswith(".")]
    return sorted(p for top in tops for p in top.rglob("*") if p.suffix in (".h", ".cpp"))


def offences(root):
    found = []
    for path in sources(root):
        name = path.relative_to(root).as_posix()
        missing, spare, unknown = examined(path)
        found += [f"{name}: uses {used}, and does not include <{header}>" for header, used in missing.items()]
        found += [f"{name}: includes <{header}>, and uses no name of it" for header in spare]
        found += [f"{name}: {used} is not in the table of tests/house/include_hygiene.py" for used in unknown]
    return found


def place_of_block(lines):
    """Where the standard headers go in a file that has none yet: behind those of third parties or its own one."""
    includes = [n for n, line in enumerate(lines) if line.startswith("#include")]
    third_party = [n for n in includes if lines[n].startswith("#include <")]
    if third_party:
        end = third_party[0]
        while lines[end].startswith("#include <"):
            end += 1
        return end
    if len(includes) > 1 and includes[1] > includes[0] + 1 and lines[includes[0] + 1] == "":
        return includes[0] + 1
    once = [n for n, line in enumerate(lines) if line.startswith("#pragma once")]
    return once[0] + 1 if once else includes[0] if includes else 0


def fix(path):
    missing, spare, _ = examined(path)
    if not missing and not spare:
        return
    lines = path.read_text().split("\n")
    lines = [line for line in lines if not ((match := INCLUDED.match(line)) and match[1] in spare)]
    added = [f"#include <{header}>" for header in sorted(missing)]
    standard = [n for n, line in enumerate(lines) if (match := INCLUDED.match(line)) and match[1] in CHECKED]
    if standard and added:
        lines[standard[0]:standard[0]] = added
    elif added:
        at = place_of_block(lines)
        apart = at > 0 and lines[at - 1] != "" and not lines[at - 1].startswith("//")
        lines[at:at] = ["", *added, ""] if apart else [*added, ""]
    path.write_text(re.sub(r"\n{3,}", "\n\n", "\n".join(lines)))


def self_test():
    fine = {"kernel/own.h": "#pragma once\n#include <vector>\nstd::vector<int> own();\n",
            "kernel/own.cpp": '#include "kernel/own.h"\nstd::vector<int> own() { return {}; }  // std::string in a comment\n',
            "kernel/both.h": '#include <cstdlib>\ninline int both(int a) { return std::abs(a); }\nconst char* const text = "std::map";\n',
            "kernel/system.h": "#include <unistd.h>\n#include <systemc>\n",
            "kernel/error.cpp": "#include <cerrno>\nint error() { return errno; }\n"}
    planted = {"kernel/a.h": ("std::uint32_t a;\n", "cstdint"), "kernel/b.h": ("#include <cstdint>\nstd::size_t b;\n", "cstddef"),
               "kernel/c.cpp": ("#include <algorithm>\nint c(int d) { return std::max(1, std::move(d)); }\n", "utility"),
               "kernel/d.h": ("#include <map>\nint d;\n", "uses no name"), "kernel/e.h": ("std::nonsense e;\n", "not in the table"),
               "kernel/f.h": ("bool f(int* p) { return std::ranges::count(*p); }\n", "algorithm"),
               "kernel/g.cpp": ("int g() { assert(true); return 1; }\n", "cassert"),
               "tests/h.cpp": ('#include "kernel/own.h"\nstd::vector<int> h;\n', "vector")}
    with tempfile.TemporaryDirectory() as folder:
        root = Path(folder)
        for name, text in {**fine, **{name: text for name, (text, _) in planted.items()}}.items():
            (root / name).parent.mkdir(parents=True, exist_ok=True)
            (root / name).write_text(text)
        found = offences(root)
        for name, (_, said) in planted.items():
            assert any(offence.startswith(name + ":") and said in offence for offence in found), f"missed: {name}; {found}"
        extra = [offence for offence in found if offence.split(":")[0] not in planted]
        assert not extra, f"wrongly reported: {extra}"
        for path in sources(root) * 2:
            fix(path)
        left = offences(root)
        assert len(left) == 1 and "std::nonsense" in left[0], left
        assert (root / "kernel/own.cpp").read_text() == fine["kernel/own.cpp"]
        assert (root / "kernel/c.cpp").read_text().count("#include") == 2
    print(f"all {len(planted)} planted offences caught, and those that can be mended are")


if __name__ == "__main__":
    if sys.argv[1:] == ["--self-test"]:
        self_test()
        sys.exit(0)
    house = Path(sys.argv[1])
    if "--fix" in sys.argv:
        for source in sources(house) * 2:  # what a header gives up, its source may need
            fix(source)
    problems = offences(house)
    print("\n".join(problems) if problems else "every file includes the standard headers whose names it uses")
    sys.exit(1 if problems else 0)
