#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
#
# check_docs.sh [--update] COMPILER [FLAGS...]
#
# The code of README.md and of docs/*.md is tested:
#   - the ```cpp blocks of a page, in their order, make one program that compiles and, where it has a main, runs;
#   - a line `<!-- case: NAME -->` is followed by the code of tests/compile_fail/NAME.cpp (or of one beside this script) and
#     by what g++ 12 says to it, without the paths and the line numbers of headers. Both must be what they are now;
#     --update writes them anew. Other compilers have other words: with them, only the programs are compiled;
#   - every line that form_tables.cpp prints stands in docs/forms.md;
#   - a test that docs/paper.md names in typographic quotes has that name, and files that it names are there.
set -uo pipefail
cd -- "$(dirname -- "${BASH_SOURCE[0]}")/../.." || exit 2

update=0
if [[ ${1:-} == --update ]]; then update=1; shift; fi
compiler=${1:?give a compiler}
shift
flags=(-std=c++20 -isystem include "$@")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
export LC_ALL=C
failures=0

complain() {
  echo "check_docs: $*" >&2
  ((failures += 1))
}

# The blocks of a page as one translation unit, each with its place in the page; those of a case are left out.
program_of() {
  awk -v page="$1" '
    /^<!-- case: / { of_case = 1 }
    /^```cpp$/ && !of_case { inside = 1; printf "#line %d \"%s\"\n", NR + 1, page; next }
    /^```$/ { if (inside) inside = 0; else if (of_case && in_case_code) { of_case = 0; in_case_code = 0 } next }
    /^```/ { if (of_case) in_case_code = 1; next }
    inside { print }' "$1"
}

case_source() {
  local folder
  for folder in tests/compile_fail tests/docs; do
    if [[ -f $folder/$1.cpp ]]; then echo "$folder/$1.cpp"; return; fi
  done
  return 1
}

# What a reader needs of a case: the code after its includes, the two expressions marked.
code_of() {
  awk '
    /^#include/ { started = 1; next }
    !started { next }
    /^$/ && !printed { next }
    { printed = 1 }
    /^#ifdef MALUS_FAIL$/ { print "  // does not compile:"; next }
    /^#else$/ { print "  // compiles:"; next }
    /^#endif$/ { next }
    { print }' "$1"
}

# Fails unless the wrong expression does, for the reason that the case expects.
message_of() {
  local reason message
  reason=$(sed -n 's|^// expect: ||p' "$1")
  message=$(compiler_says "$1")
  grep -qF -- "$reason" <<<"$message" || { echo "check_docs: $1: the message is not of $reason" >&2; return 1; }
  printf '%s\n' "$message"
}

compiler_says() {
  (cd "$(dirname "$1")" && "$compiler" -std=c++20 -fsyntax-only -isystem "$root/include" "${extra[@]}" -DMALUS_FAIL \
    "$(basename "$1")" 2>&1) |
    sed -E -e '/^In file included from /d' -e '/^ +from /d' -e 's|^.*/(malus/[^: ]*):[0-9]+:[0-9]+:|\1:|' |
    awk '/^malus\// { header = 1 } header { sub(/^ *[0-9]+ \|/, "      |") } { print }'
}

# The page with its cases as they are now.
with_cases() {
  local page=$1 line name source message skipping=0 in_block=0
  while IFS= read -r line || [[ -n $line ]]; do
    if ((skipping > 0)); then
      if [[ $line == '```'?* ]]; then in_block=1
      elif [[ $line == '```' ]]; then in_block=0; ((skipping -= 1))
      elif ((!in_block)) && [[ -n $line ]]; then
        echo "check_docs: $page: a case's code and message are not followed by one another" >&2
        return 1
      fi
      continue
    fi
    printf '%s\n' "$line"
    if [[ $line =~ ^'<!-- case: '([a-z_0-9]+)' -->'$ ]]; then
      name=${BASH_REMATCH[1]}
      source=$(case_source "$name") || { echo "check_docs: $page: no case is called '$name'" >&2; return 1; }
      message=$(message_of "$source") || return 1
      printf '```cpp\n%s\n```\n\n```text\n%s\n```\n' "$(code_of "$source")" "$message"
      skipping=2
    fi
  done <"$page"
}

extra=("$@")
root=$PWD
is_gcc_12=0
if [[ $("$compiler" -dM -E -x c++ /dev/null) =~ '#define __GNUC__ 12' ]] &&
  [[ $("$compiler" --version) != *clang* ]]; then
  is_gcc_12=1
fi

cases=0 pages=0
for page in README.md docs/*.md; do
  if ((is_gcc_12)); then
    if ! with_cases "$page" >"$work/page.md"; then
      complain "$page: its cases cannot be read"
    elif ! cmp -s "$page" "$work/page.md"; then
      if ((update)); then
        cat "$work/page.md" >"$page"
      else
        diff -u "$page" "$work/page.md" >&2
        complain "$page: a case's code or message is not what it is now (check_docs.sh --update writes them anew)"
      fi
    fi
    ((cases += $(grep -c '^<!-- case: ' "$page")))
  fi
  program_of "$page" >"$work/program.cpp"
  [[ -s $work/program.cpp ]] || continue
  ((pages += 1))
  # Compiled, not only parsed: templates are instantiated.
  if ! "$compiler" "${flags[@]}" -Wall -Wextra -Wconversion -Wshadow -Werror -c "$work/program.cpp" -o "$work/program.o"; then
    complain "$page: its code does not compile"
  elif grep -q '^int main()' "$work/program.cpp"; then
    "$compiler" "$@" "$work/program.o" -o "$work/program" && "$work/program" >/dev/null ||
      complain "$page: its program does not succeed"
  fi
done

if "$compiler" "${flags[@]}" tests/docs/form_tables.cpp -o "$work/form_tables"; then
  while IFS= read -r line; do
    grep -qxF -- "$line" docs/forms.md || complain "docs/forms.md lacks the line: $line"
  done < <("$work/form_tables")
else
  complain "tests/docs/form_tables.cpp does not compile"
fi

named=0
cat tests/{unit,property,renderer}/*.cpp >"$work/tests.txt"
while IFS= read -r name; do
  ((named += 1))
  grep -qF -- "\"$name\"" "$work/tests.txt" || complain "docs/paper.md: no test is called “$name”"
done < <(sed 's/”/\n/g' docs/paper.md | sed -n 's/.*“//p' | sort -u)
while IFS= read -r file; do
  compgen -G "tests/${file%.cpp}.cpp" >/dev/null || complain "docs/paper.md: there is no tests/$file"
done < <(grep -oE '`(unit|property|renderer|static|compile_fail)/[a-z_0-9.]+`' docs/paper.md | tr -d '`' | sort -u)
((named > 0)) || complain "docs/paper.md names no test"

# The right expressions of tests/compile_fail are compiled there.
"$compiler" "${flags[@]}" -fsyntax-only tests/docs/wrong_order.cpp ||
  complain "tests/docs/wrong_order.cpp: the right expression does not compile"

((pages > 0)) || complain "no page has any code"
echo "check_docs: $pages pages with code, $cases cases, $named tests named, $failures failures"
((failures == 0))
