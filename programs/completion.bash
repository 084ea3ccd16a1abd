# Completes options of Weft's programs, their choices, and names of files. Installed under the name of
# each program, which it asks: `weft-fit --help` knows.
_weft() {
  local current=${COMP_WORDS[COMP_CWORD]} previous=${COMP_WORDS[COMP_CWORD - 1]} help choices=
  help=$("$1" --help 2>/dev/null)
  # "  --filter TEXT:{nearest,bilinear}=bilinear"
  [[ $previous == -* ]] &&
    choices=$(sed -nE "s/^  (.*,)?$previous [A-Z]+:\{([^}]*)\}.*/\2/p" <<<"$help" | tr , ' ')
  if [[ -n $choices ]]; then
    mapfile -t COMPREPLY < <(compgen -W "$choices" -- "$current")
  elif [[ $current == -* ]]; then
    mapfile -t COMPREPLY < <(compgen -W "$(sed -nE 's/^  (-[a-z],)?(--?[a-z-]+).*/\2/p' <<<"$help")" -- "$current")
  else
    compopt -o filenames 2>/dev/null
    mapfile -t COMPREPLY < <(compgen -f -- "$current")
  fi
}
complete -F _weft "${BASH_SOURCE[0]##*/}"
