#!/usr/bin/env bash
# expect_error.sh SOURCE.cpp COMPILER FLAGS...
# Passes if the compiler rejects the source with fewer than 20 lines of output that contain the text after "the error must contain: ". For
# sources about a shader, the output must also contain "the shader". Flags after "compile with: " in the source are appended to the command.
set -u
source=$1
shift
expected=$(sed -n 's/.*the error must contain: //p' "$source" | sed 's/\.$//')
[ -n "$expected" ] || { echo "$source does not say what the error must contain"; exit 1; }
read -ra flags <<< "$(sed -n 's/.*compile with: //p' "$source")"
if message=$("$@" "${flags[@]}" "$source" 2>&1); then
  echo "$source compiles; expected an error"
  exit 1
fi
lines=$(printf '%s\n' "$message" | wc -l)
printf '%s\n' "$message"
[ "$lines" -lt 20 ] || { echo "the error has $lines lines; expected fewer than 20"; exit 1; }
if grep -q "A shader" "$source"; then
  printf '%s\n' "$message" | grep -qF "the shader" || { echo "the error does not mention the shader"; exit 1; }
fi
printf '%s\n' "$message" | grep -qF -- "$expected" || { echo "the error does not contain '$expected'"; exit 1; }
