#!/usr/bin/env bash
# Writes what the program prints into the pages that show it: README.md and docs/src/*.md.
#
#   cargo build --release && docs/refresh-outputs.sh [PAGE...]
#
# SLIDEWAY=path runs another binary. Two kinds of code blocks are rewritten; every viewer hides what stands behind the
# language:
#
#   ```console exit=1                 begins with a command, `$ slideway ...`; what it prints follows. It must end with
#                                     this exit code (0 if none is given), or the script stops.
#   ```console answer                 shows the second paragraph of what is printed, which has the answer, and `...` for the others;
#   ```console answer=2               the first two lines of the answer;
#   ```console paragraphs=2           the first two paragraphs;
#   ```console lines=9                the first nine lines.
#   ```console once                   of a help, names the options that an earlier block of the page shows with the same words, and
#                                     leaves out the examples and the exit codes;
#   ```console once options           and what stands behind the options, which another page of the book says.
#   ```toml file=docs/src/examples/engine.toml        shows the file.
set -euo pipefail
cd "$(dirname "$0")/.."
program=$(realpath "${SLIDEWAY:-target/release/slideway}")
[ $# -gt 0 ] || set -- README.md docs/src/*.md

# Commands run in a folder of their own, so that the files they write are not kept.
scratch=$(mktemp -d)
trap 'rm -r "$scratch"' EXIT
mkdir "$scratch/bin" "$scratch/run"
ln -s "$program" "$scratch/bin/slideway"
ln -s "$PWD/models" "$PWD/docs" "$PWD/crates" "$scratch/run"
export NO_COLOR=1 PATH="$scratch/bin:$PATH"

fault() {
    echo "$page: $*" >&2
    exit 1
}

# part FROM TO END: of standard input the parts FROM to TO, each of which ends with END (nothing: with an empty line).
part() {
    awk -v from="$1" -v to="$2" -v RS="$3" '
        NR >= from && NR <= to { print (NR > from && RS == "" ? "\n" : "") $0 }
        END { if (NR > to) print "..." }'
}

# once: a help on standard input without its examples and exit codes, and without the arguments and options that are in $scratch/options, to
# which it adds the others. once 1: also without what stands behind the options.
once() {
    awk -v known="$scratch/options" -v brief="${1:-0}" '
        function end_option() {
            key = option
            gsub(/[ \n]+/, " ", key)
            if (key in seen) {
                match(option, /--[a-z-]+|[<[][A-Z]+[]>]/)
                named = named (named == "" ? "" : ", ") substr(option, RSTART, RLENGTH)
            } else if (option != "") {
                printf "%s", option
                print key >>known
            }
            option = ""
        }
        function end_section() {
            end_option()
            if (named != "") print "  as above: " named "\n"
            named = ""
        }
        BEGIN { while ((getline line <known) > 0) seen[line] }
        /^[^ ]/ { end_section(); exits = exits || /^Exit codes:/; left_out = exits || /^Examples:/ || brief && options; options = options || /^Options:/ }
        left_out { next }
        /^(  -[a-zA-Z], |      )--|^  [<[]/ { end_option(); option = $0 "\n"; next }
        option != "" { option = option $0 "\n"; next }
        { print }
        END { end_section() }'
}

# show FENCE COMMAND: the command and its output.
show() {
    local expected=0 code=0 printed
    [[ $1 != *exit=* ]] || expected=${1#*exit=} expected=${expected%% *}
    case $2 in
        '$ slideway '*) ;;
        *) fault "a console block begins with '\$ slideway', not with: $2" ;;
    esac
    printed=$(cd "$scratch/run" && eval "${2#\$ }" </dev/null 2>&1) || code=$?
    [ "$code" -eq "$expected" ] || fault "$2: exit code $code, expected $expected; printed: $printed"
    case $1 in
        *answer=*) printed=$(part 2 2 "" <<<"$printed" | part 1 "${1#*answer=}" $'\n') ;;
        *answer*) printed=$(part 2 2 "" <<<"$printed") ;;
        *paragraphs=*) printed=$(part 1 "${1#*paragraphs=}" "" <<<"$printed") ;;
        *lines=*) printed=$(part 1 "${1#*lines=}" $'\n' <<<"$printed") ;;
        *once*options*) printed=$(once 1 <<<"$printed") ;;
        *once*) printed=$(once <<<"$printed") ;;
    esac
    [ -n "$printed" ] || fault "$2: nothing of what is printed is shown"
    printf '%s\n%s\n' "$2" "$printed"
}

# Rewrites the page on standard input.
rewrite() {
    local line command
    while IFS= read -r line; do
        printf '%s\n' "$line"
        case $line in
            '```console'*)
                IFS= read -r command || fault "a console block without a command"
                show "$line" "$command"
                ;;
            '```'*' file='*) cat "${line#* file=}" ;;
            *) continue ;;
        esac
        while IFS= read -r line && [ "$line" != '```' ]; do :; done
        [ "$line" = '```' ] || fault "a code block has no end"
        printf '```\n'
    done
}

for page in "$@"; do
    : >"$scratch/options"
    rewrite <"$page" >"$scratch/page"
    cmp -s "$scratch/page" "$page" || cat "$scratch/page" >"$page"
done
