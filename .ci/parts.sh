# shellcheck shell=bash
# The parts of a run of continuous integration; .ci/run sources this file. Its argument is the folder of the parts' output.
logs=$1 rows=() failed=()
mkdir -p "$logs"

# Processor seconds of the finished parts.
processor_s() {
    local fields
    read -ra fields <"/proc/$$/stat"
    echo $(((fields[15] + fields[16]) / $(getconf CLK_TCK)))
}

# Runs a part, unless minute LATEST-BEGIN of the run has come. A part that still runs at minute END is stopped. Both are failures,
# unless may_lack_time is set.
part() { # NAME LATEST-BEGIN END COMMAND...
    local name=$1 latest=$2 end=$3 begun=$SECONDS begun_s result=passed status=0
    shift 3
    begun_s=$(processor_s)
    if ((SECONDS >= 60 * latest)); then
        result="left out: it would begin at minute $((SECONDS / 60)); run $* by hand"
        echo "$result" >"$logs/$name.log"
    else
        timeout $((SECONDS < 60 * end ? 60 * end - SECONDS : 1)) "$@" 2>&1 | tee "$logs/$name.log" || status=$?
        if ((status != 0)); then
            result=FAILED
            ((SECONDS < 60 * end)) || result="ended at minute $end; run $* by hand"
        fi
    fi
    [[ $result == passed || ($result != FAILED && -n ${may_lack_time-}) ]] || failed+=("$name")
    rows+=("$(printf '%-14s %5d s %6d s   %s' "$name" $((SECONDS - begun)) $(($(processor_s) - begun_s)) "$result")")
}

# Prints the table and then, in at most ten lines, each part that failed with its log's path and the words of its tests.
# Returns 1 if a part failed.
summary() {
    printf '\n== part            wall  processor\n'
    printf '   %s\n' "${rows[@]}"
    local name words
    for name in ${failed[@]+"${failed[@]}"}; do
        words=$((10 / ${#failed[@]} - 1))
        printf '== %s failed; its whole output is in %s\n' "$name" "$logs/$name.log"
        "$(dirname "${BASH_SOURCE[0]}")/why_failed" "$logs/$name.log" $((words > 0 ? words : 0))
    done
    ((${#failed[@]} == 0))
}
