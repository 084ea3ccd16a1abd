# Every signal in the middle of a write: an output is whole or absent, and nothing stays.

folder=$work/signals
mkdir "$folder"
output=$folder/tiles.zip
bake=(weft-bake --pattern tiles --size 4 --samples 1 --quiet)
"${bake[@]}" -o "$work/whole.zip" >"$work/said"

# bakeUntil SIGNAL COMMAND...: sends it while the zip is written; the exit code is in $code.
bakeUntil() {
  local signal=$1
  shift
  "$@" "${bake[@]}" -o "$output" >"$work/said" 2>&1 &
  while kill -0 $! 2>/dev/null && ! isWriting "$folder"; do :; done
  kill -s "$signal" $! 2>/dev/null
  case $signal in STOP | TSTP | TTIN | TTOU)
    sleep 0.3
    kill -s CONT $!
    ;;
  esac
  wait $! 2>/dev/null
  code=$?
}

for number in $(seq 1 31) 34 64; do
  signal=$(kill -l "$number")
  signal=${signal#SIG}
  # A shell hides some signals from what runs in its background.
  bakeUntil "$signal" env --default-signal
  check "$signal: output" wholeOrAbsent "$output" "$work/whole.zip"
  case $signal in
  HUP | INT | QUIT | TERM | XCPU | USR1 | USR2)
    check "$signal: ended by it, not with $code" [ $code = $((128 + number)) ]
    check "$signal: nothing is left" [ -z "$(ls -A "$folder")" ]
    ;;
  PIPE | XFSZ | CHLD | CONT | URG | WINCH | STOP | TSTP | TTIN | TTOU)
    check "$signal: goes on, not with $code" [ $code = 0 ]
    ;;
  *)
    check "$signal: ended by it, not with $code" [ $code = $((128 + number)) ]
    ;;
  esac
  "${bake[@]}" -o "$output" >"$work/said" 2>&1
  check "$signal: the next run" cmp -s "$output" "$work/whole.zip"
  check "$signal: the next run leaves nothing" [ "$(ls -A "$folder")" = tiles.zip ]
  rm "$output"
done

for signal in HUP INT; do # as under nohup, and in the background of a script
  bakeUntil $signal env --default-signal --ignore-signal=$signal
  check "ignored $signal: goes on" [ $code = 0 ]
done
rm -rf "$folder"

if command -v mpirun >/dev/null; then
  mkdir "$folder"
  for ((i = 0; i < 10; ++i)); do
    mpirun --oversubscribe -n 2 "${fit[@]}" -o "$folder/weave.rf.exr" >"$work/said" 2>&1 &
    sleep "$(below $((fitMs + 1500)))"
    kill -TERM $! 2>/dev/null
    wait $! 2>/dev/null
    check "TERM $i under MPI: output" wholeOrAbsent "$folder/weave.rf.exr" "$work/weave.rf.exr"
    check "TERM $i under MPI: no temporaries" [ -z "$(find "$folder" -name '.weft*')" ]
    rm -rf "${folder:?}"/*
  done
fi
