# SPDX-License-Identifier: BSL-1.0
"""A header includes, itself or through others, what it names of scarp, of the standard library and of Eigen, so that it may be the
first include of a source. Names are found by patterns, in a second: all_verify_interface_header_sets (tests/run --all) compiles
each header alone."""
import collections
import functools
import pathlib
import re
import sys

sys.dont_write_bytecode = True
here = pathlib.Path(__file__).resolve().parent
sys.path[:0] = [str(here / "examples")]
from expectations import expect, finish

INCLUDE = re.compile(r'^#include ["<]([^">]+)[">]', re.M)
DEFINITIONS = (r"\b(?:class|struct|enum|concept)\s+(?:SCARP_\w+\s+)?(\w+)\b(?!\s*<)", r"\busing\s+(\w+)\s*=",
               r"\b(?:constexpr|const|inline)\b[^()=]*?\b([A-Za-z_]\w*)\s*(?:=|$)")
NO_TYPES = set("""static inline constexpr const return else explicit virtual noexcept requires throw new operator template public private
case and or not if mutable final override""".split())
# A name that is no member, after its namespaces within scarp.
NAMES = re.compile(r"(?<![\w.:])(?<!->)((?:scarp::|detail::|lanes::)*)([A-Za-z_]\w*)\b")
FOREIGN = {
    r"std::vector\b": "vector", r"std::(?:string|to_string)\b": "string", r"std::string_view\b": "string_view", r"std::array\b": "array",
    r"std::map\b": "map", r"std::set\b": "set", r"std::unordered_map\b": "unordered_map", r"std::optional\b|std::nullopt\b": "optional",
    r"std::variant\b": "variant", r"std::function\b": "functional", r"std::(?:unique|shared|weak)_ptr\b|std::make_(?:unique|shared)\b": "memory",
    r"std::span\b": "span", r"std::tuple\b|std::tie\b": "tuple", r"std::atomic\b": "atomic", r"std::thread\b": "thread", r"std::chrono\b": "chrono",
    r"std::(?:sort|min_element|max_element|any_of|all_of|none_of|fill|copy_n|lower_bound|upper_bound|nth_element|reverse|clamp)\b": "algorithm",
    r"std::(?:accumulate|iota|inner_product)\b": "numeric", r"std::numeric_limits\b": "limits", r"std::filesystem\b": "filesystem",
    r"std::(?:sqrt|abs|pow|hypot|atan2|isfinite|isnan|cos|sin|tan|exp|log|floor|ceil)\b": "cmath", r"std::bit_cast\b": "bit",
    r"std::[iof]+stringstream\b": "sstream", r"std::(?:if|of)stream\b": "fstream", r"std::(?:mt19937|uniform_real_distribution)\b": "random",
    r"[.](?:inverse|determinant)\(": "Eigen/LU", r"Eigen::SparseMatrix\b": "Eigen/SparseCore", r"[.]cross\(": "Eigen/Geometry",
    r"SelfAdjointEigenSolver\b": "Eigen/Eigenvalues"}


def without_words(text):
    text = re.sub(r"//[^\n]*|/\*.*?\*/", "", re.sub(r"#include.*", "", text), flags=re.S)
    return re.sub(r'"(?:[^"\\\n]|\\.)*"', '""', text)


def declarations(text):
    """What stands in namespaces, outside of classes and functions, with the sign that ends it."""
    within = []
    text = re.sub(r"^#define \w+ inline$", "", text, flags=re.M)
    for piece in re.findall(r"[^{};]*[{};]", text):
        if all(within):
            yield piece[:-1].strip(), piece[-1]
        if piece[-1] == "{":
            within.append(bool(re.search(r"\bnamespace\b[^;{}]*$", piece[:-1])))
        elif piece[-1] == "}" and within:
            within.pop()


def definitions(text):
    yield from re.findall(r"^#define (\w+)", text, re.M)
    for piece, end in declarations(text):
        for pattern in DEFINITIONS:
            found = re.search(pattern, piece)
            if found and not (end == ";" and re.search(rf"\b(?:class|struct|enum)\s+{found.group(1)}$", piece)):
                yield found.group(1)
        function = re.search(r"[\w>&*\]]\s+[&*]?([a-z]\w*)\s*\(", piece)
        if function:
            yield function.group(1)


def introduced(text):
    """Parameters, variables and types of a header's own: what follows a type."""
    kinds = re.finditer(r"(?:([A-Za-z_]\w*)|[>\]])(?:\s*[&*]+\s*|\s*\.\.\.\s*|\s+)(?=([A-Za-z_]\w*)\b)", text)
    return {found.group(2) for found in kinds if found.group(1) not in NO_TYPES} | set(re.findall(r"[\[,]\s*&?([a-z_]\w*)\s*(?=[,\]])", text))


def main(root):
    texts = {path.relative_to(root).as_posix(): path.read_text() for path in root.rglob("*.hpp")}
    expect(len(texts) > 100, f"{root} has {len(texts)} headers")
    includes = {name: INCLUDE.findall(text) for name, text in texts.items()}
    code = {name: without_words(text) for name, text in texts.items()}
    homes = collections.defaultdict(set)
    for name, text in code.items():
        for one in definitions(text):
            homes[one].add(name)

    @functools.cache
    def read_by(header):
        seen, left = set(), [header]
        while left:
            if (one := left.pop()) not in seen:
                seen.add(one)
                left += includes.get(one, [])
        return seen

    for header, text in sorted(code.items()):
        read, own = read_by(header), introduced(text)
        for space, name in sorted(set(NAMES.findall(text))):
            # A short name without its namespace may be anything.
            certain = space or (name not in own and (name[0].isupper() or "_" in name))
            if name in homes and certain:
                expect(homes[name] & read, f"{header} names {name} and does not include {' or '.join(sorted(homes[name]))}")
        for pattern, wanted in FOREIGN.items():
            if re.search(pattern, text):
                expect(wanted in read, f"{header} names {re.search(pattern, text).group()} and does not include <{wanted}>")
    finish()


if __name__ == "__main__":
    main(pathlib.Path(sys.argv[1]) if len(sys.argv) > 1 else here.parent / "include")
