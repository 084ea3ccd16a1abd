# Standard streams that are closed, full or broken, and outputs that are no files.

results=(
  "weft-info $work/weave.zip"
  "weft-info $work/weave.zip --json -"
  "weft-eval $work/weave.rf.exr --against $work/weave.zip --quiet"
  "${fit[*]} -o $work/streams.rf.exr"
  "weft-bake --pattern tiles --size 1 --samples 1 --quiet -o $work/streams.zip"
  "weft-render shape:plane --size 8 -o $work/streams.png --json -"
  "weft-compare --help"
)
for words in "${results[@]}"; do
  read -ra command <<<"$words"
  "${command[@]}" >&- 2>"$work/said"
  check "stdout closed: $words" [ $? = 2 ]
  "${command[@]}" >/dev/full 2>"$work/said"
  check "stdout full: $words" [ $? = 2 ]
  { sleep 0.1; "${command[@]}" 2>"$work/said"; echo $? >"$work/code"; } | :
  check "stdout broken: $words" [ "$(cat "$work/code")" = 2 ]
  "${command[@]}" <&- >"$work/said" 2>&-
  check "stdin and stderr closed: $words" [ $? = 0 ]
done
for name in info bake fit eval compare render; do
  command=("weft-$name" --no-such-option)
  for redirection in "2>&-" "2>/dev/full" ">&- 2>&-" "<&- >&- 2>&-"; do
    (eval '"${command[@]}"' "$redirection") >"$work/said" 2>&1
    check "a message into $redirection of weft-$name" [ $? = 1 ]
  done
done
weft-info "$work/absent.zip" 2>&-
check "bad input with stderr closed" [ $? = 2 ]
# Messages must not get into what is opened in the place of a closed stream.
weft-info "$work/weave.zip" --json "$work/report.json" >&- 2>&-
check "a report with all streams closed" grep -q '"views": 81' "$work/report.json"

fifo=$work/page.html
mkfifo "$fifo"
cat "$fifo" >"$work/read" &
weft-eval "$work/weave.rf.exr" --against "$work/weave.zip" --quiet --report "$fifo" >"$work/said"
check "a page into a pipe" [ $? = 0 ]
wait $!
check "a page into a pipe is whole" grep -q '</html>' "$work/read"
check "the pipe is still there" [ -p "$fifo" ]
for output in /dev/stdout /dev/fd/1 -; do
  check "a report into $output" grep -q '"views"' <(weft-info "$work/weave.zip" --json $output)
done
weft-info "$work/weave.zip" --json /dev/null >"$work/said"
check "a report into /dev/null" [ $? = 0 ]
check "/dev/null is a device" [ -c /dev/null ]
weft-info "$work/weave.zip" --json /dev/full >"$work/said" 2>&1
check "a report into /dev/full" [ $? = 2 ]
cp "$work/weave.zip" "$work/before.zip"
for option in --json --report -o; do
  weft-eval "$work/weave.rf.exr" --against "$work/weave.zip" --image 0 0 0 0 -o "$work/image.exr" $option \
    "$work/weave.zip" >"$work/said" 2>&1
  check "$option onto an input is refused" [ $? != 0 ]
done
check "inputs stay" cmp -s "$work/weave.zip" "$work/before.zip"
