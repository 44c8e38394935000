# From the log of ctest with the output of tests that failed: their names once more, each with what its first failures say.
# Without this a reader of the end of a long log would see names alone.
/^ *[0-9]+\/[0-9]+ Test +#/ {
  failed = /\*\*\*(Failed|Timeout|Exception|Not Run)/
  if (failed) { sub(/ \.\.\.+/, " "); print; left = 0; shown = 0 }
  next
}
/^ *Start +[0-9]+: / { next }
/ tests passed, [0-9]+ tests? failed out of / { failed = 0 }
failed && /: Failure$/ && shown < 3 { ++shown; left = 12 }
failed && left > 0 { print "    " substr($0, 1, 300); --left }
