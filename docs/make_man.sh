#!/usr/bin/env bash
# The manual page, made of what the program says of itself, so that no command or option can be missing or stale.
# Usage: docs/make_man.sh PROGRAM >surefoot.1
set -euo pipefail

program=$1
version=$("$program" --version | head -n 1)

# Help of a command as roff: synopsis, positionals and options as tagged paragraphs, the footer line by line.
to_roff() {
  awk '
    function roff(s) { gsub(/\\/, "\\e", s); gsub(/-/, "\\-", s); gsub(/\047/, "\\(aq", s); return (s ~ /^\./ ? "\\\\&" : "") s }
    NR == 1 { about = $0; next }
    /^Usage: / { print ".B " roff(substr($0, 8)); print ".PP"; print roff(about) "."; next }
    /^[A-Z][a-z]*:$/ { part = $0; next }
    part != "" && /^  [^ ]/ {
      entry = substr($0, 3); text = ""
      if (match(entry, /  +/)) { text = substr(entry, RSTART + RLENGTH); entry = substr(entry, 1, RSTART - 1) }
      sub(/ Excludes: .*/, "", entry)
      word = entry; sub(/ .*/, "", word)
      value = part == "Positionals:" || word == entry ? "" : substr(entry, length(word) + 2)
      print ".TP"; print "\\fB" roff(word) "\\fR" (value == "" ? "" : " \\fI" roff(value) "\\fR")
      if (text != "") print roff(text)
      next
    }
    part != "" && /^   / { sub(/^ +/, ""); print roff($0); next }
    /^$/ { if (part == "footer") print ".PP"; else if (part != "") blank = 1; next }
    { if (part != "footer") { part = "footer"; print ".PP"; print ".nf" } print roff($0) }
    END { if (part == "footer") print ".fi" }'
}

cat <<END
.\" Made by docs/make_man.sh.
.TH SUREFOOT 1 "" "$version" "User Commands"
.SH NAME
surefoot \- quasistatic gait planner for a planar three\-legged robot
.SH SYNOPSIS
.B surefoot
.I COMMAND
[\fIOPTIONS\fR] ...
.br
.B surefoot
\fB\-\-help\fR | \fB\-h\fR | \fB\-\-version\fR
.SH DESCRIPTION
Plans how a planar three\-legged robot walks over uneven ground: which foot goes where and where the centre of mass is,
so that every stance and every move is stable under every disturbance force and torque of a declared box. Stability is
decided exactly for the numbers given, and no plan is printed that an independent verifier has not accepted.
.PP
A \fISCENE\fR is a YAML file, the name of a canned scene where no file has that name (\fBsurefoot maps\fR lists them),
or \fB\-\fR for standard input. \fBsurefoot\fR \fICOMMAND\fR \fB\-\-help\fR tells of one command what follows here.
.SH COMMANDS
END
"$program" --help | awk '/^Subcommands:/ { inside = 1; next } inside && /^$/ { exit } inside && /^  [^ ]/ { print $1 }' |
  while read -r command; do
    printf '.SS %s\n' "$command"
    "$program" "$command" --help | to_roff
  done
cat <<'END'
.SH EXIT STATUS
.TP
.B 0
solved; the plan holds; done
.TP
.B 1
no plan found within the limit; the plan does not hold
.TP
.B 2
bad input or usage, or output that cannot be written: one line on standard error that begins with
\(dqsurefoot: error:\(dq
.TP
.B 3
proven that there is no plan
.SH ENVIRONMENT
.TP
.B NO_COLOR
if set and not empty: no colour. There is none without a terminal, and neither colour nor progress with TERM=dumb.
.SH FILES
Canned scenes are looked for in ../share/surefoot/maps beside the folder of the program. The README, the formats of
scenes, plans and postures (formats.md) and all other documents are installed in ../share/doc/surefoot.
END
