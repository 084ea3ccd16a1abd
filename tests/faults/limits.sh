# No thread to be had; a full disk under the caches of weft-render.

# crowded THREADS COMMAND...: runs it as a user who may have so many threads, for two minutes at most.
crowded() {
  local threads=$1
  shift
  timeout 120 setpriv --reuid 65534 --clear-groups prlimit --nproc="$threads" \
    env XDG_CACHE_HOME="$crowd" "$@" >"$work/said" 2>&1
}

if isRoot; then
  crowd=$work/crowd
  mkdir "$crowd"
  chmod 755 "$work"
  chown 65534 "$crowd"
  for ((threads = 1; threads <= 10; ++threads)); do
    crowded $threads "${fit[@]}" -o "$crowd/weave.rf.exr" --threads 7
    code=$?
    check "$threads threads: exit code $code" [ $code = 0 -o $code = 2 ]
    check "$threads threads: output" wholeOrAbsent "$crowd/weave.rf.exr" "$work/weave.rf.exr"
    check "$threads threads: nothing is left" nothingLeftIn "$crowd"
    crowded $threads weft-render shape:cloth --size 40x30 -o "$crowd/cloth.png"
    code=$?
    check "$threads threads to draw with: exit code $code" [ $code = 0 -o $code = 2 ]
  done

  for size in 4 500 1400 3000; do
    mount -t tmpfs -o "size=${size}k" weft-faults "$disk"
    XDG_CACHE_HOME=$disk \
      weft-render shape:cloth --env sky --size 40x30 -o "$work/cloth.png" >"$work/said" 2>&1
    code=$?
    check "caches on a disk of $size KiB: exit code $code" [ $code = 0 ]
    umount "$disk"
  done
else
  echo "limits are left out: only root takes away threads and mounts disks"
fi
