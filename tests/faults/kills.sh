# Kills, after which an output is whole or absent; the run after them removes what they left.

folder=$work/kills
mkdir "$folder"
output=$folder/weave.rf.exr
kills=0

# A fit that takes long enough to keep finished rows, as the other does not.
weft-bake --pattern weave --size 32 --samples 1 -o "$work/large.zip" --quiet >"$work/said"
longFit=(weft-fit "$work/large.zip" --model laf --lobes 10 --quiet)
"${longFit[@]}" -o "$work/large.rf.exr" >"$work/said"

# killNow PROCESS: and not a word of the shell about it.
killNow() {
  kill -KILL "$1" 2>/dev/null
  wait "$1" 2>/dev/null
  kills=$((kills + 1))
}

# goOn WHAT REFERENCE FIT...: the fit goes on to the same bytes as one that was never killed.
goOn() {
  local what=$1 reference=$2
  shift 2
  "$@" -o "$output" --resume >"$work/said" 2>&1
  check "$what: the fit that goes on" cmp -s "$output" "$reference"
  check "$what: nothing is left" [ "$(ls -A "$folder")" = weave.rf.exr ]
  rm -rf "$folder"/* "$folder"/.weft*
}

# killFits THREADS COUNT: at any time.
killFits() {
  local i
  for ((i = 0; i < $2; ++i)); do
    "${fit[@]}" -o "$output" --threads "$1" --resume >"$work/said" 2>&1 &
    sleep "$(below "$fitMs")"
    killNow $!
    check "kill $i of $1 threads: output" wholeOrAbsent "$output" "$work/weave.rf.exr"
    if [[ -e $output || $((i % 5)) = 4 ]]; then
      goOn "kill $i of $1 threads" "$work/weave.rf.exr" "${fit[@]}"
    fi
  done
}

# killLongFits THREADS COUNT: some time after each has kept further rows.
killLongFits() {
  local i rows
  for ((i = 0; i < $2; ++i)); do
    rows=$(compgen -G "$output.parts/*.rows")
    "${longFit[@]}" -o "$output" --threads "$1" --resume >"$work/said" 2>&1 &
    while kill -0 $! 2>/dev/null && [[ $(compgen -G "$output.parts/*.rows") = "$rows" ]]; do sleep 0.05; done
    sleep "$(below 300)"
    killNow $!
    check "kill $i of $1 threads with rows: output" wholeOrAbsent "$output" "$work/large.rf.exr"
    [[ ! -e $output ]] || break
  done
  goOn "kills of $1 threads with rows" "$work/large.rf.exr" "${longFit[@]}"
}

# killRanks COUNT: one process of two dies, and mpirun ends the other.
killRanks() {
  local i ranks
  for ((i = 0; i < $1; ++i)); do
    mpirun --oversubscribe -n 2 "${fit[@]}" -o "$output" --resume >"$work/said" 2>&1 &
    sleep "$(below $((fitMs + 1500)))"
    read -ra ranks <"/proc/$!/task/$!/children" 2>/dev/null
    if [[ ${#ranks[@]} -gt 0 ]]; then kill -KILL "${ranks[RANDOM % ${#ranks[@]}]}" 2>/dev/null; fi
    wait $! 2>/dev/null
    kills=$((kills + 1))
    check "kill $i under MPI: output" wholeOrAbsent "$output" "$work/weave.rf.exr"
    if [[ -e $output || $((i % 5)) = 4 ]]; then goOn "kill $i under MPI" "$work/weave.rf.exr" "${fit[@]}"; fi
  done
}

# killWriting COUNT FILE REFERENCE COMMAND...: as soon as it writes FILE.
killWriting() {
  local count=$1 file=$2 reference=$3 i
  shift 3
  for ((i = 0; i < count; ++i)); do
    "$@" >"$work/said" 2>&1 &
    while kill -0 $! 2>/dev/null && ! isWriting "$folder"; do :; done
    sleep "$(below 40)"
    killNow $!
    check "kill $i in the write of ${file##*/}: output" wholeOrAbsent "$file" "$reference"
    "$@" >"$work/said" 2>&1
    check "kill $i in the write of ${file##*/}: the next run" cmp -s "$file" "$reference"
    check "kill $i in the write of ${file##*/}: nothing is left" nothingLeftIn "$folder"
    rm -f "$file"
  done
}

for threads in 1 2 7; do
  killFits $threads 21
  killLongFits $threads 4
done
if command -v mpirun >/dev/null; then
  killRanks 15
else
  echo "kills under MPI are left out: there is no mpirun"
fi
killWriting 5 "$output" "$work/weave.rf.exr" "${fit[@]}" -o "$output"
killWriting 5 "$folder/tiles.zip" "$work/tiles.zip" \
  weft-bake --pattern tiles --size 2 --samples 1 -o "$folder/tiles.zip" --quiet
echo "kills: $kills kills"
