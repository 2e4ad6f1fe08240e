#!/bin/sh
# Builds base and sea by hand with every compiler, level and machine at hand, runs hash_main, and
# compares its text with expected_hashes.txt. A leg whose compiler, libraries or emulator are missing
# is skipped with a message; a leg that builds and prints anything else fails.
#
# Usage: determinism_matrix.sh SOURCE_ROOT WORK_DIR FILE.cc...   (files relative to SOURCE_ROOT)
# One leg only: ONESEA_MATRIX_LEG=gcc-O3
set -u
root=$1
work=$2
shift 2
cd "$root" || exit 1  # relative paths: a compiler cache then serves every checkout
files="$*"
golden=$root/tests/golden/expected_hashes.txt
# As in common/sea/CMakeLists.txt.
no_sve="-DHWY_DISABLED_TARGETS=(HWY_SVE|HWY_SVE2|HWY_SVE_256|HWY_SVE2_128)"
cache=$(command -v ccache || true)
failed=0
ran=0

# leg NAME COMPILER RUNNER PKG_CONFIG_DIR FLAGS: one column of the matrix.
leg() {
  name=$1 compiler=$2 runner=$3 pkg_dir=$4 flags=$5
  [ -n "${ONESEA_MATRIX_LEG:-}" ] && [ "$ONESEA_MATRIX_LEG" != "$name" ] && return
  for program in ${compiler%% *} $runner; do
    if ! command -v "$program" >/dev/null; then
      echo "SKIP $name: $program is not installed"
      return
    fi
  done
  libraries=$(PKG_CONFIG_LIBDIR=$pkg_dir pkg-config --static --libs \
    absl_status absl_statusor absl_strings libhwy 2>&1) || {
    echo "SKIP $name: libabsl-dev or libhwy-dev is missing for it"
    return
  }
  dir=$work/$name
  mkdir -p "$dir"
  rm -f "$dir"/*.o
  if ! printf '%s\n' $files | xargs -P 2 -I FILE sh -c '
      object=$1/$(echo "$2" | tr / _).o
      $3 $4 -std=c++20 $5 -ffp-contract=off "$6" -I . -c "$2" -o "$object"' \
      - "$dir" FILE "$cache" "$compiler" "$flags" "$no_sve" 2>"$dir/errors"; then
    echo "FAIL $name: does not compile"
    head -20 "$dir/errors"
    failed=1
    return
  fi
  if ! $compiler $flags "$dir"/*.o $libraries -o "$dir/hash_main" 2>"$dir/errors"; then
    echo "FAIL $name: does not link"
    tail -20 "$dir/errors"
    failed=1
    return
  fi
  if ! $runner "$dir/hash_main" >"$dir/hashes.txt"; then
    echo "FAIL $name: hash_main fails"
    failed=1
  elif ! diff "$golden" "$dir/hashes.txt" >"$dir/diff.txt"; then
    echo "FAIL $name: hashes differ, first:"
    head -4 "$dir/diff.txt"
    failed=1
  else
    ran=$((ran + 1))
    echo "PASS $name"
  fi
}

case $(uname -m) in
  x86_64)
    native=/usr/lib/x86_64-linux-gnu/pkgconfig:/usr/share/pkgconfig
    arm=/usr/lib/aarch64-linux-gnu/pkgconfig:/usr/share/pkgconfig
    leg gcc-O0 g++ "" $native "-O0"
    leg gcc-O3 g++ "" $native "-O3 -DNDEBUG"
    leg clang-O0 clang++ "" $native "-O0"
    leg clang-O3 clang++ "" $native "-O3 -DNDEBUG"
    # With fused instructions within reach: what -ffp-contract=off is for.
    if grep -q ' avx2 .*' /proc/cpuinfo && grep -q ' fma ' /proc/cpuinfo; then
      leg gcc-O3-v3 g++ "" $native "-O3 -DNDEBUG -march=x86-64-v3"
    else
      echo "SKIP gcc-O3-v3: this processor has no FMA"
    fi
    leg aarch64-O0 aarch64-linux-gnu-g++ qemu-aarch64 $arm "-O0"
    leg aarch64-O3 aarch64-linux-gnu-g++ qemu-aarch64 $arm "-O3 -DNDEBUG"
    ;;
  *)
    native=$(pkg-config --variable pc_path pkg-config)
    leg gcc-O0 g++ "" "$native" "-O0"
    leg gcc-O3 g++ "" "$native" "-O3 -DNDEBUG"
    leg clang-O3 clang++ "" "$native" "-O3 -DNDEBUG"
    ;;
esac
if [ $failed -eq 0 ] && [ $ran -eq 0 ]; then
  echo "SKIP: no leg could run"
  exit 77
fi
exit $failed
