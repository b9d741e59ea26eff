# The whole test run and the fuzzers, in steps; `bl` reads this file for `./bl test` and `./bl fuzz`.
# shellcheck shell=sh
# shellcheck disable=SC2154

# What the thread sanitizer is run on, as a filter of test names: what starts threads. More laws run on several threads, but start no
# others than these, and take a quarter of an hour under it.
tsan_tests='*hread*:*arallel*:*nalys*:TickTimes*:Host*:LiveSession*:Writer*:Mqtt*:Osc*:Past.*:RestTest*:Pace*:RivalLaws*-LargeLaws*'
tsan_programs='base_tests geometry_tests graph_tests script_tests session_tests live_tests host_tests laws_tests journal_tests'
short_fuzzing=12    # seconds for each fuzzer within ./bl test --deep

passed=0
failed=0

heading() { printf '\n== %s\n' "$*"; step_began=$(date +%s); }
step_time() { printf -- '-- %s: %s s\n' "$1" $(($(date +%s) - step_began)); }

# attribute NAME FILE: a number of the first element of a JUnit file.
attribute() { sed -n "s/^[[:space:]]*$1=\"\([0-9]*\)\".*/\1/p; /<testcase/q" "$2" | head -n 1; }

# in_shards FILE: of the test programs that ran in shards, from the log of ctest: how many tests PASSED, how many FAILED, and how many
# shards failed. A shard that ends without its sum has crashed, and counts as one failed test.
in_shards() {
  awk 'function close_shard() { if (shard && !is_whole && !bad) bad = 1
      if (shard) { passed += good; failed += bad; if (bad) broken++ }
      shard = good = bad = is_whole = 0 }
    /^Command: / { close_shard(); shard = /_tests/ && !/--gtest_filter/ }
    shard && $4 ~ /^[0-9]+$/ && $5 ~ /^tests?[.,]/ { if (/^\[  PASSED  \] /) { good = $4; is_whole = 1 } else if (/^\[  FAILED  \] /) bad = $4 }
    shard && /^Test Failed\.$/ && !bad { bad = 1 }
    END { close_shard(); print passed + 0, failed + 0, broken + 0 }' "$1"
}

# run_ctest PRESET ARGUMENTS...: runs the tests of a build and adds to $passed and $failed.
run_ctest() {
  preset=$1
  shift
  junit=$root/build/$preset/junit.xml
  rm -f "$junit"
  # shellcheck disable=SC2086
  ${build_prefix:-} ctest --test-dir "$root/build/$preset" -j "$(nproc)" --output-on-failure --no-tests=error \
    --output-junit "$junit" "$@" </dev/null
  code=$?
  tests=0 bad=0 idle=0
  if [ -f "$junit" ]; then
    tests=$(attribute tests "$junit") bad=$(attribute failures "$junit")
    idle=$(($(attribute disabled "$junit") + $(attribute skipped "$junit")))
  fi
  # A program in shards is a few tests to ctest; what counts are the tests inside.
  shards=$(grep -c '<testcase name="[a-z_]*_tests/shard_' "$junit" 2>/dev/null)
  if [ "${shards:-0}" -gt 0 ]; then
    # shellcheck disable=SC2046
    set -- $(in_shards "$root/build/$preset/Testing/Temporary/LastTest.log")
    tests=$((tests - shards + $1 + $2))
    bad=$((bad > $3 ? bad - $3 + $2 : $2))
  fi
  passed=$((passed + ${tests:-0} - ${bad:-0} - idle))
  # A ctest that fails without a failed test (none found, a program missing) is a failure all the same.
  [ "$code" -ne 0 ] && [ "${bad:-0}" -eq 0 ] && bad=1
  failed=$((failed + bad))
  return "$code"
}

# checked PRESET CTEST ARGUMENTS...: builds a preset ($programs of it, or all) and runs its tests; a build that fails counts as one
# failed test.
checked() {
  # shellcheck disable=SC2086
  if build "$1" ON ${programs:-}; then run_ctest "$@"; else failed=$((failed + 1)); fi
}

# The programs that the fuzz build makes, as paths inside its folder.
fuzzer_list() {
  ninja -C "$root/build/fuzz" -t targets all | sed -n 's/^\([^ :]*_fuzzer\): CXX_EXECUTABLE_LINKER.*/\1/p'
}

# fill_corpus NAME: what a fuzzer begins with.
fill_corpus() {
  name=$1 corpus=$root/build/fuzz/corpus/$1 finds=$root/build/fuzz/finds
  mkdir -p "$corpus" "$finds"
  case $name in
    *scene*)
      find "$root/scenes" -name '*.json' | while IFS= read -r scene; do
        cp -- "$scene" "$corpus/$(printf '%s' "${scene#"$root/scenes/"}" | tr / -)"
      done
      ;;
    case)    # the first byte says what the rest is: a fit as JSON, a fit as a table with a boundary
      printf '1{"boundary": {"plan": [[0,0],[9,0],[9,9],[0,9]], "holes": [], "bottom": 0, "top": 9}, "sites": [[1,2,3],[4,5,6]], "weights": [1,0], "demands": [{"min": 1, "max": 2}, {"floor_area": 3, "storey_height": 3}], "groups": [[0],[1]], "locked": []}' >"$corpus/fit"
      printf '0{"cases": [{"boundary": {"planes": [[-1,0,0,0],[0,-1,0,0],[0,0,-1,0],[1,1,1,9]]}, "sites": [[1,2,3]], "weights": [1e1]}]}' >"$corpus/cells"
      printf '7x,y,z,weight,demand,demand_min,demand_max,group,name\n1,2,3,4,5,,,a,b\n2;3\n' >"$corpus/table"
      ;;
    frame)
      printf '%s\n' '{"t":"op","id":1,"c":{"command":"set_port","arguments":{"node":"a","port":"smart_volume.demand","value":5}}}' \
        '{"t":"room","id":1,"e":{"event":"define_area","arguments":{"area":"n","nodes":{"ids":["a"]}}}}' \
        '{"t":"room","id":1,"e":{"event":"comment","arguments":{"id":"c","text":"x"}}}' '{"t":"room","id":1,"e":{"event":"open_vote","arguments":{"vote":"poll"}}}' \
        '{"t":"op","id":1,"c":{"command":"cast_vote","arguments":{"node":"poll","voter":"seat 2","ballot":"yes"}}}' \
        '{"t":"draft","id":1,"do":"begin","draft":"d"}' '{"t":"undo","id":1}' '{"t":"op","id":1,"draft":"d","c":{"command":"remove_node","arguments":{"id":"b"}}}' \
        '{"t":"room","id":1,"e":{"event":"propose","arguments":{"draft":"d"}}}' '{"t":"rewind","id":1,"to":2}' '{"t":"redo","id":1}' \
        '{"t":"op","id":1,"c":{"command":"batch","arguments":{"commands":[{"command":"rename_node","arguments":{"id":"a","name":"A"}}]}}}' >"$corpus/session"
      number=0
      while IFS= read -r frame; do
        number=$((number + 1))
        printf '%s\n' "$frame" >"$corpus/frame$number"
      done <"$corpus/session"
      ;;
    message)
      number=0
      for frame in '{"t":"hello","room":"BCDF","run":"r","kind":"page","views":["plan"],"unacked":0,"have":3,"token":"aa"}' '{"t":"op","id":1,"c":{"command":"rename_node","arguments":{"id":"a","name":"A"}},"conditions":[{"key":"nodes/a/name","was":"B"}],"draft":"d","gesture":2}' \
        '{"t":"room","id":1,"e":{"event":"mark","arguments":{"text":"x"}}}' '{"t":"undo","id":1,"gesture":2,"of":3}' '{"t":"redo","id":1,"gesture":2}' '{"t":"rewind","id":1,"to":2}' '{"t":"draft","id":1,"do":"begin","draft":"d","title":"T"}' \
        '{"t":"want","views":["plan","votes"],"drafts":["d"]}' '{"t":"seen","s":3,"lag":5}' '{"t":"ping","n":1}' '{"t":"presence","n":1,"cursor":[1,2,3],"holds":["a"],"hidden":true}' '{"t":"resync","k":4,"have":2,"expected":"0f","found":"1f","why":"hash"}'; do
        number=$((number + 1))
        printf '%s' "$frame" >"$corpus/message$number"
      done
      ;;
    osm)
      printf '<osm version="0.6"><node id="1" lat="60" lon="25"/><node id="2" lat="60" lon="25.001"/><node id="3" lat="60.001" lon="25.001"/><way id="1"><nd ref="1"/><nd ref="2"/><nd ref="3"/><nd ref="1"/><tag k="building" v="yes"/><tag k="height" v="12,5 m"/></way><way id="2"><nd ref="1"/><nd ref="3"/><tag k="highway" v="primary"/><tag k="oneway" v="-1"/></way><relation id="3"><member type="way" ref="1" role="outer"/><tag k="type" v="multipolygon"/><tag k="building" v="yes"/></relation></osm>' >"$corpus/xml"
      ;;
    cityjson)
      printf '{"type":"CityJSON","version":"2.0","vertices":[[0,0,0],[9,0,0],[9,9,0],[0,9,0],[0,0,5],[9,0,5],[9,9,5],[0,9,5]],"CityObjects":{"a":{"type":"Building","attributes":{"measuredHeight":5},"geometry":[{"type":"Solid","lod":"1.2","boundaries":[[[[0,3,2,1]],[[4,5,6,7]],[[0,1,5,4]],[[1,2,6,5]],[[2,3,7,6]],[[3,0,4,7]]]]}]}}}' >"$corpus/solid"
      ;;
    geojson)
      printf '{"type":"FeatureCollection","features":[{"type":"Feature","properties":{"height":"12","use":"shop"},"geometry":{"type":"Polygon","coordinates":[[[0,0],[9,0],[9,9],[0,9],[0,0]],[[2,2],[4,2],[4,4],[2,2]]]}},{"type":"Feature","properties":{"highway":"primary"},"geometry":{"type":"LineString","coordinates":[[0,0],[5,5]]}},{"type":"Feature","properties":{"v":1},"geometry":{"type":"Point","coordinates":[1,2]}}]}' >"$corpus/features"
      ;;
  esac
}

# run_fuzzer FUZZER SECONDS: runs one, and says what it found; fails when that is something.
run_fuzzer() {
  name=$(basename "$1" _fuzzer)
  corpus=$root/build/fuzz/corpus/$name finds=$root/build/fuzz/finds log=$logs/fuzz-$name.log
  if "$root/build/fuzz/$1" -max_total_time="$2" -timeout=25 -rss_limit_mb=4096 -print_final_stats=1 \
    -artifact_prefix="$finds/$name-" "$corpus" >"$log" 2>&1 </dev/null; then
    printf '%s: %s inputs in %s s, no find\n' "$name" \
      "$(sed -n 's/^stat::number_of_executed_units: *//p' "$log")" "$2"
  else
    grep -E 'ERROR: |SUMMARY: |runtime error: |Test unit written' "$log" | head -n 8
    printf '%s: FOUND something; input in %s, the whole story: %s\n' "$name" "$finds" "$log"
    return 1
  fi
}

# wait_for_fuzzers: waits for those that run ($waiting, NAME:PROCESS each), prints what they said and counts the $broken.
wait_for_fuzzers() {
  for one in $waiting; do
    wait "${one#*:}" || broken=$((broken + 1))
    cat "$logs/fuzz-${one%%:*}.said"
  done
  running=0 waiting=''
}

# run_fuzzers SECONDS: builds and runs every fuzzer; fails when one does.
run_fuzzers() {
  case $1 in '' | *[!0-9]*) fail "fuzz takes a whole number of seconds, not \`$1\`." ;; esac
  configure fuzz ON OFF || return 1
  fuzzers=$(fuzzer_list)
  [ -n "$fuzzers" ] || { say 'bl: there are no fuzzers yet.'; return 0; }
  # shellcheck disable=SC2086
  build_window=OFF
  build fuzz ON $fuzzers || return 1
  broken=0 running=0 waiting=''
  for fuzzer in $fuzzers; do
    name=$(basename "$fuzzer" _fuzzer)
    fill_corpus "$name"
    run_fuzzer "$fuzzer" "$1" >"$logs/fuzz-$name.said" 2>&1 &
    waiting="$waiting $name:$!" running=$((running + 1))
    # Two at a time where there are two cores; more would want more memory than small machines have.
    [ "$running" -lt 2 ] && [ "$(nproc)" -gt 1 ] || wait_for_fuzzers
  done
  wait_for_fuzzers
  [ "$broken" -eq 0 ]
}

# run_suite [--deep | CTEST ARGUMENTS...]: the release build and its tests; --deep adds sanitizers and fuzzing. Nothing that fails is
# passed over, and the last line says the sum.
run_suite() {
  deep=no
  [ "${1:-}" = --deep ] && { deep=yes; shift; }
  heading 'Release'
  checked release "$@"
  step_time 'Release'
  if [ "$deep" = yes ]; then
    heading 'Address and undefined behaviour sanitizers'
    ASAN_OPTIONS=detect_leaks=1:strict_string_checks=1:malloc_context_size=10 UBSAN_OPTIONS=halt_on_error=1:print_stacktrace=1
    export ASAN_OPTIONS UBSAN_OPTIONS
    # With what the fuzzers need besides, so that one build serves both: compiling is most of the time. The window is left out: its
    # drawing is half of all code, and the sanitizers have found nothing in it for long.
    build_window=OFF
    checked fuzz
    step_time 'Sanitizers'

    heading 'Thread sanitizer'
    # With much address randomisation the thread sanitizer of this compiler does not start; nor would the tests be listed.
    build_prefix=
    [ "$(cat /proc/sys/vm/mmap_rnd_bits 2>/dev/null || echo 0)" -gt 28 ] && setarch -R true 2>/dev/null &&
      build_prefix='setarch -R'
    TSAN_OPTIONS=halt_on_error=1:second_deadlock_stack=1:suppressions=\'$root/tests/house/thread_sanitizer.supp\'
    export TSAN_OPTIONS
    programs=$tsan_programs
    GTEST_FILTER=$tsan_tests
    export GTEST_FILTER
    checked tsan -R "^($(echo "$tsan_programs" | tr ' ' '|'))/"
    unset GTEST_FILTER
    programs='' build_window='' build_prefix=''
    step_time 'Thread sanitizer'

    heading "Fuzzers, $short_fuzzing s each"
    run_fuzzers "$short_fuzzing" || failed=$((failed + 1))
    step_time 'Fuzzers'
  fi
  printf '\n%s passed, %s failed\n' "$passed" "$failed"
  [ "$failed" -eq 0 ]
}
