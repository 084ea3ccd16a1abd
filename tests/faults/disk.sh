# A disk that is full at every step of every output: exit 2, one message, and what was there before stays.

# checkFull WHAT NAME COMMAND...: where the command cannot write $disk/NAME whole.
checkFull() {
  local what=$1 name=$2 message code
  shift 2
  echo old >"$disk/$name"
  message=$("$@" 2>&1 >/dev/null)
  code=$?
  check "$what: exit code $code" [ $code = 2 ]
  check "$what: one message, not '$message'" [ "$(wc -l <<<"$message")" = 1 ]
  check "$what: what was there stays" [ "$(cat "$disk/$name")" = old ]
  check "$what: nothing is left" [ "$(ls -A "$disk")" = "$name" ]
}

# withLimit KIB COMMAND...: runs it so that no file may be larger.
withLimit() {
  (ulimit -f "$1" && shift && exec "$@")
}

# fill NAME ENOUGH STEP COMMAND...: the command writes $disk/NAME, for which ENOUGH KiB are enough.
fill() {
  local name=$1 enough=$2 step=$3 size
  shift 3
  for ((size = 0; size < enough; size += step)); do
    checkFull "$name of at most $size KiB" "$name" withLimit "$size" "$@"
    rm -rf "${disk:?}"/* "$disk"/.weft*
  done
  isRoot || return
  for ((size = 4; size < enough + 4; size += step < 4 ? 4 : step)); do # what is old has a page of its own
    mount -t tmpfs -o "size=${size}k" weft-faults "$disk"
    checkFull "$name on a disk of $size KiB" "$name" "$@"
    umount "$disk"
  done
}

isRoot || echo "full disks are left out: only root mounts them"
fill report.json 1 1 weft-info "$work/weave.zip" --json "$disk/report.json"
fill field.rf.exr 16 2 "${fit[@]}" -o "$disk/field.rf.exr"
fill page.html 8 1 \
  weft-eval "$work/weave.rf.exr" --against "$work/weave.zip" --report "$disk/page.html" --quiet
fill image.exr 2 1 weft-eval "$work/weave.rf.exr" --image 30 0 30 90 -o "$disk/image.exr"
fill tiles.zip 5500 500 weft-bake --pattern tiles --size 2 --samples 1 -o "$disk/tiles.zip" --quiet
fill cloth.png 10 2 weft-render shape:cloth --size 200x200 -o "$disk/cloth.png"
fill cloth.exr 48 8 weft-render shape:cloth --size 200x200 -o "$disk/cloth.exr"

if isRoot; then # a folder of outputs, some of which may be there already
  for size in 8 40 100; do
    mount -t tmpfs -o "size=${size}k" weft-faults "$disk"
    message=$(weft-compare "$work/tiles.zip" --models rfp --quiet -o "$disk/tiles" 2>&1 >/dev/null)
    code=$?
    check "a comparison on a disk of $size KiB: exit code $code" [ $code = 2 ]
    check "a comparison on a disk of $size KiB: one message, not '$message'" [ "$(wc -l <<<"$message")" = 1 ]
    check "a comparison on a disk of $size KiB: no temporaries" [ -z "$(find "$disk" -name '.weft*')" ]
    umount "$disk"
  done
fi
