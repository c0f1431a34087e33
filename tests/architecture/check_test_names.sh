#!/bin/sh
# Fails when a test case has a semicolon in its name: CMake cuts the name there, ctest then runs a filter that matches
# nothing, and nothing is not a failure. `check_test_names.sh DIR` looks in another folder.
set -eu
cd "${1:-$(dirname "$0")/..}"
names=$(grep -rhoE --include='*.cpp' '(TEST_CASE|SCENARIO|TEST_CASE_METHOD)\(("([^"\\]|\\.)*")' . || true)
[ -n "$names" ] || { echo "no test cases found: the check is broken"; exit 1; }
if echo "$names" | grep ';'; then
  echo "no semicolons in names of test cases"
  exit 1
fi
