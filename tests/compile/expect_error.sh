#!/usr/bin/env bash
# expect_error.sh SOURCE.cpp COMMAND...
# COMMAND is a compiler with its flags, or errors_of.py. Passes if it rejects the source with fewer than 20 lines of output, without the list
# of included files, that contain the text after each "the error must contain: ". For sources about a shader, the output must also contain
# "the shader". Flags after "compile with: " in the source are appended to the command.
set -u
source=$1
shift
mapfile -t expected < <(sed -n 's/.*the error must contain: //p' "$source" | sed 's/\.$//')
[ "${#expected[@]}" -gt 0 ] || { echo "$source does not say what the error must contain"; exit 1; }
read -ra flags <<< "$(sed -n 's/.*compile with: //p' "$source")"
message=$("$@" "${flags[@]}" "$source" 2>&1)
status=$?
lines=$(printf '%s\n' "$message" | grep -cvE '^(In file included| +) ?from ')  # which header was first does not matter
printf '%s\n' "$message"
[ "$status" -ne 0 ] || { echo "$source compiles; expected an error"; exit 1; }
[ "$status" -eq 1 ] || { echo "the compiler exits with $status; expected 1"; exit 1; }
[ "$lines" -lt 20 ] || { echo "the error has $lines lines; expected fewer than 20"; exit 1; }
if grep -q "A shader" "$source"; then
  printf '%s\n' "$message" | grep -qF "the shader" || { echo "the error does not mention the shader"; exit 1; }
fi
for text in "${expected[@]}"; do
  printf '%s\n' "$message" | grep -qF -- "$text" || { echo "the error does not contain '$text'"; exit 1; }
done
