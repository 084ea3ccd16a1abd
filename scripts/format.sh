#!/bin/bash
# Formats our sources. With --check: says which are not formatted, or have comments or prose wider than 100
# columns, and fails if there are any.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

folders=(core chunks scenegraph materials loaders fitter programs samples shaders tests)
sources=$(find "${folders[@]}" -name '*.h' -o -name '*.cpp')
if [[ ${1:-} != --check ]]; then
  xargs clang-format -i <<<"$sources"
  exit
fi

# wide FILE...: lines of comments and prose; tables, code and addresses may be wider.
wide() {
  perl -CSDA -ne '
    $code = !$code if /^```/ && $ARGV =~ /\.md$/;
    chomp;
    my $counts = $ARGV =~ /\.md$/ ? !$code && !/^(\||    )/ && !m{https?:}
               : $ARGV =~ /\.(h|cpp)$/ ? m{(^|[^:"])// } || m{^\s*///?( |$)} : 1;
    print "$ARGV:$.\n" if $counts && length > 100;
    if (eof) { close ARGV; $code = 0 }' "$@"
}
too_wide=$(wide $sources $(find "${folders[@]}" cmake docs *.md CMakeLists.txt -name '*.md' -o -name '*.glsl' \
  -o -name '*.frag' -o -name '*.vert' -o -name '*.cmake' -o -name '*.in' -o -name CMakeLists.txt) | sort -u)
if [[ -n $too_wide ]]; then
  printf 'Wider than 100 columns:\n%s\n' "$too_wide" >&2
  exit 1
fi
xargs clang-format --dry-run --Werror --ferror-limit=1 <<<"$sources"
