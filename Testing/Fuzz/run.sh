#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# run.sh SECONDS BUILD [labels|meshes]: fuzzes the readers of label files, or of
# mesh files, for that long. Builds the targets in the folder BUILD, where the
# inputs it finds are kept for the next run; one that breaks a promise is left
# there as crash-*, leak-* or timeout-*.
# Returns 77 where Clang or its libFuzzer is missing. MYOTET_JOBS: compilers at once.
set -euo pipefail
here="$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)"
seconds="$1"
build="$2"
what="${3:-labels}"

# libFuzzer is in a package of its own.
target='extern "C" int LLVMFuzzerTestOneInput(const unsigned char*, unsigned long) { return 0; }'
if ! clang++ -x c++ -fsanitize=fuzzer,address,undefined -o /dev/null - <<<"$target" 2>/dev/null; then
  echo "Skipped: the readers are fuzzed with clang++ and libFuzzer, which are not here" \
    "(apt-get install clang libclang-rt-dev)."
  exit 77
fi
generator=()
if command -v ninja >/dev/null; then generator=(-G Ninja); fi
cmake -S "$here" -B "$build" "${generator[@]}" -DCMAKE_BUILD_TYPE=Release \
  -DCMAKE_C_COMPILER=clang -DCMAKE_CXX_COMPILER=clang++ >"$build.log" 2>&1 ||
  { cat "$build.log"; exit 1; }
if [[ $what == meshes ]]; then
  programs=(MeshFilesTarget MakeMeshSeeds)
  seeds=()
else
  programs=(ReadersTarget MakeSeeds)
  seeds=("$here/../../../shared/data/odd_inputs" "$here/../../../shared/data/labels")
fi
cmake --build "$build" -j "${MYOTET_JOBS:-2}" --target "${programs[@]}" >>"$build.log" 2>&1 ||
  { cat "$build.log"; exit 1; }

mkdir -p "$build/$what/found"
cd "$build/$what"
"../${programs[1]}" seeds "${seeds[@]}"
# What a small file may cost: a stream of 100 kB inflates to 100 MB at most, and
# its labels take 4 bytes each. libFuzzer would end with 77, too, when it finds something.
exec "../${programs[0]}" found seeds -max_total_time="$seconds" -max_len=100000 -timeout=30 \
  -rss_limit_mb=3000 -malloc_limit_mb=1500 -print_final_stats=1 -verbosity=0 \
  -error_exitcode=1
