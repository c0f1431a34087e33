#!/bin/sh
# Fails when a file includes a room to its right in the order below, or when a library that only one room may see leaks.
set -eu
cd "$(dirname "$0")/../.."
rooms="geometry model threads kernels neighbors physics ode integrate measure setup io replay render view export simulate converge sweep apps"

rank() {
  position=0
  for room in $rooms; do
    position=$((position + 1))
    [ "$room" = "$1" ] && echo "$position" && return
  done
  echo 0 # errors.hpp, version.hpp: usable by all
}

failed=0
checked=0
for file in $(find include/suture src -name '*.hpp' -o -name '*.cpp' -o -name '*.inl' | sort); do
  path=${file#include/suture/}
  path=${path#src/}
  own=$(rank "${path%%/*}")
  for include in $(sed -n 's/^#include "\(suture\/\)\{0,1\}\([a-z_]*\)\/.*"/\2/p' "$file" | sort -u); do
    checked=$((checked + 1))
    other=$(rank "$include")
    if [ "$own" -gt 0 ] && [ "$other" -gt "$own" ]; then
      echo "$file includes $include, which comes after ${path%%/*}"
      failed=1
    fi
  done
done

only_in() { # PATTERN ALLOWED-PATH-PATTERN
  for file in $(grep -rlE "#include <$1" include src | grep -vE "$2" || true); do
    echo "$file includes <$1...>, which only $2 may"
    failed=1
  done
}
only_in '(cvode|arkode|sundials|sunnonlinsol|nvector)' '^src/integrate/(cvode_[a-z]+|adams_integrator|arkode_integrator|sundials_problem|fused_nvector)'
only_in 'hdf5' '^src/io/hdf5_(calls|datasets|file)\.'
only_in 'toml\+\+' '^src/io/(config_document|sweep_file)\.cpp'
only_in 'cairo' '^src/render/'
only_in 'zlib' '^src/view/packed_numbers\.cpp'

[ "$checked" -gt 50 ] || { echo "only $checked includes looked at: the check is broken"; exit 1; }
exit $failed
