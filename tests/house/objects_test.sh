#!/bin/sh
# Refuses libraries that call functions of the C library whose last bits follow the processor. usage: objects_test.sh LIBRARIES...
set -u

# With f and l for other widths. What rounds exactly (sqrt, fma, fmod, floor, ldexp ...) is the same everywhere.
inexact='a?(sin|cos|tan)h?|atan2|sincos|exp(2|10|m1)?|log(2|10|1p|b)?|pow|cbrt|hypot|[lt]gamma|erfc?|j[01n]|y[01n]|c?(exp|log|pow|sin|cos)'
calls='^(.*:)? *U (__)?('$inexact')[fl]?(_finite)?(@.*)?$'

# The check itself, on planted lines.
for line in '                 U sin' 'a.o:  U __exp_finite' '                 U atan2@GLIBC_2.2.5' 'U powf' 'x.cpp.o: U hypot'; do
  printf '%s\n' "$line" | grep -Eq "$calls" || { echo "objects_test: passes over \`$line\`" >&2; exit 1; }
done
for line in '                 U sqrt' 'U floor' 'U _ZN2bl11mathematics4sineEd' 'U Sleef_cinz_sind1_u10purec' '0000 T sin' 'U fmod' 'U cosine'; do
  printf '%s\n' "$line" | grep -Eq "$calls" && { echo "objects_test: refuses \`$line\`" >&2; exit 1; }
done

[ $# -gt 0 ] || { echo 'objects_test: no library to look at' >&2; exit 2; }
failures=0
for library in "$@"; do
  names=$(nm --undefined-only --print-file-name "$library") || { echo "objects_test: nm cannot read $library" >&2; exit 1; }
  found=$(printf '%s\n' "$names" | grep -E "$calls")
  [ -z "$found" ] && continue
  echo "$found: take core/base/mathematics.h" >&2
  failures=$((failures + 1))
done
[ $failures -eq 0 ] && echo "$# libraries call nothing of the kind"
exit $((failures > 0))
