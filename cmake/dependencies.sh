# SPDX-License-Identifier: MIT
#
# Sourced by examples/run.sh and tests/run.sh. `require_dependencies NAME...` sees to it that the named tools and
# libraries are here: with apt-get it installs those that are missing and nothing else; without, it names them and exits
# with status 2. MALUS_NO_INSTALL=1 takes everything for granted.

# What to look for (command:NAME|NAME, header:PATH|PATH or file:PATH|PATH, one of which will do) and Debian's package for it.
dependency() {
  case $1 in
    compiler) echo "command:c++ g++" ;;
    cmake) echo "command:cmake cmake" ;;
    ninja) echo "command:ninja ninja-build" ;;
    pkg-config) echo "command:pkg-config pkgconf" ;;
    glm) echo "header:glm/glm.hpp libglm-dev" ;;
    embree) echo "header:embree4/rtcore.h|embree3/rtcore.h libembree-dev" ;;
    openexr) echo "header:OpenEXR/ImfHeader.h libopenexr-dev" ;;
    tbb) echo "header:tbb/parallel_for.h libtbb-dev" ;;
    pugixml) echo "header:pugixml.hpp libpugixml-dev" ;;
    cli11) echo "header:CLI/CLI.hpp libcli11-dev" ;;
    json) echo "header:nlohmann/json.hpp nlohmann-json3-dev" ;;
    tinyobjloader) echo "header:tiny_obj_loader.h libtinyobjloader-dev" ;;
    png) echo "header:png.h libpng-dev" ;;
    stb) echo "header:stb/stb_image.h|stb_image.h libstb-dev" ;;
    doctest) echo "header:doctest/doctest.h doctest-dev" ;;
    rapidcheck) echo "header:rapidcheck.h librapidcheck-dev" ;;
    benchmark) echo "header:benchmark/benchmark.h libbenchmark-dev" ;;
    clang) echo "command:clang++-16 clang-16" ;;
    clang-fuzzer) echo "file:/usr/lib/llvm-16/lib/clang/16/lib/linux/libclang_rt.fuzzer-$(uname -m).a libclang-rt-16-dev" ;;
    clang-tidy) echo "command:clang-tidy-16 clang-tidy-16" ;;
    clang-format) echo "command:clang-format-16 clang-format-16" ;;
    valgrind) echo "command:valgrind valgrind" ;;
    *) echo "dependencies.sh: nothing is known of '$1'" >&2; exit 2 ;;
  esac
}

# is_present KIND:ALTERNATIVES
is_present() {
  local kind=${1%%:*} alternative
  local -a alternatives
  IFS='|' read -r -a alternatives <<<"${1#*:}"
  for alternative in "${alternatives[@]}"; do
    if [[ $kind == command ]]; then
      command -v "$alternative" >/dev/null && return 0
    elif [[ $kind == file ]]; then
      [[ -e $alternative ]] && return 0
    else
      printf '#if !__has_include(<%s>)\n#error\n#endif\n' "$alternative" | "${CXX:-c++}" -E -x c++ - >/dev/null 2>&1 &&
        return 0
    fi
  done
  return 1
}

# Leaves the missing ones in missing_packages and missing_probes.
find_missing() {
  local name probe package
  missing_packages=() missing_probes=()
  for name in "$@"; do
    read -r probe package <<<"$(dependency "$name")"
    is_present "$probe" || { missing_packages+=("$package"); missing_probes+=("${probe//|/ or }"); }
  done
}

require_dependencies() {
  [[ ${MALUS_NO_INSTALL:-} == 1 ]] && return
  find_missing "$@"
  ((${#missing_packages[@]} == 0)) && return

  local -a as_root=()
  if ((EUID != 0)); then
    command -v sudo >/dev/null && as_root=(sudo) || as_root=(false)
  fi
  if command -v apt-get >/dev/null && [[ ${as_root[0]:-} != false ]]; then
    echo "Installing ${missing_packages[*]}"
    local -a apt=("${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get -qq -o Dpkg::Use-Pty=0)
    local log
    log=$(mktemp)
    # The lists on a machine may be empty, or older than what the mirror holds.
    if ! "${apt[@]}" install -y --no-install-recommends "${missing_packages[@]}" >"$log" 2>&1 </dev/null; then
      "${apt[@]}" update </dev/null || true
      "${apt[@]}" install -y --no-install-recommends "${missing_packages[@]}" >"$log" 2>&1 </dev/null || cat "$log" >&2
    fi
    rm -f "$log"
    hash -r
    find_missing "$@"
    ((${#missing_packages[@]} == 0)) && return
  fi

  {
    echo "These are missing and could not be installed:"
    local i
    for i in "${!missing_probes[@]}"; do
      echo "  ${missing_probes[i]/:/ }   (Debian package ${missing_packages[i]})"
    done
    echo "Install them and call this again, or set MALUS_NO_INSTALL=1 if they are where only CMake finds them."
  } >&2
  exit 2
}
